//! Damping: layers before the grips that take waves out of the specimen, so that none come back, and what takes heat out of
//! the whole.

use std::ops::Range;

use rayon::prelude::*;

use crate::domain::Ranks;
use crate::mesh::Mesh;
use crate::state::State;

/// What is left of a longitudinal wave that goes through a layer, is thrown back by the grip and comes out again is
/// exp(-this): a hundredth.
const LOSS: f64 = 4.6;

/// Atoms in one parallel task.
const TASK: usize = 4096;

/// Damps the velocity relative to that of even stretching, which is left alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Sponge {
    /// What it was made from: the rate of stretching, the layers, and what damps the whole.
    made_from: (f64, Option<Layers>, f64),
    elements: Vec<Soaked>,
    /// How many elements each parallel task has, and where the nodes of its group or of its atoms end.
    tasks: Vec<[usize; 2]>,
    /// Kinetic energy taken so far from each, eV: each has its own sum, so that their total does not depend on which rank
    /// moves it. Zero for those of other ranks.
    absorbed: Vec<f64>,
    /// The time for which what is kept has been computed, ps.
    time: f64,
}

/// Layers before both grips. They damp by a rate that grows with the square of the depth, so that they set in too gently to
/// throw waves back themselves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layers {
    /// nm
    pub width: f64,
    /// Of the waves that they take out, nm/ps.
    pub wave_speed: f64,
}

/// An element that is damped.
#[derive(Clone, Debug, PartialEq)]
struct Soaked {
    /// Its first node, and from there to the next.
    first: usize,
    step: usize,
    node_count: usize,
    /// 1/ps
    damping: f64,
    /// Share of the relative velocity that is kept, over the time.
    kept: f64,
    /// Velocity y of its nodes in even stretching, nm/ps.
    stretching: [f64; 3],
}

impl Sponge {
    /// In a specimen stretched at a rate (1/ps): layers, and what damps the whole (1/ps).
    pub fn new(mesh: &Mesh, rate: f64, layers: Option<Layers>, everywhere: f64) -> Self {
        let [low, high] = mesh.grip_edges();
        let middle = 0.5 * (low + high);
        let mut elements = Vec::new();
        let mut tasks: Vec<[usize; 2]> = Vec::new();
        for (number, element) in mesh.elements.iter().enumerate() {
            let height = element.centre()[1] * mesh.spacing;
            let in_layers = layers.map_or(0.0, |layers| layers.damping(height, [low, high]));
            let damping = everywhere + in_layers;
            if damping <= 0.0 || mesh.grip_of(element) != 0 {
                continue;
            }
            let mut stretching = [0.0; 3];
            for (speed, corner) in stretching.iter_mut().zip(element.corners()) {
                *speed = rate * (mesh.reference(corner)[1] - middle);
            }
            let [step, end] = match number < mesh.triangles {
                true => [mesh.groups.of(number).len(), mesh.groups.of(number).nodes().end],
                false => [1, (mesh.node(number, 0) + 1).next_multiple_of(TASK)],
            };
            match tasks.last_mut() {
                Some([count, last]) if *last == end => *count += 1,
                _ => tasks.push([1, end]),
            }
            elements.push(Soaked {
                first: mesh.node(number, 0),
                step,
                node_count: element.node_count(),
                damping,
                kept: 1.0,
                stretching,
            });
        }
        Self {
            made_from: (rate, layers, everywhere),
            absorbed: vec![0.0; elements.len()],
            elements,
            tasks,
            time: 0.0,
        }
    }

    /// The same in another mesh of the specimen, where it has taken nothing yet.
    pub fn on(&self, mesh: &Mesh) -> Self {
        let (rate, layers, everywhere) = self.made_from;
        Self::new(mesh, rate, layers, everywhere)
    }

    /// Elements that are damped.
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
        let mut velocity = std::mem::take(&mut state.velocity);
        let [mut x, mut y] = velocity.each_mut().map(Vec::as_mut_slice);
        let (mut elements, mut absorbed, mut from) = (self.elements.as_slice(), self.absorbed.as_mut_slice(), 0);
        let mut tasks = Vec::with_capacity(self.tasks.len());
        for &[count, end] in &self.tasks {
            let own = [&mut x, &mut y].map(|plane| {
                let length = (end - from).min(plane.len());
                plane.split_off_mut(..length).unwrap_or_default()
            });
            let elements = elements.split_off(..count).unwrap_or_default();
            let absorbed = absorbed.split_off_mut(..count).unwrap_or_default();
            tasks.push((elements, absorbed, own, from));
            from = end;
        }
        let state_before: &State = state;
        tasks.into_par_iter().for_each(|(elements, absorbed, mut own, from)| {
            for (element, absorbed) in elements.iter().zip(absorbed) {
                if element.is_within(nodes) {
                    let [mass, coupling] = [
                        state_before.mass[element.first],
                        state_before.coupling_of(element.first),
                    ];
                    *absorbed += element.absorb(&mut own, from, mass, coupling);
                }
            }
        });
        state.velocity = velocity;
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

impl Layers {
    /// The rate at a height between the grips, 1/ps.
    fn damping(self, height: f64, [low, high]: [f64; 2]) -> f64 {
        let width = self.width;
        let depth = ((low + width - height).max(height - high + width) / width).clamp(0.0, 1.0);
        // The square of the depth has a mean of a third; the way is twice the width.
        3.0 * LOSS * self.wave_speed / width * depth * depth
    }
}

impl Soaked {
    fn is_within(&self, nodes: &[Range<usize>]) -> bool {
        nodes.iter().any(|range| range.contains(&self.first))
    }

