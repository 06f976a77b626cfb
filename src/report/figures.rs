//! The line charts of a report.

mod arrivals;
mod sweep;

use super::Analysed;
use super::chart::{Chart, Content, Curve};
use super::refined::is_refined;
use super::sweep::{Look, looks};
use super::tables::speed_against_error;
use super::units::{GIGAPASCAL, PERCENT};
use crate::analysis::series::Probe;
use crate::analysis::speed::Speed;
use crate::plan::Comparison;

/// All charts that have something to show.
pub fn charts(cases: &[Analysed], comparisons: &[Comparison]) -> Vec<Chart> {
    let mut charts = sweep::charts(cases, comparisons);
    charts.extend(speed_against_error::charts(cases, comparisons));
    charts.extend([
        stress_strain(cases),
        temperature(cases),
        crack_speed(cases),
        tip_position(cases),
        profile(cases),
        traction(cases),
        nodes(cases),
        imbalance(cases),
    ]);
    charts.extend(cases.iter().map(energies));
    charts.extend(arrivals::charts(cases));
    charts.retain_mut(|chart| match &mut chart.content {
        Content::Curves(curves) => {
            curves.retain(|curve| curve.points.iter().any(|point| point.1.is_finite()));
            !curves.is_empty()
        }
        Content::Points(_) | Content::Ranks(_) => true,
    });
    charts
}

/// Whether a report may have drawn a file of this name.
pub fn is_of_a_report(name: &str) -> bool {
    const COMMON: [&str; 8] = [
        "stress-strain",
        "temperature",
        "crack-speed",
        "tip-position",
        "stress-profile",
        "traction-profile",
        "nodes",
        "energy-imbalance",
    ];
    let id = name.strip_suffix(".svg").unwrap_or_default();
    COMMON.contains(&id)
        || id.starts_with(sweep::START)
        || id.starts_with("speed-against-error-")
        || id.starts_with("scaling-")
        || id.starts_with("arrivals-")
        || id.starts_with("energy-")
}

/// One curve per case: by colour and dashes of what a sweep varies.
fn curves(cases: &[Analysed], points: impl Fn(&Analysed) -> Vec<(f64, f64)>) -> Vec<Curve> {
    let curve = |(case, look): (&Analysed, Look)| Curve {
        label: case.name().to_owned(),
        style: look.style,
        points: points(case),
        key: look.key,
        ..Curve::default()
    };
    cases.iter().zip(looks(cases)).map(curve).collect()
}

/// Points of a quantity over the strain in percent.
fn over_strain(case: &Analysed, of: impl Fn(&Probe) -> f64) -> Vec<(f64, f64)> {
    case.result
        .series
        .probes
        .iter()
        .map(|row| (row.strain * PERCENT, of(row)))
        .collect()
}

fn stress_strain(cases: &[Analysed]) -> Chart {
    Chart {
        id: "stress-strain".to_owned(),
        detail: false,
        table: "stress_strain",
        title: "Average stress over strain".to_owned(),
        caption: match cases.iter().any(Analysed::has_crack) {
            true => {
                "Average virial stress across the crack plane of everything between the grips, over the nominal strain. \
                 Curves that lie on each other below initiation show that the coarser mesh is as stiff as the finer; the \
                 drop is the crack."
            }
            false => {
                "Average virial stress, in the direction of the pull, of everything between the grips, over the nominal \
                 strain. Curves that lie on each other show that the coarser mesh is as stiff as the finer."
            }
        }
        .to_owned(),
        x: "nominal strain (%)".to_owned(),
        y: "average σyy (GPa)".to_owned(),
        content: Content::Curves(curves(cases, |case| over_strain(case, |row| row.sigma_yy * GIGAPASCAL))),
    }
}

fn temperature(cases: &[Analysed]) -> Chart {
    Chart {
        id: "temperature".to_owned(),
        detail: false,
        table: "stress_strain",
        title: "Temperature over strain".to_owned(),
        caption:
            "How fast atoms move relative to the mean of the cell of 8 by 8 rows around them. Meshes without atoms \
                  have no such motion and no curve."
                .to_owned(),
        x: "nominal strain (%)".to_owned(),
        y: "temperature (K)".to_owned(),
        content: Content::Curves(curves(cases, |case| over_strain(case, |row| row.temperature))),
    }
}

fn crack_speed(cases: &[Analysed]) -> Chart {
    let speed = |case: &Analysed| {
        let rows = case.result.series.probes.iter().zip(&case.findings.speeds);
        let share = |speed: &Option<Speed>| {
            speed
                .zip(case.rayleigh_speed())
                .map_or(f64::NAN, |(speed, rayleigh)| speed.value / rayleigh)
        };
        rows.map(|(row, speed)| (row.strain * PERCENT, share(speed))).collect()
    };
    Chart {
        id: "crack-speed".to_owned(),
        detail: false,
        table: "crack_speed",
        title: "Crack speed over strain".to_owned(),
        caption:
            "Speed of the foremost tip along the crack, over the Rayleigh speed of this lattice. There is no curve \
                  before the crack starts. The window of the fit is stated under Method."
                .to_owned(),
        x: "nominal strain (%)".to_owned(),
        y: "crack speed / c_R".to_owned(),
        content: Content::Curves(curves(cases, speed)),
    }
}

