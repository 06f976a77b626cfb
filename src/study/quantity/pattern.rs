//! Quantities as regular expressions, so that an editor sees a wrong unit: `60 ps` for a length, or `ev`.
//!
//! Only the usual ways to spell a unit; a product that is spelled otherwise is for `units` to judge.

use crate::units::Dimension;

const NUMBER: &str = r"\s*[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?\s*";

const LENGTH: &str = "([fpnuµμmckMG]?m|Å|\u{212b}|angstrom)";
const TIME: &str = "([fpnuµμmckMG]?s|min|h)";
const ENERGY: &str = "([fpnuµμmckMG]?(eV|J))";
const MASS: &str = "(u|Da|[fpnuµμmckMG]?g)";
const FORCE: &str = "([fpnuµμmckMG]?N)";
const PRESSURE: &str = "([fpnuµμmckMG]?Pa)";

/// What a quantity of a dimension looks like.
pub fn of(dimension: Dimension) -> String {
    format!("^{NUMBER}{}\\s*$", unit(dimension))
}

/// A strain in words, or a time.
pub fn of_interval() -> String {
    format!("^{NUMBER}(%\\s*strain|{TIME})\\s*$")
}

fn unit(dimension: Dimension) -> String {
    let over = |unit: &str| format!("(1?\\s*/\\s*{unit}|{unit}\\s*(\\^?-1|⁻¹))");
    let power = |unit: &str, power: u8, sign: char| format!("{unit}(\\^?{power}|{sign})");
    match dimension {
        Dimension::Length => LENGTH.to_owned(),
        Dimension::Time | Dimension::Duration => TIME.to_owned(),
        Dimension::Energy => ENERGY.to_owned(),
        Dimension::Mass => MASS.to_owned(),
        Dimension::Temperature => "([mk]?K)".to_owned(),
        Dimension::Rate => over(TIME),
        Dimension::InverseLength => over(LENGTH),
        Dimension::Velocity => format!("({LENGTH}\\s*/\\s*{TIME})"),
        Dimension::Stress => format!("({PRESSURE}|{ENERGY}\\s*/\\s*{})", power(LENGTH, 3, '³')),
        Dimension::Stiffness => format!("({ENERGY}\\s*/\\s*{}|{FORCE}\\s*/\\s*{LENGTH})", power(LENGTH, 2, '²')),
        Dimension::Fraction => "%".to_owned(),
    }
}
