//! The program a person types: plans a study, runs what is missing, reports.

fn main() -> std::process::ExitCode {
    cgaft::cli::main()
}
