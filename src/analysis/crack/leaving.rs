//! Where the crack leaves its plane.

use super::Tracker;

/// A broken path that hangs together with the notch and has come this many spacings from the crack plane has left it: the
/// path through single atoms strays by one or two, and a coarse mesh opens an edge that it may close again.
pub const LEAVES_PLANE_SPACINGS: f64 = 8.0;

/// The end of the first such path, when it is that far away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departure {
    /// nm from the left edge and from the crack plane.
    pub x: f64,
    pub y: f64,
    /// Probe at which the first bond of the path off the plane had broken, after which it does not come back to the plane.
    pub first_off: u32,
}

impl Tracker {
    /// Whether any path from the notch has left the plane so far.
    pub fn has_left_plane(&self) -> bool {
        self.departed.is_some()
    }

    /// The first path that has left the plane, as it is now.
    pub fn departure(&self) -> Option<Departure> {
        let mut here = self.departed?;
        let [x, y] = self.notch.centre(self.cells[here].place);
        let mut first_off = None;
        while let Some((bond, nearer)) = self.step_back(here) {
            if self.notch.is_in_plane(bond) {
                break;
            }
            first_off = Some(self.opened(bond));
            here = nearer;
        }
        let first_off = first_off?;
        Some(Departure { x, y, first_off })
    }

    /// Notes the first cell that is far enough from the plane.
    pub(super) fn note_height(&mut self, at: usize) {
        let [_, y] = self.notch.centre(self.cells[at].place);
        let is_far = y.abs() >= LEAVES_PLANE_SPACINGS * self.notch.spacing;
        if is_far && self.departed.is_none() {
            self.departed = Some(at);
        }
    }
}
