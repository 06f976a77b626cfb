//! Slabs under a pulse as the report wants them: as solids, whose columns it shares.

use std::path::Path;

use crate::analysis::series::{Series as Rows, Setting};
use crate::material::WaveSpeeds;
use crate::record::{self, RecordError, SERIES_FILE};
use crate::report::CaseResult;
use crate::report::solid::{Gauge, Series, Specimen};
use crate::setup::slab::estimate::Specimen as Laid;
use crate::setup::slab::material;
use crate::study::case::solid::{PulseShape, Side};
use crate::study::case::{Grips, Loading, Slab};
use crate::units::{self, Dimension};

/// Tells of the specimen of a slab.
pub fn tell(result: &mut CaseResult, slab: &Slab, laid: &Laid) {
    let told = result.solid.get_or_insert_default();
    let [length, width] = [laid.geometry.length, laid.geometry.width].map(|size| size.actual);
    told.specimen = Specimen {
        edges: vec![("length", length), ("width", width)],
        kinds: match laid.elements - laid.atoms_alone {
            0 => format!("{} atoms", laid.atoms_alone),
            triangles if laid.atoms_alone == 0 => format!("{triangles} triangles"),
            triangles => format!("{triangles} triangles, {} atoms", laid.atoms_alone),
        },
        notch: "none".to_owned(),
        held: match slab.specimen.grips {
            Grips::Clamped => "both grips, along x and y".to_owned(),
            Grips::Sliding => "both grips, along y".to_owned(),
        },
        loading: loading(slab),
        direction: [1.0, 0.0, 0.0],
        is_relaxed: result.choices.iter().any(|(key, _)| key.starts_with("run.relax")),
        spacing: material(slab).map_or(f64::NAN, |material| material.spacing),
        nodes: laid.nodes,
        elements: laid.elements,
        atoms: laid.atoms,
        atoms_alone: laid.atoms_alone,
        leftover_share: laid.leftovers.map(|leftovers| leftovers.share()),
        computation: laid.computation,
        wave_speed: material(slab)
            .ok()
            .map(|material| WaveSpeeds::of(&material).longitudinal),
        ..Specimen::default()
    };
}

/// `10 MPa of pressure on x-low, a Gaussian of 40 ps`
fn loading(slab: &Slab) -> String {
    let Loading::Pulse {
        face,
        pressure,
        shape,
        duration,
    } = slab.loading
    else {
        return String::new();
    };
    let face = match face {
        Side::Low => "x-low",
        Side::High => "x-high",
    };
    let shape = match shape {
        PulseShape::HalfSine => "half a sine",
        PulseShape::Gaussian => "a Gaussian",
    };
    format!(
        "{} of pressure on {face}, {shape} of {}",
        units::format(pressure, Dimension::Stress),
        units::format(duration, Dimension::Time)
    )
}

/// Reads what a run has left.
pub fn read(result: &mut CaseResult, folder: &Path) -> Result<(), RecordError> {
    let (_, rows): (Setting, Rows) = record::read_series(&folder.join(SERIES_FILE))?;
    result.solid.get_or_insert_default().series = Some(series(&rows));
    Ok(())
}

/// Not a number where a sheet has no such component.
fn series(rows: &Rows) -> Series {
    let column = |of: fn(&crate::analysis::series::Probe) -> f64| rows.probes.iter().map(of).collect::<Vec<f64>>();
    let absent = vec![f64::NAN; rows.probes.len()];
    let mut broken = vec![0.0; rows.probes.len()];
    for bond in &rows.bonds {
        broken[bond.probe as usize] += if bond.broken { 1.0 } else { -1.0 };
    }
    (1..broken.len()).for_each(|probe| broken[probe] += broken[probe - 1]);
    let tensor = |[xx, yy, xy]: [f64; 3]| [xx, yy, f64::NAN, f64::NAN, f64::NAN, xy];
    let places = rows.gauge_places.len();
    Series {
        is_driven: false,
        time: column(|probe| probe.time),
        strain: column(|probe| probe.strain),
        stress: rows
            .probes
            .iter()
            .map(|probe| tensor([probe.sigma_xx, probe.sigma_yy, probe.sigma_xy]))
            .collect(),
        kinetic: column(|probe| probe.kinetic),
        potential: column(|probe| probe.potential),
        work: column(|probe| probe.work),
        release: column(|probe| probe.cutoff_release),
        force: vec![[f64::NAN; 3]; rows.probes.len()],
        broken,
        open_interfaces: absent,
        temperature: column(|probe| probe.temperature),
        gauges: (0..places)
            .map(|gauge| {
                let read = rows.gauges.iter().skip(gauge).step_by(places);
                Gauge {
                    at: rows.gauge_places[gauge][0],
                    velocity: read.clone().map(|&[x, y, ..]| [x, y, f64::NAN]).collect(),
                    stress: read.map(|&[_, _, xx, yy, xy]| tensor([xx, yy, xy])).collect(),
                }
            })
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::series::{BondEvent, Probe};

    #[test]
    fn gauges_of_a_slab_are_told_one_by_one_and_its_bonds_are_counted_on() {
        let bond = |probe: u32, broken: bool| BondEvent {
            probe,
            column: 1,
            row: 1,
            direction: 0,
            broken,
        };
        let rows = Rows {
            probes: vec![Probe::default(); 3],
            gauge_places: vec![[20.0, 0.0], [60.0, 0.0]],
            gauges: (0..6)
                .map(|row| [f64::from(row), 0.0, 10.0 * f64::from(row), 0.0, 0.5])
                .collect(),
            bonds: vec![bond(1, true), bond(1, true), bond(2, false)],
            ..Rows::default()
        };
        let found = series(&rows);
        assert_eq!(found.broken, [0.0, 2.0, 1.0]);
        let second = &found.gauges[1];
        assert_eq!(second.at, 60.0);
        assert_eq!(
            second.velocity.iter().map(|velocity| velocity[0]).collect::<Vec<_>>(),
            [1.0, 3.0, 5.0]
        );
        assert_eq!(second.stress[2][0], 50.0);
        // What a sheet has not does not hide what it has.
        assert_eq!(crate::report::solid::along(&second.stress[2], [1.0, 0.0, 0.0]), 50.0);
    }
}
