//! Elements and the regions where they are finer.

use super::{At, Check, nanometres, specimen::SpecimenAt};
use crate::study::{
    case::{Region, RegionShape, Resolution},
    file,
    finding::{Finding, Place},
    reader::Given,
};

impl Check<'_> {
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
        let refine = self.refine(&values.refine, element);
        Some(Resolution {
            element: element?.0,
            regions: regions?,
            refine: refine?,
        })
    }

    fn element(&self, given: &Given<u32>, section: Place, path: &str) -> Option<At<u32>> {
        let (element, place) = self.need(given, section, path, "10")?;
        if matches!(element, 0 | 2) {
            let message = format!("an element of {element} atoms per edge does not exist");
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
            // Refused where what a slab has no use for is.
            file::Region::Slab(_) | file::Region::Ball(_) | file::Region::Cylinder(_) => return None,
        };
        if let (Some((fine, at)), Some((coarse, given))) = (element, base)
            && fine > coarse
        {
            let message = format!(
                "the elements of this region ({fine} atoms per edge) are coarser than those around it ({coarse})"
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

    fn point(&self, given: &Given<file::Point>, region: Place, path: &str) -> Option<At<[f64; 2]>> {
        self.coordinates(given, region, path, "[10 nm, -5 nm]")
    }

    /// A point of as many coordinates as the specimen has dimensions.
    pub fn coordinates<const D: usize>(
        &self,
        given: &Given<file::Point>,
        region: Place,
        path: &str,
        example: &str,
    ) -> Option<At<[f64; D]>> {
        let (file::Point(point), place) = self.need(given, region, path, example)?;
        if point.len() != D {
            let message = format!("expected a list of {D} values, found {}", point.len());
            self.add(Finding::at(place, message).help(format!("write for example {example}")));
            return None;
        }
        let mut values = [0.0; D];
        for (value, coordinate) in values.iter_mut().zip(&point) {
            *value = coordinate.right()?.value;
        }
        Some((values, place))
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
