//! Size of the specimen, its elements and its crack.

use super::{At, Check, about, nanometres};
use crate::study::{
    case::{Crack, Edge, Grips, Lattice, Region, RegionShape, Resolution, Specimen},
    defaults, file,
    finding::{Finding, Place},
    quantity::Length,
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
    /// `spacing` is the distance at which two atoms rest, nm.
    pub fn specimen(&self, given: &Given<file::Specimen>, case: Place, spacing: Option<f64>) -> SpecimenAt {
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
            Given::Right(file::Lattice::Triangular, _) => Some(Lattice::Triangular),
        };
        let grips = match &values.grips {
            Given::Absent => Some(defaults::GRIPS),
            Given::Wrong(_) => None,
            Given::Right(file::Grips::Clamped, _) => Some(Grips::Clamped),
            Given::Right(file::Grips::Sliding, _) => Some(Grips::Sliding),
        };
        let block = self.block(&values.block);
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

    fn block(&self, given: &Given<u32>) -> Option<u32> {
        if let Given::Right(block @ 0..3, place) = given {
            let message = format!("`specimen.block` must be at least 3 atoms an edge, and {block} is not");
            self.add(Finding::at(*place, message).help(format!("leave it out for the usual {}", defaults::BLOCK)));
            return None;
        }
        self.choice(given, defaults::BLOCK)
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
            let help = format!("make it {least} or more, or take a smaller `specimen.block`");
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

    /// The outer `None` is a mistake, the inner one the absence of a crack.
    pub fn crack(&self, given: &Given<file::Crack>, specimen: &SpecimenAt) -> Option<Option<At<Crack>>> {
        let (values, place) = match given {
            Given::Absent => return Some(None),
            Given::Wrong(_) => return None,
            Given::Right(values, place) => (values, *place),
        };
        let edge = match &values.edge {
            Given::Absent => Some(defaults::EDGE),
            Given::Wrong(_) => None,
            Given::Right(file::Edge::Left, _) => Some(Edge::Left),
        };
        let (length, at) = self.size(&values.length, place, "crack.length")?;
        if let Some((whole, given)) = specimen.length
            && length >= whole
        {
            let compared = if length > whole { "longer than" } else { "as long as" };
            let message = format!(
                "the crack ({}) is {compared} the specimen ({})",
                nanometres(length),
                nanometres(whole)
            );
            let help = "shorten the crack or lengthen the specimen";
            self.add(Finding::at(at, message).with(given, "the specimen").help(help));
            return None;
        }
        Some(Some((Crack { edge: edge?, length }, at)))
    }

    pub fn resolution(
        &self,
        given: &Given<file::Resolution>,
        case: Place,
        specimen: &SpecimenAt,
    ) -> Option<Resolution> {
        let (values, place) = self.section(given, case)?;
        let element = self.element(&values.element, place, "resolution.element");
        let regions = match &values.regions {
            Given::Absent => Some(Vec::new()),
            Given::Wrong(_) => None,
            Given::Right(regions, _) => {
                let regions: Vec<_> = regions
                    .iter()
                    .map(|region| self.region(region, element, specimen))
                    .collect();
                regions.into_iter().collect()
            }
        };
        Some(Resolution {
            element: element?.0,
            regions: regions?,
        })
    }

    fn element(&self, given: &Given<u32>, section: Place, path: &str) -> Option<At<u32>> {
        let (element, place) = self.need(given, section, path, "10")?;
        if matches!(element, 0 | 2) {
            let message = format!("an element of {element} atoms an edge does not exist");
            self.add(Finding::at(place, message).help("write 1 for single atoms, or 3 or more for triangles"));
            return None;
        }
        Some((element, place))
    }

    fn region(&self, given: &Given<file::Region>, base: Option<At<u32>>, specimen: &SpecimenAt) -> Option<Region> {
        let Given::Right(region, place) = given else {
            return None;
        };
        let (element, shape) = match region {
            file::Region::Band(band) => {
                let half_width = self.size(&band.half_width, *place, "band.half-width");
                (
                    self.element(&band.element, *place, "band.element"),
                    half_width.map(|(half_width, _)| RegionShape::Band { half_width }),
                )
            }
            file::Region::Box(rectangle) => {
                let from = self.point(&rectangle.from, *place, "box.from");
                let to = self.point(&rectangle.to, *place, "box.to");
                let shape = from.zip(to).and_then(|(from, to)| self.rectangle(from, to));
                (self.element(&rectangle.element, *place, "box.element"), shape)
            }
            file::Region::Disc(disc) => {
                let center = self.point(&disc.center, *place, "disc.center");
                let radius = self.size(&disc.radius, *place, "disc.radius");
                let shape = center.zip(radius).map(|(center, radius)| RegionShape::Disc {
                    center: center.0,
                    radius: radius.0,
                });
                (self.element(&disc.element, *place, "disc.element"), shape)
            }
        };
        if let (Some((fine, at)), Some((coarse, given))) = (element, base)
            && fine > coarse
        {
            let message = format!(
                "the elements of this region ({fine} atoms an edge) are coarser than those around it ({coarse})"
            );
            self.add(
                Finding::at(at, message)
                    .with(given, "around it")
                    .help("a region may only be finer"),
            );
        }
        if let (Some(shape), Some((length, _)), Some((width, _))) = (&shape, specimen.length, specimen.width)
            && !touches(shape, length, width / 2.0)
        {
            let [length, half] = [length, width / 2.0].map(nanometres);
            let message = format!(
                "this region touches nothing of the specimen, where x is 0 to {length} and y is -{half} to {half}"
            );
            let help = "x is measured from the left edge, y from the crack plane";
            self.add(Finding::at(*place, message).help(help));
        }
        Some(Region {
            element: element?.0,
            shape: shape?,
        })
    }

    fn point(&self, given: &Given<[Given<Length>; 2]>, region: Place, path: &str) -> Option<At<[f64; 2]>> {
        let (point, place) = self.need(given, region, path, "[10 nm, -5 nm]")?;
        let [x, y] = point.map(|coordinate| coordinate.right().map(|length| length.value));
        Some(([x?, y?], place))
    }

    fn rectangle(&self, (from, at): At<[f64; 2]>, (to, until): At<[f64; 2]>) -> Option<RegionShape> {
        if from[0] < to[0] && from[1] < to[1] {
            return Some(RegionShape::Box { from, to });
        }
        let [from, to] = [from, to].map(|[x, y]| format!("[{}, {}]", nanometres(x), nanometres(y)));
        let message = format!("this box is empty: from {from} to {to}");
        self.add(
            Finding::at(at, message)
                .with(until, "to here")
                .help("`from` is its lower left, `to` its upper right corner"),
        );
        None
    }
}

fn touches(shape: &RegionShape, length: f64, half: f64) -> bool {
    match *shape {
        RegionShape::Band { .. } => true,
        RegionShape::Box { from, to } => from[0] < length && to[0] > 0.0 && from[1] < half && to[1] > -half,
        RegionShape::Disc { center: [x, y], radius } => {
            (x - x.clamp(0.0, length)).hypot(y - y.clamp(-half, half)) < radius
        }
    }
}
