//! Unit expressions: `nm`, `/s`, `1/s`, `m/s`, `eV/nm^2`, `s^-1`, `eV/nm³`.

use super::{Dimension, EV_IN_JOULE, U_IN_KILOGRAM, UnitError};

/// A product of unit symbols, reduced: one of it is `factor * 10^decimal` of nm, ps, eV, u, K to these powers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    pub powers: [i8; 5],
    pub decimal: i32,
    /// What is no power of ten (a joule in eV); 1 for most.
    pub factor: f64,
}

struct Symbol {
    name: &'static str,
    /// Whether `k`, `m`, `n`, … may stand before it.
    prefixed: bool,
    unit: Unit,
}

const fn symbol(name: &'static str, prefixed: bool, powers: [i8; 5], decimal: i32, factor: f64) -> Symbol {
    Symbol {
        name,
        prefixed,
        unit: Unit {
            powers,
            decimal,
            factor,
        },
    }
}

const SYMBOLS: [Symbol; 16] = [
    symbol("m", true, [1, 0, 0, 0, 0], 9, 1.0),
    symbol("Å", false, [1, 0, 0, 0, 0], -1, 1.0),
    // U+212B, the sign that some keyboards give for the letter above.
    symbol("\u{212b}", false, [1, 0, 0, 0, 0], -1, 1.0),
    symbol("angstrom", false, [1, 0, 0, 0, 0], -1, 1.0),
    symbol("s", true, [0, 1, 0, 0, 0], 12, 1.0),
    symbol("min", false, [0, 1, 0, 0, 0], 12, 60.0),
    symbol("h", false, [0, 1, 0, 0, 0], 12, 3600.0),
    symbol("eV", true, [0, 0, 1, 0, 0], 0, 1.0),
    symbol("J", true, [0, 0, 1, 0, 0], 0, 1.0 / EV_IN_JOULE),
    symbol("u", false, [0, 0, 0, 1, 0], 0, 1.0),
    symbol("Da", false, [0, 0, 0, 1, 0], 0, 1.0),
    symbol("g", true, [0, 0, 0, 1, 0], -3, 1.0 / U_IN_KILOGRAM),
    symbol("K", true, [0, 0, 0, 0, 1], 0, 1.0),
    // 1 Pa = 1 J/m^3, 1 N = 1 J/m.
    symbol("Pa", true, [-3, 0, 1, 0, 0], -27, 1.0 / EV_IN_JOULE),
    symbol("N", true, [-1, 0, 1, 0, 0], -9, 1.0 / EV_IN_JOULE),
    symbol("%", false, [0; 5], -2, 1.0),
];

/// The micro sign is typed as `u`, as U+00B5 or as the Greek letter.
const PREFIXES: [(char, i32); 11] = [
    ('f', -15),
    ('p', -12),
    ('n', -9),
    ('u', -6),
    ('\u{b5}', -6),
    ('\u{3bc}', -6),
    ('m', -3),
    ('c', -2),
    ('k', 3),
    ('M', 6),
    ('G', 9),
];

/// What people mean, for the nearest name; the commonest of equally near ones first.
const COMMON: [&str; 31] = [
    "nm", "ps", "eV", "u", "K", "GPa", "fs", "s", "um", "MPa", "ns", "Å", "angstrom", "m", "mm", "pm", "us", "ms",
    "min", "h", "meV", "keV", "J", "kJ", "kg", "g", "Da", "Pa", "kPa", "N", "%",
];

impl Unit {
    const ONE: Self = Self {
        powers: [0; 5],
        decimal: 0,
        factor: 1.0,
    };

    /// Read a unit expression; what stands after a slash divides. `expected` only steers the hints.
    pub fn read(text: &str, expected: Dimension) -> Result<Self, UnitError> {
        let mut product = Self::ONE;
        let mut symbols = 0;
        for (part, over) in text.split('/').zip(0..) {
            for token in part
                .split([' ', '*', '·'])
                .filter(|token| !token.is_empty() && *token != "1")
            {
                let (unit, power) = read_power(token).ok_or_else(|| unknown(token, expected))?;
                product = product.times(unit, if over > 0 { -power } else { power });
                symbols += 1;
            }
        }
        if symbols == 0 {
            Err(unknown(text, expected))
        } else {
            Ok(product)
        }
    }

