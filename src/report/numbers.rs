//! Numbers as people read them.

/// What stands where there is no value.
pub const ABSENT: &str = "–";

/// A number with so many significant digits, without trailing zeros beyond them; large ones in groups of three.
pub fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return ABSENT.to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let rounded = round_significant(value, digits);
    let magnitude = rounded.abs().log10().floor() as i32;
    if !(-4..9).contains(&magnitude) {
        let (mantissa, exponent) = (rounded / 10f64.powi(magnitude), magnitude);
        return minus(format!("{mantissa:.*} × 10{}", digits - 1, superscript(exponent)));
    }
    let decimals = (digits as i32 - 1 - magnitude).max(0) as usize;
    let text = format!("{rounded:.decimals$}");
    let (whole, rest) = text.split_at(text.find('.').unwrap_or(text.len()));
    minus(format!("{}{rest}", grouped(whole)))
}

pub fn count(value: u64) -> String {
    grouped(&value.to_string())
}

/// A number that is a whole one but for rounding.
pub fn whole(value: f64) -> String {
    let digits = count(value.abs().round() as u64);
    if value.round() < 0.0 {
        format!("−{digits}")
    } else {
        digits
    }
}

/// A share in percent, with its sign where it is large enough to have one.
pub fn signed_percent(share: f64) -> String {
    let percent = share * 100.0;
    match percent.abs() {
        0.0 => "0 %".to_owned(),
        size if size < 0.05 => "< 0.1 %".to_owned(),
        _ => minus(format!("{percent:+.1} %")),
    }
}

/// A text as it begins a sentence.
pub fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|letter| letter.to_uppercase().collect::<String>());
    first.unwrap_or_default() + letters.as_str()
}

pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The nearest number with so many significant decimal digits.
pub fn round_significant(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits.saturating_sub(1))
        .parse()
        .unwrap_or(value)
}

/// The label of a tick: as many digits as it takes.
pub fn tick(value: f64) -> String {
    let rounded = round_significant(value, 10);
    minus(if rounded.abs() < 1e-12 {
        "0".to_owned()
    } else {
        format!("{rounded}")
    })
}

fn grouped(digits: &str) -> String {
    let (sign, digits) = digits.strip_prefix('-').map_or(("", digits), |rest| ("-", rest));
    if digits.len() < 5 {
        return format!("{sign}{digits}");
    }
    let mut text = String::from(sign);
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

fn superscript(exponent: i32) -> String {
    let raised = |digit: char| match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32('⁰' as u32 + digit.to_digit(10).unwrap_or(0)).unwrap_or(digit),
    };
    exponent.to_string().chars().map(raised).collect()
}

/// The minus sign proper instead of the hyphen.
fn minus(text: String) -> String {
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_significant_digits() {
        assert_eq!(significant(0.018_123, 3), "0.0181");
        assert_eq!(significant(1234.5, 3), "1230");
        assert_eq!(significant(71_280.0, 5), "71\u{202f}280");
        assert_eq!(significant(-2.5e-7, 2), "−2.5 × 10⁻⁷");
        assert_eq!(significant(9.996, 3), "10.0");
        assert_eq!(significant(f64::NAN, 3), ABSENT);
    }

    #[test]
    fn whole_numbers_have_no_decimals() {
        assert_eq!(
            [90.000_000_01, -0.2, -12_345.0].map(whole),
            ["90", "0", "−12\u{202f}345"]
        );
    }

    #[test]
    fn percentages_carry_their_sign() {
        assert_eq!(signed_percent(0.0061), "+0.6 %");
        assert_eq!(signed_percent(-0.061), "−6.1 %");
        assert_eq!([-0.0001, 0.0].map(signed_percent), ["< 0.1 %", "0 %"]);
    }
}
