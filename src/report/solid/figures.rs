//! The line charts of solids.

use super::series::{along, component};
use super::surfaces::Surface;
use super::{Analysed, Series};
use crate::report::chart::{Chart, Content, Curve};
use crate::report::units::{GIGAPASCAL, METRE_PER_SECOND, PERCENT};

/// Whether a report may have drawn a file of this name.
pub fn is_of_a_report(name: &str) -> bool {
    const COMMON: [&str; 9] = [
        "stress",
        "broken-bonds",
        "crack",
        "front",
        "slip",
        "dislocated",
        "force",
        "temperature",
        "energy-imbalance",
    ];
    let id = name.strip_suffix(".svg").unwrap_or_default();
    COMMON.contains(&id) || id.starts_with("gauges-") || id.starts_with("energy-")
}

/// All charts that have something to show.
pub fn charts(cases: &[Analysed]) -> Vec<Chart> {
    let mut charts = vec![
        stress(cases),
        broken(cases),
        picture_by_picture(cases, &CRACK),
        picture_by_picture(cases, &FRONT),
        picture_by_picture(cases, &SLIP),
        picture_by_picture(cases, &DISLOCATED),
        force(cases),
        temperature(cases),
        imbalance(cases),
    ];
    charts.extend(cases.iter().flat_map(gauges));
    charts.extend(cases.iter().map(energies));
    charts.retain_mut(|chart| match &mut chart.content {
        Content::Curves(curves) => {
            let says_something = |curve: &Curve| {
                let finite = curve.points.iter().filter(|point| point.1.is_finite());
                finite.clone().count() > 1 && finite.clone().any(|point| point.1 != 0.0)
            };
            curves.retain(says_something);
            !curves.is_empty()
        }
        Content::Points(_) | Content::Ranks(_) => true,
    });
    charts
}

/// What all cases are drawn over: the strain where each has one.
fn abscissa(cases: &[Analysed]) -> (bool, String) {
    let mut known = cases.iter().filter_map(Analysed::series);
    match known.clone().next().is_some() && known.all(|series| series.is_driven) {
        true => (true, "nominal strain (%)".to_owned()),
        false => (false, "time (ps)".to_owned()),
    }
}

fn curves(cases: &[Analysed], of: impl Fn(&Analysed, &Series) -> Vec<f64>) -> Content {
    let (by_strain, _) = abscissa(cases);
    let curve = |(style, case): (usize, &Analysed)| {
        let points = case.series().map(|series| {
            let x = if by_strain {
                series.percent()
            } else {
                series.time.clone()
            };
            x.into_iter().zip(of(case, series)).collect()
        });
        Curve {
            label: case.name().to_owned(),
            style,
            points: points.unwrap_or_default(),
            ..Curve::default()
        }
    };
    Content::Curves(cases.iter().enumerate().map(curve).collect())
}

fn chart(cases: &[Analysed], id: &str, title: &str, caption: &str, y: &str, content: Content) -> Chart {
    Chart {
        id: id.to_owned(),
        title: title.to_owned(),
        caption: caption.to_owned(),
        detail: false,
        table: "series",
        x: abscissa(cases).1,
        y: y.to_owned(),
        content,
    }
}

fn stress(cases: &[Analysed]) -> Chart {
    chart(
        cases,
        "stress",
        "Average stress",
        "Mean virial stress of the whole specimen, of a slab between its grips, in the direction in which the loading pulls. Curves that lie on each other \
         show that the coarser mesh is as stiff as the finer and carries the same waves.",
        "average stress (GPa)",
        curves(cases, |case, series| {
            let pull = series.pull(case.solid.specimen.direction);
            pull.into_iter().map(|stress| stress * GIGAPASCAL).collect()
        }),
    )
}

fn broken(cases: &[Analysed]) -> Chart {
    chart(
        cases,
        "broken-bonds",
        "Bonds lost",
        "Pairs of atoms that have left the cutoff since the start, less those that have come within it: cracks and slip break \
         bonds, and what is pressed together gains some.",
        "bonds lost",
        curves(cases, |_, series| {
            let start = series.broken.first().copied().unwrap_or(0.0);
            series.broken.iter().map(|broken| broken - start).collect()
        }),
    )
}

/// What is read of pictures.
struct OfPictures {
    id: &'static str,
    title: &'static str,
    caption: &'static str,
    y: &'static str,
    of: fn(&Surface) -> Option<f64>,
}

const CRACK: OfPictures = OfPictures {
    id: "crack",
    title: "Area of the crack",
    caption: "Faces of elements and bonds of atoms that have opened and hang together with the notch, or with each other where \
              there is none.",
    y: "crack (nm²)",
    of: |surface| Some(surface.crack()),
};

const FRONT: OfPictures = OfPictures {
    id: "front",
    title: "Front of the crack",
    caption: "How far the crack has come from the notch, as the mean over strips along its front.",
    y: "front (nm)",
    of: |surface| Some(surface.front()?[0]),
};

const SLIP: OfPictures = OfPictures {
    id: "slip",
    title: "Area of slip",
    caption: "Faces and bonds whose sides have moved along each other by more than half a partial dislocation, and touch.",
    y: "slip (nm²)",
    of: |surface| Some(surface.slip()),
};

const DISLOCATED: OfPictures = OfPictures {
    id: "dislocated",
    title: "Dislocated atoms",
    caption: "Atoms in stacking faults and cores of dislocations, by centrosymmetry; of cases of atoms alone.",
    y: "dislocated atoms",
    of: |surface| Some(surface.atoms?.dislocated as f64),
};

