//! Solids side by side: what differs, what it costs, what came out, how far from the finest.

use super::findings::{Moment, distance};
use super::surfaces::kept;
use super::{Analysed, reference};
use crate::report::numbers::{ABSENT, count, signed_percent, significant, whole};
use crate::report::overview::{Group, Row, differing};
use crate::report::units::{GIGAPASCAL, METRE_PER_SECOND, PERCENT};
use crate::units::amounts::duration;

/// Stands where a case is measured against itself.
const REFERENCE: &str = "reference";

/// The comparison, in the order in which it is read.
pub fn groups(cases: &[Analysed]) -> Vec<Group> {
    let results: Vec<_> = cases.iter().map(|case| case.result).collect();
    let mut groups = vec![
        Group {
            title: "What differs",
            rows: differing(&results),
        },
        Group {
            title: "What it costs",
            rows: costs(cases),
        },
        Group {
            title: "What comes out",
            rows: results_of(cases),
        },
        Group {
            title: "How far from the finest of the same experiment",
            rows: distances(cases),
        },
        Group {
            title: "Where the energy goes",
            rows: energies(cases),
        },
    ];
    let says_something = |row: &Row| row.cells.iter().any(|cell| cell != ABSENT && cell != REFERENCE);
    for group in &mut groups {
        group.rows.retain(says_something);
    }
    groups.retain(|group| !group.rows.is_empty());
    groups
}

fn row(cases: &[Analysed], label: &str, cell: impl Fn(&Analysed) -> Option<String>) -> Row {
    let cells = cases.iter().map(|case| cell(case).unwrap_or_else(|| ABSENT.to_owned()));
    Row {
        label: label.to_owned(),
        cells: cells.collect(),
    }
}

fn costs(cases: &[Analysed]) -> Vec<Row> {
    let three = |value: f64| significant(value, 3);
    vec![
        row(cases, "elements", |case| Some(case.solid.specimen.kinds.clone())),
        row(cases, "nodes", |case| Some(count(case.solid.specimen.nodes))),
        row(cases, "atoms represented", |case| {
            Some(count(case.solid.specimen.atoms))
        }),
        row(cases, "time step (ps)", |case| {
            case.result.manifest.time_step.map(three)
        }),
        row(cases, "steps", |case| case.result.manifest.steps.map(count)),
        row(cases, "wall time", |case| {
            case.result.manifest.wall_seconds.map(duration)
        }),
        row(cases, "core-seconds", |case| case.result.core_seconds().map(three)),
        row(cases, "memory (MB)", |case| {
            case.result.manifest.peak_memory.map(|bytes| three(bytes * 1e-6))
        }),
        row(cases, "million atom-steps per second", |case| {
            case.atom_steps_a_second().map(|pace| three(pace / 1e6))
        }),
    ]
}

