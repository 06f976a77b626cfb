use clap::Args;
use serde_json::json;

use super::survey::{self, Common, Place};
use super::terminal::Terminal;
use super::{CliError, format};
use crate::store::{Removed, Store};

#[derive(Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub place: Place,
}

/// `cgaft study clean FILE`
pub fn clean(arguments: &Arguments) -> Result<u8, CliError> {
    let plan = survey::read(&arguments.common.study)?;
    let store = Store::open(&arguments.place.results, &plan.study)?;
    let current = plan.cases.iter().map(|case| case.id.to_string()).collect();
    let names = plan.cases.iter().map(|case| case.name.clone()).collect();
    let removed = store.clean(&current, &names)?;
    let entries: Vec<_> = removed
        .iter()
        .map(|entry| json!({ "path": entry.path, "what": entry.what, "bytes": entry.bytes, "removed": entry.removed }))
        .collect();
    let json = json!({ "study": plan.study, "runs": entries });
    Terminal {
        quiet: false,
        json: arguments.common.json,
    }
    .result(&json, || words(&removed))?;
    Ok(0)
}

fn words(removed: &[Removed]) -> String {
    let mut words = String::new();
    for entry in removed {
        let doing = if entry.removed { "removed" } else { "left, in use:" };
        words.push_str(&format!(
            "{doing} {} {} ({})\n",
            entry.what,
            entry.path.display(),
            format::bytes(entry.bytes)
        ));
    }
    if removed.is_empty() {
        words.push_str("nothing to remove\n");
    }
    words
}