    fn times(mut self, other: Self, power: i8) -> Self {
        for (mine, theirs) in self.powers.iter_mut().zip(other.powers) {
            *mine += theirs * power;
        }
        self.decimal += other.decimal * i32::from(power);
        self.factor *= other.factor.powi(i32::from(power));
        self
    }
}

/// `nm^2`, `nm2`, `nm²`, `s^-1`: a symbol and its power, which is at most 4 either way.
fn read_power(token: &str) -> Option<(Unit, i8)> {
    let end = token
        .find(|c: char| !(c.is_alphabetic() || c == '%'))
        .unwrap_or(token.len());
    let (name, power) = token.split_at(end);
    let power: String = power.trim_start_matches('^').chars().map(plain_digit).collect();
    let power = if power.is_empty() {
        1
    } else {
        power.parse().ok().filter(|p: &i8| (1..=4).contains(&p.abs()))?
    };
    Some((find(name)?, power))
}

fn plain_digit(c: char) -> char {
    match c {
        '¹' => '1',
        '²' => '2',
        '³' => '3',
        '⁴' => '4',
        '⁻' | '−' => '-',
        other => other,
    }
}

fn find(name: &str) -> Option<Unit> {
    if let Some(symbol) = SYMBOLS.iter().find(|symbol| symbol.name == name) {
        return Some(symbol.unit);
    }
    let mut letters = name.chars();
    let (_, power) = PREFIXES
        .iter()
        .find(|(prefix, _)| Some(*prefix) == letters.clone().next())?;
    letters.next();
    let symbol = SYMBOLS
        .iter()
        .find(|symbol| symbol.prefixed && symbol.name == letters.as_str())?;
    Some(Unit {
        decimal: symbol.unit.decimal + power,
        ..symbol.unit
    })
}

fn unknown(token: &str, expected: Dimension) -> UnitError {
    let token: String = token.chars().take(40).collect();
    let otherwise = || format!("{} is written such as {}", expected.noun(), expected.example());
    let guessed = || nearest(&token, expected).map(|near| format!("did you mean `{near}`?"));
    let hint = by_another_name(&token, expected)
        .or_else(guessed)
        .unwrap_or_else(otherwise);
    UnitError::UnknownUnit { unit: token, hint }
}

/// What people write who have learned it so, in the units that are read here.
fn by_another_name(token: &str, expected: Dimension) -> Option<String> {
    let other = match (token, expected) {
        ("Hz", _) => "1 Hz is 1 /s",
        ("kHz", _) => "1 kHz is 1e3 /s",
        ("MHz", _) => "1 MHz is 1e6 /s",
        ("GHz", _) => "1 GHz is 1e9 /s",
        ("THz", _) => "1 THz is 1e12 /s",
        ("mol", Dimension::Mass) => "1 g/mol is 1 u",
        ("mol", Dimension::Energy) => "1 kJ/mol is 0.0103643 eV",
        ("kcal" | "cal", Dimension::Energy) => "1 kcal/mol is 0.0433641 eV",
        ("Ha" | "hartree", Dimension::Energy) => "1 hartree is 27.2114 eV",
        ("amu", _) => "1 amu is 1 u",
        _ => return None,
    };
    Some(format!(
        "{other}; {} is written such as {}",
        expected.noun(),
        expected.example()
    ))
}

/// The common unit most like `token`: letters matter most, then the dimension, then capitals.
fn nearest(token: &str, expected: Dimension) -> Option<&'static str> {
    let lower = token.to_lowercase();
    let occurs = |name: &str| {
        find(name).is_some_and(|unit| (0..5).any(|axis| unit.powers[axis] != 0 && expected.powers()[axis] != 0))
    };
    let rank = |name: &&&str| {
        let letters = strsim::osa_distance(&name.to_lowercase(), &lower);
        (letters, !occurs(name), strsim::osa_distance(name, token))
    };
    let most = if lower.chars().count() <= 3 { 1 } else { 2 };
    COMMON
        .iter()
        .min_by_key(rank)
        .filter(|name| rank(name).0 <= most)
        .copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_unit_that_is_suggested_can_be_read() {
        for name in COMMON {
            assert!(find(name).is_some(), "{name}");
        }
    }
}
