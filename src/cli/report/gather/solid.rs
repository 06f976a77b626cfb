//! Solids as the report wants them.

use std::path::Path;

use crate::analysis::columns::{Columns, SolidSetting};
use crate::cli::specimen::solid::{intensity, kinds, notch};
use crate::record::{self, FIELDS_FILE, RecordError, SERIES_FILE};
use crate::report::solid::specimen::Bar;
use crate::report::solid::{Crystal, Gauge, Series, Specimen};
use crate::report::{CaseResult, Film};
use crate::setup::solid::{LOADING, Specimen as Laid, bar, gauge_name, lay_out, material};
use crate::study::case::Solid;
use crate::study::case::solid::Loading;

/// Tells of the specimen of a solid.
pub fn tell(result: &mut CaseResult, solid: &Solid, laid: &Laid) {
    let told = result.solid.get_or_insert_default();
    told.specimen = Specimen {
        edges: laid.edges.iter().map(|(name, length)| (*name, length.actual)).collect(),
        kinds: kinds(laid),
        notch: notch(laid),
        intensity: intensity(laid),
        held: laid.held.clone().unwrap_or_else(|| "nothing".to_owned()),
        loading: laid.loading.clone(),
        direction: laid.direction,
        bar: bar(solid).map(|bar| Bar {
            along: bar.along,
            length: bar.length,
            cross_section: bar.cross_section,
            density: bar.density,
            young_modulus: bar.young_modulus,
        }),
        is_relaxed: result.choices.iter().any(|(key, _)| key.starts_with("run.relax")),
        spacing: laid.spacing,
        nodes: laid.nodes,
        elements: laid.elements,
        blocks: laid.blocks.map(|blocks| {
            let all: u64 = blocks.into_iter().map(u64::from).product();
            all - laid.slot.unwrap_or(0)
        }),
        atoms: laid.sites,
        atoms_alone: laid
            .kinds
            .iter()
            .filter(|kind| kind.size == 1)
            .map(|kind| kind.number)
            .sum(),
        leftover_share: laid.leftover_share,
        computation: laid.computation,
        wave_speed: None,
    };
}

/// Reads what a run of a solid has left.
pub fn read(result: &mut CaseResult, solid: &Solid, folder: &Path, with_film: bool) -> Result<(), RecordError> {
    let (setting, columns) = record::read_series::<SolidSetting>(&folder.join(SERIES_FILE))?;
    let told = result.solid.get_or_insert_default();
    told.series = Some(series(solid, &setting, &columns));
    told.crystal = crystal(solid);
    let fields = folder.join(FIELDS_FILE);
    if with_film && fields.exists() {
        let (mesh, frames) = record::read_fields(&fields)?;
        told.film = Some(Film::stored(mesh, frames));
    }
    Ok(())
}

fn crystal(solid: &Solid) -> Option<Crystal> {
    let material = material(solid).ok()?;
    let laid = lay_out(solid, material.spacing).ok()?;
    let struck = match solid.loading {
        Loading::Impact { face, center, .. } => {
            Some([center.unwrap_or_else(|| laid.before(face, 0.0)), laid.outward(face)])
        }
        _ => None,
    };
    Some(Crystal {
        struck,
        breaking_length: material.breaking_length(),
        plan: laid.plan,
    })
}

fn series(solid: &Solid, setting: &SolidSetting, columns: &Columns) -> Series {
    let rows = columns.steps.len();
    let column = |name: &str| columns.get(name).map_or_else(|| vec![f64::NAN; rows], <[f64]>::to_vec);
    let release = column("cutoff_release");
    // Under a potential that ends without a jump no energy tells of bonds.
    let jump = material(solid).map_or(0.0, |material| material.interaction.jump_at_cutoff());
    let broken = match jump {
        0.0 => column("open_interfaces"),
        jump => release.iter().map(|release| (release / -jump).round()).collect(),
    };
    let gauges = solid.gauges.iter().flat_map(|gauges| gauges.at.iter().enumerate());
    Series {
        is_driven: setting.strain_rate.is_finite(),
        time: column("time"),
        strain: column("strain"),
        stress: rows_of(columns, "sigma", &TENSOR),
        kinetic: column("kinetic"),
        potential: column("potential"),
        work: column("work"),
        force: rows_of(columns, &format!("{LOADING}_force"), &VECTOR),
        temperature: column("temperature"),
        open_interfaces: column("open_interfaces"),
        release,
        broken,
        gauges: gauges
            .map(|(place, &at)| {
                let name = gauge_name(place);
                Gauge {
                    at,
                    velocity: rows_of(columns, &format!("{name}_velocity"), &VECTOR),
                    stress: rows_of(columns, &format!("{name}_sigma"), &TENSOR),
                }
            })
            .collect(),
    }
}

const VECTOR: [&str; 3] = ["x", "y", "z"];
const TENSOR: [&str; 6] = ["xx", "yy", "zz", "yz", "xz", "xy"];

/// Rows of the columns of one name, a number for each of its parts.
fn rows_of<const N: usize>(columns: &Columns, name: &str, parts: &[&str; N]) -> Vec<[f64; N]> {
    let found = parts.map(|part| columns.get(&format!("{name}_{part}")));
    let row = |row: usize| found.map(|column| column.map_or(f64::NAN, |numbers| numbers[row]));
    (0..columns.steps.len()).map(row).collect()
}