fn picture_by_picture(cases: &[Analysed], chart: &OfPictures) -> Chart {
    let (by_strain, _) = abscissa(cases);
    let point = |surface: &Surface| {
        let x = if by_strain {
            PERCENT * surface.strain?
        } else {
            surface.time
        };
        Some((x, (chart.of)(surface)?))
    };
    let curve = |(style, case): (usize, &Analysed)| Curve {
        label: case.name().to_owned(),
        style,
        points: case.surfaces.iter().filter_map(point).collect(),
        ..Curve::default()
    };
    let content = Content::Curves(cases.iter().enumerate().map(curve).collect());
    Chart {
        table: "surfaces",
        ..self::chart(cases, chart.id, chart.title, chart.caption, chart.y, content)
    }
}

fn force(cases: &[Analysed]) -> Chart {
    chart(
        cases,
        "force",
        "Force of the loading",
        "Force with which the loading acts on the solid, in the direction in which it pulls.",
        "force (nN)",
        curves(cases, |case, series| {
            let direction = case.solid.specimen.direction;
            let along = |force: &[f64; 3]| (0..3).map(|axis| force[axis] * direction[axis]).sum::<f64>();
            series.force.iter().map(|force| along(force) * NANONEWTON).collect()
        }),
    )
}

/// 1 eV/nm in nN. [CODATA 2018]
const NANONEWTON: f64 = 0.160_217_663_4;

fn temperature(cases: &[Analysed]) -> Chart {
    chart(
        cases,
        "temperature",
        "Temperature of the atoms",
        "Kinetic temperature of the single atoms, where there are any, by the mean of their kinetic energies.",
        "temperature (K)",
        curves(cases, |_, series| series.temperature.clone()),
    )
}

fn imbalance(cases: &[Analysed]) -> Chart {
    chart(
        cases,
        "energy-imbalance",
        "Energy that is missing",
        "Kinetic and potential energy less the work of the loading and what pairs released at the cutoff, over the greatest \
         work: the error of the computation. Nothing works on what stands still at rest.",
        "missing over greatest work (%)",
        curves(cases, |case, series| {
            if case.findings.modulus_at_rest.is_some() {
                return Vec::new();
            }
            let most = series.work.iter().fold(0.0, |most: f64, work| most.max(work.abs()));
            let start =
                series.kinetic.first().copied().unwrap_or(0.0) + series.potential.first().copied().unwrap_or(0.0);
            let missing = |probe: usize| {
                let held = series.kinetic[probe] + series.potential[probe] - start;
                100.0 * (held - series.work[probe] - series.release[probe]) / most
            };
            (0..series.time.len()).map(missing).collect()
        }),
    )
}

/// Stress and velocity at the gauges of a case, over time.
fn gauges(case: &Analysed) -> Vec<Chart> {
    let Some(series) = case.series().filter(|series| !series.gauges.is_empty()) else {
        return Vec::new();
    };
    let direction = case.solid.specimen.direction;
    let curves = |of: &dyn Fn(&super::Gauge) -> Vec<f64>| {
        let curve = |(style, gauge): (usize, &super::Gauge)| Curve {
            label: format!("{} nm", gauge.at),
            style,
            points: series.time.iter().copied().zip(of(gauge)).collect(),
            ..Curve::default()
        };
        Content::Curves(series.gauges.iter().enumerate().map(curve).collect())
    };
    let of = |kind: &str, y: &str, content: Content| Chart {
        id: format!("gauges-{kind}-{}", case.file_part()),
        title: format!("{kind} at the gauges: {}", case.name()),
        caption: format!("Mean {kind} over planes across the specimen, in the direction in which the loading pulls."),
        detail: false,
        table: "gauges",
        x: "time (ps)".to_owned(),
        y: y.to_owned(),
        content,
    };
    let speed = |velocity: &[f64; 3]| component(velocity, direction) * METRE_PER_SECOND;
    vec![
        of(
            "stress",
            "stress (GPa)",
            curves(&|gauge| {
                gauge
                    .stress
                    .iter()
                    .map(|stress| along(stress, direction) * GIGAPASCAL)
                    .collect()
            }),
        ),
        of(
            "velocity",
            "velocity (m/s)",
            curves(&|gauge| gauge.velocity.iter().map(speed).collect()),
        ),
    ]
}

/// A column of the series.
type Column = fn(&Series) -> &Vec<f64>;

fn energies(case: &Analysed) -> Chart {
    let series = case.series();
    let curve = |(style, (label, of)): (usize, (&str, Column))| Curve {
        label: label.to_owned(),
        style,
        points: series.map_or_else(Vec::new, |series| {
            let start = of(series).first().copied().unwrap_or(0.0);
            let rise = of(series).iter().map(|value| value - start);
            series.time.iter().copied().zip(rise).collect()
        }),
        ..Curve::default()
    };
    let parts: [(&str, Column); 4] = [
        ("work", |series| &series.work),
        ("kinetic", |series| &series.kinetic),
        ("potential", |series| &series.potential),
        ("cutoff release", |series| &series.release),
    ];
    Chart {
        id: format!("energy-{}", case.file_part()),
        title: format!("Energies of {}", case.name()),
        caption: "Work of the loading, and where it went, since the start.".to_owned(),
        detail: true,
        table: "series",
        x: "time (ps)".to_owned(),
        y: "energy (eV)".to_owned(),
        content: Content::Curves(parts.into_iter().enumerate().map(curve).collect()),
    }
}
