pub mod ovito;

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use serde_json::json;

use super::CliError;
use super::survey::{self, Common};
use super::terminal::Terminal;
use crate::export::lammps::{Model, Motion};
use crate::loading::Grip;
use crate::plan::{Plan, PlannedCase};
use crate::setup::{self, SetupError};
use crate::solver::{Solver, Until};
use crate::study::case;

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Write the LAMMPS input script and data file of an all-atom case
    Lammps(Arguments),
    /// Write the pictures of a case as extended XYZ, for OVITO and ASE
    Ovito(ovito::Arguments),
}

#[derive(Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    pub common: Common,
    /// The case; its resolution must be single atoms
    #[arg(long, value_name = "CASE")]
    pub case: String,
    /// Folder for the two files, made if it is missing
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub into: PathBuf,
}

/// `cgaft export lammps FILE --case C`
pub fn lammps(arguments: &Arguments) -> Result<u8, CliError> {
    let plan = survey::read(&arguments.common.study)?;
    let planned = survey::named(&plan, &arguments.case)?;
    let refused = |why: SetupError| plan.refuse([(planned.name.as_str(), why.refusal())]);
    let case = &planned.case;
    let slab = case.slab().ok_or_else(|| {
        CliError::Input(format!(
            "case `{}` is a solid, and the input of LAMMPS is written for slabs; export a case of the triangular lattice",
            planned.name
        ))
    })?;
    let material = setup::slab::material(slab).map_err(refused)?;
    let solver = setup::slab::solver(case, slab).map_err(refused)?;
    let model = Model::new(case, slab, &material, solver.mesh())
        .map_err(|error| CliError::Input(format!("case `{}`: {error}", planned.name)))?;

    let [script_file, data_file] = ["in", "data"].map(|kind| format!("{kind}.{}", planned.name));
    let [script_path, data_path] = [&script_file, &data_file].map(|file| arguments.into.join(file));
    let script = model.script(
        &head(&plan, planned, slab, &script_file),
        &planned.name,
        &motion(case, slab, &solver),
    );
    let title = format!(
        "LAMMPS data of case `{}` of study `{}`, for {script_file}",
        planned.name, plan.study
    );
    fs::create_dir_all(&arguments.into).map_err(|source| CliError::Output {
        what: arguments.into.display().to_string(),
        source,
    })?;
    write(&script_path, |out| out.write_all(script.as_bytes()))?;
    write(&data_path, |out| model.write_data(&title, solver.state(), out))?;

    let json = json!({
        "study": plan.study, "case": planned.name, "script": script_path, "data": data_path,
        "atoms": solver.state().nodes(),
    });
    let terminal = Terminal {
        quiet: false,
        json: arguments.common.json,
    };
    terminal.result(&json, || {
        let folder = arguments.into.display();
        format!(
            "wrote {} and {}: {} atoms\nrun it: cd {folder} && lmp -in {script_file}\n",
            script_path.display(),
            data_path.display(),
            solver.state().nodes()
        )
    })?;
    Ok(0)
}

/// Writes a new file; what a person may have edited is never overwritten.
fn write(path: &Path, content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> Result<(), CliError> {
    let written = File::create_new(path).and_then(|file| {
        let mut out = BufWriter::new(file);
        content(&mut out)?;
        out.flush()
    });
    written.map_err(|source| {
        let what = path.display().to_string();
        if source.kind() == io::ErrorKind::AlreadyExists {
            CliError::Input(format!(
                "{what} exists already; choose another folder with --into, or remove it first"
            ))
        } else {
            CliError::Output { what, source }
        }
    })
}

/// What the script is, and where its run differs from that of cgaft.
fn head(plan: &Plan, planned: &PlannedCase, slab: &case::Slab, script_file: &str) -> Vec<String> {
    let until = &planned.case.run.until;
    let mut head = vec![
        format!(
            "LAMMPS input of an all-atom case of a study, written by cgaft {}",
            env!("CARGO_PKG_VERSION")
        ),
        String::new(),
        format!("study   {} ({})", plan.study, plan.file()),
        format!("case    {} ({})", planned.name, planned.id),
        format!("run     lmp -in {script_file}"),
    ];
    if let case::TimeStep::Auto { .. } = planned.case.run.time_step {
        head.push(String::new());
        head.push(
            "The time step is the one cgaft starts with; cgaft shortens it should the specimen stiffen.".to_owned(),
        );
    }
    let case::Loading::StrainRate { sponge, damping, .. } = slab.loading;
    if sponge.is_some() {
        head.push(String::new());
        head.push("The sponge layers of the case are left out: its waves come back from the grips.".to_owned());
    }
    if damping.is_some() {
        head.push(String::new());
        head.push("The damping of the case is left out: it gets as hot as it gets.".to_owned());
    }
    let crack_stops = [
        until.crack_length,
        until.arrest,
        until.after_branch,
        until.leaves_the_plane,
    ];
    if crack_stops.iter().any(Option::is_some) {
        head.push(String::new());
        head.push(
            "The run ends at its strain or time: LAMMPS does not follow the crack, so it does not end at a".to_owned(),
        );
        head.push("crack length, at an arrest, after a branch or off its plane, as the case asks cgaft to.".to_owned());
    }
    head
}

fn motion(case: &case::Case, slab: &case::Slab, solver: &Solver) -> Motion {
    let case::Loading::StrainRate { rate, .. } = slab.loading;
    let [time_step, _] = solver.time_step();
    let until = Until {
        strain: case.run.until.strain,
        time: case.run.until.time,
        ..Until::default()
    };
    let steps = until.steps(0, 0.0, time_step, |strain| strain / rate);
    let interval = |time: f64| ((time / time_step).round() as u64).clamp(1, steps.max(1));
    Motion {
        rate,
        grip: match slab.specimen.grips {
            case::Grips::Clamped => Grip::Clamped,
            case::Grips::Sliding => Grip::Sliding,
        },
        time_step,
        steps,
        probe_every: interval(case.probes.every),
        snapshot_every: match case.snapshots.every {
            None => steps.max(1),
            Some(case::SnapshotInterval::Strain(strain)) => interval(strain / rate),
            Some(case::SnapshotInterval::Time(time)) => interval(time),
        },
    }
}
