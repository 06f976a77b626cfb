//! The layout of a time series in HDF5, and the published file that holds it.
//!
//! One dataset a column, in the internal units that its attribute `units` names, so that reading gives the same
//! bits: `probes/time`, `profiles/x`, `profiles/stress` (probe, bin, component), `bonds/column`, ...

use std::path::Path;

use hdf5::Group;

use super::RecordError;
use super::arrays::{Packing, get, get_column, get_rows, new_group, put};
use super::bonds::{get_bonds, put_bonds};
use super::provenance::put_provenance;
use super::rows::{Described, Rows};
use super::sealed::{self, Seal};
use super::setting::{get_setting, put_setting};
use crate::analysis::series::{Probe, Series, Setting};

/// The series of a finished run and what is needed to understand it.
pub fn read_series<S: Described>(path: &Path) -> Result<(S, S::Rows), RecordError> {
    let file = sealed::open(path, SEAL)?;
    let damaged = |cause| RecordError::damaged(path, cause);
    Ok((S::get(&file).map_err(damaged)?, S::Rows::get(&file).map_err(damaged)?))
}

/// Counterpart of [`read_series`].
pub(super) fn write_series<S: Described>(
    path: &Path,
    case_id: &str,
    setting: &S,
    series: &S::Rows,
) -> Result<(), RecordError> {
    sealed::write(path, SEAL, |file| {
        put_provenance(file, case_id)?;
        setting.put(file)?;
        series.put(file)
    })
}

/// The step of the last row of a finished run; `None` where there is no row.
pub(super) fn last_step(path: &Path) -> Result<Option<u64>, RecordError> {
    let file = sealed::open(path, SEAL)?;
    let steps: hdf5::Result<Vec<u64>> = file.group("probes").and_then(|probes| get(&probes, "step"));
    let steps = steps.map_err(|cause| RecordError::damaged(path, cause))?;
    Ok(steps.last().copied())
}

const SEAL: Seal = Seal {
    kind: "series",
    format: 1,
    case_id: "",
};

impl Described for Setting {
    type Rows = Series;

    fn put(&self, group: &Group) -> hdf5::Result<()> {
        put_setting(group, self)
    }

    fn get(group: &Group) -> hdf5::Result<Self> {
        get_setting(group)
    }
}

impl Rows for Series {
    fn put(&self, group: &Group) -> hdf5::Result<()> {
        put_series(group, self)
    }

    fn get(group: &Group) -> hdf5::Result<Self> {
        get_series(group)
    }

    fn steps(&self) -> Vec<u64> {
        self.probes.iter().map(|probe| probe.step).collect()
    }

    fn append(&mut self, mut part: Self) -> Result<(), String> {
        if !self.probes.is_empty() && part.profile_x != self.profile_x {
            return Err("the bins of its profiles are not those of the segments before it".to_owned());
        }
        if !self.probes.is_empty() && part.gauge_places != self.gauge_places {
            return Err("its wave gauges do not stand where those of the segments before it do".to_owned());
        }
        self.profile_x = part.profile_x;
        self.gauge_places = part.gauge_places;
        append_all(&mut self.probes, &mut part.probes);
        append_all(&mut self.profiles, &mut part.profiles);
        append_all(&mut self.tractions, &mut part.tractions);
        append_all(&mut self.gauges, &mut part.gauges);
        append_all(&mut self.bonds, &mut part.bonds);
        Ok(())
    }

    fn truncate(&mut self, rows: usize, first: u64) {
        self.probes.truncate(rows);
        self.profiles.truncate(rows * self.profile_x.len());
        self.tractions.truncate(rows * self.profile_x.len());
        self.gauges.truncate(rows * self.gauge_places.len());
        self.bonds.retain(|bond| u64::from(bond.probe) < first + rows as u64);
    }
}

/// With no more memory than the rows need: the profiles of a long run are large.
fn append_all<T>(rows: &mut Vec<T>, more: &mut Vec<T>) {
    rows.reserve_exact(more.len());
    rows.append(more);
}

/// Name, unit and place of a column.
type Column = (&'static str, &'static str, fn(&mut Probe) -> &mut f64);

const COLUMNS: [Column; 11] = [
    ("time", "ps", |probe| &mut probe.time),
    ("strain", "1", |probe| &mut probe.strain),
    ("sigma_xx", "eV/nm^3", |probe| &mut probe.sigma_xx),
    ("sigma_yy", "eV/nm^3", |probe| &mut probe.sigma_yy),
    ("sigma_xy", "eV/nm^3", |probe| &mut probe.sigma_xy),
    ("grip_stress", "eV/nm^3", |probe| &mut probe.grip_stress),
    ("kinetic", "eV", |probe| &mut probe.kinetic),
    ("potential", "eV", |probe| &mut probe.potential),
    ("work", "eV", |probe| &mut probe.work),
    ("cutoff_release", "eV", |probe| &mut probe.cutoff_release),
    ("temperature", "K", |probe| &mut probe.temperature),
];

/// Columns that files written before there were any do not have; not a number there.
const LATER_COLUMNS: [Column; 6] = [
    ("j_integral_inner", "eV/nm", |probe| &mut probe.j_integral[0]),
    ("j_integral_middle", "eV/nm", |probe| &mut probe.j_integral[1]),
    ("j_integral_outer", "eV/nm", |probe| &mut probe.j_integral[2]),
    ("refined_energy", "eV", |probe| &mut probe.refined_energy),
    ("nodes", "1", |probe| &mut probe.nodes),
    ("outruns", "1", |probe| &mut probe.outruns),
];