    /// Damps the element, whose mass and coupling these are, in velocities that begin with those of node `from`; the kinetic
    /// energy that this takes, eV.
    fn absorb(&self, velocity: &mut [&mut [f64]; 2], from: usize, mass: f64, coupling: f64) -> f64 {
        let mut taken = 0.0;
        for (axis, plane) in velocity.iter_mut().enumerate() {
            let places = (0..self.node_count).map(|corner| self.first + corner * self.step - from);
            let before = squared_speed(places.clone().map(|place| plane[place]), coupling);
            for (place, stretching) in places.clone().zip(self.stretching) {
                let even = if axis == 1 { stretching } else { 0.0 };
                plane[place] = even + self.kept * (plane[place] - even);
            }
            taken += 0.5 * mass * (before - squared_speed(places.map(|place| plane[place]), coupling));
        }
        taken
    }
}

/// v^T M v of the nodes of an element over the lumped mass of one.
fn squared_speed(velocity: impl Iterator<Item = f64> + Clone, coupling: f64) -> f64 {
    let sum: f64 = velocity.clone().sum();
    let squares: f64 = velocity.map(|speed| speed * speed).sum();
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
            crack: None,
            grip_rows: 4,
            spacing: 1.0,
        });
        let state = State::at_rest(mesh.node_positions(), mesh.lumped_masses());
        (mesh, state)
    }

    fn layers(width: f64) -> Layers {
        Layers { width, wave_speed: 9.0 }
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
        let mut sponge = Sponge::new(&mesh, RATE, Some(layers(10.0)), 0.0);
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
        state.couple_masses(&mesh, 1.0);
        let speeds = (0..state.nodes())
            .map(|node| 0.1 + 0.01 * node as f64)
            .collect::<Vec<_>>();
        state.velocity = [speeds.clone(), speeds];
        let before = state.kinetic_energy();
        let mut sponge = Sponge::new(&mesh, RATE, Some(layers(10.0)), 0.0);
        let nodes = state.every_node();
        sponge.absorb(&mut state, &nodes, 0.1);
        let taken: f64 = sponge.absorbed(Ranks::alone()).iter().sum();
        assert!(taken > 0.0);
        assert!((before - state.kinetic_energy() - taken).abs() < 1e-12 * before);
    }

    #[test]
    fn a_layer_takes_a_hundredth_of_a_wave_and_of_even_motion_what_its_depth_says() {
        // Damping d halves into the decay of a wave, d/2, over twice the width w at speed c: the integral of d/c over the
        // layer is ln 100, and with the square of the depth s it is d = 3 ln(100) c/w s^2. In a time that is short
        // 2 d t of the energy goes.
        const TIME: f64 = 1e-6;
        // 4.6 for ln 100, and squares of 2 d t.
        const ROUNDED: f64 = 2e-3;
        let (width, speed) = (10.0, 9.0);
        let (mesh, mut state) = specimen();
        state.velocity[0].fill(1.0);
        state.velocity[1].fill(0.0);
        let mut sponge = Sponge::new(&mesh, 0.0, Some(layers(width)), 0.0);
        let nodes = state.every_node();
        sponge.absorb(&mut state, &nodes, TIME);
        let taken: f64 = sponge.absorbed(Ranks::alone()).iter().sum();
        let [low, high] = mesh.grip_edges();
        let expected = mesh
            .elements
            .iter()
            .filter(|element| mesh.grip_of(element) == 0)
            .map(|element| {
                let sites = element.sites().collect::<Vec<_>>();
                let height = sites.iter().map(|&site| mesh.reference(site)[1]).sum::<f64>() / sites.len() as f64;
                let depth = [low + width - height, height - high + width].map(|depth| depth.max(0.0) / width);
                let damping = 3.0 * 100_f64.ln() * speed / width * (depth[0] * depth[0] + depth[1] * depth[1]);
                0.5 * sites.len() as f64 * 2.0 * damping * TIME
            });
        let expected: f64 = expected.sum();
        assert!((taken / expected - 1.0).abs() < ROUNDED, "{taken} {expected}");
    }

    #[test]
    fn the_middle_of_the_specimen_and_the_grips_are_left_alone() {
        let (mesh, mut state) = specimen();
        state.velocity[0].fill(1.0);
        let mut sponge = Sponge::new(&mesh, RATE, Some(layers(5.0)), 0.0);
        let nodes = state.every_node();
        sponge.absorb(&mut state, &nodes, 0.1);
        let [low, high] = mesh.grip_edges();
        for (number, element) in mesh.elements.iter().enumerate() {
            let height = element.centre()[1];
            let inside = mesh.grip_of(element) == 0 && (height < low + 5.0 || height > high - 5.0);
            let first = mesh.node(number, 0);
            assert_eq!(state.velocity[0][first] < 1.0, inside, "{height}");
        }
    }

    #[test]
    fn damping_everywhere_leaves_of_motion_between_the_grips_the_same_share_in_every_element() {
        let (mesh, mut state) = specimen();
        state.velocity[0].fill(1.0);
        let mut damping = Sponge::new(&mesh, RATE, None, 0.5);
        let nodes = state.every_node();
        for _ in 0..10 {
            damping.absorb(&mut state, &nodes, 0.1);
        }
        let free = mesh.elements.iter().enumerate();
        let mut free = free.filter(|(_, element)| mesh.grip_of(element) == 0).peekable();
        assert!(free.peek().is_some());
        for (number, _) in free {
            let kept = state.velocity[0][mesh.node(number, 0)];
            assert!((kept - (-0.5_f64).exp()).abs() < 1e-14, "{kept}");
        }
    }
}
