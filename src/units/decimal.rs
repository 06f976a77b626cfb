//! Decimal numbers as typed: nothing is rounded until a value is asked for.

use std::fmt;

/// `digits * 10^exponent`; the digits have no leading and no trailing zeros, and zero is "0" and exponent 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decimal {
    negative: bool,
    digits: String,
    exponent: i32,
}

/// Exponents are held within this, so that sums of them cannot overflow; far beyond what a f64 can hold.
const LARGEST_EXPONENT: i32 = 100_000;
/// Digits a number may have; a f64 is settled by 17, and no file needs more than this.
const MOST_DIGITS: usize = 1000;

impl Decimal {
    /// The number at the beginning of a text, and what follows it.
    pub fn split(text: &str) -> Option<(Self, &str)> {
        let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
        let whole = leading_digits(unsigned);
        let rest = &unsigned[whole.len()..];
        let part = rest.strip_prefix('.').map_or("", leading_digits);
        if whole.is_empty() && part.is_empty() || whole.len() + part.len() > MOST_DIGITS {
            return None;
        }
        let rest = rest.strip_prefix('.').map_or(rest, |rest| &rest[part.len()..]);
        let (exponent, rest) = split_exponent(rest);
        let digits = format!("{whole}{part}");
        Some((
            Self::tidy(text.starts_with('-'), &digits, exponent - part.len() as i32),
            rest,
        ))
    }

    /// The shortest decimal that reads back as `value`.
    pub fn of(value: f64) -> Self {
        // `{:e}` of a finite f64 is always a decimal; what is not finite never gets into a study.
        Self::split(&format!("{value:e}")).map_or_else(|| Self::tidy(false, "0", 0), |(number, _)| number)
    }

    /// `count * 10^exponent`.
    pub fn scaled(count: i128, exponent: i32) -> Self {
        Self::tidy(count < 0, &count.unsigned_abs().to_string(), exponent)
    }

    /// This number as a count of `10^exponent`; `None` where it is no such multiple or the count is too long.
    pub fn count(&self, exponent: i32) -> Option<i128> {
        if self.is_zero() {
            return Some(0);
        }
        let zeros = usize::try_from(self.exponent - exponent)
            .ok()
            .filter(|zeros| *zeros <= 38)?;
        let count: i128 = format!("{}{}", self.digits, "0".repeat(zeros)).parse().ok()?;
        Some(if self.negative { -count } else { count })
    }

    pub fn exponent(&self) -> i32 {
        self.exponent
    }

    /// Times `10^power`.
    pub fn shifted(mut self, power: i32) -> Self {
        if !self.is_zero() {
            self.exponent = (self.exponent + power).clamp(-LARGEST_EXPONENT, LARGEST_EXPONENT);
        }
        self
    }

    pub fn is_zero(&self) -> bool {
        self.digits == "0"
    }

    /// The nearest f64; infinite where there is none.
    pub fn value(&self) -> f64 {
        let sign = if self.negative && !self.is_zero() { "-" } else { "" };
        format!("{sign}{}e{}", self.digits, self.exponent)
            .parse()
            .unwrap_or(f64::INFINITY)
    }

    fn tidy(negative: bool, digits: &str, exponent: i32) -> Self {
        let digits = digits.trim_start_matches('0');
        let kept = digits.trim_end_matches('0');
        if kept.is_empty() {
            return Self {
                negative: false,
                digits: "0".into(),
                exponent: 0,
            };
        }
        Self {
            negative,
            digits: kept.into(),
            exponent: exponent + (digits.len() - kept.len()) as i32,
        }
    }
}

/// Plain between 0.0001 and 999999, scientific beyond: `354`, `0.2277`, `4.6e6`.
impl fmt::Display for Decimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.negative {
            f.write_str("-")?;
        }
        let digits = &self.digits;
        // Decimal point after this many digits.
        let point = digits.len() as i32 + self.exponent;
        match point {
            -3..=0 => write!(f, "0.{}{digits}", "0".repeat(-point as usize)),
            1..=6 if point as usize >= digits.len() => {
                write!(f, "{digits}{}", "0".repeat(point as usize - digits.len()))
            }
            1..=6 => write!(f, "{}.{}", &digits[..point as usize], &digits[point as usize..]),
            _ if digits.len() == 1 => write!(f, "{digits}e{}", point - 1),
            _ => write!(f, "{}.{}e{}", &digits[..1], &digits[1..], point - 1),
        }
    }
}

fn leading_digits(text: &str) -> &str {
    &text[..text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len())]
}

/// `e-6` and what follows; a unit that begins with e (`eV`) is no exponent.
fn split_exponent(text: &str) -> (i32, &str) {
    let Some(after) = text.strip_prefix(['e', 'E']) else {
        return (0, text);
    };
    let unsigned = after.strip_prefix(['+', '-']).unwrap_or(after);
    let digits = leading_digits(unsigned);
    if digits.is_empty() {
        return (0, text);
    }
    let size = digits.parse().unwrap_or(LARGEST_EXPONENT).min(LARGEST_EXPONENT);
    (
        if after.starts_with('-') { -size } else { size },
        &unsigned[digits.len()..],
    )
}
