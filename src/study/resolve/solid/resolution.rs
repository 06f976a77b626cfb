//! Elements of a solid and the regions where they are finer.

use super::case::{Region, RegionShape, Resolution};
use super::specimen::{Laid, SMALLEST_BLOCK, told};
use crate::study::{
    file,
    finding::{Finding, Place},
    reader::Given,
    resolve::{At, Check},
};

const POINT: &str = "[10 nm, 20 nm, 1 nm]";

impl Check<'_> {
    pub fn solid_resolution(&self, given: &Given<file::Resolution>, case: Place, laid: &Laid) -> Option<Resolution> {
        let (values, place) = self.section(given, case)?;
        let element = self.cells(&values.element, place, "resolution.element");
        let regions = match &values.regions {
            Given::Absent => Some(Vec::new()),
            Given::Wrong(_) => None,
            Given::Right(regions, _) => {
                let regions: Vec<_> = regions
                    .iter()
                    .map(|region| self.solid_region(region, element, laid))
                    .collect();
                regions.into_iter().collect()
            }
        };
        Some(Resolution {
            element: element?.0,
            regions: regions?,
        })
    }

    fn cells(&self, given: &Given<u32>, section: Place, path: &str) -> Option<At<u32>> {
        let (element, place) = self.need(given, section, path, "10")?;
        if element != 1 && element < SMALLEST_BLOCK {
            let message = format!("a block of {element} cells per edge holds no elements");
            let help = format!("write 1 for single atoms, or {SMALLEST_BLOCK} or more");
            self.add(Finding::at(place, message).help(help));
            return None;
        }
        Some((element, place))
    }

    fn solid_region(&self, given: &Given<file::Region>, base: Option<At<u32>>, laid: &Laid) -> Option<Region> {
        let Given::Right(region, place) = given else {
            return None;
        };
        let place = *place;
        let (element, shape) = match region {
            file::Region::Box(values) => (
                self.cells(&values.element, place, "box.element"),
                self.cuboid(values, place),
            ),
            file::Region::Slab(values) => {
                let normal = self.axis(&values.normal, place, "slab.normal", laid);
                let at = self.size(&values.at, place, "slab.at");
                let half_width = self.size(&values.half_width, place, "slab.half-width");
                let shape = normal.zip(at).zip(half_width);
                (
                    self.cells(&values.element, place, "slab.element"),
                    shape.map(|((normal, at), half_width)| RegionShape::Slab {
                        normal: normal.0,
                        at: at.0,
                        half_width: half_width.0,
                    }),
                )
            }
            file::Region::Ball(values) => {
                let center = self.coordinates(&values.center, place, "ball.center", POINT);
                let radius = self.size(&values.radius, place, "ball.radius");
                (
                    self.cells(&values.element, place, "ball.element"),
                    center.zip(radius).map(|(center, radius)| RegionShape::Ball {
                        center: center.0,
                        radius: radius.0,
                    }),
                )
            }
            file::Region::Cylinder(values) => {
                let along = self.axis(&values.along, place, "cylinder.along", laid);
                let center = self.coordinates(&values.center, place, "cylinder.center", POINT);
                let radius = self.size(&values.radius, place, "cylinder.radius");
                let shape = along.zip(center).zip(radius);
                (
                    self.cells(&values.element, place, "cylinder.element"),
                    shape.map(|((along, center), radius)| RegionShape::Cylinder {
                        along: along.0,
                        center: center.0,
                        radius: radius.0,
                    }),
                )
            }
            // Refused where what a solid has no use for is.
            file::Region::Band(_) | file::Region::Disc(_) => return None,
        };
        if let (Some((fine, at)), Some((coarse, given))) = (element, base)
            && fine > coarse
        {
            let message = format!(
                "the elements of this region ({fine} cells per edge) are coarser than those around it ({coarse})"
            );
            let finding = Finding::at(at, message).with(given, "around it");
            self.add(finding.help("a region may only be finer"));
        }
        if let (Some(shape), Some(bounds)) = (&shape, laid.bounds())
            && !touches(shape, bounds, laid)
        {
            let [from, to] = bounds.map(told);
            let message = format!("this region touches nothing of the specimen, which lies between {from} and {to}");
            self.add(Finding::at(place, message).help("all is measured from the corner of the low faces"));
        }
        Some(Region {
            element: element?.0,
            shape: shape?,
        })
    }

    fn cuboid(&self, values: &file::Rectangle, place: Place) -> Option<RegionShape> {
        let from = self.coordinates(&values.from, place, "box.from", POINT);
        let to = self.coordinates(&values.to, place, "box.to", POINT);
        let ((from, at), (to, until)) = (from?, to?);
        if (0..3).all(|axis| from[axis] < to[axis]) {
            return Some(RegionShape::Box { from, to });
        }
        let message = format!("this box is empty: from {} to {}", told(from), told(to));
        let finding = Finding::at(at, message).with(until, "to here");
        self.add(finding.help("`from` is the corner of its low faces, `to` that of its high ones"));
        None
    }
}

/// Whether a shape has a part in the box that holds the specimen.
fn touches(shape: &RegionShape, [low, high]: [[f64; 3]; 2], laid: &Laid) -> bool {
    let outside = |center: [f64; 3]| {
        let gaps = (0..3).map(|axis| center[axis] - center[axis].clamp(low[axis], high[axis]));
        gaps.map(|gap| gap * gap).sum::<f64>().sqrt()
    };
    match *shape {
        RegionShape::Box { from, to } => (0..3).all(|axis| from[axis] < high[axis] && to[axis] > low[axis]),
        RegionShape::Slab { normal, at, half_width } => laid
            .thickness(normal)
            .is_none_or(|thickness| at - half_width < thickness),
        RegionShape::Ball { center, radius } => outside(center) < radius,
        // It is of any length: only what lies across it can miss the specimen, which the mesh tells.
        RegionShape::Cylinder { .. } => true,
    }
}
