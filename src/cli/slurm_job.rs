use clap::Args;

use super::survey::Place;
use super::terminal::Terminal;
use super::{CliError, progress};
use crate::executor::slurm::job::{self, Bell};
use crate::executor::{Ending, exit};
use crate::store::Store;

/// What a script of `study run --on slurm` says on a node.
#[derive(Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    place: Place,
    /// Name of the study
    study: String,
    /// Id of the case
    id: String,
}

/// `cgaft slurm-job`
pub fn slurm_job(arguments: &Arguments) -> Result<u8, CliError> {
    let Arguments { place, study, id } = arguments;
    let signals = |error| CliError::Environment(format!("cannot catch signals: {error}"));
    let bell = Bell::on_signals().map_err(signals)?;
    let store = Store::open(&place.results, study)?;
    let terminal = Terminal {
        quiet: false,
        json: false,
    };
    let mut watcher = progress::watcher(terminal, &store, &[]);
    let ending = job::carry_out(&store, id, &bell, watcher.as_mut())?;
    match ending {
        Some(Ending::Done(_) | Ending::DoneElsewhere(_)) => Ok(0),
        Some(Ending::Interrupted(_) | Ending::NotStarted) => Ok(exit::INTERRUPTED),
        Some(_) => Ok(1),
        None => Err(CliError::Input(format!(
            "no case {id} was handed over in {}; does this node see the same folder as the machine that submitted it?",
            store.root().display()
        ))),
    }
}