fn tip_position(cases: &[Analysed]) -> Chart {
    let position = |case: &Analysed| {
        let rows = case.result.series.probes.iter().zip(&case.findings.tips);
        rows.map(|(row, tip)| (row.time, tip.x)).collect()
    };
    Chart {
        id: "tip-position".to_owned(),
        detail: false,
        table: "crack_speed",
        title: "Tip position over time".to_owned(),
        caption: "Distance of the foremost tip from the left edge, in the reference configuration.".to_owned(),
        x: "time (ps)".to_owned(),
        y: "tip x (nm)".to_owned(),
        content: Content::Curves(curves(cases, position)),
    }
}

fn profile(cases: &[Analysed]) -> Chart {
    let stress = |case: &Analysed| {
        let bins = case.findings.ahead.iter();
        bins.map(|bin| (bin.distance, bin.stress[1] * GIGAPASCAL)).collect()
    };
    Chart {
        id: "stress-profile".to_owned(),
        detail: false,
        table: "stress_profile",
        title: "Stress ahead of the tip at initiation".to_owned(),
        caption: "Virial stress across the crack plane ahead of the tip, at the last probe before the crack starts. \
                  Its fall with the root of the distance gives the stress intensity."
            .to_owned(),
        x: "distance ahead of the tip (nm)".to_owned(),
        y: "σyy (GPa)".to_owned(),
        content: Content::Curves(curves(cases, stress)),
    }
}

fn traction(cases: &[Analysed]) -> Chart {
    let traction = |case: &Analysed| {
        let bins = case.findings.ahead.iter();
        bins.filter_map(|bin| Some((bin.distance, bin.traction?[1] * GIGAPASCAL)))
            .collect()
    };
    Chart {
        id: "traction-profile".to_owned(),
        detail: false,
        table: "stress_profile",
        title: "Traction ahead of the tip at initiation".to_owned(),
        caption:
            "What pulls across the crack plane itself at the same moments: the forces of the bonds that cross it, \
                  over the area. It is a stress whatever the mesh; the virial stress is a mean over elements."
                .to_owned(),
        x: "distance ahead of the tip (nm)".to_owned(),
        y: "traction (GPa)".to_owned(),
        content: Content::Curves(curves(cases, traction)),
    }
}

/// Of cases whose elements become atoms on the way.
fn nodes(cases: &[Analysed]) -> Chart {
    let nodes = |case: &Analysed| {
        let rows = case.result.series.probes.iter().filter(|_| is_refined(case));
        rows.map(|row| (row.time, row.nodes)).collect()
    };
    Chart {
        id: "nodes".to_owned(),
        detail: false,
        table: "stress_strain",
        title: "Nodes over time".to_owned(),
        caption:
            "Elements become atoms where their strain differs too much from that of their neighbours, and the layers \
                  around them with them. Each rise is a new mesh."
                .to_owned(),
        x: "time (ps)".to_owned(),
        y: "nodes".to_owned(),
        content: Content::Curves(curves(cases, nodes)),
    }
}

fn imbalance(cases: &[Analysed]) -> Chart {
    let error = |case: &Analysed| {
        let work = case
            .result
            .series
            .probes
            .iter()
            .map(|row| row.work.abs())
            .fold(0.0, f64::max);
        let start = case.result.series.probes.first().map_or(0.0, balance);
        over_strain(case, |row| {
            if work > 0.0 {
                (balance(row) - start) / work * PERCENT
            } else {
                f64::NAN
            }
        })
    };
    Chart {
        id: "energy-imbalance".to_owned(),
        detail: true,
        table: "stress_strain",
        title: "Energy imbalance over strain".to_owned(),
        caption: "Kinetic and potential energy gained, less the work of the grips and what the cutoff released, over \
                  the largest work. It would be zero with an infinitely short time step."
            .to_owned(),
        x: "nominal strain (%)".to_owned(),
        y: "imbalance (% of work)".to_owned(),
        content: Content::Curves(curves(cases, error)),
    }
}

fn balance(row: &Probe) -> f64 {
    row.kinetic + row.potential - row.work - row.cutoff_release - gained(row)
}

/// What came with finer meshes, eV; older versions had none.
fn gained(row: &Probe) -> f64 {
    if row.refined_energy.is_nan() {
        0.0
    } else {
        row.refined_energy
    }
}

fn energies(case: &Analysed) -> Chart {
    let probes = &case.result.series.probes;
    let start = probes.first().copied().unwrap_or_default();
    let largest = probes
        .iter()
        .map(|row| row.work.abs().max(row.potential.abs()))
        .fold(0.0, f64::max);
    let (unit, size) = [("MeV", 1e6), ("keV", 1e3)]
        .into_iter()
        .find(|unit| largest >= unit.1)
        .unwrap_or(("eV", 1.0));
    let curve = |style, label: &str, of: &dyn Fn(&Probe) -> f64| Curve {
        label: label.to_owned(),
        style,
        points: over_strain(case, |row| of(row) / size),
        ..Curve::default()
    };
    let mut curves = vec![
        curve(0, "grip work", &|row| row.work),
        curve(1, "potential", &|row| row.potential),
        curve(2, "kinetic", &|row| row.kinetic - start.kinetic),
        curve(3, "cutoff release", &|row| row.cutoff_release),
    ];
    if is_refined(case) {
        curves.push(curve(4, "refined", &gained));
    }
    Chart {
        id: format!("energy-{}", case.file_part()),
        detail: true,
        table: "stress_strain",
        title: format!("Energy ledger of {}", case.name()),
        caption: format!(
            "Where the work of the grips goes in {}: strain energy{}. Kinetic energy is counted from the start.",
            case.name(),
            match case.has_crack() {
                true => " until the crack starts, then surfaces and motion",
                false => " and motion",
            }
        ),
        x: "nominal strain (%)".to_owned(),
        y: format!("energy ({unit})"),
        content: Content::Curves(curves),
    }
}
