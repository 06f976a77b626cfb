//! Static equilibrium: the nodes that are free to move come to rest where no force is left on them.
//!
//! Two ways follow each other. FIRE, a damped motion that only ever goes downhill, leaves any start behind, also one
//! where bonds are beyond their inflection. Near the minimum Newton's method with conjugate gradients takes over and
//! goes down to the rounding of the forces; where it meets negative curvature, the damped motion goes on.
//!
//! Both work in coordinates in which every element is about equally stiff, so that a mesh may mix atoms with
//! triangles of any size.

mod fire;
mod newton;
mod vectors;

use std::sync::atomic::{AtomicBool, Ordering};

use crate::domain::{Call, Domain};
use crate::forces::{ForceError, Forces, Planes};
use crate::material::Material;
use crate::state::State;
use fire::Fire;

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// Largest force left on a free node, over the strength of a bond.
    pub residual: f64,
    /// Most evaluations of the forces.
    pub evaluations: u64,
}

impl Default for Target {
    fn default() -> Self {
        Self {
            residual: 1e-10,
            evaluations: 200_000,
        }
    }
}

/// What it took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rest {
    /// Largest force left on a free node, over the strength of a bond.
    pub residual: f64,
    pub evaluations: u64,
}

/// Why a specimen did not come to rest.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RelaxationError {
    #[error(
        "after {evaluations} evaluations of the forces {residual:.2e} of a bond's strength is left on a node, more than \
         {wanted:.0e}: the specimen may be breaking; load it less, or allow more evaluations"
    )]
    NotAtRest {
        evaluations: u64,
        residual: f64,
        wanted: f64,
    },
    #[error("{0}; start from a state nearer to the lattice")]
    NoForces(#[from] ForceError),
    #[error("asked to stop before the specimen was at rest")]
    Interrupted,
}

/// What is brought to rest in `D` dimensions.
pub trait Elastic<const D: usize> {
    fn domain(&self) -> &Domain;

    fn domain_mut(&mut self) -> &mut Domain;

    fn material(&self) -> &Material;

    /// Forces on the nodes at their present positions.
    fn compute(&mut self, state: &mut State<D>) -> Result<(), ForceError>;

    /// A bound of the stiffness that each node answers with, eV/nm^2; zero where it has lost all its bonds.
    fn stiffness_of_nodes(&mut self, state: &State<D>) -> Result<Vec<f64>, ForceError>;
}

impl Elastic<2> for Forces {
    fn domain(&self) -> &Domain {
        self.domain()
    }

    fn domain_mut(&mut self) -> &mut Domain {
        self.domain_mut()
    }

    fn material(&self) -> &Material {
        self.material()
    }

    fn compute(&mut self, state: &mut State) -> Result<(), ForceError> {
        let State { position, force, .. } = state;
        self.compute(position, force)
    }

    /// The stiffness of an element bounds that of each of its nodes.
    fn stiffness_of_nodes(&mut self, state: &State) -> Result<Vec<f64>, ForceError> {
        let bounds = self.stiffness_bounds(&state.position)?;
        let mesh = self.mesh();
        let mut of_nodes = vec![0.0; mesh.node_count()];
        for (element, bound) in bounds.into_iter().enumerate() {
            mesh.nodes_of(element).for_each(|node| of_nodes[node] = bound);
        }
        Ok(of_nodes)
    }
}

/// Moves the free nodes of `state` to where their forces vanish; velocities play no part and end as zero there.
/// Where the motion is prescribed (a mobility of zero), positions stay as they are.
pub fn relax(forces: &mut Forces, state: &mut State, target: Target) -> Result<Rest, RelaxationError> {
    relax_unless(forces, state, target, &AtomicBool::new(false), &mut |_| ())
}

/// The same, given up as soon as `stop` becomes true. `tell` hears about what is left of the residual, again and again.
pub fn relax_unless<const D: usize>(
    forces: &mut impl Elastic<D>,
    state: &mut State<D>,
    target: Target,
    stop: &AtomicBool,
    tell: &mut dyn FnMut(f64),
) -> Result<Rest, RelaxationError> {
    Descent::new(forces, state, target, stop, tell)?.run()
}

