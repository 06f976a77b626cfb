//! The notch: the bonds that were severed before anything broke.

use super::plaquette::{Bond, Plaquette};

/// A cut that ends on the middle of a bond leaves it whole. The mesh knows its ends in spacings, and here they are in nm.
const ROUNDING: f64 = 1e-9;

/// The cut, and where it lies in the lattice. It is measured from the origin of the crack's frame: the edge that the crack
/// comes from, or the middle of a notch that reaches no edge.
#[derive(Clone, Copy, Debug)]
pub struct Notch {
    pub spacing: f64,
    /// Lattice x of the origin, nm.
    pub left_x: f64,
    /// Bonds between lattice rows `row` and `row + 1` are cut.
    pub row: i32,
    pub cut_end: f64,
    /// The cut is as long on the other side of the origin.
    pub is_inside: bool,
}

impl Notch {
    /// The severed bonds from the origin on, left to right.
    pub fn cut_bonds(&self) -> Vec<Bond> {
        let first = ((self.left_x / self.spacing) - 0.5 * f64::from(self.row)).floor() as i32;
        let count = (self.cut_end / self.spacing).ceil() as i32;
        (first..=first + count + 1)
            .flat_map(|column| {
                [2, 1].map(|direction| Bond {
                    column,
                    row: self.row,
                    direction,
                })
            })
            .filter(|bond| self.is_cut(*bond) && self.place(*bond)[0] >= -ROUNDING * self.spacing)
            .collect()
    }

    /// A bond is severed when its middle is before the end of the cut, as in the mesh.
    pub fn is_cut(&self, bond: Bond) -> bool {
        let x = self.place(bond)[0];
        let off = if self.is_inside { x.abs() } else { x };
        self.is_in_plane(bond) && off >= 0.0 && off < self.cut_end - ROUNDING * self.spacing
    }

    /// Middle of a bond, nm from the origin and from the crack plane.
    pub fn place(&self, bond: Bond) -> [f64; 2] {
        let [x, y] = bond.midpoint();
        let plane = (f64::from(self.row) + 0.5) * 0.75_f64.sqrt();
        [x * self.spacing - self.left_x, (y - plane) * self.spacing]
    }

    /// Whether a bond crosses the crack plane.
    pub fn is_in_plane(&self, bond: Bond) -> bool {
        bond.row == self.row && bond.direction != 0
    }

    /// Centre of a plaquette, nm from the origin and from the crack plane.
    pub fn centre(&self, of: Plaquette) -> [f64; 2] {
        let sides = [0, 1, 2].map(|direction| self.place(of.across(direction).0));
        [0, 1].map(|axis| sides.iter().map(|side| side[axis]).sum::<f64>() / 3.0)
    }
}
