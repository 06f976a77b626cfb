//! What moves and loads a slab.

use crate::study::{
    case::{Loading, Mode, Ramp, solid::PulseShape, solid::Side},
    defaults, file,
    finding::{Finding, Place},
    quantity::Length,
    reader::Given,
    resolve::{Check, nanometres, specimen::SpecimenAt},
};

impl Check<'_> {
    pub fn loading(&self, given: &Given<file::Loading>, case: Place, specimen: &SpecimenAt) -> Option<Loading> {
        let (loading, place) = self.need(given, case, "loading", "{strain-rate: {mode: I, rate: 4.6e6 /s}}")?;
        match &loading {
            file::Loading::StrainRate(values) => self.strain_rate(values, place, specimen),
            file::Loading::Pulse(values) => self.slab_pulse(values, place),
            // Refused where what a slab has no use for is.
            _ => None,
        }
    }

    fn strain_rate(&self, values: &file::StrainRate, place: Place, specimen: &SpecimenAt) -> Option<Loading> {
        let mode = match &values.mode {
            Given::Absent => Some(defaults::MODE),
            Given::Wrong(_) => None,
            Given::Right(file::Mode::I, _) => Some(Mode::I),
        };
        let ramp = match &values.ramp {
            Given::Absent => Some(defaults::RAMP),
            Given::Wrong(_) => None,
            Given::Right(file::Ramp::InitialVelocity, _) => Some(Ramp::InitialVelocity),
            Given::Right(file::Ramp::AtRest, _) => Some(Ramp::AtRest),
        };
        let sponge = self.sponge(&values.sponge, specimen);
        let damping = self.size_if_given(&values.damping, "strain-rate.damping");
        let (rate, _) = self.size(&values.rate, place, "strain-rate.rate")?;
        Some(Loading::StrainRate {
            mode: mode?,
            rate,
            ramp: ramp?,
            sponge: sponge?,
            damping: damping?.map(|(damping, _)| damping),
        })
    }

    /// The outer `None` is a mistake.
    fn sponge(&self, given: &Given<Length>, specimen: &SpecimenAt) -> Option<Option<f64>> {
        let sponge = self.size_if_given(given, "strain-rate.sponge")?;
        if let (Some((sponge, place)), Some((width, given))) = (sponge, specimen.width)
            && sponge >= 0.5 * width
        {
            let [sponge, width] = [sponge, width].map(nanometres);
            let message = format!("two sponges of {sponge} leave nothing of a specimen of {width} for a crack");
            let help = "make the sponges thinner or the specimen wider";
            self.add(Finding::at(place, message).with(given, "the specimen").help(help));
            return None;
        }
        Some(sponge.map(|(width, _)| width))
    }

    /// Of a pressure on one of the faces that no grip holds.
    fn slab_pulse(&self, values: &file::Pulse, place: Place) -> Option<Loading> {
        let face = self.end_face(&values.face, place);
        let duration = self.size(&values.duration, place, "pulse.duration");
        let shape = self.pulse_shape(&values.shape);
        if let Some(place) = values.stress.place() {
            let message = "a slab is pushed straight into its face, and this is a stress of any direction";
            self.add(Finding::at(place, message).help("write `pressure: 0.1 GPa`; a negative one pulls"));
            return None;
        }
        let (pressure, at) = self.need(&values.pressure, place, "pulse.pressure", "0.1 GPa")?;
        if pressure.value == 0.0 {
            self.add(Finding::at(at, "no force at all loads nothing").help("write for example `pressure: 0.1 GPa`"));
            return None;
        }
        Some(Loading::Pulse {
            face: face?,
            pressure: pressure.value,
            shape: shape?,
            duration: duration?.0,
        })
    }

    pub fn pulse_shape(&self, given: &Given<file::PulseShape>) -> Option<PulseShape> {
        match given {
            Given::Absent => Some(defaults::PULSE),
            Given::Wrong(_) => None,
            Given::Right(file::PulseShape::HalfSine, _) => Some(PulseShape::HalfSine),
            Given::Right(file::PulseShape::Gaussian, _) => Some(PulseShape::Gaussian),
        }
    }

    fn end_face(&self, given: &Given<file::Face>, section: Place) -> Option<Side> {
        let (face, place) = self.need(given, section, "pulse.face", "x-low")?;
        match face {
            file::Face::XLow => Some(Side::Low),
            file::Face::XHigh => Some(Side::High),
            _ => {
                let message = "a pulse enters a slab at its left or its right face: the grips hold the others";
                self.add(
                    Finding::at(place, message).help("write `x-low` for the left face, `x-high` for the right one"),
                );
                None
            }
        }
    }
}
