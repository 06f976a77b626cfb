//! Faces and axes by name, and how much belongs to a face.

use super::{case, specimen::Laid};
use crate::study::{
    file,
    finding::{Finding, Place},
    quantity::Length,
    reader::Given,
    resolve::{At, Check},
};
use case::{Axis, Depth, Face, Held, Side};

/// Layers of a face beyond these are a slip.
const MOST_LAYERS: u32 = 1_000_000;

impl Check<'_> {
    pub fn axis(&self, given: &Given<file::Axis>, section: Place, path: &str, laid: &Laid) -> Option<At<Axis>> {
        let (name, place) = self.need(given, section, path, laid.names()[0])?;
        let (axis, of_blocks) = match name {
            file::Axis::A1 => (Axis::First, true),
            file::Axis::A2 => (Axis::Second, true),
            file::Axis::A3 => (Axis::Third, true),
            file::Axis::X => (Axis::First, false),
            file::Axis::Y => (Axis::Second, false),
            file::Axis::Z => (Axis::Third, false),
        };
        self.fits(of_blocks, axis, "", place, laid).then_some((axis, place))
    }

    pub fn face(&self, given: &Given<file::Face>, section: Place, path: &str, laid: &Laid) -> Option<At<Face>> {
        let example = format!("{}-high", laid.names()[1]);
        let (name, place) = self.need(given, section, path, &example)?;
        let (axis, side, of_blocks) = match name {
            file::Face::A1Low => (Axis::First, Side::Low, true),
            file::Face::A1High => (Axis::First, Side::High, true),
            file::Face::A2Low => (Axis::Second, Side::Low, true),
            file::Face::A2High => (Axis::Second, Side::High, true),
            file::Face::A3Low => (Axis::Third, Side::Low, true),
            file::Face::A3High => (Axis::Third, Side::High, true),
            file::Face::XLow => (Axis::First, Side::Low, false),
            file::Face::XHigh => (Axis::First, Side::High, false),
            file::Face::YLow => (Axis::Second, Side::Low, false),
            file::Face::YHigh => (Axis::Second, Side::High, false),
            file::Face::ZLow => (Axis::Third, Side::Low, false),
            file::Face::ZHigh => (Axis::Third, Side::High, false),
        };
        let ending = match side {
            Side::Low => "-low",
            Side::High => "-high",
        };
        let fits = self.fits(of_blocks, axis, ending, place, laid);
        fits.then_some((Face { axis, side }, place))
    }

    /// Blocks have the axes a1, a2, a3, and boxes x, y, z.
    fn fits(&self, of_blocks: bool, axis: Axis, ending: &str, place: Place, laid: &Laid) -> bool {
        let Some(is_box) = laid.is_box else { return true };
        if of_blocks != is_box {
            return true;
        }
        let message = match is_box {
            true => "this is an axis of blocks, and the specimen is a box",
            false => "this is an axis of a box, and the specimen is made of blocks",
        };
        let help = format!("write `{}{ending}`", laid.names()[axis.index()]);
        self.add(Finding::at(place, message).help(help));
        false
    }

    /// The faces that do not move; the outer `None` is a mistake.
    pub fn held(&self, given: &Given<file::Held>, laid: &Laid) -> Option<Option<At<Held>>> {
        let (values, place) = match given {
            Given::Absent => return Some(None),
            Given::Wrong(_) => return None,
            Given::Right(values, place) => (values, *place),
        };
        let example = format!("[{}-low]", laid.names()[1]);
        let (names, list) = self.need(&values.faces, place, "held.faces", &example)?;
        if names.is_empty() {
            self.add(
                Finding::at(list, "no face is named").help(format!("write `faces: {example}`, or leave `held` out")),
            );
            return None;
        }
        let mut faces = Vec::new();
        for name in &names {
            let (face, place) = self.face(name, list, "held.faces", laid)?;
            if faces.contains(&face) {
                self.add(Finding::at(place, "this face is held already").help("name it once"));
                return None;
            }
            faces.push(face);
        }
        let depth = self.depth(&values.layers, &values.depth, place, "held", laid)?;
        Some(Some((Held { faces, depth }, place)))
    }

    /// How much belongs to a face: layers of cells of blocks, where nothing is said those of one block; a length of a box.
    pub fn depth(
        &self,
        layers: &Given<u32>,
        length: &Given<Length>,
        section: Place,
        path: &str,
        laid: &Laid,
    ) -> Option<Depth> {
        if laid.is_box? {
            if let Some(place) = layers.place() {
                let message = "a box has no layers of cells along its axes";
                self.add(Finding::at(place, message).help("write a length, such as `depth: 2 nm`"));
                return None;
            }
            let (length, _) = self.size(length, section, &format!("{path}.depth"))?;
            return Some(Depth::Length(length));
        }
        if let Some(place) = length.place() {
            let message = "what is made of blocks has layers of cells from a face on";
            self.add(Finding::at(place, message).help("write their number, such as `layers: 10`"));
            return None;
        }
        let layers = self
            .choice(layers, laid.block?)
            .map(|number| (number, layers.place()))?;
        match layers {
            (1..=MOST_LAYERS, _) => Some(Depth::Layers(layers.0)),
            (number, place) => {
                let message = format!("{number} layers make no face");
                self.add(Finding::at(place.unwrap_or(section), message).help("write 1 or more, such as `layers: 10`"));
                None
            }
        }
    }

    /// A face cannot both be held and be loaded.
    pub fn moves_no_held_face(&self, (loading, place): &At<case::Loading>, held: Option<&At<Held>>) {
        use case::Loading;
        let faces = match *loading {
            Loading::Velocity { face, .. }
            | Loading::Traction { face, .. }
            | Loading::Pulse { face, .. }
            | Loading::Impact { face, .. } => vec![face],
            Loading::OpposedTractions { axis, .. } => [Side::Low, Side::High].map(|side| Face { axis, side }).to_vec(),
        };
        let Some((held, given)) = held else { return };
        if faces.iter().any(|face| held.faces.contains(face)) {
            let message = "this loads a face that is held";
            let help = "load another face, or let this one go";
            self.add(Finding::at(*place, message).with(*given, "held here").help(help));
        }
    }
}
