//! Layers before the grips that take waves out of the specimen, so that none come back.

use std::ops::Range;

use crate::domain::Ranks;
use crate::mesh::Mesh;
use crate::state::State;

/// What is left of a longitudinal wave that goes through a layer, is thrown back by the grip and comes out again is
/// exp(-this): a hundredth.
const LOSS: f64 = 4.6;

/// Damps the velocity relative to that of even stretching, by a rate that grows with the square of the depth, so that it
/// sets in too gently to throw waves back itself. Slow stretching of the whole is left alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Sponge {
    elements: Vec<Soaked>,
    /// Kinetic energy taken so far from each, eV: each has its own sum, so that their total does not depend on which rank
    /// moves it. Zero for those of other ranks.
    absorbed: Vec<f64>,
    /// The time for which what is kept has been computed, ps.
    time: f64,
}

/// An element within a layer.
#[derive(Clone, Debug, PartialEq)]
struct Soaked {
    /// Number of its first node among the nodes and, where it is a triangle, its number among the triangles.
    first: usize,
    triangle: Option<usize>,
    /// 1/ps
    damping: f64,
    /// Share of the relative velocity that is kept, over the time.
    kept: f64,
    /// Velocity y of its nodes in even stretching, nm/ps.
    stretching: [f64; 3],
}

impl Sponge {
    /// Layers of a width (nm) before both grips, for waves of a speed (nm/ps) in a specimen stretched at a rate (1/ps).
    pub fn new(mesh: &Mesh, width: f64, wave_speed: f64, rate: f64) -> Self {
        let [low, high] = mesh.grip_edges();
        let middle = 0.5 * (low + high);
        // The square of the depth has a mean of a third; the way is twice the width.
        let most = 3.0 * LOSS * wave_speed / width;
        let mut elements = Vec::new();
        for (number, element) in mesh.elements.iter().enumerate() {
            let height = element.centre()[1] * mesh.spacing;
            let depth = ((low + width - height).max(height - high + width) / width).min(1.0);
            if depth <= 0.0 || mesh.grip_of(element) != 0 {
                continue;
            }
            let mut stretching = [0.0; 3];
            for (speed, corner) in stretching.iter_mut().zip(element.corners()) {
                *speed = rate * (mesh.reference(corner)[1] - middle);
            }
            elements.push(Soaked {
                first: mesh.first_node(number),
                triangle: (number < mesh.triangles).then_some(number),
                damping: most * depth * depth,
                kept: 1.0,
                stretching,
            });
        }
        Self {
            absorbed: vec![0.0; elements.len()],
            elements,
            time: 0.0,
        }
    }

    /// Elements in the layers.
    pub fn size(&self) -> usize {
        self.elements.len()
    }

    /// Damps these ranges of nodes for a time, ps.
    pub fn absorb(&mut self, state: &mut State, nodes: &[Range<usize>], time: f64) {
        if self.time != time {
            self.time = time;
            for element in &mut self.elements {
                element.kept = (-element.damping * time).exp();
            }
        }
        for (element, absorbed) in self.elements.iter().zip(&mut self.absorbed) {
            if element.is_within(nodes) {
                *absorbed += element.absorb(state);
            }
        }
    }

    /// What was taken from each element so far, from all ranks, which must call this together, eV.
    pub fn absorbed(&self, ranks: Ranks) -> Vec<f64> {
        ranks.merge(&self.absorbed)
    }

    /// Goes back to what [`Self::absorbed`] gave, for a rank that moves these ranges of nodes.
    pub fn restore(&mut self, absorbed: &[f64], nodes: &[Range<usize>]) {
        for ((element, mine), &all) in self.elements.iter().zip(&mut self.absorbed).zip(absorbed) {
            *mine = if element.is_within(nodes) { all } else { 0.0 };
        }
    }
}

impl Soaked {
    fn is_within(&self, nodes: &[Range<usize>]) -> bool {
        nodes.iter().any(|range| range.contains(&self.first))
    }

