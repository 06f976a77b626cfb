//! The program that computes one case; `cgaft` starts it, and so can a person.

fn main() -> std::process::ExitCode {
    cgaft::cli::solve::main()
}
