//! What is cut in a solid.

use super::{case::Notch, specimen::Laid};
use crate::study::{
    file,
    finding::{Finding, Place},
    reader::Given,
    resolve::{Check, about},
};

impl Check<'_> {
    /// The outer `None` is a mistake.
    pub fn solid_notch(&self, given: &Given<file::Notch>, laid: &Laid) -> Option<Option<Notch>> {
        match given {
            Given::Absent => Some(None),
            Given::Wrong(_) => None,
            Given::Right(file::Notch::Blocks(values), place) => self.slot(values, *place, laid).map(Some),
            Given::Right(file::Notch::Plane(values), place) => self.severed(values, *place, laid).map(Some),
        }
    }

    fn slot(&self, values: &file::Slot, place: Place, laid: &Laid) -> Option<Notch> {
        if laid.is_box == Some(true) {
            let message = "a box is not made of blocks that could be left out";
            let help = "write `plane: {normal: y, at: 10 nm, from: x-low, depth: 5 nm}`";
            self.add(Finding::at(place, message).help(help));
            return None;
        }
        let (from, at) = self.need(&values.from, place, "blocks.from", "[0, 20, 0]")?;
        let (to, until) = self.need(&values.to, place, "blocks.to", "[10, 21, 1]")?;
        let numbers = |given: [Given<u32>; 3]| {
            let [a, b, c] = given.map(|number| number.right().copied());
            Some([a?, b?, c?])
        };
        let (from, to) = (numbers(from)?, numbers(to)?);
        if (0..3).any(|axis| from[axis] >= to[axis]) {
            let message = format!("no block is left out from {from:?} to {to:?}");
            let help = "`to` is the first block that is there again, so it is more than `from` along each axis";
            self.add(Finding::at(at, message).with(until, "to here").help(help));
            return None;
        }
        let Some((blocks, given)) = laid.blocks else {
            return Some(Notch::Slot { from, to });
        };
        if (0..3).any(|axis| to[axis] > blocks[axis]) {
            let message = format!("the slot ends at {to:?}, and the solid has {blocks:?} blocks");
            self.add(
                Finding::at(until, message)
                    .with(given, "the solid")
                    .help("let it end within the solid"),
            );
            return None;
        }
        if from == [0; 3] && to == blocks {
            let finding = Finding::at(at, "the slot leaves nothing of the solid").with(given, "the solid");
            self.add(finding.help("leave out fewer blocks"));
            return None;
        }
        Some(Notch::Slot { from, to })
    }

    fn severed(&self, values: &file::SeveredPlane, place: Place, laid: &Laid) -> Option<Notch> {
        let normal = self.axis(&values.normal, place, "plane.normal", laid);
        let at = self.size(&values.at, place, "plane.at");
        let from = self.face(&values.from, place, "plane.from", laid);
        let depth = self.size(&values.depth, place, "plane.depth");
        let ((normal, _), at, (from, at_from), (depth, at_depth)) = (normal?, at?, from?, depth?);
        let at = self.inside(at, laid.thickness(normal))?;
        if from.axis == normal {
            let message = "a plane parallel to this face cannot begin at it";
            self.add(Finding::at(at_from, message).help("begin at a face of another axis"));
            return None;
        }
        if let Some(thickness) = laid.thickness(from.axis)
            && depth >= thickness
        {
            let message = format!(
                "a cut of this depth parts the solid, which is {} thick here",
                about(thickness)
            );
            self.add(Finding::at(at_depth, message).help("make it less deep"));
            return None;
        }
        Some(Notch::Plane {
            normal,
            at,
            from,
            depth,
        })
    }
}
