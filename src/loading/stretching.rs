//! Grips that pull a specimen apart.

use std::ops::Range;

use super::impulse::Impulse;
use super::sponge::Sponge;
use super::{Load, pace};
use crate::domain::Ranks;
use crate::mesh::Mesh;
use crate::state::State;

/// How the grips hold the specimen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grip {
    /// No motion along x.
    Clamped,
    /// Free along x.
    Sliding,
}

/// Mode I at a constant nominal strain rate: the grips part at rate H, H the height between their inner edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Stretching {
    /// 1/ps
    pub rate: f64,
    pub grip: Grip,
    /// The interior starts with the velocity rate (y - y_mid), so that no shock enters.
    pub ramp: bool,
    /// Nominal strain at the start.
    pub pre_strain: f64,
    sponge: Option<Sponge>,
    /// Nodes of the lower and of the upper grip.
    nodes: [Vec<u32>; 2],
    /// Speed of each grip, nm/ps.
    speed: f64,
    impulse: Impulse,
    /// Work done on the meshes that the specimen had before, eV.
    earlier_work: f64,
}

impl Stretching {
    /// Grips that pull at a nominal strain rate, 1/ps; with a `ramp` everything between them starts with its share of
    /// their speed.
    pub fn new(mesh: &Mesh, rate: f64, grip: Grip, ramp: bool) -> Self {
        let mut nodes = [Vec::new(), Vec::new()];
        for (number, element) in mesh.elements.iter().enumerate() {
            let side = mesh.grip_of(element);
            if side != 0 {
                nodes[usize::from(side > 0)].extend(mesh.nodes_of(number).map(|node| node as u32));
            }
        }
        let [low, high] = mesh.grip_edges();
        let held = nodes.iter().flatten().copied();
        let every_node = 0..mesh.node_count();
        Self {
            impulse: Impulse::new(held, &[every_node]),
            rate,
            grip,
            ramp,
            pre_strain: 0.0,
            sponge: None,
            nodes,
            speed: 0.5 * rate * (high - low),
            earlier_work: 0.0,
        }
    }

    /// The same on another mesh of the specimen. What it has done so far is kept as one sum. All ranks must ask for it together.
    pub fn on(&self, mesh: &Mesh, ranks: Ranks) -> Self {
        Self {
            earlier_work: self.work(ranks),
            ..Self::new(mesh, self.rate, self.grip, self.ramp)
        }
        .from_strain(self.pre_strain)
        .with_sponge(self.sponge.as_ref().map(|sponge| sponge.on(mesh)))
    }

    /// Work done on the meshes that the specimen had before, eV.
    pub fn earlier_work(&self) -> f64 {
        self.earlier_work
    }

    /// Goes back to what [`Self::earlier_work`] gave.
    pub fn restore_earlier_work(&mut self, work: f64) {
        self.earlier_work = work;
    }

    /// The same from a specimen that is already stretched to a nominal strain.
    pub fn from_strain(self, pre_strain: f64) -> Self {
        Self { pre_strain, ..self }
    }

    /// The same with what damps the specimen.
    pub fn with_sponge(self, sponge: Option<Sponge>) -> Self {
        Self { sponge, ..self }
    }

    /// Becomes the part of a rank that moves these ranges of nodes, with what all have booked so far.
    pub fn belong_to(&mut self, nodes: &[Range<usize>], impulses: &[f64], absorbed: &[f64]) {
        self.impulse = Impulse::new(self.nodes.iter().flatten().copied(), nodes);
        self.impulse.restore(impulses);
        if let Some(sponge) = &mut self.sponge {
            sponge.restore(absorbed, nodes);
        }
    }

    /// Impulse with which the specimen has pulled so far at each of the held nodes along y, the lower grip first, eV ps/nm. All
    /// ranks must ask for it together.
    pub fn impulses(&self, ranks: Ranks) -> Vec<f64> {
        self.impulse.gathered(ranks)
    }

    /// Kinetic energy that the sponge has taken so far from each of its elements, eV; none without a sponge. All ranks must
    /// call this together.
    pub fn absorbed(&self, ranks: Ranks) -> Vec<f64> {
        self.sponge
            .as_ref()
            .map_or_else(Vec::new, |sponge| sponge.absorbed(ranks))
    }

    /// Elements in the sponge.
    pub fn sponge_size(&self) -> usize {
        self.sponge.as_ref().map_or(0, Sponge::size)
    }

    /// Stretches a specimen from its reference positions to the strain of the start: the grips as they are, evenly what
    /// is between them.
    pub fn pre_stretch(&self, mesh: &Mesh, state: &mut State) {
        let [low, high] = mesh.grip_edges();
        let middle = 0.5 * (low + high);
        for (height, _) in state.position[1]
            .iter_mut()
            .zip(&state.mass)
            .filter(|(_, mass)| **mass > 0.0)
        {
            *height += self.pre_strain * (height.clamp(low, high) - middle);
        }
    }

    /// Takes hold of the grips and sets the velocities of the start.
    pub fn start(&self, mesh: &Mesh, state: &mut State) {
        if self.ramp {
            let [low, high] = mesh.grip_edges();
            let middle = 0.5 * (low + high);
            for (number, element) in mesh.elements.iter().enumerate() {
                for (node, corner) in mesh.nodes_of(number).zip(element.corners()) {
                    if state.has(node) {
                        let [_, height] = mesh.reference(corner);
                        state.velocity[1][node] = self.rate * (height - middle);
                    }
                }
            }
        }
        self.hold(state);
    }

