use std::path::Path;
use std::thread;

use clap::Args;
use serde_json::json;

use super::terminal::Terminal;
use super::{CliError, format};
use crate::durable;
use crate::executor::exit;
use crate::executor::launch;
use crate::executor::mpi::{self, Speaks};
use crate::executor::probe::output_of;

#[derive(Args, Debug)]
pub struct Arguments {
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}

/// `cgaft doctor`: a line each, with what to do where something is missing.
pub fn doctor(arguments: &Arguments) -> Result<u8, CliError> {
    let findings = [solver(), cores(), memory(), hdf5(), mpi(), slurm(), python()];
    let missing = findings.iter().any(|finding| finding.needed_and_missing);
    let row = |finding: &Finding| {
        vec![
            finding.mark().to_owned(),
            finding.what.to_owned(),
            finding.words.clone(),
        ]
    };
    let told = |finding: &Finding| {
        json!({
            "what": finding.what, "state": finding.mark(), "words": finding.words,
        })
    };
    let json = json!({ "ok": !missing, "findings": findings.each_ref().map(told) });
    let terminal = Terminal {
        quiet: false,
        json: arguments.json,
    };
    terminal.result(&json, || format::list(&findings.each_ref().map(row)))?;
    Ok(if missing { exit::MISSING_ENVIRONMENT } else { 0 })
}

struct Finding {
    what: &'static str,
    here: bool,
    needed_and_missing: bool,
    /// What was found, or what to do about it.
    words: String,
}

impl Finding {
    /// `-` is not here, and not needed.
    fn mark(&self) -> &'static str {
        if self.needed_and_missing {
            "missing"
        } else if self.here {
            "ok"
        } else {
            "-"
        }
    }
}

fn found(what: &'static str, words: String) -> Finding {
    Finding {
        what,
        here: true,
        needed_and_missing: false,
        words,
    }
}

fn optional(what: &'static str, advice: &str) -> Finding {
    Finding {
        what,
        here: false,
        needed_and_missing: false,
        words: advice.to_owned(),
    }
}

fn solver() -> Finding {
    match launch::find_solver() {
        Ok(path) => found("cgaft-solve", path.display().to_string()),
        Err(error) => Finding {
            what: "cgaft-solve",
            here: false,
            needed_and_missing: true,
            words: error.to_string(),
        },
    }
}

fn cores() -> Finding {
    let cores = thread::available_parallelism().map_or(1, usize::from);
    found(
        "cores",
        format!("{cores}, all used by `cgaft study run` unless --jobs or --threads say otherwise"),
    )
}

fn memory() -> Finding {
    let text = durable::read_to_string(Path::new("/proc/meminfo")).unwrap_or_default();
    let kibibytes = |key: &str| {
        let line = text.lines().find(|line| line.starts_with(key))?;
        line.split_whitespace().nth(1)?.parse::<u64>().ok()
    };
    match (kibibytes("MemTotal:"), kibibytes("MemAvailable:")) {
        (Some(total), Some(available)) => found(
            "memory",
            format!(
                "{}, {} free",
                format::bytes(1024 * total),
                format::bytes(1024 * available)
            ),
        ),
        _ => optional("memory", "this system does not tell how much there is"),
    }
}

fn hdf5() -> Finding {
    let advice = "linked into this program; building it again needs libhdf5-dev and pkg-config (`make setup`)";
    let version = first_line("pkg-config", &["--modversion", "hdf5"]);
    version.map_or_else(|| optional("HDF5", advice), |version| found("HDF5", version))
}

/// Both the one who starts ranks and the one who is started must know MPI.
fn mpi() -> Finding {
    let solver = launch::find_solver().map_or(Speaks::Nothing, |solver| mpi::of_solver(&solver));
    match (mpi::of_mpirun(), solver) {
        (Some(mpirun), Speaks::Mpi(library)) => found("MPI", format!("{mpirun}, cgaft-solve built with {library}")),
        (None, Speaks::Mpi(library)) => {
            let words = format!(
                "cgaft-solve built with {library}, but no mpirun on the PATH: cases use threads; for ranks, install \
                 openmpi-bin"
            );
            optional("MPI", &words)
        }
        (Some(mpirun), _) => {
            let words =
                format!("{mpirun}, but cgaft-solve was built without MPI: cases use threads; for ranks, `make build`");
            optional("MPI", &words)
        }
        (None, _) => optional(
            "MPI",
            "not found: cases use threads; for ranks, install openmpi-bin and `make build`",
        ),
    }
}

fn slurm() -> Finding {
    let advice = "not found; cases run on this machine, and `--on slurm` needs a machine with sbatch";
    let Some(version) = first_line("sbatch", &["--version"]) else {
        return optional("Slurm", advice);
    };
    match output_of("squeue", &["--noheader"]) {
        Some(_) => found("Slurm", version),
        None => {
            let words = format!(
                "{version}, but no controller answers `squeue`: cases run on this machine; ask who runs the cluster"
            );
            optional("Slurm", &words)
        }
    }
}

/// Only to check that others can read the files; the project's own environment comes first.
fn python() -> Finding {
    let own = Path::new("target/python/bin/python");
    let python = if own.exists() {
        own.as_os_str()
    } else {
        "python3".as_ref()
    };
    let script = "import h5py, vtk; print('h5py', h5py.__version__ + ', vtk', vtk.VTK_VERSION)";
    let advice = "without h5py and vtk, which only the tests of this project need: `make test` installs them there";
    output_of(python, &["-c", script]).map_or_else(|| optional("python", advice), |versions| found("python", versions))
}

fn first_line(program: &str, arguments: &[&str]) -> Option<String> {
    output_of(program, arguments)?.lines().next().map(str::to_owned)
}
