//! The spaces between the bonds: the triangles of the lattice through which a crack runs.
//!
//! Site (i, j) stands at x = (i + j/2) r0, y = j sqrt(3)/2 r0. An upright plaquette (i, j) has the corners
//! (i, j), (i + 1, j), (i, j + 1); the inverted one (i + 1, j), (i, j + 1), (i + 1, j + 1). Breaking a bond
//! opens the way between the two plaquettes on its sides.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hash, Hasher};

use crate::analysis::series::BondEvent;

/// A bond of the triangular lattice, named as in [`BondEvent`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Bond {
    pub column: i32,
    pub row: i32,
    pub direction: u8,
}

/// A triangle of three neighbouring sites.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Plaquette {
    pub row: i32,
    pub column: i32,
    pub upright: bool,
}

impl Plaquette {
    /// The bond on the side of the given direction, and the plaquette beyond it.
    pub fn across(self, direction: u8) -> (Bond, Plaquette) {
        let Plaquette { row, column, upright } = self;
        let bond = |column, row| Bond { column, row, direction };
        let beyond = |column, row| Plaquette {
            row,
            column,
            upright: !upright,
        };
        match (upright, direction) {
            (true, 0) => (bond(column, row), beyond(column, row - 1)),
            (true, 1) => (bond(column, row), beyond(column - 1, row)),
            (true, _) => (bond(column + 1, row), beyond(column, row)),
            (false, 0) => (bond(column, row + 1), beyond(column, row + 1)),
            (false, 1) => (bond(column + 1, row), beyond(column + 1, row)),
            (false, _) => (bond(column + 1, row), beyond(column, row)),
        }
    }

    /// Centre along x in half spacings, an integer.
    pub fn half_spacings(self) -> i32 {
        2 * self.column + self.row + if self.upright { 1 } else { 2 }
    }
}

impl Bond {
    /// The bond that an event is about.
    pub fn of(event: &BondEvent) -> Bond {
        Bond {
            column: event.column,
            row: event.row,
            direction: event.direction,
        }
    }

    /// The plaquettes on its two sides, the upright one first.
    pub fn plaquettes(self) -> [Plaquette; 2] {
        let Bond { column, row, direction } = self;
        let column = if direction == 2 { column - 1 } else { column };
        let upright = Plaquette {
            row,
            column,
            upright: true,
        };
        [upright, upright.across(direction).1]
    }

    /// Middle of the bond in units of the spacing, lattice axes.
    pub fn midpoint(self) -> [f64; 2] {
        let (step, rise) = [(0.5, 0.0), (0.25, 0.5), (-0.25, 0.5)][usize::from(self.direction)];
        let row = f64::from(self.row);
        [
            f64::from(self.column) + 0.5 * row + step,
            (row + rise) * 0.75_f64.sqrt(),
        ]
    }
}

/// A map from plaquettes, with a hash made for them: the standard one takes half of the time of following a crack.
pub type PlaquetteMap<T> = HashMap<Plaquette, T, BuildHasherDefault<Scatter>>;

/// One multiplication, folded so that the low bits depend on all.
#[derive(Clone, Copy, Debug, Default)]
pub struct Scatter(u64);

impl Hash for Plaquette {
    fn hash<H: Hasher>(&self, state: &mut H) {
        let column = u64::from(self.column as u32) << 1 | u64::from(self.upright);
        state.write_u64(u64::from(self.row as u32) << 33 ^ column);
    }
}

impl Hasher for Scatter {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|&byte| self.write_u64(u64::from(byte)));
    }

    fn write_u64(&mut self, value: u64) {
        let product = (self.0 ^ value).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        self.0 = product ^ product >> 32;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crossing_a_bond_twice_leads_back() {
        for upright in [true, false] {
            let start = Plaquette {
                row: -3,
                column: 7,
                upright,
            };
            for direction in 0..3 {
                let (bond, beyond) = start.across(direction);
                assert_eq!(beyond.across(direction), (bond, start));
                let mut sides = [start, beyond];
                sides.sort_by_key(|side| !side.upright);
                assert_eq!(bond.plaquettes(), sides);
            }
        }
    }

    #[test]
    fn middles_of_the_sides_of_a_plaquette_are_half_a_spacing_apart() {
        for upright in [true, false] {
            let plaquette = Plaquette {
                row: 2,
                column: -5,
                upright,
            };
            let middles = [0, 1, 2].map(|direction| plaquette.across(direction).0.midpoint());
            for side in 0..3 {
                let [a, b] = [middles[side], middles[(side + 1) % 3]];
                assert!(((a[0] - b[0]).hypot(a[1] - b[1]) - 0.5).abs() < 1e-12);
            }
        }
    }
}
