//! What acts on a slab, from its case.

use std::iter;

use crate::lattice::triangular;
use crate::loading::{
    Action, Carried, Course, Grip, Hold, Layers, Push, SlabLoad, Sponge, Stretching, Together, longest_step,
};
use crate::material::{Material, WaveSpeeds};
use crate::mesh::{Mesh, Plan};
use crate::setup::SetupError;
use crate::study::case::solid::{PulseShape, Side};
use crate::study::case::{Case, Grips, Loading, Mode, Ramp, Slab};

/// Grips that part, or a pulse on a face between grips at rest.
pub fn load(case: &Case, slab: &Slab, mesh: &Mesh, material: &Material) -> SlabLoad {
    match slab.loading {
        Loading::StrainRate {
            mode: Mode::I,
            rate,
            ramp,
            sponge,
            damping,
        } => {
            let loading = Stretching::new(mesh, rate, grip(slab), ramp == Ramp::InitialVelocity);
            let wave_speed = WaveSpeeds::of(material).longitudinal;
            let layers = sponge.map(|width| Layers { width, wave_speed });
            let is_damped = layers.is_some() || damping.is_some();
            let sponge = is_damped.then(|| Sponge::new(mesh, rate, layers, damping.unwrap_or(0.0)));
            let start = case.run.relax.unwrap_or(0.0);
            loading.from_strain(start).with_sponge(sponge).into()
        }
        Loading::Pulse {
            face,
            pressure,
            shape,
            duration,
        } => {
            let course = match shape {
                PulseShape::HalfSine => Course::HalfSine { duration },
                PulseShape::Gaussian => Course::Gaussian { duration },
            };
            let area = triangular::ROW_HEIGHT * mesh.spacing * slab.material.thickness;
            let inward = match face {
                Side::Low => 1.0,
                Side::High => -1.0,
            };
            let push = Push::new(end_of_rows(mesh, face), [inward * pressure * area, 0.0], course);
            let held = Hold::at_rest(grips(mesh)).along(match slab.specimen.grips {
                Grips::Clamped => [true, true],
                Grips::Sliding => [false, true],
            });
            let actions: [(&str, Box<dyn Action<2>>); 2] = [("loading", Box::new(push)), ("held", Box::new(held))];
            let named = actions.map(|(name, action)| (name.to_owned(), action));
            Together::new(named.into()).into()
        }
    }
}

/// The longest step that the grips of a slab allow, ps.
pub fn longest_step_of(slab: &Slab, plan: &Plan) -> f64 {
    match slab.loading {
        Loading::StrainRate { rate, ramp, .. } => {
            let is_ramped = ramp == Ramp::InitialVelocity;
            longest_step(rate, plan.height_between_grips(), is_ramped, plan.spacing)
        }
        Loading::Pulse { .. } => f64::INFINITY,
    }
}

/// Refuses grips that part faster than sound, and sponges that the height (nm) between them or an element has no room for.
pub fn refuse_grips(slab: &Slab, height: f64, material: &Material) -> Result<(), SetupError> {
    let Loading::StrainRate { rate, sponge, .. } = slab.loading else {
        return Ok(());
    };
    let speed = 0.5 * rate * height;
    let sound = WaveSpeeds::of(material).longitudinal;
    if speed > sound {
        return Err(SetupError::FasterThanSound { speed, sound });
    }
    let row = f64::from(slab.resolution.element) * triangular::ROW_HEIGHT * material.spacing;
    match sponge {
        Some(sponge) if 2.0 * sponge >= height => Err(SetupError::SpongesMeet { sponge, height }),
        Some(sponge) if sponge < row => Err(SetupError::SpongeTooThin { sponge, row }),
        _ => Ok(()),
    }
}

/// How the grips of a slab hold it.
pub fn grip(slab: &Slab) -> Grip {
    match slab.specimen.grips {
        Grips::Clamped => Grip::Clamped,
        Grips::Sliding => Grip::Sliding,
    }
}

