//! What the colour of a picture stands for.

use super::scale::Scale;
use crate::record::frames::{FieldMesh, Frame};
use crate::report::units::{GIGAPASCAL, METRE_PER_SECOND};
use crate::report::{numbers, palette};

/// The scale ends at this quantile, so that a few torn atoms do not darken all the rest.
const QUANTILE: f64 = 0.995;

/// Colours of the grips and of empty space, greys of the palette of a picture.
const GRIPS: [u8; 3] = [151; 3];
const BLACK: [u8; 3] = [34; 3];
const WHITE: [u8; 3] = [255; 3];

/// The innermost nodes of the grips are at their inner edges, but for rounding.
const INNER_EDGE: f64 = 1.0 - 1e-6;

/// A quantity of every cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shade {
    /// Virial stress across the crack plane, GPa, from minus the limit.
    Stress,
    /// Speed of the particles, m/s, from zero.
    Speed,
    /// Atoms per edge of an element, from zero.
    Size,
}

impl Shade {
    /// Of empty space: what is farthest from the colour at zero, so that a crack between idle faces shows.
    pub fn empty(self) -> [u8; 3] {
        match self {
            Self::Stress | Self::Size => BLACK,
            Self::Speed => WHITE,
        }
    }

    /// Its colours, with the end at this value.
    pub fn scale(self, limit: f64) -> Scale {
        match self {
            Self::Stress => Scale {
                label: "σyy (GPa)",
                ends: [-limit, limit],
                colour: palette::stress,
            },
            Self::Speed => Scale {
                label: "speed (m/s)",
                ends: [0.0, limit],
                colour: palette::speed,
            },
            Self::Size => Scale {
                label: "atoms per edge",
                ends: [0.0, limit],
                colour: palette::speed,
            },
        }
    }

    pub fn colours(self, mesh: &FieldMesh, frame: &Frame, limit: f64) -> Vec<[u8; 3]> {
        let values = self.values(mesh, frame);
        let scale = self.scale(limit);
        values.into_iter().map(|value| scale.colour_of(value)).collect()
    }

    /// The same where grips hold a specimen of this height (nm) between them: they do not stretch, so that the stress in
    /// them says nothing.
    pub fn colours_between_grips(self, mesh: &FieldMesh, frame: &Frame, limit: f64, height: f64) -> Vec<[u8; 3]> {
        let mut colours = self.colours(mesh, frame, limit);
        if self != Self::Stress {
            return colours;
        }
        let heights = || mesh.points.iter().map(|point| point[1]);
        let middle = 0.5 * (heights().fold(f64::INFINITY, f64::min) + heights().fold(f64::NEG_INFINITY, f64::max));
        let is_held = |node: &u32| (mesh.points[*node as usize][1] - middle).abs() > 0.5 * height * INNER_EDGE;
        for (colour, ends) in colours.iter_mut().zip(mesh.offsets.windows(2)) {
            if mesh.connectivity[ends[0] as usize..ends[1] as usize]
                .iter()
                .all(is_held)
            {
                *colour = GRIPS;
            }
        }
        colours
    }

    fn values(self, mesh: &FieldMesh, frame: &Frame) -> Vec<f64> {
        match self {
            Self::Size => mesh.element_size.iter().map(|&size| f64::from(size)).collect(),
            Self::Stress => frame.stress.iter().map(|stress| stress[1] * GIGAPASCAL).collect(),
            Self::Speed => {
                let speed = |ends: &[u32]| {
                    let nodes = &mesh.connectivity[ends[0] as usize..ends[1] as usize];
                    let sum = |axis: usize| {
                        let speeds = nodes.iter().map(|&node| frame.velocity[node as usize][axis]);
                        speeds.sum::<f64>() / nodes.len().max(1) as f64
                    };
                    sum(0).hypot(sum(1)) * METRE_PER_SECOND
                };
                mesh.offsets.windows(2).map(speed).collect()
            }
        }
    }

    /// Below which all but a few cells of a frame are.
    pub fn quantile(self, mesh: &FieldMesh, frame: &Frame) -> f64 {
        let mut sizes: Vec<f64> = self.values(mesh, frame).into_iter().map(f64::abs).collect();
        sizes.retain(|value| value.is_finite());
        sizes.sort_by(f64::total_cmp);
        let place = (QUANTILE * sizes.len().saturating_sub(1) as f64) as usize;
        sizes.get(place).copied().unwrap_or(0.0)
    }
}

/// The end of a scale: a simple number above the largest value.
pub fn scale_end(top: f64) -> f64 {
    if top <= 0.0 {
        return 1.0;
    }
    let power = 10f64.powf(top.log10().floor());
    let steps = [1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    let step = steps.into_iter().find(|step| step * power >= top).unwrap_or(10.0);
    numbers::round_significant(power * step, 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grips_are_grey_and_what_is_between_them_is_coloured_by_its_stress() {
        // A triangle up to the inner edge of the lower grip, an atom between the grips, one at the edge of the upper one.
        let mesh = FieldMesh {
            points: vec![
                [0.0, -9.0],
                [2.0, -9.0],
                [1.0, -7.0],
                [1.0, 6.5],
                [1.0, 7.0],
                [1.0, 9.0],
            ],
            connectivity: (0..6).collect(),
            offsets: vec![0, 3, 4, 5, 6],
            element_size: vec![3, 1, 1, 1],
        };
        let frame = Frame {
            stress: vec![[0.0; 3]; 4],
            velocity: vec![[0.0; 2]; 6],
            ..Frame::default()
        };
        let colours = Shade::Stress.colours_between_grips(&mesh, &frame, 1.0, 14.0);
        assert_eq!(colours, [GRIPS, palette::stress(0.5), GRIPS, GRIPS]);
        let moving = Shade::Speed.colours_between_grips(&mesh, &frame, 1.0, 14.0);
        assert_eq!(moving, [palette::speed(0.0); 4]);
    }
}