fn results_of(cases: &[Analysed]) -> Vec<Row> {
    let three = |value: f64| significant(value, 3);
    let when = |moment: Moment| match moment.strain {
        Some(strain) => format!("{} % ({} ps)", three(strain * PERCENT), three(moment.time)),
        None => format!("{} ps", three(moment.time)),
    };
    vec![
        row(cases, "modulus (GPa)", |case| {
            case.findings.modulus.map(|modulus| three(modulus * GIGAPASCAL))
        }),
        row(cases, "greatest stress (GPa)", |case| {
            case.findings.peak.map(|peak| three(peak.stress * GIGAPASCAL))
        }),
        row(cases, "greatest stress at", |case| case.findings.peak.map(when)),
        row(cases, "bonds first change at", |case| {
            case.findings.first_break.map(when)
        }),
        row(cases, "stress there (GPa)", |case| {
            case.findings.first_break.map(|start| three(start.stress * GIGAPASCAL))
        }),
        row(cases, "bonds lost at the end", |case| case.findings.broken.map(whole)),
        row(cases, "borders of elements open at the end", |case| {
            let open = case.series()?.open_interfaces.last().copied()?;
            (open.is_finite() && case.solid.specimen.elements > case.solid.specimen.atoms_alone)
                .then(|| count(open as u64))
        }),
        row(cases, "crack at the end (nm²)", |case| {
            Some(three(case.surfaces.last()?.crack())).filter(|_| case.has_parted())
        }),
        row(cases, "slip at the end (nm²)", |case| {
            Some(three(case.surfaces.last()?.slip())).filter(|_| case.has_parted())
        }),
        row(cases, "front at the end (nm)", |case| {
            let [mean, least, most] = case.surfaces.last()?.front()?;
            (most > 0.0).then(|| format!("{} ({} to {})", three(mean), three(least), three(most)))
        }),
        row(cases, "fastest front (m/s)", |case| {
            let speeds = case.surfaces.iter().filter_map(|surface| surface.speed);
            let fastest = speeds.max_by(f64::total_cmp).filter(|&speed| speed > 0.0)?;
            Some(three(fastest * METRE_PER_SECOND))
        }),
        row(cases, "what keeps a direction", |case| {
            let kept = kept(&case.surfaces);
            let told: Vec<String> = kept
                .iter()
                .map(|kept| format!("{} {}°", kept.kind, significant(kept.degrees, 2)))
                .collect();
            (!told.is_empty()).then(|| told.join(", "))
        }),
        row(cases, "dislocated atoms at the end", |case| {
            Some(count(case.surfaces.last()?.atoms?.dislocated))
        }),
        row(cases, "period (ps)", |case| {
            let (period, seen) = case.findings.period?;
            Some(format!("{} over {} periods", significant(period, 4), seen))
        }),
        row(cases, "period of a thin bar of the crystal (ps)", |case| {
            let bar = case.solid.specimen.bar.filter(|_| case.findings.period.is_some())?;
            Some(significant(bar.period(bar.young_modulus), 4))
        }),
        row(cases, "Young's modulus at rest (GPa)", |case| {
            Some(significant(case.findings.modulus_at_rest? * GIGAPASCAL, 4))
        }),
        row(cases, "the same, over that of the crystal", |case| {
            Some(signed_percent(
                case.findings.modulus_at_rest? / case.solid.specimen.bar?.young_modulus - 1.0,
            ))
        }),
        row(cases, "period of a thin bar with it (ps)", |case| {
            Some(significant(
                case.solid.specimen.bar?.period(case.findings.modulus_at_rest?),
                4,
            ))
        }),
        row(cases, "highest temperature of atoms (K)", |case| {
            case.findings.temperature.map(three)
        }),
        row(cases, "wave speed from the first to the last gauge (m/s)", |case| {
            Some(significant(case.findings.wave_speed? * METRE_PER_SECOND, 5))
        }),
        row(cases, "the same, against that of long waves (%)", |case| {
            let share = case.findings.wave_speed? / case.solid.specimen.wave_speed?;
            Some(significant(PERCENT * (share - 1.0), 2))
        }),
        row(cases, "ended because", |case| case.result.manifest.end_reason.clone()),
    ]
}

fn distances(cases: &[Analysed]) -> Vec<Row> {
    let beside = |label: &str, told: &dyn Fn(&Analysed, &Analysed) -> Option<String>| {
        row(cases, label, |case| match reference(cases, case)? {
            finest if std::ptr::eq(case, finest) => Some(REFERENCE.to_owned()),
            finest => told(case, finest),
        })
    };
    let against = |label: &str, of: &dyn Fn(&Analysed) -> Option<f64>| {
        beside(label, &|case, finest| {
            Some(signed_percent(of(case)? / of(finest)? - 1.0))
        })
    };
    vec![
        against("modulus", &|case| case.findings.modulus),
        against("greatest stress", &|case| Some(case.findings.peak?.stress)),
        against("strain at the first change of bonds", &|case| {
            case.findings.first_break?.strain
        }),
        against("time of the first change of bonds", &|case| {
            Some(case.findings.first_break?.time)
        }),
        against("period", &|case| Some(case.findings.period?.0)),
        against("wave speed", &|case| case.findings.wave_speed),
        beside("curve of the stress, over its greatest", &|case, finest| {
            let far = curve_distance(case, finest)?;
            Some(format!("{} %", significant(PERCENT * far, 2)))
        }),
        beside("core-seconds of the finest over its own", &|case, finest| {
            let gain = finest.result.core_seconds()? / case.result.core_seconds()?;
            Some(significant(gain, 3))
        }),
    ]
}

/// How far the stress of a case is from that of another, both in the direction of their pull.
pub fn curve_distance(case: &Analysed, finest: &Analysed) -> Option<f64> {
    let [own, other] =
        [case, finest].map(|case| case.series().map(|series| series.pull(case.solid.specimen.direction)));
    distance(case.series()?, &own?, finest.series()?, &other?)
}

fn energies(cases: &[Analysed]) -> Vec<Row> {
    let last = |case: &Analysed, column: fn(&super::Series) -> &Vec<f64>| {
        let value = column(case.series()?).last().copied()?;
        Some(significant(value, 3))
    };
    vec![
        row(cases, "work of the loading (eV)", |case| {
            last(case, |series| &series.work)
        }),
        row(cases, "kinetic energy (eV)", |case| {
            last(case, |series| &series.kinetic)
        }),
        row(cases, "potential energy (eV)", |case| {
            last(case, |series| &series.potential)
        }),
        row(cases, "released at the cutoff (eV)", |case| {
            last(case, |series| &series.release)
        }),
        row(cases, "energy missing, over the work", |case| {
            case.energy_error().map(|error| significant(error, 2))
        }),
    ]
}
