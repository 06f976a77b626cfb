use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;

use super::write;
use crate::cli::survey::{self, OfResults};
use crate::cli::terminal::Terminal;
use crate::cli::{CliError, format};
use crate::export::ovito::{self, Sites};
use crate::record::frames::Vector;
use crate::record::{self, FIELDS_FILE};
use crate::report::ReportError;
use crate::store::State;
use crate::study::case::Body;

#[derive(Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    pub of: OfResults,
    /// The case; it must be done and have pictures
    #[arg(long, value_name = "CASE")]
    pub case: String,
    /// Folder for the file, made if it is missing
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub into: PathBuf,
    /// Write single atoms alone, without the sites that elements carry
    #[arg(long)]
    pub atoms: bool,
}

/// `cgaft export ovito FILE --case C`
pub fn ovito(arguments: &Arguments) -> Result<u8, CliError> {
    let OfResults { common, place } = &arguments.of;
    let survey = survey::survey(&common.study, &place.results)?;
    let case = survey::named(&survey.plan, &arguments.case)?;
    let entry = survey.entries.iter().find(|entry| entry.planned.name == case.name);
    let done = entry.filter(|entry| matches!(entry.state, State::Done(_)));
    let Some(entry) = done else {
        return Err(CliError::Input(format!(
            "case `{}` is not done; `cgaft study run {} --only {}` computes it",
            case.name, common.study, case.name
        )));
    };
    let fields = survey.store.run_folder(&entry.id).join(FIELDS_FILE);
    if !fields.exists() {
        return Err(CliError::Input(format!(
            "case `{}` took no pictures; write `observe: [{{snapshots: {{every: 0.5 % strain}}}}]` into the study and run it again",
            case.name
        )));
    }
    match case.case.body {
        Body::Slab(_) => pictures::<[f64; 2]>(arguments, &survey.plan.study, &fields),
        Body::Solid(_) => pictures::<[f64; 3]>(arguments, &survey.plan.study, &fields),
    }
}

/// Writes those of a file.
fn pictures<V: Vector>(arguments: &Arguments, study: &str, fields: &Path) -> Result<u8, CliError> {
    let (name, common) = (&arguments.case, &arguments.of.common);
    let read = |error| CliError::Report(ReportError::Read(error));
    let (mesh, frames) = record::read_fields::<V>(fields).map_err(read)?;
    let which = if arguments.atoms { Sites::Atoms } else { Sites::All };
    // A mesh that changes has most atoms at the end.
    let last = frames.times().len().checked_sub(1).map(|last| frames.frame(last));
    let last = last.transpose().map_err(read)?.and_then(|frame| frame.mesh);
    let sites = ovito::count(last.as_ref().unwrap_or(&mesh), which);
    if sites == 0 {
        return Err(CliError::Input(format!(
            "case `{name}` has no single atoms; leave out `--atoms`"
        )));
    }
    fs::create_dir_all(&arguments.into).map_err(|source| CliError::Output {
        what: arguments.into.display().to_string(),
        source,
    })?;
    let path = arguments.into.join(format!("{name}.xyz"));
    let number = frames.times().len();
    let mut damaged = None;
    write(&path, |out| {
        for index in 0..number {
            match frames.frame(index) {
                Ok(frame) => ovito::write(out, frame.mesh.as_ref().unwrap_or(&mesh), &frame, which)?,
                Err(error) => {
                    damaged = Some(error);
                    break;
                }
            }
        }
        Ok(())
    })?;
    if let Some(error) = damaged {
        return Err(read(error));
    }
    let json = json!({
        "study": study, "case": name, "file": path, "sites": sites, "pictures": number,
    });
    let terminal = Terminal {
        quiet: false,
        json: common.json,
    };
    terminal.result(&json, || {
        format!(
            "wrote {}: {} of {}; open it in OVITO, or with `ase.io.read(\"{}\", index=\":\")`\n",
            path.display(),
            format::count(number, "picture"),
            format::count(sites, "site"),
            path.display()
        )
    })?;
    Ok(0)
}