fn put_series(parent: &Group, series: &Series) -> hdf5::Result<()> {
    let Series {
        probes,
        profile_x,
        profiles,
        tractions,
        gauge_places,
        gauges,
        bonds,
    } = series;
    put_probes(&new_group(parent, "probes")?, probes)?;

    let group = new_group(parent, "profiles")?;
    let shape = [probes.len(), profile_x.len(), 3];
    put(&group, "x", "nm", &[profile_x.len()], profile_x, Packing::Deflated)?;
    put(
        &group,
        "stress",
        "eV/nm^3",
        &shape,
        profiles.as_flattened(),
        Packing::Deflated,
    )?;
    let shape = [tractions.len() / profile_x.len().max(1), profile_x.len(), 2];
    put(
        &group,
        "traction",
        "eV/nm^3",
        &shape,
        tractions.as_flattened(),
        Packing::Deflated,
    )?;

    let group = new_group(parent, "gauges")?;
    let count = gauge_places.len();
    put(
        &group,
        "place",
        "nm",
        &[count, 2],
        gauge_places.as_flattened(),
        Packing::Deflated,
    )?;
    let part = |from: usize, width: usize| -> Vec<f64> {
        let rows = gauges.iter().flat_map(|row| &row[from..from + width]);
        rows.copied().collect()
    };
    let shape = |width: usize| [probes.len(), count, width];
    put(&group, "velocity", "nm/ps", &shape(2), &part(0, 2), Packing::Deflated)?;
    put(&group, "stress", "eV/nm^3", &shape(3), &part(2, 3), Packing::Deflated)?;

    put_bonds(&new_group(parent, "bonds")?, bonds)
}

fn get_series(parent: &Group) -> hdf5::Result<Series> {
    let profiles = parent.group("profiles")?;
    let mut series = Series {
        probes: get_probes(&parent.group("probes")?)?,
        profile_x: get(&profiles, "x")?,
        profiles: get_rows(&profiles, "stress")?,
        tractions: match profiles.link_exists("traction") {
            true => get_rows(&profiles, "traction")?,
            // Written before there were any.
            false => Vec::new(),
        },
        bonds: get_bonds(&parent.group("bonds")?)?,
        ..Series::default()
    };
    get_gauges(parent, &mut series)?;
    Ok(series)
}

/// Places and readings; none in files written before there were any.
fn get_gauges(parent: &Group, series: &mut Series) -> hdf5::Result<()> {
    if !parent.link_exists("gauges") {
        return Ok(());
    }
    let group = parent.group("gauges")?;
    let velocity: Vec<[f64; 2]> = get_rows(&group, "velocity")?;
    let stress: Vec<[f64; 3]> = get_rows(&group, "stress")?;
    if velocity.len() != stress.len() {
        return Err("the gauges have not as many velocities as stresses".into());
    }
    let rows = velocity.iter().zip(&stress);
    series.gauges = rows.map(|(v, s)| [v[0], v[1], s[0], s[1], s[2]]).collect();
    series.gauge_places = get_rows(&group, "place")?;
    Ok(())
}

fn put_probes(group: &Group, probes: &[Probe]) -> hdf5::Result<()> {
    let shape = [probes.len()];
    let step: Vec<u64> = probes.iter().map(|probe| probe.step).collect();
    put(group, "step", "1", &shape, &step, Packing::Deflated)?;
    for (name, unit, place) in COLUMNS.into_iter().chain(LATER_COLUMNS) {
        let column: Vec<f64> = probes.iter().map(|probe| *place(&mut probe.clone())).collect();
        put(group, name, unit, &shape, &column, Packing::Deflated)?;
    }
    Ok(())
}

fn get_probes(group: &Group) -> hdf5::Result<Vec<Probe>> {
    let step: Vec<u64> = get(group, "step")?;
    let length = step.len();
    let mut probes: Vec<Probe> = step
        .into_iter()
        .map(|step| Probe {
            step,
            ..Probe::default()
        })
        .collect();
    for (name, _, place) in COLUMNS {
        for (probe, number) in probes.iter_mut().zip(get_column::<f64>(group, name, length)?) {
            *place(probe) = number;
        }
    }
    for (name, _, place) in LATER_COLUMNS {
        let column = match group.link_exists(name) {
            true => get_column::<f64>(group, name, length)?,
            false => vec![f64::NAN; length],
        };
        for (probe, number) in probes.iter_mut().zip(column) {
            *place(probe) = number;
        }
    }
    Ok(probes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_series_from_before_there_were_rings_and_gauges_is_read_without_them() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("series.h5");
        let series = Series {
            probes: vec![Probe {
                time: 3.0,
                j_integral: [1.0; 3],
                ..Probe::default()
            }],
            gauge_places: vec![[1.0, 2.0]],
            gauges: vec![[1.0; 5]],
            ..Series::default()
        };
        let write = |group: &Group| {
            put_series(group, &series)?;
            group.unlink("gauges")?;
            let probes = group.group("probes")?;
            LATER_COLUMNS.iter().try_for_each(|column| probes.unlink(column.0))
        };
        sealed::write(&path, SEAL, write).unwrap();
        let found = get_series(&sealed::open(&path, SEAL).unwrap()).unwrap();
        assert_eq!(found.probes[0].time, 3.0);
        assert!(found.probes[0].j_integral.iter().all(|j| j.is_nan()));
        assert!(found.gauge_places.is_empty() && found.gauges.is_empty());
    }
}
