use clap::Args;
use serde_json::json;

use super::survey::{self, OfResults, Survey};
use super::terminal::Terminal;
use super::{CliError, format};
use crate::executor::slurm;
use crate::store::Leftover;

#[derive(Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    pub of: OfResults,
    /// Tell what would be removed, and change nothing
    #[arg(long)]
    pub dry_run: bool,
}

/// `cgaft study clean FILE`
pub fn clean(arguments: &Arguments) -> Result<u8, CliError> {
    let OfResults { common, place } = &arguments.of;
    let Survey { plan, store, entries } = survey::survey(&common.study, &place.results)?;
    let current = plan.cases.iter().map(|case| case.id.to_string()).collect();
    let names = plan.cases.iter().map(|case| case.name.clone()).collect();
    let on_slurm = entries.iter().filter(|entry| entry.is_on_slurm());
    let waiting = on_slurm.map(|entry| entry.id.clone()).collect();
    let leftovers = if arguments.dry_run {
        store.leftovers(&current, &waiting)?
    } else {
        slurm::forget(&store, &waiting)?;
        store.clean(&current, &waiting, &names)?
    };
    let removed = |leftover: &Leftover| !leftover.in_use && !arguments.dry_run;
    let entry = |leftover: &Leftover| {
        json!({
            "path": leftover.path, "what": leftover.what, "bytes": leftover.bytes, "in_use": leftover.in_use,
            "removed": removed(leftover),
        })
    };
    let entries: Vec<_> = leftovers.iter().map(entry).collect();
    let json = json!({ "study": plan.study, "runs": entries });
    Terminal {
        quiet: false,
        json: common.json,
    }
    .result(&json, || words(&leftovers, arguments.dry_run))?;
    Ok(0)
}

fn words(leftovers: &[Leftover], dry_run: bool) -> String {
    let verb = if dry_run { "would remove" } else { "removed" };
    let mut words = String::new();
    for leftover in leftovers {
        let doing = if leftover.in_use { "left, in use:" } else { verb };
        words.push_str(&format!(
            "{doing} {} {} ({})\n",
            leftover.what,
            leftover.path.display(),
            format::bytes(leftover.bytes)
        ));
    }
    let free: Vec<&Leftover> = leftovers.iter().filter(|leftover| !leftover.in_use).collect();
    match free.as_slice() {
        [] => words.push_str("nothing to remove\n"),
        [_] => (),
        several => {
            let bytes = several.iter().map(|leftover| leftover.bytes).sum();
            words.push_str(&format!("{verb} {} in all\n", format::bytes(bytes)));
        }
    }
    words
}
