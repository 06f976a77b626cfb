//! A slab becomes a mesh, a loading and a solver.

pub mod burden;
mod census;
pub mod estimate;
pub mod geometry;
pub mod leftovers;
pub mod loading;
pub mod refined;

use super::{SetupError, interaction};
use crate::domain::Ranks;
use crate::lattice::triangular;
use crate::material::Material;
use crate::mesh::cut::{Crack, Side, WantedEnd};
use crate::mesh::region::{Region, Shape};
use crate::mesh::sites::{Layout, SiteSet};
use crate::mesh::{Mesh, Plan};
use crate::solver::{self, Solver};
use crate::study::case::{self, Case, Slab};

/// Atoms along a side. Columns are counted from the lowest row, so that they reach as far to the left as there are
/// rows; this leaves 32-bit numbers room for both.
const MOST_ATOMS_ALONG: f64 = 5e8;

/// The crystal of a slab.
pub fn material(slab: &Slab) -> Result<Material, SetupError> {
    let (interaction, site_mass) = interaction(&slab.material.atoms)?;
    Material::new(interaction, site_mass).ok_or(SetupError::NoLattice {
        cutoff: interaction.cutoff(),
        minimum: interaction.minimum(),
    })
}

/// What the mesh of a slab is made from.
pub fn mesh_plan(slab: &Slab, until: &case::Until, material: &Material) -> Result<Plan, SetupError> {
    let case::Lattice::Triangular = slab.specimen.lattice;
    let spacing = material.spacing;
    let specimen = &slab.specimen;
    let atoms = specimen.length.max(specimen.width) / spacing;
    if atoms > MOST_ATOMS_ALONG {
        return Err(SetupError::TooLong {
            side: specimen.length.max(specimen.width),
            is_width: specimen.width > specimen.length,
            atoms,
            most: MOST_ATOMS_ALONG,
        });
    }
    let layout = Layout::nearest(
        specimen.length / spacing,
        specimen.width / spacing,
        specimen.block as i32,
    );
    if layout.rows < 4 || layout.triangles < 3 {
        return Err(SetupError::TooSmall {
            length: specimen.length,
            width: specimen.width,
            rows: layout.rows,
            triangles: layout.triangles.max(0),
            block: specimen.block,
            spacing,
        });
    }
    let height = f64::from((layout.rows - 2) * layout.block) * triangular::ROW_HEIGHT * spacing;
    loading::refuse_grips(slab, height, material)?;
    refuse_cracks_beyond(slab, until, &SiteSet::new(layout), spacing)?;
    let highest = (layout.rows - layout.rows / 2 - 1) * layout.block;
    let element = |element: u32| match u16::try_from(element) {
        Ok(fitting) if i32::from(fitting) <= highest => Ok(fitting),
        _ => Err(SetupError::ElementTooLarge { element, rows: highest }),
    };
    let region = |region: &case::Region| -> Result<Region, SetupError> {
        let shape = match region.shape {
            case::RegionShape::Band { half_width } => Shape::Band { half_width },
            case::RegionShape::Box { from, to } => Shape::Box { from, to },
            case::RegionShape::Disc { center, radius } => Shape::Disc { center, radius },
        };
        Ok(Region {
            shape,
            element: element(region.element)?,
        })
    };
    Ok(Plan {
        layout,
        element: element(slab.resolution.element)?,
        regions: slab.resolution.regions.iter().map(region).collect::<Result<_, _>>()?,
        crack: slab.crack.as_ref().map(|crack| notch(crack, spacing)),
        grip_rows: specimen.block as i32,
        spacing,
    })
}

/// A notch must sever a bond and leave one whole, on either side of it where it lies inside, and no crack comes farther than
/// the last. A tip is told where the next bond would be. Bonds cross the crack plane half a spacing apart.
fn refuse_cracks_beyond(slab: &Slab, until: &case::Until, sites: &SiteSet, spacing: f64) -> Result<(), SetupError> {
    let Some(crack) = &slab.crack else { return Ok(()) };
    let [first, last] = [sites.first_bond(), sites.last_bond()].map(|bond| bond * spacing);
    let (shortest, longest) = match crack.edge {
        case::Edge::Left | case::Edge::Right => (first.max(spacing), last),
        case::Edge::None { center } => (0.5 * spacing, last - center),
    };
    if crack.measured() <= shortest {
        let [crack, shortest] = [crack.length, crack.length / crack.measured() * shortest];
        return Err(SetupError::CrackTooShort { crack, shortest });
    }
    let length = crack.length;
    match crack.edge {
        case::Edge::None { center } if crack.measured() > longest.min(center - first) => {
            return Err(SetupError::NotchNotInside {
                length,
                center,
                bonds: [first, last],
            });
        }
        case::Edge::Left | case::Edge::Right if length > longest => {
            return Err(SetupError::CrackTooLong { crack: length, longest });
        }
        _ => {}
    }
    match until.crack_length {
        Some(end) if end > longest + 0.5 * spacing => Err(SetupError::CrackOutOfReach { end, longest }),
        _ => Ok(()),
    }
}

/// The crack of a case, in units of the lattice spacing.
fn notch(crack: &case::Crack, spacing: f64) -> Crack {
    let case::Crack { edge, length, end } = *crack;
    Crack {
        side: match edge {
            case::Edge::Left => Side::Left,
            case::Edge::Right => Side::Right,
            case::Edge::None { center } => Side::Inside {
                center: center / spacing,
            },
        },
        length: length / spacing,
        end: end.map(|end| match end {
            case::NotchEnd::Corner => WantedEnd::Corner,
            case::NotchEnd::MidEdge => WantedEnd::MidEdge,
        }),
    }
}

/// The solver of a slab at the start of its run.
pub fn solver(case: &Case, slab: &Slab) -> Result<Solver, SetupError> {
    shared_solver(case, slab, Ranks::alone())
}

/// The part of this rank in a solver of a slab.
pub fn shared_solver(case: &Case, slab: &Slab, ranks: Ranks) -> Result<Solver, SetupError> {
    let material = material(slab)?;
    let plan = mesh_plan(slab, &case.run.until, &material)?;
    estimate::refuse_what_does_not_fit(&plan, ranks.here())?;
    // All have looked at what is free before any takes of it.
    ranks.wait_for_all();
    let mesh = Mesh::new(&plan);
    let load = loading::load(case, slab, &mesh, &material);
    let solver = Solver::shared(ranks, mesh, material, load, settings(case, slab))?;
    Ok(solver.with_gauges(&slab.gauges))
}

fn settings(case: &Case, slab: &Slab) -> solver::Settings {
    let rate = slab.loading.strain_rate();
    let refine = slab.resolution.refine;
    solver::Settings {
        refine: refine.map(|case::Refine { error, ahead }| solver::Refine { error, ahead }),
        thickness: slab.material.thickness,
        ..super::settings(case, |strain| rate.map_or(f64::INFINITY, |rate| strain / rate))
    }
}
