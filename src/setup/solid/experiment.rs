//! What acts on a solid, and what is read of it.

use super::plan::{Laid, dot};
use crate::loading::{Action, Ball, Carried, Course, Hold, Push, Ramp};
use crate::material::Material;
use crate::mesh::solid::Solid as Mesh;
use crate::setup::SetupError;
use crate::solver::solid::{Experiment, Extension, Gauge};
use crate::study::case::Ramp as Start;
use crate::study::case::Solid;
use crate::study::case::solid::{Axis, Depth, Face, Loading, Pull, PulseShape, Side};

/// Names of the actions, which columns of the series begin with: what the study calls its loading, and the rest.
pub const LOADING: &str = "loading";
const OPPOSITE: &str = "opposite";
const HELD: &str = "held";

/// Stiffness of the contact of a ball in the curvature of a bond over the spacing: a site that it has pushed in by the spacing
/// is pushed back about a fifth as strongly as a bond would at the same stretch.
const CONTACT: f64 = 0.2;

/// The name of a gauge, by its place among them.
pub fn gauge_name(place: usize) -> String {
    format!("gauge_{}", place + 1)
}

/// Everything about a solid that is no mesh.
pub fn experiment(solid: &Solid, laid: &Laid, mesh: &Mesh, material: &Material) -> Result<Experiment, SetupError> {
    let setup = Setup {
        solid,
        laid,
        mesh,
        material,
    };
    let held = setup.held()?;
    let mut actions = setup.actions(&held)?;
    if !held.is_empty() {
        actions.push((HELD.to_owned(), Box::new(Hold::at_rest(held))));
    }
    let gauges = solid.gauges.iter().flat_map(|gauges| {
        let of_plane = |(place, &at): (usize, &f64)| {
            Gauge::new(gauge_name(place), mesh, |site| laid.is_in_layer(site, gauges.axis, at))
        };
        gauges.at.iter().enumerate().map(of_plane)
    });
    Ok(Experiment {
        actions,
        ramp: setup.ramp(),
        extension: setup.extension(),
        gauges: gauges.collect(),
    })
}

type Named = (String, Box<dyn Action<3>>);

struct Setup<'a> {
    solid: &'a Solid,
    laid: &'a Laid,
    mesh: &'a Mesh,
    material: &'a Material,
}

fn high(axis: Axis) -> Face {
    Face { axis, side: Side::High }
}

fn low(axis: Axis) -> Face {
    Face { axis, side: Side::Low }
}