/// Largest force with which a bond resists being stretched, eV/nm: what a residual force is measured by.
pub fn bond_strength(material: &Material) -> f64 {
    const SCAN: u32 = 1000;
    let interaction = material.interaction;
    let [start, end] = [interaction.minimum(), interaction.cutoff()];
    let pull = |k: u32| {
        let distance = start + (end - start) * f64::from(k) / f64::from(SCAN);
        interaction.evaluate(distance * distance).slope * distance
    };
    (0..SCAN).map(pull).fold(0.0, f64::max)
}

/// Residual at which Newton's method first takes over from the damped motion. In a soft specimen its steps come to nothing
/// before: 180,000 atoms with a notch took 6,700 evaluations of the forces with 3e-3, 4,600 with 1e-5.
const NEWTON_FROM: f64 = 1e-6;

/// Share of the residual that the damped motion removes where Newton's method could not.
const DAMPED_SHARE: f64 = 0.1;

/// A specimen on its way to rest. Its forces always belong to its positions.
struct Descent<'a, const D: usize> {
    forces: &'a mut dyn Elastic<D>,
    state: &'a mut State<D>,
    target: Target,
    stop: &'a AtomicBool,
    tell: &'a mut dyn FnMut(f64),
    /// Inverse of every node's stiffness bound, nm^2/eV; zero where the motion is prescribed.
    compliance: Planes<D>,
    strength: f64,
    spacing: f64,
    evaluations: u64,
}

impl<'a, const D: usize> Descent<'a, D> {
    fn new(
        forces: &'a mut dyn Elastic<D>,
        state: &'a mut State<D>,
        target: Target,
        stop: &'a AtomicBool,
        tell: &'a mut dyn FnMut(f64),
    ) -> Result<Self, RelaxationError> {
        let bounds = forces.stiffness_of_nodes(state)?;
        let [strength, spacing] = [bond_strength(forces.material()), forces.material().spacing];
        let mut descent = Self {
            compliance: compliance(&bounds, &state.mobility),
            forces,
            state,
            target,
            stop,
            tell,
            strength,
            spacing,
            evaluations: 0,
        };
        descent.evaluate()?;
        Ok(descent)
    }

    fn run(mut self) -> Result<Rest, RelaxationError> {
        let mut damped_to = NEWTON_FROM.max(self.target.residual);
        loop {
            Fire::default().run(&mut self, damped_to)?;
            while self.residual() > self.target.residual && self.newton_step()? {}
            if self.residual() <= self.target.residual {
                self.come_to_rest();
                return Ok(Rest {
                    residual: self.residual(),
                    evaluations: self.evaluations,
                });
            }
            damped_to = (DAMPED_SHARE * self.residual()).max(self.target.residual);
        }
    }

    /// Forces at the present positions. Refuses when there were too many.
    fn evaluate(&mut self) -> Result<(), RelaxationError> {
        if self.evaluations >= self.target.evaluations {
            return Err(RelaxationError::NotAtRest {
                evaluations: self.evaluations,
                residual: self.residual(),
                wanted: self.target.residual,
            });
        }
        if self.forces.domain_mut().hears(Call::Stop) {
            return Err(RelaxationError::Interrupted);
        }
        if self.stop.load(Ordering::Relaxed) {
            self.forces.domain_mut().call(Call::Stop);
        }
        self.evaluations += 1;
        self.forces.compute(self.state)?;
        // Every rank carries the whole specimen to rest.
        let planes = self.state.force.iter_mut();
        planes.for_each(|axis| self.forces.domain().share_nodes(axis));
        Ok(())
    }

    fn residual(&self) -> f64 {
        vectors::largest_free(&self.state.force, &self.compliance) / self.strength
    }

    fn come_to_rest(&mut self) {
        for axis in 0..D {
            let free = self.state.velocity[axis].iter_mut().zip(&self.state.mobility[axis]);
            free.filter(|(_, mobility)| **mobility > 0.0)
                .for_each(|(velocity, _)| *velocity = 0.0);
        }
    }
}

/// Where a node has lost all its bonds, the softest other one serves.
fn compliance<const D: usize>(bounds: &[f64], mobility: &Planes<D>) -> Planes<D> {
    let softest = bounds.iter().copied().filter(|&bound| bound > 0.0);
    let softest = softest.fold(f64::INFINITY, f64::min);
    let of_node = |(&bound, &mobility): (&f64, &f64)| match mobility > 0.0 {
        true => 1.0 / if bound > 0.0 { bound } else { softest },
        false => 0.0,
    };
    mobility
        .each_ref()
        .map(|plane| bounds.iter().zip(plane).map(of_node).collect())
}
