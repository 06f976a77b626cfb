//! Quantities as a person types them ("354 nm", "4.6e6 /s") in, one internal unit system, quantities out.
//!
//! Internal units are nm, ps, eV, u and K, so a rate is 1/ps, a velocity nm/ps and a stress eV/nm^3.

pub mod amounts;
mod decimal;
mod symbols;

pub use decimal::Decimal;
use symbols::Unit;

/// eV in joule, exact by the definition of the SI (2019).
pub const EV_IN_JOULE: f64 = 1.602_176_634e-19;
/// u in kilogram, CODATA 2022.
pub const U_IN_KILOGRAM: f64 = 1.660_539_068_92e-27;
/// Mass: 1 u in eV ps^2/nm^2, so that force / (mass * this) is an acceleration in nm/ps^2.
pub const U_IN_EV_PS2_PER_NM2: f64 = U_IN_KILOGRAM * 1e6 / EV_IN_JOULE;
/// Boltzmann's constant, eV/K.
pub const BOLTZMANN_EV_PER_K: f64 = 1.380_649e-23 / EV_IN_JOULE;
/// Stress: 1 eV/nm^3 in GPa.
pub const EV_PER_NM3_IN_GPA: f64 = EV_IN_JOULE * 1e18;
/// Stress intensity: 1 eV/nm^3 sqrt(nm) in MPa sqrt(m); the last factor is sqrt(1e-9).
pub const EV_PER_NM3_SQRT_NM_IN_MPA_SQRT_M: f64 = EV_IN_JOULE * 1e21 * 3.162_277_660_168_379_5e-5;
/// Velocity: 1 nm/ps in m/s.
pub const NM_PER_PS_IN_M_PER_S: f64 = 1000.0;

/// What a quantity measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// nm
    Length,
    /// Simulated time, ps.
    Time,
    /// Time on the wall, s.
    Duration,
    /// eV
    Energy,
    /// u
    Mass,
    /// K
    Temperature,
    /// 1/ps
    Rate,
    /// nm/ps
    Velocity,
    /// eV/nm^3
    Stress,
    /// eV/nm^2
    Stiffness,
    /// 1/nm
    InverseLength,
    /// A ratio, typed in percent.
    Fraction,
}

use Dimension::*;

/// What is to be known of a dimension.
struct Description {
    /// "a length", as a sentence needs it.
    noun: &'static str,
    example: &'static str,
    /// The unit in which quantities are written out; a power of ten away from the internal one, so nothing is rounded.
    written: &'static str,
    /// Powers of length, time, energy, mass and temperature.
    powers: [i8; 5],
}

const fn description(noun: &'static str, example: &'static str, written: &'static str, powers: [i8; 5]) -> Description {
    Description {
        noun,
        example,
        written,
        powers,
    }
}

impl Dimension {
    pub const ALL: [Dimension; 12] = [
        Length,
        Time,
        Duration,
        Energy,
        Mass,
        Temperature,
        Rate,
        Velocity,
        Stress,
        Stiffness,
        InverseLength,
        Fraction,
    ];

    fn description(self) -> Description {
        match self {
            Length => description("a length", "354 nm", "nm", [1, 0, 0, 0, 0]),
            Time => description("a time", "10 ps", "ps", [0, 1, 0, 0, 0]),
            Duration => description("a duration", "60 s", "s", [0, 1, 0, 0, 0]),
            Energy => description("an energy", "0.415 eV", "eV", [0, 0, 1, 0, 0]),
            Mass => description("a mass", "802 u", "u", [0, 0, 0, 1, 0]),
            Temperature => description("a temperature", "300 K", "K", [0, 0, 0, 0, 1]),
            Rate => description("a rate", "4.6e6 /s", "/s", [0, -1, 0, 0, 0]),
            Velocity => description("a velocity", "20 m/s", "m/s", [1, -1, 0, 0, 0]),
            Stress => description("a stress", "1.6 GPa", "eV/nm^3", [-3, 0, 1, 0, 0]),
            Stiffness => description("a stiffness", "320 eV/nm^2", "eV/nm^2", [-2, 0, 1, 0, 0]),
            InverseLength => description("an inverse length", "13.6 /nm", "/nm", [-1, 0, 0, 0, 0]),
            Fraction => description("a ratio", "1.2 %", "%", [0; 5]),
        }
    }

    /// "a length", as a sentence needs it.
    pub fn noun(self) -> &'static str {
        self.description().noun
    }

    pub fn example(self) -> &'static str {
        self.description().example
    }

    fn written(self) -> &'static str {
        self.description().written
    }

    fn powers(self) -> [i8; 5] {
        self.description().powers
    }

    /// Power of ten from nm, ps, eV, u, K to the internal unit of this dimension.
    fn shift(self) -> i32 {
        if self == Duration { -12 } else { 0 }
    }
}

