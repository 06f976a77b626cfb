//! What a person types: one file a command.

mod cancel;
mod check;
mod choices;
mod clean;
mod cluster;
mod completions;
mod doctor;
mod error;
mod estimate;
mod export;
mod format;
mod man;
mod new;
mod plan;
mod prepare;
mod progress;
mod report;
mod room;
mod run;
mod schema;
mod slurm_job;
pub mod solve;
mod specimen;
mod status;
mod survey;
mod table;
mod terminal;
mod warnings;

pub use error::CliError;

use std::process::ExitCode;

use clap::error::{ContextKind, ContextValue};
use clap::{Parser, Subcommand};
use terminal::Terminal;

/// Coarse-grained atomistic dynamics of fracture: from a study file to a report.
///
/// Exit codes: 0 done, 1 a case failed or is damaged, 2 bad input, 3 something is missing on this machine,
/// 5 output could not be written, 130 interrupted.
#[derive(Debug, Parser)]
#[command(name = "cgaft", version, propagate_version = true, arg_required_else_help = true)]
struct Cgaft {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Run, check and report a study
    #[command(subcommand)]
    Study(StudyCommand),
    /// Write a case as input of another program
    #[command(subcommand)]
    Export(export::Command),
    /// Put one table of many studies together
    Table(table::Arguments),
    /// Print the JSON Schema of a study file, for editors
    Schema,
    /// Write a commented study to start from
    New(new::Arguments),
    /// Write man pages of both programs
    Man(man::Arguments),
    /// Print completions of both programs for a shell
    Completions(completions::Arguments),
    /// Tell what this machine has, and what to do about the rest
    Doctor(doctor::Arguments),
    /// Compute one case inside a job of Slurm; the scripts of `study run --on slurm` call it
    #[command(hide = true)]
    SlurmJob(slurm_job::Arguments),
}

#[derive(Debug, Subcommand)]
enum StudyCommand {
    /// Compute the cases that are missing, then build the report
    Run(prepare::Arguments),
    /// Validate a study and tell the size and cost of each case; computes nothing
    Check(survey::Common),
    /// Tell what would run, why, and the exact command
    Plan(plan::Arguments),
    /// Tell the state of every case
    Status(status::Arguments),
    /// End the jobs of a study on Slurm; those at work write a checkpoint first
    Cancel(survey::OfResults),
    /// Build tables, figures and report again from what is there
    Report(survey::OfResults),
    /// Remove unpublished and superseded runs
    Clean(clean::Arguments),
}

/// The whole of `cgaft`.
pub fn main() -> ExitCode {
    let command = Cgaft::try_parse().unwrap_or_else(|error| refuse(error)).command;
    let json = command.json();
    match command.carry_out() {
        Ok(code) => ExitCode::from(code),
        Err(error) => {
            terminal::warn(&error.render(terminal::color()));
            if json {
                // The exit code tells even if nobody reads this.
                let _ = Terminal { quiet: false, json }.result(&error.to_json(), String::new);
            }
            ExitCode::from(error.exit_code())
        }
    }
}

/// Tells a mistake in what was typed; who has left out `study` is told so.
fn refuse(mut error: clap::Error) -> ! {
    let typed = error.get(ContextKind::InvalidSubcommand);
    if let Some(ContextValue::String(word)) = typed
        && StudyCommand::has_subcommand(word)
    {
        let meant = vec![format!("study {word}")];
        error.insert(ContextKind::SuggestedSubcommand, ContextValue::Strings(meant));
    }
    error.exit()
}

impl Command {
    fn carry_out(self) -> Result<u8, CliError> {
        match self {
            Command::Study(StudyCommand::Run(arguments)) => run::run(&arguments),
            Command::Study(StudyCommand::Check(common)) => check::check(&common),
            Command::Study(StudyCommand::Plan(arguments)) => plan::plan(&arguments),
            Command::Study(StudyCommand::Status(arguments)) => status::status(&arguments),
            Command::Study(StudyCommand::Cancel(arguments)) => cancel::cancel(&arguments),
            Command::Study(StudyCommand::Report(arguments)) => report::rebuild_report(&arguments),
            Command::Study(StudyCommand::Clean(arguments)) => clean::clean(&arguments),
            Command::Export(export::Command::Lammps(arguments)) => export::lammps(&arguments),
            Command::Export(export::Command::Ovito(arguments)) => export::ovito::ovito(&arguments),
            Command::Table(arguments) => table::table(&arguments),
            Command::Schema => schema::schema(),
            Command::New(arguments) => new::new(&arguments),
            Command::Man(arguments) => man::man(&arguments),
            Command::Completions(arguments) => completions::completions(&arguments),
            Command::Doctor(arguments) => doctor::doctor(&arguments),
            Command::SlurmJob(arguments) => slurm_job::slurm_job(&arguments),
        }
    }

    fn json(&self) -> bool {
        match self {
            Command::Study(StudyCommand::Run(arguments)) => arguments.common.json,
            Command::Study(StudyCommand::Check(common)) => common.json,
            Command::Study(StudyCommand::Plan(arguments)) => arguments.of.common.json,
            Command::Study(StudyCommand::Status(arguments)) => arguments.of.common.json,
            Command::Study(StudyCommand::Cancel(arguments)) => arguments.common.json,
            Command::Study(StudyCommand::Report(arguments)) => arguments.common.json,
            Command::Study(StudyCommand::Clean(arguments)) => arguments.of.common.json,
            Command::Export(export::Command::Lammps(arguments)) => arguments.common.json,
            Command::Export(export::Command::Ovito(arguments)) => arguments.of.common.json,
            Command::Doctor(arguments) => arguments.json,
            _ => false,
        }
    }
}
