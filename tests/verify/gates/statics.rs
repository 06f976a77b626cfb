//! Cracked specimens at rest between grips.

use cgaft::analysis::series::RINGS;
use cgaft::forces::Forces;
use cgaft::loading::{Grip, Load, Stretching};
use cgaft::material::Material;
use cgaft::mesh::cut::Cut;
use cgaft::mesh::sites::Layout;
use cgaft::mesh::{Mesh, Plan};
use cgaft::relaxation::{Target, relax};
use cgaft::solver::j_integral::{JIntegral, Rings};
use cgaft::state::State;

use super::smooth;

/// Shape of a specimen; lengths in spacings.
#[derive(Clone, Copy)]
pub struct Shape {
    pub layout: Layout,
    pub element: u16,
    pub grip_rows: i32,
    pub grip: Grip,
}

impl Shape {
    /// Lattice rows that pull on each other between the rigid grips.
    pub fn gaps(&self) -> i32 {
        self.layout.lattice_rows() - 2 * self.grip_rows + 1
    }
}

/// A specimen with an edge crack from the left between its grips, at rest at one strain after another.
pub struct Specimen {
    pub forces: Forces,
    pub state: State,
    reference: State,
    heights: [f64; 2],
    strain: f64,
    /// Energy without strain.
    perfect: f64,
    /// Length of the cut: each bond it severs stands for half a spacing.
    pub crack: f64,
}

impl Specimen {
    pub fn new(shape: &Shape, crack_length: f64) -> Self {
        let material = smooth();
        let mut mesh = Mesh::new(&Plan {
            layout: shape.layout,
            element: shape.element,
            regions: vec![],
            crack: None,
            grip_rows: shape.grip_rows,
            spacing: material.spacing,
        });
        let left = mesh.sites.left();
        mesh.cut = Some(Cut {
            row: mesh.sites.middle_row(),
            from: left - 1.0,
            to: left + crack_length,
        });
        let mut state = State::at_rest(mesh.node_positions(), mesh.lumped_masses());
        Stretching::new(&mesh, 1.0, shape.grip, false).hold(&mut state);
        let (heights, crack) = (mesh.grip_edges(), severed_length(&mesh));
        let mut forces = Forces::new(mesh, material);
        let perfect = forces
            .measure(&state.position)
            .expect("the lattice is sound")
            .energy(forces.domain());
        Self {
            forces,
            reference: state.clone(),
            state,
            heights,
            strain: 0.0,
            perfect,
            crack,
        }
    }

    /// Strains further without coming to rest: what there is of displacement grows in proportion, from the start the
    /// linear displacement between rigid grips.
    pub fn stretch(&mut self, strain: f64) {
        let [low, high] = self.heights;
        for node in 0..self.state.nodes() {
            let start = self.reference.position[1][node];
            if self.strain == 0.0 {
                let above = start.clamp(low, high) - 0.5 * (low + high);
                self.state.position[1][node] = start + strain * above;
                continue;
            }
            let grow = strain / self.strain;
            for axis in 0..2 {
                let start = self.reference.position[axis][node];
                let place = &mut self.state.position[axis][node];
                *place = start + grow * (*place - start);
            }
        }
        self.strain = strain;
    }

    /// Takes over the displacements of another crack length.
    pub fn like(mut self, other: &Self) -> Self {
        self.state.position.clone_from(&other.state.position);
        self.strain = other.strain;
        self
    }

    pub fn relax(&mut self) {
        relax(&mut self.forces, &mut self.state, Target::default()).expect("it comes to rest");
    }

    /// Whether at rest more bonds than `few` are broken beyond the cut; as soon as that is so, it need not rest.
    pub fn breaks(&mut self, few: usize) -> bool {
        const LOOK_EVERY: u64 = 2000;
        const LOOKS: u32 = 100;
        let target = Target {
            residual: 1e-7,
            evaluations: LOOK_EVERY,
        };
        for _ in 0..LOOKS {
            let at_rest = relax(&mut self.forces, &mut self.state, target).is_ok();
            if self.forces.broken_bonds(&self.state.position).len() > few {
                return true;
            }
            if at_rest {
                return false;
            }
        }
        panic!("neither at rest nor broken");
    }

    /// J-integral in rings within a circle around the tip, in spacings. The specimen must be at rest.
    pub fn j_integral(&self, radius: f64) -> [f64; RINGS] {
        let mesh = self.forces.mesh();
        let tip = [(mesh.sites.left() + self.crack) * mesh.spacing, mesh.middle_height()];
        let rings = Rings::within(radius * mesh.spacing, tip);
        JIntegral::new(mesh, *self.forces.material()).evaluate(mesh, &self.state, rings)
    }

    /// Energy above that of the unstrained lattice with the same cut.
    pub fn strain_energy(&mut self) -> f64 {
        let measure = self.forces.measure(&self.state.position).expect("the state is sound");
        measure.energy(self.forces.domain()) - self.perfect
    }
}

fn severed_length(mesh: &Mesh) -> f64 {
    let row = mesh.sites.middle_row();
    let below = mesh.sites.columns(row - 1).map(|column| [column, row - 1]);
    let bonds = below.flat_map(|site| [[0, 1], [-1, 1]].map(|v| (site, [site[0] + v[0], site[1] + v[1]])));
    0.5 * bonds
        .filter(|&(a, b)| mesh.owner_of(b).is_some() && mesh.severed(a, b))
        .count() as f64
}

/// Energy released per length of crack between two crack lengths at the same strain, and their mean, in spacings.
pub fn release(shape: &Shape, strain: f64, crack_lengths: [f64; 2]) -> (f64, f64) {
    let mut short = Specimen::new(shape, crack_lengths[0]);
    short.stretch(strain);
    short.relax();
    let mut long = Specimen::new(shape, crack_lengths[1]).like(&short);
    long.relax();
    let length = (long.crack - short.crack) * smooth().spacing;
    let released = (short.strain_energy() - long.strain_energy()) / length;
    (released, 0.5 * (long.crack + short.crack))
}

/// Energy per length stored between fixed grips far ahead of a crack, the lattice's own 2 h W: each pair of rows holds
/// two bonds a spacing that stretch.
pub fn stored(shape: &Shape, material: &Material, strain: f64) -> f64 {
    let squared = 0.25 + 0.75 * (1.0 + strain) * (1.0 + strain);
    let spacing = material.spacing;
    let energy = |squared: f64| material.interaction.evaluate(squared * spacing * spacing).energy;
    2.0 * f64::from(shape.gaps()) * (energy(squared) - energy(1.0)) / spacing
}

/// The strain at which that much energy is stored.
pub fn strain_storing(shape: &Shape, material: &Material, wanted: f64) -> f64 {
    let [mut low, mut high] = [0.0, 0.14];
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if stored(shape, material, middle) < wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}
