//! Which element carries which site.

use super::element::Element;
use super::groups::Groups;

/// The elements of all sites, kept by what is alike: along a lattice row the triangles of a group lie side by side at equal
/// distances, and single atoms with consecutive numbers follow each other.
#[derive(Clone, Debug)]
pub struct Owners {
    triangles: Rows,
    atoms: Rows,
}

/// Stretches of lattice rows, row by row from the left.
#[derive(Clone, Debug)]
struct Rows {
    /// Where those of each row start, and their number at the end.
    starts: Vec<u32>,
    stretches: Vec<Stretch>,
}

/// Elements with consecutive numbers that have equally many sites each in a row, at equal distances.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    row: i32,
    /// Column of the first site.
    column: i32,
    /// Sites of each element, and columns from one element to the next.
    width: i32,
    pitch: i32,
    first: u32,
    count: u32,
}

impl Owners {
    /// `elements` hold every site of so many lattice rows once, those in groups first.
    pub fn new(rows: i32, elements: &[Element], groups: &Groups) -> Self {
        let of_triangles = groups.all().iter().flat_map(|group| {
            let first = elements[group.elements.start];
            first.rows().map(|([column, row], width)| Stretch {
                row,
                column,
                width,
                pitch: group.size + 1,
                first: group.elements.start as u32,
                count: group.len() as u32,
            })
        });
        let grouped = groups.all().last().map_or(0, |group| group.elements.end);
        let atoms = &elements[grouped..];
        let mut first = grouped;
        let follows = |one: &Element, next: &Element| one.row == next.row && one.column + 1 == next.column;
        let of_atoms = atoms.chunk_by(follows).map(|run| {
            let stretch = Stretch {
                row: run[0].row,
                column: run[0].column,
                width: 1,
                pitch: 1,
                first: first as u32,
                count: run.len() as u32,
            };
            first += run.len();
            stretch
        });
        Self {
            atoms: Rows::new(rows, of_atoms.collect()),
            triangles: Rows::new(rows, of_triangles.collect()),
        }
    }

    /// The element of a site; `None` where there is no site.
    #[inline(always)]
    pub fn of(&self, [column, row]: [i32; 2]) -> Option<usize> {
        let mut of_triangles = self.triangles.of(row).iter();
        of_triangles.find_map(|stretch| stretch.owner(column)).or_else(|| {
            let of_atoms = self.atoms.of(row);
            let after = of_atoms.partition_point(|stretch| stretch.column <= column);
            of_atoms[..after].last()?.owner(column)
        })
    }
}

impl Rows {
    fn new(rows: i32, mut stretches: Vec<Stretch>) -> Self {
        stretches.sort_by_key(|stretch| (stretch.row, stretch.column));
        let starts = (0..=rows).map(|row| stretches.partition_point(|stretch| stretch.row < row) as u32);
        Self {
            starts: starts.collect(),
            stretches,
        }
    }

    #[inline(always)]
    fn of(&self, row: i32) -> &[Stretch] {
        let bounds = usize::try_from(row)
            .ok()
            .and_then(|row| Some([*self.starts.get(row)?, *self.starts.get(row + 1)?]));
        bounds.map_or(&[], |[from, to]| &self.stretches[from as usize..to as usize])
    }
}

impl Stretch {
    #[inline(always)]
    fn owner(&self, column: i32) -> Option<usize> {
        let along = column - self.column;
        if along < 0 {
            return None;
        }
        let element = along / self.pitch;
        let is_there = (element as u32) < self.count && along - element * self.pitch < self.width;
        is_there.then_some(self.first as usize + element as usize)
    }
}