    /// Nominal strain after a time.
    pub fn strain(&self, time: f64) -> f64 {
        self.pre_strain + self.rate * time
    }

    /// When a nominal strain is reached, ps.
    pub fn time_of(&self, strain: f64) -> f64 {
        (strain - self.pre_strain) / self.rate
    }

    /// Force with which the specimen pulls the grips together, eV/nm: half of what it pulls on both.
    pub fn grip_force(&self, state: &State) -> f64 {
        let pull = |nodes: &[u32]| nodes.iter().map(|&node| state.force[1][node as usize]).sum::<f64>();
        0.5 * (pull(&self.nodes[0]) - pull(&self.nodes[1]))
    }
}

impl Load<2> for Stretching {
    fn hold(&self, state: &mut State) {
        for (nodes, speed) in self.nodes.iter().zip([-self.speed, self.speed]) {
            for &node in nodes {
                let node = node as usize;
                state.mobility[1][node] = 0.0;
                state.velocity[1][node] = speed;
                if self.grip == Grip::Clamped {
                    state.mobility[0][node] = 0.0;
                    state.velocity[0][node] = 0.0;
                }
            }
        }
    }

    /// Those of the lower grip first.
    fn held(&self) -> Vec<u32> {
        self.nodes.iter().flatten().copied().collect()
    }

    fn damp(&mut self, state: &mut State, nodes: &[Range<usize>], time: f64) {
        if let Some(sponge) = &mut self.sponge {
            sponge.absorb(state, nodes, time);
        }
    }

    fn book(&mut self, state: &State, time: f64) {
        self.impulse.add(state, time);
    }

    /// That of the grips less what the sponge has taken.
    fn work(&self, ranks: Ranks) -> f64 {
        let impulses = self.impulses(ranks);
        let absorbed: f64 = self.absorbed(ranks).iter().sum();
        let (low, high) = impulses.split_at(self.nodes[0].len());
        self.earlier_work + self.speed * (low.iter().sum::<f64>() - high.iter().sum::<f64>()) - absorbed
    }

    fn longest_step(&self, spacing: f64) -> f64 {
        pace::longest_step(self.rate, 2.0 * self.speed / self.rate, self.ramp, spacing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Plan;
    use crate::mesh::sites::Layout;

    /// Rounding of a product.
    const ROUNDING: f64 = 1e-12;

    fn mesh() -> Mesh {
        let layout = Layout {
            block: 10,
            rows: 4,
            triangles: 5,
        };
        Mesh::new(&Plan {
            layout,
            element: 10,
            regions: vec![],
            crack: None,
            grip_rows: 10,
            spacing: 1.0,
        })
    }

    #[test]
    fn the_grips_part_at_the_strain_rate_times_the_height_between_them() {
        let mesh = mesh();
        let loading = Stretching::new(&mesh, 1e-3, Grip::Clamped, true);
        let mut state = State::at_rest(mesh.node_positions(), mesh.lumped_masses());
        loading.start(&mesh, &mut state);
        let [low, high] = mesh.grip_edges();
        let [bottom, top] = [0, state.nodes() - 1].map(|node| state.velocity[1][node]);
        assert!((top - bottom - 1e-3 * (high - low)).abs() < 1e-15);
        let interior = 3 * 5 + 1;
        let expected = 1e-3 * (state.position[1][interior] - 0.5 * (low + high));
        assert!((state.velocity[1][interior] - expected).abs() < 1e-15);
        assert_eq!(state.mobility[0][0], 0.0);
        assert!(state.mobility[0][interior] > 0.0);
        assert_eq!(loading.strain(20.0), 0.02);
    }

    #[test]
    fn sliding_grips_leave_x_free_and_work_is_force_times_way() {
        let mesh = mesh();
        let mut loading = Stretching::new(&mesh, 1e-3, Grip::Sliding, false);
        let mut state = State::at_rest(mesh.node_positions(), mesh.lumped_masses());
        loading.start(&mesh, &mut state);
        assert!(state.mobility[0][0] > 0.0 && state.mobility[1][0] == 0.0);
        assert_eq!(state.velocity[1][15], 0.0);
        let last = state.nodes() - 1;
        state.force[1][0] = 3.0;
        state.force[1][last] = -3.0;
        assert_eq!(loading.grip_force(&state), 3.0);
        loading.book(&state, 2.0);
        let [low, high] = mesh.grip_edges();
        let way = 2.0 * 1e-3 * (high - low);
        assert!((loading.work(Ranks::alone()) - 3.0 * way).abs() < 1e-14);
    }

    #[test]
    fn in_the_longest_step_the_grips_outrun_the_specimen_by_a_share_of_the_spacing() {
        let mesh = mesh();
        let [low, high] = mesh.grip_edges();
        let at_rest = Stretching::new(&mesh, 1e-3, Grip::Clamped, false).longest_step(0.25);
        let way = 0.5 * 1e-3 * (high - low) * at_rest;
        assert!((way / (0.01 * 0.25) - 1.0).abs() < ROUNDING);
        let along = Stretching::new(&mesh, 1e-3, Grip::Clamped, true).longest_step(0.25);
        assert!((along * 1e-3 / 0.01 - 1.0).abs() < ROUNDING);
    }
}
