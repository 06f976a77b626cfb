pub mod ovito;

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use serde_json::json;

use super::CliError;
use super::survey::{self, Common};
use super::terminal::Terminal;
use crate::domain::Ranks;
use crate::export::lammps::{Crystal, ExportError, Model, Motion, SolidModel, Times};
use crate::loading::Grip;
use crate::plan::{Plan, PlannedCase};
use crate::setup::slab::loading::grip;
use crate::setup::{self, SetupError};
use crate::solver::{Body as _, Solver, Until};
use crate::state::State;
use crate::study::case::{self, Body};

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
    let no_equal = |error: ExportError| CliError::Input(format!("case `{}`: {error}", planned.name));
    let case = &planned.case;
    let input = Input {
        arguments,
        plan: &plan,
        planned,
    };
    match &case.body {
        Body::Slab(slab) => {
            let Some(rate) = slab.loading.strain_rate() else {
                return Err(CliError::Input(format!(
                    "case `{}`: a pulse on a slab is not written for LAMMPS in this version; export a case that is pulled with a \
                     `strain-rate`, or the pulse of a solid",
                    planned.name
                )));
            };
            let material = setup::slab::material(slab).map_err(refused)?;
            let solver = setup::slab::solver(case, slab).map_err(refused)?;
            let model = Model::new(case, slab, &material, solver.mesh()).map_err(no_equal)?;
            let motion = motion(case, rate, grip(slab), &solver);
            let script = |head: &[String]| model.script(head, &planned.name, &motion);
            input.write(&model.crystal, slab_remarks(case, slab), script, solver.state())
        }
        Body::Solid(solid) => {
            let material = setup::solid::material(solid).map_err(refused)?;
            let solver = setup::solid::solver(case, solid, Ranks::alone()).map_err(refused)?;
            let body = solver.body();
            let size = (solver.state().nodes(), body.setting().volume);
            let model = SolidModel::new(case, solid, &material, size, body.load().acts()).map_err(no_equal)?;
            let times = times(case, setup::solid::strain_rate(solid), solver.time_step()[0]);
            let script = |head: &[String]| model.script(head, &planned.name, &times);
            input.write(&model.crystal, Vec::new(), script, solver.state())
        }
    }
}

/// What becomes a script and a data file.
struct Input<'a> {
    arguments: &'a Arguments,
    plan: &'a Plan,
    planned: &'a PlannedCase,
}

impl Input<'_> {
    /// Writes both. `remarks` are paragraphs of the head of the script.
    fn write<const D: usize>(
        &self,
        crystal: &Crystal,
        remarks: Vec<&str>,
        script: impl Fn(&[String]) -> String,
        state: &State<D>,
    ) -> Result<u8, CliError> {
        let Self {
            arguments,
            plan,
            planned,
        } = self;
        let [script_file, data_file] = ["in", "data"].map(|kind| format!("{kind}.{}", planned.name));
        let [script_path, data_path] = [&script_file, &data_file].map(|file| arguments.into.join(file));
        let script = script(&self.head(&script_file, remarks));
        let title = format!(
            "LAMMPS data of case `{}` of study `{}`, for {script_file}",
            planned.name, plan.study
        );
        fs::create_dir_all(&arguments.into).map_err(|source| CliError::Output {
            what: arguments.into.display().to_string(),
            source,
        })?;
        write(&script_path, |out| out.write_all(script.as_bytes()))?;
        write(&data_path, |out| crystal.write_data(&title, state, out))?;

        let json = json!({
            "study": plan.study, "case": planned.name, "script": script_path, "data": data_path,
            "atoms": state.nodes(),
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
                state.nodes()
            )
        })?;
        Ok(0)
    }

    /// What the script is, and where its run differs from that of cgaft.
    fn head(&self, script_file: &str, remarks: Vec<&str>) -> Vec<String> {
        let Self { plan, planned, .. } = self;
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
        let of_step = "The time step is the one cgaft starts with; cgaft shortens it should the specimen stiffen.";
        let is_auto = matches!(planned.case.run.time_step, case::TimeStep::Auto { .. });
        for remark in is_auto.then_some(of_step).into_iter().chain(remarks) {
            head.push(String::new());
            head.extend(remark.lines().map(str::to_owned));
        }
        head
    }
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

/// Where the run of a slab differs from that of cgaft.
fn slab_remarks(case: &case::Case, slab: &case::Slab) -> Vec<&'static str> {
    let until = &case.run.until;
    let (has_sponge, is_damped) = match slab.loading {
        case::Loading::StrainRate { sponge, damping, .. } => (sponge.is_some(), damping.is_some()),
        case::Loading::Pulse { .. } => (false, false),
    };
    let crack_stops = [
        until.crack_length,
        until.arrest,
        until.after_branch,
        until.leaves_the_plane,
    ];
    let remarks = [
        (
            has_sponge,
            "The sponge layers of the case are left out: its waves come back from the grips.",
        ),
        (
            is_damped,
            "The damping of the case is left out: it gets as hot as it gets.",
        ),
        (
            crack_stops.iter().any(Option::is_some),
            "The run ends at its strain or time: LAMMPS does not follow the crack, so it does not end at a\n\
             crack length, at an arrest, after a branch or off its plane, as the case asks cgaft to.",
        ),
    ];
    remarks
        .into_iter()
        .filter(|(is_so, _)| *is_so)
        .map(|(_, remark)| remark)
        .collect()
}

fn motion(case: &case::Case, rate: f64, grip: Grip, solver: &Solver) -> Motion {
    Motion {
        rate,
        grip,
        times: times(case, Some(rate), solver.time_step()[0]),
    }
}

/// Of a case that is strained at a rate, 1/ps, or at none that is known before.
fn times(case: &case::Case, rate: Option<f64>, time_step: f64) -> Times {
    let until = Until {
        strain: case.run.until.strain.filter(|_| rate.is_some()),
        time: case.run.until.time,
        ..Until::default()
    };
    let time_of = |strain: f64| rate.map_or(f64::INFINITY, |rate| strain / rate);
    let steps = until.steps(0, 0.0, time_step, time_of);
    let interval = |time: f64| ((time / time_step).round() as u64).clamp(1, steps.max(1));
    Times {
        time_step,
        steps,
        probe_every: interval(case.probes.every),
        snapshot_every: match case.snapshots.every {
            None => steps.max(1),
            Some(case::SnapshotInterval::Strain(strain)) => interval(time_of(strain)),
            Some(case::SnapshotInterval::Time(time)) => interval(time),
        },
    }
}