impl Setup<'_> {
    /// Nodes that do not move.
    fn held(&self) -> Result<Vec<u32>, SetupError> {
        let Some(held) = &self.solid.held else {
            return Ok(Vec::new());
        };
        let mut nodes = Vec::new();
        for &face in &held.faces {
            nodes.extend(self.nodes(face, held.depth)?);
        }
        nodes.sort_unstable();
        nodes.dedup();
        Ok(nodes)
    }

    fn nodes(&self, face: Face, depth: Depth) -> Result<Vec<u32>, SetupError> {
        let nodes = self.laid.nodes_within(self.mesh, face, depth);
        match nodes.is_empty() {
            true => Err(SetupError::FaceTooThin {
                depth: self.laid.depth(face.axis, depth),
                element: self.solid.resolution.element,
            }),
            false => Ok(nodes),
        }
    }

    fn actions(&self, held: &[u32]) -> Result<Vec<Named>, SetupError> {
        let loading = |action: Box<dyn Action<3>>| vec![(LOADING.to_owned(), action)];
        Ok(match self.solid.loading {
            Loading::Velocity {
                face,
                speed,
                direction,
                depth,
                ramp,
            } => {
                let mut nodes = self.nodes(face, depth)?;
                nodes.retain(|node| held.binary_search(node).is_err());
                let velocity = self.laid.direction(face, direction).map(|part| part * speed);
                loading(Box::new(Hold::moving(nodes, velocity, ramp == Start::InitialVelocity)))
            }
            Loading::Traction { face, pull, rise_time } => loading(Box::new(self.push(
                face,
                |_| true,
                pull,
                Course::Rise { within: rise_time },
            ))),
            Loading::Pulse {
                face,
                pull,
                shape,
                duration,
            } => {
                let course = match shape {
                    PulseShape::HalfSine => Course::HalfSine { duration },
                    PulseShape::Gaussian => Course::Gaussian { duration },
                };
                loading(Box::new(self.push(face, |_| true, pull, course)))
            }
            Loading::OpposedTractions {
                axis,
                thickness,
                share,
                pull,
                rise_time,
            } => {
                let depth = Depth::Length(share * self.laid.thickness(thickness));
                let course = Course::Rise { within: rise_time };
                let on = |face: Face, part: Face, pull: Pull| -> Box<dyn Action<3>> {
                    Box::new(self.push(face, |site| self.laid.is_within(site, part, depth), pull, course))
                };
                let opposite = match pull {
                    Pull::Stress(parts) => Pull::Stress(parts.map(|part| -part)),
                    Pull::Pressure(pressure) => Pull::Pressure(pressure),
                };
                vec![
                    (LOADING.to_owned(), on(high(axis), high(thickness), pull)),
                    (OPPOSITE.to_owned(), on(low(axis), low(thickness), opposite)),
                ]
            }
            Loading::Impact {
                face,
                radius,
                speed,
                center,
                gap,
            } => {
                let (_, sites) = Carried::of_solid(self.mesh, |site| self.laid.is_on(site, face));
                let outward = self.laid.outward(face);
                let start = center.unwrap_or_else(|| self.laid.before(face, radius + gap));
                let curvature = self.material.interaction.curvature(self.material.spacing);
                let stiffness = CONTACT * curvature / self.material.spacing;
                let velocity = outward.map(|part| -part * speed);
                loading(Box::new(Ball::new(sites, [radius, stiffness], [start, velocity])))
            }
        })
    }

    /// Force per area on the outermost sites of a face, as a force a site.
    fn push(&self, face: Face, is_wanted: impl Fn([i32; 3]) -> bool, pull: Pull, course: Course) -> Push<3> {
        let on_face = |site| self.laid.is_on(site, face);
        let (_, all) = Carried::of_solid(self.mesh, on_face);
        let (_, sites) = Carried::of_solid(self.mesh, |site| on_face(site) && is_wanted(site));
        let area = self.laid.area_of_a_site(face.axis, all.len());
        let stress = match pull {
            Pull::Stress(parts) => parts,
            Pull::Pressure(pressure) => self.laid.outward(face).map(|part| -part * pressure),
        };
        Push::new(sites.shares(), stress.map(|part| part * area), course)
    }

    /// Velocities that grow from what is held, or the opposite face, to the face that moves.
    fn ramp(&self) -> Option<Ramp<3>> {
        let Loading::Velocity {
            face,
            speed,
            direction,
            depth,
            ramp: Start::InitialVelocity,
        } = self.solid.loading
        else {
            return None;
        };
        let along = self.laid.outward(face);
        let length = self.laid.free_length(self.solid, face, depth);
        // Where the moving part begins, along the way out of its face.
        let origin = match face.side {
            Side::High => self.laid.thickness(face.axis) - 0.5 * self.laid.depth_of_a_layer(face.axis),
            Side::Low => 0.5 * self.laid.depth_of_a_layer(face.axis),
        };
        let to = origin - self.laid.depth(face.axis, depth);
        let velocity = self.laid.direction(face, direction).map(|part| part * speed);
        Some(Ramp {
            along,
            from: to - length,
            to,
            velocities: [[0.0; 3], velocity],
        })
    }

    /// A direction the way that leads from the low to the high face of an axis.
    fn towards_high(&self, direction: [f64; 3], axis: Axis) -> [f64; 3] {
        let sign = dot(direction, self.laid.normal(axis)).signum();
        direction.map(|part| part * sign)
    }

    /// The faces of the axis that the loading acts along.
    fn extension(&self) -> Extension {
        let shares = |is_wanted: &dyn Fn([i32; 3]) -> bool| Carried::of_solid(self.mesh, is_wanted).1.shares();
        if let Loading::Velocity {
            face,
            speed,
            direction,
            depth,
            ..
        } = self.solid.loading
        {
            let opposite = face.opposite();
            let along = self.laid.direction(face, direction);
            let length = self.laid.strained_length(self.solid, face, direction, depth);
            let held = self.solid.held.as_ref().filter(|held| held.faces.contains(&opposite));
            let there = held.map_or(Depth::Layers(1), |held| held.depth);
            return Extension {
                ends: [
                    shares(&|site| self.laid.is_within(site, opposite, there)),
                    shares(&|site| self.laid.is_within(site, face, depth)),
                ],
                along,
                length,
                rate: Some(speed / length),
            };
        }
        let bar = self.laid.bar(self.solid, self.material);
        let axis = match self.solid.loading {
            Loading::OpposedTractions { axis, .. } => axis,
            Loading::Velocity { face, .. }
            | Loading::Traction { face, .. }
            | Loading::Pulse { face, .. }
            | Loading::Impact { face, .. } => face.axis,
        };
        Extension {
            ends: [low(axis), high(axis)].map(|face| shares(&|site| self.laid.is_on(site, face))),
            along: bar.map_or(self.laid.normal(axis), |bar| self.towards_high(bar.along, axis)),
            length: bar.map_or(self.laid.thickness(axis), |bar| bar.length),
            rate: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::solid::{lay_out, material};
    use crate::study::case::Case;
    use crate::{plan, study};

    fn case(changes: &str) -> Case {
        let text = format!(
            "study: faces\nbase:\n  material:\n    potential: {{lennard-jones: {{epsilon: 0.415 eV, sigma: 0.2277 nm, cutoff: 0.34 nm}}}}\n    \
             mass: 63.546 u\n  specimen: {{lattice: fcc, blocks: [2, 3, 1], block: 5}}\n  resolution: {{element: 5}}\n  run: {{until: \
             {{time: 5 ps}}}}\n  {changes}\n"
        );
        let read = study::read_text("study.yaml", &text).expect("it can be read");
        let planned = plan::plan(&read).unwrap_or_else(|error| panic!("{error}"));
        planned.cases.into_iter().next().expect("it has a case").case
    }

    fn made(changes: &str) -> (Experiment, Laid) {
        let case = case(changes);
        let solid = case.solid().expect("it is a solid");
        let material = material(solid).expect("it binds");
        let laid = lay_out(solid, material.spacing).expect("it can be laid out");
        let mesh = Mesh::new(&laid.plan);
        (
            experiment(solid, &laid, &mesh, &material).expect("it can be loaded"),
            laid,
        )
    }

    #[test]
    fn the_force_on_a_face_is_its_stress_times_its_area() {
        let (experiment, laid) = made("loading: {traction: {face: a2-high, stress: [0 GPa, 1 GPa, 0 GPa]}}");
        let state = crate::state::State::at_rest([vec![0.0; 600], vec![0.0; 600], vec![0.0; 600]], vec![1.0; 600]);
        let mut state = state;
        let mut actions = experiment.actions;
        let (name, push) = &mut actions[0];
        push.force(&mut state, 0.0);
        let pull = push.pull(&state, crate::domain::Ranks::alone());
        let expected = laid.area(Axis::Second) / crate::units::EV_PER_NM3_IN_GPA;
        assert_eq!(name, LOADING);
        assert!((pull[1] / expected - 1.0).abs() < 1e-12, "{pull:?} {expected}");
        assert_eq!([pull[0], pull[2]], [0.0; 2]);
    }

    #[test]
    fn a_row_of_blocks_is_held_and_the_opposite_one_moves() {
        let (experiment, laid) = made("held: {faces: [a2-low]}\n  loading: {velocity: {face: a2-high, speed: 20 m/s}}");
        let held: Vec<usize> = experiment
            .actions
            .iter()
            .map(|(_, action)| action.held().len())
            .collect();
        // Two blocks of 14 nodes each.
        assert_eq!(held, [28, 28]);
        let free = laid.thickness(Axis::Second) / 3.0;
        assert!((experiment.extension.length - free).abs() < 1e-12);
        let ramp = experiment.ramp.expect("it begins with its velocities");
        assert!((ramp.to - ramp.from - free).abs() < 1e-12);
        assert!((dot(ramp.along, laid.normal(Axis::Second)) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_ball_starts_its_gap_before_the_middle_of_its_face() {
        let (experiment, laid) = made("loading: {impact: {face: a3-high, radius: 2 nm, speed: 100 m/s, gap: 0.3 nm}}");
        assert_eq!(experiment.extension.rate, None);
        let layer = laid.depth_of_a_layer(Axis::Third);
        assert!((laid.thickness(Axis::Third) - 5.0 * layer).abs() < 1e-12);
    }
}
