//! What the report knows of a case of a solid.

use super::series::Series;
use crate::mesh::solid::Plan;
use crate::report::Film;

/// What a case of a solid has beside what any case has.
#[derive(Clone, Debug, Default)]
pub struct Solid {
    pub specimen: Specimen,
    /// `None` where nothing was computed or nothing can be read.
    pub series: Option<Series>,
    /// The pictures that the run took.
    pub film: Option<Film<[f64; 3]>>,
    /// `None` where nobody has laid it out.
    pub crystal: Option<Crystal>,
}

/// What tells which bonds and faces a solid has, and when they have parted.
#[derive(Clone, Debug)]
pub struct Crystal {
    pub plan: Plan,
    /// Distance beyond which a bond of nearest neighbours is broken, nm.
    pub breaking_length: f64,
    /// Where a ball strikes, nm, and the normal of the face there.
    pub struck: Option<[[f64; 3]; 2]>,
}

/// A bar of elastic crystal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bar {
    /// Of length 1.
    pub along: [f64; 3],
    /// nm
    pub length: f64,
    /// nm^2
    pub cross_section: f64,
    /// eV ps^2/nm^5
    pub density: f64,
    /// Young's modulus of the crystal along it, eV/nm^3.
    pub young_modulus: f64,
}

impl Bar {
    /// Of a thin bar with this Young's modulus, held at one end: 4 L sqrt(rho/E), ps.
    pub fn period(&self, young_modulus: f64) -> f64 {
        4.0 * self.length * (self.density / young_modulus).sqrt()
    }
}

/// A solid as it is laid out; in words where the page shows words.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Specimen {
    /// Lengths along its axes, with their names, nm.
    pub edges: Vec<(&'static str, f64)>,
    /// `1,590 octahedra of 10, 3,180 tetrahedra of 10`
    pub kinds: String,
    pub notch: String,
    /// K of a severed plane at rest in MPa √m and over that of Griffith, `1.21 / 1.16`.
    pub intensity: Option<String>,
    pub held: String,
    pub loading: String,
    /// Where the loading pulls, of length 1.
    pub direction: [f64; 3],
    /// What it is along its load, where that pulls or strikes one face.
    pub bar: Option<Bar>,
    /// Whether it comes to rest before it moves.
    pub is_relaxed: bool,
    /// Distance of nearest neighbours, nm.
    pub spacing: f64,
    pub nodes: u64,
    pub elements: u64,
    /// Blocks of cells, where it is laid out of them, whatever its resolution.
    pub blocks: Option<u64>,
    pub atoms: u64,
    /// Elements that are single atoms.
    pub atoms_alone: u64,
    /// Share of the atoms in smaller elements than asked for.
    pub leftover_share: Option<f64>,
    /// Equal for cases that are one computation, however they were asked for.
    pub computation: u64,
    /// Speed in the crystal of the long plane waves that its gauges wait for, nm/ps, where there is a closed form: of a slab
    /// under a pulse.
    pub wave_speed: Option<f64>,
}
