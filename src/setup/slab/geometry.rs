//! The specimen of a case as asked for and as laid out of whole elements.

use std::hash::{DefaultHasher, Hash, Hasher};

use crate::lattice::triangular;
use crate::mesh::cut::NotchEnd;
use crate::mesh::{Mesh, Plan};
use crate::study::case::{Body, Case, Slab};

/// A length as asked for and as it is, nm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    pub asked: f64,
    pub actual: f64,
}

/// Sizes of a specimen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geometry {
    pub length: Size,
    pub width: Size,
    /// Between the innermost rows of atoms of the grips; asked for is the width less the grips.
    pub height: Size,
    /// `None` where there is no crack, or where nobody has laid the elements.
    pub notch: Option<Notch>,
    /// nm
    pub grip_thickness: f64,
    /// Of each grip, nm/ps.
    pub grip_speed: f64,
}

/// A crack as it is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Notch {
    pub length: Size,
    pub end: NotchEnd,
    /// Tells apart which bonds are severed.
    pub severed: u64,
}

/// Bonds this much longer than the spacing are counted among those that a cut severs: the third shell.
const REACH: f64 = 2.0;

impl Size {
    /// How far it is from what was asked for, over what was asked for.
    pub fn error(&self) -> f64 {
        self.actual / self.asked - 1.0
    }
}

impl Geometry {
    pub fn of(slab: &Slab, plan: &Plan, notch: Option<Notch>) -> Self {
        let layout = &plan.layout;
        let row = triangular::ROW_HEIGHT * plan.spacing;
        let [width, grip] = [layout.lattice_rows(), plan.grip_rows].map(|rows| f64::from(rows) * row);
        // From a face, half a row beyond its atoms, to the innermost row of the grip.
        let edge = grip - 0.5 * row;
        let size = |asked: f64, actual: f64| Size { asked, actual };
        let height = size(slab.specimen.width - 2.0 * edge, width - 2.0 * edge);
        Self {
            length: size(slab.specimen.length, layout.length() * plan.spacing),
            width: size(slab.specimen.width, width),
            height,
            notch,
            grip_thickness: grip,
            grip_speed: 0.5 * slab.loading.strain_rate().unwrap_or(0.0) * height.actual,
        }
    }

    /// The sizes with their names.
    pub fn sizes(&self) -> Vec<(&'static str, Size)> {
        let mut sizes = vec![
            ("length", self.length),
            ("width", self.width),
            ("height between the grips", self.height),
        ];
        sizes.extend(self.notch.map(|notch| ("crack length", notch.length)));
        sizes
    }
}

impl Notch {
    /// Of a mesh with a cut.
    pub fn of(slab: &Slab, mesh: &Mesh) -> Option<Self> {
        let (crack, cut) = (slab.crack.as_ref()?, mesh.cut?);
        let mut severed = DefaultHasher::new();
        let vectors = triangular::vectors_within(REACH);
        for row in (cut.row - REACH as i32 - 1).max(0)..cut.row {
            for site in mesh.sites.columns(row).map(|column| [column, row]) {
                let partners = vectors.iter().map(|vector| [site[0] + vector[0], site[1] + vector[1]]);
                for partner in partners.filter(|&partner| cut.severs(site, partner)) {
                    (site, partner).hash(&mut severed);
                }
            }
        }
        Some(Self {
            length: Size {
                asked: crack.length,
                actual: cut.length(mesh) * mesh.spacing,
            },
            end: cut.end(mesh),
            severed: severed.finish(),
        })
    }
}

/// Tells computations apart: equal for cases whose meshes, severed bonds, material, loading and run are, however their
/// specimens were asked for.
pub fn computation(case: &Case, slab: &Slab, plan: &Plan, elements: u64, notch: Option<&Notch>) -> u64 {
    let mut rest = slab.clone();
    rest.specimen.length = 0.0;
    rest.specimen.width = 0.0;
    rest.specimen.block = 0;
    rest.resolution.element = 0;
    rest.resolution.regions.clear();
    if notch.is_some() {
        rest.crack = None;
    }
    let rest = Case {
        body: Body::Slab(rest),
        ..case.clone()
    };
    let rest = serde_json::to_string(&rest).unwrap_or_default();
    let mut hasher = DefaultHasher::new();
    let layout = plan.layout;
    (
        rest,
        layout.block,
        layout.rows,
        layout.triangles,
        elements,
        notch.map(|notch| notch.severed),
    )
        .hash(&mut hasher);
    hasher.finish()
}