/// Nodes in the grips.
fn grips(mesh: &Mesh) -> Vec<u32> {
    let elements = (0..mesh.elements.len()).filter(|&element| mesh.grip_of(&mesh.elements[element]) != 0);
    elements
        .flat_map(|element| mesh.nodes_of(element))
        .map(|node| node as u32)
        .collect()
}

/// The nodes that carry the last site of every lattice row at a face, each with how many of these it stands for.
fn end_of_rows(mesh: &Mesh, face: Side) -> Vec<(u32, f64)> {
    let last = (0..mesh.sites.rows()).filter_map(|row| {
        let columns = mesh.sites.columns(row);
        let column = match face {
            Side::Low => columns.start,
            Side::High => columns.end - 1,
        };
        mesh.carriers([column, row])
    });
    Carried::new(last.map(|(_, carriers)| iter::once(carriers))).shares()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Ranks;
    use crate::loading::Load;
    use crate::setup::slab::{material, mesh_plan};
    use crate::state::State;
    use crate::units::EV_PER_NM3_IN_GPA;
    use crate::{plan, study};

    /// Rounding of a sum over some tens of rows.
    const ROUNDING: f64 = 1e-12;

    fn case(element: u32, face: &str) -> Case {
        let text = format!(
            "study: pulse\nbase:\n  material:\n    potential: {{lennard-jones: {{epsilon: 0.415 eV, sigma: 0.2277 nm, cutoff: 0.34 nm}}}}\n    \
             mass: 802 u\n    thickness: 0.2087 nm\n  specimen: {{lattice: triangular, length: 30 nm, width: 9 nm, block: 10, grips: sliding}}\n  \
             resolution: {{element: {element}}}\n  loading: {{pulse: {{face: {face}, duration: 8 ps, pressure: 0.1 GPa}}}}\n  \
             run: {{until: {{time: 20 ps}}}}\n"
        );
        let read = study::read_text("study.yaml", &text).expect("it can be read");
        let planned = plan::plan(&read).unwrap_or_else(|error| panic!("{error}"));
        planned.cases.into_iter().next().expect("it has a case").case
    }

    #[test]
    fn the_force_of_a_pulse_is_its_pressure_times_the_area_of_its_face_into_the_slab() {
        for (element, face, sign) in [(10, "x-low", 1.0), (1, "x-high", -1.0)] {
            let case = case(element, face);
            let slab = case.slab().expect("it is a slab");
            let material = material(slab).expect("it binds");
            let mesh = Mesh::new(&mesh_plan(slab, &case.run.until, &material).expect("it can be laid out"));
            let mut state = State::at_rest(mesh.node_positions(), mesh.lumped_masses());
            let SlabLoad::Actions(mut actions) = load(&case, slab, &mesh, &material) else {
                panic!("a pulse is an action");
            };
            // Half of the duration: the peak.
            actions.force(&mut state, 4.0);
            let [[x, y], held] = actions.pulls(&state, Ranks::alone())[..] else {
                panic!("it pushes and holds");
            };
            let width = f64::from(mesh.sites.rows()) * triangular::ROW_HEIGHT * mesh.spacing;
            let expected = sign * 0.1 / EV_PER_NM3_IN_GPA * width * slab.material.thickness;
            assert!((x / expected - 1.0).abs() < ROUNDING && y == 0.0, "{x} for {expected}");
            assert_eq!(held, [0.0; 2], "grips that slide take no part in it");
            // What carries the force is at that face.
            let left = state.force[0]
                .iter()
                .zip(&state.position[0])
                .filter(|(force, _)| **force != 0.0);
            let middle = 0.5 * (mesh.sites.left() + mesh.sites.right()) * mesh.spacing;
            assert!(left.clone().count() > 0);
            assert!(left.clone().all(|(_, x)| (x - middle) * sign < 0.0));
            actions.hold(&mut state);
            assert!(state.mobility[0].iter().all(|mobility| *mobility > 0.0));
            assert!(state.mobility[1].contains(&0.0));
        }
    }
}
