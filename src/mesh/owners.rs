//! Which element carries which site.

use super::element::Element;
use super::sites::SiteSet;

/// The elements of all sites, kept by runs: along a lattice row sites of one triangle follow each other, and single atoms
/// with consecutive numbers do.
#[derive(Clone, Debug)]
pub struct Owners {
    /// Where the runs of each lattice row start, and their number at the end.
    of_row: Vec<u32>,
    /// Number of the first site of every run, and its element.
    runs: Vec<[u32; 2]>,
    /// The first of the elements that are single atoms.
    first_atom: u32,
}

impl Owners {
    /// `elements` hold every site once, triangles first.
    pub fn new(sites: &SiteSet, elements: &[Element], triangles: usize) -> Self {
        let mut owner = vec![u32::MAX; sites.len()];
        for (number, element) in elements.iter().enumerate() {
            for (leftmost, count) in element.rows() {
                let run = sites.run(leftmost, count).expect("elements lie inside the specimen");
                owner[run].fill(number as u32);
            }
        }
        let mut owners = Self {
            of_row: vec![0],
            runs: Vec::new(),
            first_atom: triangles as u32,
        };
        for row in 0..sites.rows() {
            let sites = sites.numbers(row);
            let continues = |a: &u32, b: &u32| *b == *a + u32::from(*a >= owners.first_atom);
            let mut first = sites.start as u32;
            for run in owner[sites].chunk_by(continues) {
                owners.runs.push([first, run[0]]);
                first += run.len() as u32;
            }
            owners.of_row.push(owners.runs.len() as u32);
        }
        owners.runs.shrink_to_fit();
        owners
    }

    /// The element of the site with this number in this row.
    #[inline(always)]
    pub fn of(&self, row: i32, site: usize) -> usize {
        let row = row as usize;
        let runs = &self.runs[self.of_row[row] as usize..self.of_row[row + 1] as usize];
        let after = runs.partition_point(|&[first, _]| first as usize <= site);
        let [first, owner] = runs[after - 1];
        let atom = if owner >= self.first_atom {
            site - first as usize
        } else {
            0
        };
        owner as usize + atom
    }
}
