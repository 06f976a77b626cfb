use crate::analysis::crack::Tip;
use crate::analysis::frame::Frame;
use crate::analysis::series::{RINGS, Setting};
use crate::analysis::stress_intensity::{
    FROM_ELEMENTS, FROM_SPACINGS, RING_CLEAR_SHARE, RING_ELEMENTS, RING_SPACINGS, on_plane,
};
use crate::mesh::Mesh;

/// Where the rings meet, as shares of the largest radius: one beside the other, so that each sees other elements.
const BOUNDS: [f64; RINGS + 1] = [0.4, 0.6, 0.8, 1.0];

/// Rings around a tip, over which the weights of the integral fall from 1 to 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rings {
    /// Lattice coordinates, nm.
    tip: [f64; 2],
    /// 1 where the crack runs along x, -1 where against it.
    pub(super) direction: f64,
    /// Squares of the radii at which the rings meet, nm^2.
    squared: [f64; RINGS + 1],
}

impl Rings {
    /// Rings inside a circle around a tip in lattice coordinates, nm, that runs along x.
    pub fn within(radius: f64, tip: [f64; 2]) -> Self {
        Self {
            tip,
            direction: 1.0,
            squared: BOUNDS.map(|share| (share * radius).powi(2)),
        }
    }

    /// The rings of a tip in its specimen, it and the setting in the frame of the crack; `None` where they would leave it or
    /// come too near to the tip, and where the tip has left the crack plane, so that the faces are no longer along x.
    pub fn around(tip: Tip, mesh: &Mesh, frame: &Frame, setting: &Setting) -> Option<Self> {
        if !on_plane(tip, setting) {
            return None;
        }
        let left_x = mesh.sites.left() * mesh.spacing;
        let place = [left_x + frame.place([tip.x, tip.y])[0], mesh.middle_height()];
        let [low, high] = mesh.grip_edges();
        let clear = [tip.x, setting.length - tip.x, place[1] - low, high - place[1]];
        let clear = clear.into_iter().fold(f64::INFINITY, f64::min);
        let size = f64::from(setting.element_at_crack);
        let largest = setting.spacing * RING_SPACINGS.max(RING_ELEMENTS * size);
        let rings = Self {
            direction: frame.direction(),
            ..Self::within(largest.min(RING_CLEAR_SHARE * clear), place)
        };
        let nearest = setting.spacing * FROM_SPACINGS.max(FROM_ELEMENTS * size);
        (rings.squared[0] >= nearest * nearest).then_some(rings)
    }

    /// q of every ring at a reference place: linear in the square of the distance, which spares a root.
    #[inline(always)]
    pub(super) fn weights(&self, place: [f64; 2]) -> [f64; RINGS] {
        let [x, y] = [place[0] - self.tip[0], place[1] - self.tip[1]];
        let squared = x * x + y * y;
        std::array::from_fn(|ring| {
            let [inner, outer] = [self.squared[ring], self.squared[ring + 1]];
            ((outer - squared) / (outer - inner)).clamp(0.0, 1.0)
        })
    }

    /// Whether a place is no farther outside the rings than a distance.
    pub(super) fn are_within(&self, distance: f64, place: [f64; 2]) -> bool {
        let [x, y] = [place[0] - self.tip[0], place[1] - self.tip[1]];
        let reach = self.squared[RINGS].sqrt() + distance;
        x * x + y * y <= reach * reach
    }
}
