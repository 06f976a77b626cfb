//! What moves and loads a solid.

use super::case::{Loading, Pull};
use super::specimen::{Laid, told};
use crate::study::{
    case::Ramp,
    defaults, file,
    finding::{Finding, Place},
    quantity::{Stress, Time},
    reader::Given,
    resolve::{At, Check},
};

const EXAMPLE: &str = "{velocity: {face: a2-high, speed: 20 m/s}}";

impl Check<'_> {
    pub fn solid_loading(&self, given: &Given<file::Loading>, case: Place, laid: &Laid) -> Option<At<Loading>> {
        let (loading, place) = self.need(given, case, "loading", EXAMPLE)?;
        let loading = match &loading {
            file::Loading::Velocity(values) => self.moving_face(values, place, laid),
            file::Loading::Traction(values) => {
                let face = self.face(&values.face, place, "traction.face", laid);
                let pull = self.pull(&values.stress, &values.pressure, place, "traction");
                let rise_time = self.rise_time(&values.rise_time, "traction.rise-time");
                (|| {
                    Some(Loading::Traction {
                        face: face?.0,
                        pull: pull?,
                        rise_time: rise_time?,
                    })
                })()
            }
            file::Loading::OpposedTractions(values) => self.opposed(values, place, laid),
            file::Loading::Pulse(values) => {
                let face = self.face(&values.face, place, "pulse.face", laid);
                let pull = self.pull(&values.stress, &values.pressure, place, "pulse");
                let duration = self.size(&values.duration, place, "pulse.duration");
                let shape = self.pulse_shape(&values.shape);
                (|| {
                    Some(Loading::Pulse {
                        face: face?.0,
                        pull: pull?,
                        shape: shape?,
                        duration: duration?.0,
                    })
                })()
            }
            file::Loading::Impact(values) => self.impact(values, place, laid),
            // Refused where what a solid has no use for is.
            file::Loading::StrainRate(_) => None,
        };
        loading.map(|loading| (loading, place))
    }

    fn moving_face(&self, values: &file::MovingFace, place: Place, laid: &Laid) -> Option<Loading> {
        let face = self.face(&values.face, place, "velocity.face", laid);
        let speed = self.size(&values.speed, place, "velocity.speed");
        let depth = self.depth(&values.layers, &values.depth, place, "velocity", laid);
        let ramp = match &values.ramp {
            Given::Absent => Some(defaults::RAMP),
            Given::Wrong(_) => None,
            Given::Right(file::Ramp::InitialVelocity, _) => Some(Ramp::InitialVelocity),
            Given::Right(file::Ramp::AtRest, _) => Some(Ramp::AtRest),
        };
        let direction = match &values.direction {
            Given::Absent => Some(None),
            Given::Wrong(_) => None,
            Given::Right(parts, place) => self.unit_vector(parts, *place).map(Some),
        };
        Some(Loading::Velocity {
            face: face?.0,
            speed: speed?.0,
            direction: direction?,
            depth: depth?,
            ramp: ramp?,
        })
    }

    fn unit_vector(&self, parts: &[Given<f64>; 3], place: Place) -> Option<[f64; 3]> {
        let [x, y, z] = parts.each_ref().map(|part| part.right().copied());
        let vector = [x?, y?, z?];
        let length = vector.iter().map(|part| part * part).sum::<f64>().sqrt();
        if length > 0.0 && length.is_finite() {
            return Some(vector.map(|part| part / length));
        }
        let message = "a direction has a length";
        self.add(Finding::at(place, message).help("write for example `direction: [0, 1, 0]`, or leave it out"));
        None
    }

    fn opposed(&self, values: &file::OpposedTractions, place: Place, laid: &Laid) -> Option<Loading> {
        let axis = self.axis(&values.axis, place, "opposed-tractions.axis", laid);
        let thickness = self.axis(&values.thickness, place, "opposed-tractions.thickness", laid);
        let pull = self.pull(&values.stress, &values.pressure, place, "opposed-tractions");
        let rise_time = self.rise_time(&values.rise_time, "opposed-tractions.rise-time");
        let share = self.size_if_given(&values.share, "opposed-tractions.share")?;
        if let Some((_, place)) = share.filter(|(share, _)| *share > 1.0) {
            let message = "no more than the whole thickness can be loaded";
            self.add(Finding::at(place, message).help("write for example `share: 50 %`"));
            return None;
        }
        let ((axis, at_axis), (thickness, at)) = (axis?, thickness?);
        if axis == thickness {
            let finding =
                Finding::at(at, "the thickness lies along the faces, not through them").with(at_axis, "the faces");
            self.add(finding.help("name another axis"));
            return None;
        }
        Some(Loading::OpposedTractions {
            axis,
            thickness,
            share: share.map_or(defaults::SHARE, |(share, _)| share),
            pull: pull?,
            rise_time: rise_time?,
        })
    }

    fn impact(&self, values: &file::Impact, place: Place, laid: &Laid) -> Option<Loading> {
        let face = self.face(&values.face, place, "impact.face", laid);
        let radius = self.size(&values.radius, place, "impact.radius");
        let speed = self.size(&values.speed, place, "impact.speed");
        let gap = self.size_if_given(&values.gap, "impact.gap")?;
        let center = match &values.center {
            Given::Absent => None,
            Given::Wrong(_) => return None,
            Given::Right(parts, place) => {
                let [x, y, z] = parts.each_ref().map(|part| part.right().map(|length| length.value));
                Some(([x?, y?, z?], *place))
            }
        };
        let ((face, _), (radius, _), (speed, _)) = (face?, radius?, speed?);
        if let (Some((_, at)), Some((_, given))) = (gap, center) {
            let finding = Finding::at(at, "where the ball starts is said twice").with(given, "here");
            self.add(finding.help("keep `center` or `gap`"));
            return None;
        }
        if let (Some((center, at)), Some([low, high])) = (center, laid.bounds())
            && (0..3).all(|axis| (low[axis]..=high[axis]).contains(&center[axis]))
        {
            let message = format!("the middle of the ball, {}, is inside the specimen", told(center));
            self.add(Finding::at(at, message).help("let it start outside, or leave `center` out"));
            return None;
        }
        Some(Loading::Impact {
            face,
            radius,
            speed,
            center: center.map(|(center, _)| center),
            gap: gap.map_or(defaults::GAP, |(gap, _)| gap),
        })
    }

    /// A stress or a pressure, not both.
    fn pull(
        &self,
        stress: &Given<[Given<Stress>; 3]>,
        pressure: &Given<Stress>,
        section: Place,
        path: &str,
    ) -> Option<Pull> {
        const HELP: &str = "write `stress: [0 GPa, 1.6 GPa, 0 GPa]`, or `pressure: 1.6 GPa` straight into the body";
        let zero = |place: Place| {
            self.add(Finding::at(place, "no force at all loads nothing").help(HELP));
            None
        };
        match (stress, pressure) {
            (Given::Wrong(_), _) | (_, Given::Wrong(_)) => None,
            (Given::Absent, Given::Absent) => {
                let message = format!("`{path}` has neither a stress nor a pressure");
                self.add(Finding::at(section, message).help(HELP));
                None
            }
            (Given::Right(_, given), Given::Right(_, place)) => {
                let finding = Finding::at(*place, "the force is said twice").with(*given, "here");
                self.add(finding.help("keep `stress` or `pressure`"));
                None
            }
            (Given::Right(parts, place), Given::Absent) => {
                let [x, y, z] = parts.each_ref().map(|part| part.right().map(|stress| stress.value));
                let stress = [x?, y?, z?];
                if stress == [0.0; 3] {
                    zero(*place)
                } else {
                    Some(Pull::Stress(stress))
                }
            }
            (Given::Absent, Given::Right(pressure, place)) => match pressure.value {
                0.0 => zero(*place),
                pressure => Some(Pull::Pressure(pressure)),
            },
        }
    }

    fn rise_time(&self, given: &Given<Time>, path: &str) -> Option<f64> {
        Some(self.size_if_given(given, path)?.map_or(0.0, |(time, _)| time))
    }
}
