//! What a case or a sweep changes, laid over what it starts from.
//!
//! Sections go field by field, and so does a choice (such as a potential) of the same kind; a choice of another kind,
//! a list and a single value replace what was there.

use super::{file::*, quantity::Quantity, reader::Given};

pub trait Overlay {
    /// Sections keep the place at which they were first given: what they lack is missing there.
    const SECTION: bool = false;

    fn overlay(&mut self, over: &Self);
}

impl<T: Overlay + Clone> Overlay for Given<T> {
    fn overlay(&mut self, over: &Self) {
        match (self, over) {
            (_, Given::Absent) => (),
            (Given::Right(value, place), Given::Right(change, changed)) => {
                value.overlay(change);
                if !T::SECTION {
                    *place = *changed;
                }
            }
            (whatever, _) => *whatever = over.clone(),
        }
    }
}

macro_rules! field_by_field {
    ($($section:ident { $($field:ident)* })*) => {$(
        impl Overlay for $section {
            const SECTION: bool = true;

            fn overlay(&mut self, over: &Self) {
                $(self.$field.overlay(&over.$field);)*
            }
        }
    )*};
}

field_by_field! {
    CaseFile { material specimen resolution crack notch held loading run probes observe }
    Material { potential mass thickness }
    LennardJones { epsilon sigma cutoff at_cutoff }
    Morse { depth decay distance cutoff at_cutoff }
    HarmonicBond { stiffness distance cutoff at_cutoff }
    Smooth { from to }
    Specimen { lattice length width blocks size orientation block grips }
    Orientation { x z }
    Slot { from to }
    SeveredPlane { normal at from depth }
    Held { faces layers depth }
    Resolution { element regions refine }
    Refine { to error ahead }
    StrainRate { mode rate ramp sponge damping }
    MovingFace { face speed direction layers depth ramp }
    Traction { face stress pressure rise_time }
    OpposedTractions { axis thickness share stress pressure rise_time }
    Pulse { face shape duration stress pressure }
    Impact { face radius speed center gap }
    Run { until time_step summation mass relax noise ranks threads checkpoint_every }
    Relax { strain }
    Noise { amplitude seed }
    Until { strain time crack_length arrest after_branch leaves_the_plane }
    Probes { every }
}

macro_rules! replaced {
    ($($value:ty)*) => {$(
        impl Overlay for $value {
            fn overlay(&mut self, over: &Self) {
                self.clone_from(over);
            }
        }
    )*};
}

replaced! {
    u32 f64 Lattice Grips Edge NotchEnd Mode Ramp TimeStep Summation MassMatrix Axis Face PulseShape Vec<Given<Face>>
    Vec<Given<Region>> Vec<Given<Observe>>
}

/// A point, a vector or a direction is one value.
impl<T: Clone> Overlay for [Given<T>; 3] {
    fn overlay(&mut self, over: &Self) {
        self.clone_from(over);
    }
}

/// A case that names an edge lies at it: the middle of the notch inside that it starts from is none of its own.
impl Overlay for Crack {
    const SECTION: bool = true;

    fn overlay(&mut self, over: &Self) {
        if matches!(over.edge, Given::Right(Edge::Left | Edge::Right, _)) {
            self.center = Given::Absent;
        }
        self.edge.overlay(&over.edge);
        self.center.overlay(&over.center);
        self.length.overlay(&over.length);
        self.end.overlay(&over.end);
    }
}

impl<K: Copy> Overlay for Quantity<K> {
    fn overlay(&mut self, over: &Self) {
        *self = *over;
    }
}

impl Overlay for Potential {
    fn overlay(&mut self, over: &Self) {
        match (self, over) {
            (Potential::LennardJones(values), Potential::LennardJones(changes)) => values.overlay(changes),
            (Potential::Morse(values), Potential::Morse(changes)) => values.overlay(changes),
            (Potential::HarmonicBond(values), Potential::HarmonicBond(changes)) => values.overlay(changes),
            (whatever, _) => *whatever = over.clone(),
        }
    }
}

impl Overlay for AtCutoff {
    fn overlay(&mut self, over: &Self) {
        match (self, over) {
            (AtCutoff::Smooth(values), AtCutoff::Smooth(changes)) => values.overlay(changes),
            (whatever, _) => *whatever = over.clone(),
        }
    }
}

impl Overlay for Loading {
    fn overlay(&mut self, over: &Self) {
        match (self, over) {
            (Loading::StrainRate(values), Loading::StrainRate(changes)) => values.overlay(changes),
            (Loading::Velocity(values), Loading::Velocity(changes)) => values.overlay(changes),
            (Loading::Traction(values), Loading::Traction(changes)) => values.overlay(changes),
            (Loading::OpposedTractions(values), Loading::OpposedTractions(changes)) => values.overlay(changes),
            (Loading::Pulse(values), Loading::Pulse(changes)) => values.overlay(changes),
            (Loading::Impact(values), Loading::Impact(changes)) => values.overlay(changes),
            (whatever, _) => *whatever = over.clone(),
        }
    }
}

impl Overlay for Notch {
    fn overlay(&mut self, over: &Self) {
        match (self, over) {
            (Notch::Blocks(values), Notch::Blocks(changes)) => values.overlay(changes),
            (Notch::Plane(values), Notch::Plane(changes)) => values.overlay(changes),
            (whatever, _) => *whatever = over.clone(),
        }
    }
}