    /// Damps the element; the kinetic energy that this takes, eV.
    fn absorb(&self, state: &mut State) -> f64 {
        let nodes = self.first..self.first + if self.triangle.is_some() { 3 } else { 1 };
        let coupling = self.triangle.and_then(|number| state.coupling.get(number)).copied();
        let coupling = coupling.unwrap_or(0.0);
        let mass = state.mass[self.first];
        let mut taken = 0.0;
        for axis in 0..2 {
            let velocity = &mut state.velocity[axis][nodes.clone()];
            let before = squared_speed(velocity, coupling);
            for (speed, stretching) in velocity.iter_mut().zip(self.stretching) {
                let even = if axis == 1 { stretching } else { 0.0 };
                *speed = even + self.kept * (*speed - even);
            }
            taken += 0.5 * mass * (before - squared_speed(velocity, coupling));
        }
        taken
    }
}

/// v^T M v of the nodes of an element over the lumped mass of one.
fn squared_speed(velocity: &[f64], coupling: f64) -> f64 {
    let sum: f64 = velocity.iter().sum();
    let squares: f64 = velocity.iter().map(|speed| speed * speed).sum();
    (1.0 - 3.0 * coupling) * squares + coupling * sum * sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Plan;
    use crate::mesh::sites::Layout;

    const RATE: f64 = 1e-3;

    fn specimen() -> (Mesh, State) {
        let mesh = Mesh::new(&Plan {
            layout: Layout {
                block: 4,
                rows: 12,
                triangles: 5,
            },
            element: 4,
            regions: vec![],
            crack_length: None,
            grip_rows: 4,
            spacing: 1.0,
        });
        let state = State::at_rest(mesh.node_positions(), mesh.lumped_masses());
        (mesh, state)
    }

    #[test]
    fn even_stretching_goes_through_a_sponge_undamped() {
        let (mesh, mut state) = specimen();
        let [low, high] = mesh.grip_edges();
        let [_, heights] = mesh.node_positions();
        for (speed, height) in state.velocity[1].iter_mut().zip(heights) {
            *speed = RATE * (height - 0.5 * (low + high));
        }
        let before = state.clone();
        let mut sponge = Sponge::new(&mesh, 10.0, 9.0, RATE);
        assert!(!sponge.elements.is_empty());
        let nodes = state.every_node();
        sponge.absorb(&mut state, &nodes, 0.1);
        let taken: f64 = sponge.absorbed(Ranks::alone()).iter().sum();
        assert_eq!(state, before);
        assert_eq!(taken, 0.0);
    }

    #[test]
    fn a_sponge_takes_as_much_energy_as_the_specimen_loses_whatever_its_masses() {
        let (mesh, mut state) = specimen();
        state.couple_masses(mesh.mass_couplings());
        let speeds = (0..state.nodes())
            .map(|node| 0.1 + 0.01 * node as f64)
            .collect::<Vec<_>>();
        state.velocity = [speeds.clone(), speeds];
        let before = state.kinetic_energy();
        let mut sponge = Sponge::new(&mesh, 10.0, 9.0, RATE);
        let nodes = state.every_node();
        sponge.absorb(&mut state, &nodes, 0.1);
        let taken: f64 = sponge.absorbed(Ranks::alone()).iter().sum();
        assert!(taken > 0.0);
        assert!((before - state.kinetic_energy() - taken).abs() < 1e-12 * before);
    }

    #[test]
    fn the_middle_of_the_specimen_and_the_grips_are_left_alone() {
        let (mesh, mut state) = specimen();
        state.velocity[0].fill(1.0);
        let mut sponge = Sponge::new(&mesh, 5.0, 9.0, RATE);
        let nodes = state.every_node();
        sponge.absorb(&mut state, &nodes, 0.1);
        let [low, high] = mesh.grip_edges();
        for (number, element) in mesh.elements.iter().enumerate() {
            let height = element.centre()[1];
            let inside = mesh.grip_of(element) == 0 && (height < low + 5.0 || height > high - 5.0);
            let first = mesh.first_node(number);
            assert_eq!(state.velocity[0][first] < 1.0, inside, "{height}");
        }
    }
}
