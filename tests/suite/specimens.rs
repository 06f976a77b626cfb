//! Small specimens and states that several tests share.

use cgaft::forces::Planes;
use cgaft::material::Material;
use cgaft::mesh::cut::Crack;
use cgaft::mesh::region::{Region, Shape};
use cgaft::mesh::sites::Layout;
use cgaft::mesh::{Mesh, Plan};
use cgaft::potential::{AtCutoff, CutPotential, HarmonicBond, Interaction, LennardJones, Morse};

pub const LENNARD_JONES: LennardJones = LennardJones {
    epsilon: 1.0,
    sigma: 1.0,
};

pub fn lennard_jones(cutoff: f64, at_cutoff: AtCutoff) -> Material {
    material(Interaction::LennardJones(CutPotential::new(
        LENNARD_JONES,
        cutoff,
        at_cutoff,
    )))
}

pub fn material(interaction: Interaction) -> Material {
    Material::new(interaction, 1.0).expect("the potential binds")
}

/// Nearest neighbours, truncated as in the source at 0.34 nm.
pub fn nearest_neighbours() -> Material {
    lennard_jones(0.34 / 0.2277, AtCutoff::Truncated)
}

/// Every potential with every treatment of its cutoff, short and long.
pub fn all_materials() -> Vec<(&'static str, Material)> {
    let morse = Morse {
        depth: 1.0,
        decay: 5.0,
        distance: 1.1,
    };
    let harmonic = HarmonicBond {
        stiffness: 60.0,
        distance: 1.1,
    };
    vec![
        ("truncated at nearest neighbours", nearest_neighbours()),
        ("shifted at 0.57 nm", lennard_jones(0.57 / 0.2277, AtCutoff::Shifted)),
        (
            "smooth from 1.5 to 1.9",
            lennard_jones(1.9, AtCutoff::Smooth { from: 1.5 }),
        ),
        (
            "Morse",
            material(Interaction::Morse(CutPotential::new(
                morse,
                2.0,
                AtCutoff::Smooth { from: 1.5 },
            ))),
        ),
        (
            "harmonic",
            material(Interaction::HarmonicBond(CutPotential::new(
                harmonic,
                1.4,
                AtCutoff::Truncated,
            ))),
        ),
    ]
}

/// A slab of 6 x 9 blocks of 10 atoms per edge, a crack of 10 spacings to a corner of elements, and this resolution.
pub fn slab(element: u16, regions: Vec<Region>, spacing: f64) -> Mesh {
    let layout = Layout {
        block: 10,
        rows: 6,
        triangles: 9,
    };
    Mesh::new(&Plan {
        layout,
        element,
        regions,
        crack: Some(Crack::of_length(10.0)),
        grip_rows: 10,
        spacing,
    })
}

/// The resolutions every law of mechanics must hold for.
pub fn all_meshes(spacing: f64) -> Vec<(&'static str, Mesh)> {
    let band = Region {
        shape: Shape::Band {
            half_width: 9.0 * spacing,
        },
        element: 1,
    };
    let disc = Region {
        shape: Shape::Disc {
            center: [20.0 * spacing, 15.0 * spacing],
            radius: 6.0 * spacing,
        },
        element: 4,
    };
    vec![
        ("n = 10", slab(10, vec![], spacing)),
        ("n = 7 with leftovers", slab(7, vec![], spacing)),
        ("n = 4", slab(4, vec![], spacing)),
        ("atoms in a band", slab(10, vec![band], spacing)),
        ("n = 4 in a disc", slab(10, vec![disc, band], spacing)),
        ("atoms", slab(1, vec![], spacing)),
    ]
}

/// Numbers between -1 and 1 that are the same in every run.
pub struct Noise(pub u64);

impl Noise {
    pub fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// Node positions under a displacement that depends on the reference position, in spacings.
pub fn displaced(mesh: &Mesh, displacement: impl Fn([f64; 2]) -> [f64; 2]) -> Planes {
    let mut position = mesh.node_positions();
    for node in 0..mesh.node_count() {
        let reference = [position[0][node] / mesh.spacing, position[1][node] / mesh.spacing];
        let shift = displacement(reference);
        (0..2).for_each(|axis| position[axis][node] += mesh.spacing * shift[axis]);
    }
    position
}

/// States from the perfect lattice to rubble.
pub fn states(mesh: &Mesh) -> Vec<(&'static str, Planes)> {
    let middle = mesh.middle_height() / mesh.spacing;
    let mut noise = Noise(7);
    let mut shaken = displaced(mesh, |[x, y]| [0.01 * x + 0.004 * y, 0.02 * (y - middle)]);
    for axis in 0..2 {
        shaken[axis]
            .iter_mut()
            .for_each(|x| *x += 0.02 * mesh.spacing * noise.next());
    }
    let cracked = displaced(mesh, |[x, y]| {
        let opening = (0.12 * (30.0 - x)).max(0.0);
        [0.0, if y > middle { opening } else { -0.3 * opening }]
    });
    let closed = displaced(mesh, |[x, y]| {
        [0.2 * (y - middle).signum() + 0.0 * x, -0.04 * (y - middle)]
    });
    let slid = displaced(mesh, |[_, y]| [if y > middle { 0.45 } else { 0.0 }, 0.0]);
    let mut rubble = mesh.node_positions();
    for number in 0..mesh.elements.len() {
        let drift = [0, 1].map(|_| 0.8 * mesh.spacing * noise.next());
        for node in mesh.nodes_of(number) {
            (0..2).for_each(|axis| rubble[axis][node] = 1.3 * rubble[axis][node] + drift[axis]);
        }
    }
    vec![
        ("intact", mesh.node_positions()),
        ("strained", displaced(mesh, |[x, y]| [-0.006 * x, 0.02 * (y - middle)])),
        ("shaken", shaken),
        ("cracked", cracked),
        ("pressed together and slid", closed),
        ("slid rigidly", slid),
        ("rubble", rubble),
    ]
}
