//! Size of the specimen.

use super::{At, Check, about, nanometres};
use crate::study::{
    case::{Grips, Lattice, Specimen},
    defaults, file,
    finding::{Finding, Place},
    reader::Given,
};

/// A specimen, and its extents, which may be known although the whole is not.
pub struct SpecimenAt {
    pub specimen: Option<Specimen>,
    pub length: Option<At<f64>>,
    pub width: Option<At<f64>>,
}

/// Two grips of one element row each, and two rows between them for a crack to run in.
const FEWEST_ROWS: u32 = 4;

impl Check<'_> {
    /// `spacing` is the distance at which two atoms rest, nm; `element` the size of the elements outside the regions.
    pub fn specimen(
        &self,
        given: &Given<file::Specimen>,
        case: Place,
        spacing: Option<f64>,
        element: Option<u32>,
    ) -> SpecimenAt {
        let Some((values, place)) = self.section(given, case) else {
            return SpecimenAt {
                specimen: None,
                length: None,
                width: None,
            };
        };
        let lattice = match &values.lattice {
            Given::Absent => Some(defaults::LATTICE),
            Given::Wrong(_) => None,
            // The other makes a solid, which is resolved as such.
            Given::Right(file::Lattice::Triangular | file::Lattice::Fcc, _) => Some(Lattice::Triangular),
        };
        let grips = match &values.grips {
            Given::Absent => Some(defaults::GRIPS),
            Given::Wrong(_) => None,
            Given::Right(file::Grips::Clamped, _) => Some(Grips::Clamped),
            Given::Right(file::Grips::Sliding, _) => Some(Grips::Sliding),
        };
        let block = self.block(&values.block, element);
        let length = self.size(&values.length, place, "specimen.length");
        let width = self.size(&values.width, place, "specimen.width");
        if let (Some(block), Some(spacing)) = (block, spacing) {
            self.holds_sites(length, width, block, spacing);
        }
        let parts = (|| Some((lattice?, length?.0, width?.0, block?, grips?)))();
        let specimen = parts.map(|(lattice, length, width, block, grips)| Specimen {
            lattice,
            length,
            width,
            block,
            grips,
        });
        SpecimenAt {
            specimen,
            length,
            width,
        }
    }

    /// As large as the elements where nothing is said, so that they leave nothing over.
    fn block(&self, given: &Given<u32>, element: Option<u32>) -> Option<u32> {
        if let Given::Right(block @ 0..3, place) = given {
            let message = format!("`specimen.block` must be at least 3 atoms per edge, and {block} is not");
            self.add(Finding::at(*place, message).help("leave it out for that of the elements"));
            return None;
        }
        self.choice(
            given,
            element.filter(|&element| element >= 3).unwrap_or(defaults::BLOCK),
        )
    }

    /// The rows and columns of the lattice that fit, by the rule that `mesh` rounds with. A longer cutoff brings the
    /// atoms a percent or so closer than `spacing`: the mesh itself is the last judge.
    fn holds_sites(&self, length: Option<At<f64>>, width: Option<At<f64>>, block: u32, spacing: f64) {
        let row = f64::from(block) * 0.75_f64.sqrt() * spacing;
        if let Some((width, place)) = width
            && (width / row).round() < f64::from(FEWEST_ROWS)
        {
            let message = format!(
                "a width of {} holds {} element rows ({} each), and {FEWEST_ROWS} are needed: a grip at either side and two between",
                nanometres(width),
                (width / row).round(),
                about(row)
            );
            let least = about(f64::from(FEWEST_ROWS) * row);
            let help = format!("make it {least} or more, or take smaller elements or a smaller `specimen.block`");
            self.add(Finding::at(place, message).help(help));
        }
        let shortest = f64::from(block + 1) * spacing;
        if let Some((length, place)) = length
            && length < shortest / 2.0
        {
            let message = format!(
                "a length of {} holds no site: one element is {} long",
                nanometres(length),
                about(shortest)
            );
            self.add(Finding::at(place, message).help(format!("make it {} or more", about(10.0 * shortest))));
        }
    }
}
