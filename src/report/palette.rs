//! Colours that people with any colour vision can tell apart, also where they are printed in grey.

use colorous::{Gradient, MAGMA, RED_BLUE, VIRIDIS};

/// Line colours, each of a grey of its own; those that stand out best on white come first.
pub const LINES: [[u8; 3]; 7] = [
    [0, 60, 130],
    [196, 72, 0],
    [0, 156, 112],
    [148, 52, 132],
    [26, 26, 26],
    [240, 184, 44],
    [80, 170, 230],
];

/// Length of dash and gap; `None` is a full line. Not in step with the colours, so that 28 pairs differ.
pub const DASHES: [Option<(i32, i32)>; 4] = [None, Some((9, 4)), Some((4, 3)), Some((16, 4))];

/// The style of a curve that has this of the colours and this of the dashes.
pub const fn style(color: usize, dash: usize) -> usize {
    let [colors, dashes] = [LINES.len(), DASHES.len()];
    let mut style = color;
    while style % dashes != dash {
        style += colors;
    }
    style
}

/// Colour of a stress from full compression at 0, blue, to full tension at 1, red; light where there is none.
pub fn stress(place: f64) -> [u8; 3] {
    // The ends of the gradient are nearly black, like the empty space beside them.
    along(RED_BLUE, [0.92, 0.08], place)
}

/// Colour of a speed between 0, dark, so that waves shine, and 1; beyond, the end colour.
pub fn speed(share: f64) -> [u8; 3] {
    along(MAGMA, [0.04, 0.96], share)
}

/// Colour of a moment between the first (0) and the last (1), without what is too light to be seen on white.
pub fn moment(place: f64) -> [u8; 3] {
    along(VIRIDIS, [0.0, 0.78], place)
}

/// Colour at a place between 0 and 1 along a part of a gradient.
fn along(gradient: Gradient, [from, to]: [f64; 2], place: f64) -> [u8; 3] {
    let color = gradient.eval_continuous(from + (to - from) * place.clamp(0.0, 1.0));
    [color.r, color.g, color.b]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lightness, from 0 for black to 100 for white. [CIE 15:2004] L*
    fn lightness(color: [u8; 3]) -> f64 {
        let linear = color.map(|tone| {
            let tone = f64::from(tone) / 255.0;
            match tone <= 0.04045 {
                true => tone / 12.92,
                false => ((tone + 0.055) / 1.055).powf(2.4),
            }
        });
        let luminance = 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
        116.0 * luminance.cbrt() - 16.0
    }

    /// What an eye can tell on paper beside each other.
    const TELLS_APART: f64 = 6.0;

    /// By how much the lightness of an even scale may leave a straight line.
    const EVEN: f64 = 4.0;

    fn steps(scale: fn(f64) -> [u8; 3]) -> Vec<f64> {
        (0..=20).map(|step| lightness(scale(f64::from(step) / 20.0))).collect()
    }

    #[test]
    fn line_colours_differ_in_grey_and_stand_out_on_white() {
        let mut greys = LINES.map(lightness);
        greys.sort_by(f64::total_cmp);
        assert!(
            greys.windows(2).all(|pair| pair[1] - pair[0] > TELLS_APART),
            "{greys:?}"
        );
        assert!(greys[LINES.len() - 1] < 80.0, "{greys:?}");
    }

    #[test]
    fn speeds_and_moments_grow_evenly_lighter() {
        for scale in [speed, moment] {
            let greys = steps(scale);
            let [first, last] = [greys[0], greys[20]];
            for (step, grey) in greys.iter().enumerate() {
                let straight = first + (last - first) * step as f64 / 20.0;
                assert!((grey - straight).abs() < EVEN, "{greys:?}");
            }
            assert!(last > first + 50.0, "{greys:?}");
        }
    }

    #[test]
    fn stresses_are_lightest_at_zero_and_grow_darker_to_either_side() {
        let greys = steps(stress);
        assert!(
            greys[..=10].is_sorted() && greys[10..].is_sorted_by(|a, b| a >= b),
            "{greys:?}"
        );
        assert!(greys[10] > 94.0 && greys[0] < 45.0 && greys[20] < 45.0, "{greys:?}");
    }
}