/// Why a text is no quantity of the dimension asked for, and what to type instead.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum UnitError {
    #[error("expected {}, found `{found}`", described(*expected))]
    NotANumber { expected: Dimension, found: String },
    #[error("`{number}` has no unit; write {suggestion}")]
    MissingUnit { number: String, suggestion: String },
    #[error("`{unit}` is not a unit; {hint}")]
    UnknownUnit { unit: String, hint: String },
    #[error("expected {}, found {found}", described(*expected))]
    WrongDimension { expected: Dimension, found: String },
    #[error("`{number}` has a decimal comma; write {suggestion}")]
    Comma { number: String, suggestion: String },
    #[error("`{found}` is beyond what a 64-bit number holds; write {} of a size that occurs in nature", expected.noun())]
    OutOfRange { expected: Dimension, found: String },
}

fn described(dimension: Dimension) -> String {
    format!("{} such as {}", dimension.noun(), dimension.example())
}

/// Read a quantity into internal units.
///
/// Powers of ten move the decimal point of the text before anything is rounded: "0.354 um" and "354 nm" are the same bits.
pub fn parse(text: &str, expected: Dimension) -> Result<f64, UnitError> {
    let text = text.trim();
    let (number, unit) = Decimal::split(text).ok_or_else(|| UnitError::NotANumber {
        expected,
        found: text.chars().take(60).collect(),
    })?;
    let unit = unit.trim();
    if unit.is_empty() {
        return Err(missing_unit(text, &number, expected));
    }
    if let Some(decimals) = unit
        .strip_prefix(',')
        .filter(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
    {
        let suggestion = format!("{}.{decimals}", &text[..text.len() - unit.len()]);
        return Err(UnitError::Comma {
            number: text.into(),
            suggestion,
        });
    }
    let unit = Unit::read(unit, expected)?;
    if unit.powers != expected.powers() {
        return Err(UnitError::WrongDimension {
            expected,
            found: named(unit.powers, text),
        });
    }
    let value = number.clone().shifted(unit.decimal + expected.shift()).value() * unit.factor;
    if !value.is_finite() || (value == 0.0) != number.is_zero() {
        return Err(UnitError::OutOfRange {
            expected,
            found: text.into(),
        });
    }
    Ok(value)
}

/// The shortest text that `parse` reads back to the same bits.
pub fn format(value: f64, dimension: Dimension) -> String {
    let written = dimension.written();
    let decimal = Unit::read(written, dimension).map_or(0, |unit| unit.decimal);
    let number = Decimal::of(value).shifted(-decimal - dimension.shift());
    format!("{number} {written}")
}

/// A quantity or a number in the one spelling that all its spellings share: `10 nm` for `100 Å`, `10` for `10.0`. Units are
/// those that quantities are written in, and femtoseconds for times below a picosecond. `None` where the text is neither.
pub fn canonical(text: &str) -> Option<String> {
    let (number, unit) = Decimal::split(text.trim())?;
    if unit.trim().is_empty() {
        return Some(number.to_string());
    }
    let read = |dimension: Dimension| Some((parse(text, dimension).ok()?, dimension));
    let (value, dimension) = Dimension::ALL.into_iter().find_map(read)?;
    if dimension == Time && value.abs() < 1.0 {
        return Some(format!("{} fs", Decimal::of(value).shifted(3)));
    }
    Some(format(value, dimension))
}

/// A number and the unit in which quantities of its dimension are written out: `0.1 um` is 100 and `nm`; a plain number has
/// no unit. `None` for a text that is neither.
pub fn measured(text: &str) -> Option<(f64, &'static str)> {
    let (number, unit) = Decimal::split(text.trim())?;
    if unit.trim().is_empty() {
        return Some((number.to_string().parse().ok()?, ""));
    }
    let read = |dimension: Dimension| Some((parse(text, dimension).ok()?, dimension));
    let (value, dimension) = Dimension::ALL.into_iter().find_map(read)?;
    let written = format(value, dimension);
    let (number, _) = Decimal::split(&written)?;
    Some((number.to_string().parse().ok()?, dimension.written()))
}

fn missing_unit(text: &str, number: &Decimal, expected: Dimension) -> UnitError {
    let written = expected.written();
    let suggestion = match expected {
        Fraction => format!("{text} % or, if it is a ratio, {} %", number.clone().shifted(2)),
        _ => format!("{text} {written}"),
    };
    UnitError::MissingUnit {
        number: text.into(),
        suggestion,
    }
}

/// What a product of units measures: "a time (`10 ps`)".
fn named(powers: [i8; 5], text: &str) -> String {
    match Dimension::ALL
        .into_iter()
        .find(|dimension| dimension.powers() == powers)
    {
        Some(dimension) => format!("{} (`{text}`)", dimension.noun()),
        None => format!("`{text}`, which is of another kind"),
    }
}

#[cfg(test)]
mod tests;
