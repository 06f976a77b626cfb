//! Colours that people with any colour vision can tell apart.

/// Line colours, after Okabe and Ito; the darker ones first, so that few lines stand out well on white.
pub const LINES: [[u8; 3]; 7] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [170, 80, 140],
    [30, 30, 30],
    [230, 159, 0],
    [86, 180, 233],
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

/// Stops of the stress scale from compression to tension: dark at zero, so that crack faces, which carry no stress,
/// stand out against the white that shows through the crack.
const STRESS: [[f64; 3]; 7] = [
    [200.0, 226.0, 255.0],
    [88.0, 158.0, 214.0],
    [36.0, 88.0, 130.0],
    [22.0, 24.0, 30.0],
    [128.0, 44.0, 22.0],
    [222.0, 108.0, 50.0],
    [255.0, 214.0, 150.0],
];

/// Colour of a stress from full compression at 0 to full tension at 1.
pub fn stress(place: f64) -> [u8; 3] {
    blend(&STRESS, place)
}

/// Stops of the scale of speeds, from rest: dark, so that waves shine.
const SPEED: [[f64; 3]; 5] = [
    [20.0, 22.0, 34.0],
    [38.0, 70.0, 122.0],
    [42.0, 140.0, 150.0],
    [158.0, 208.0, 120.0],
    [255.0, 248.0, 190.0],
];

/// Colour of a speed between 0 and 1; beyond, the end colour.
pub fn speed(share: f64) -> [u8; 3] {
    blend(&SPEED, share)
}

/// Stops of the scale of moments, early to late; all dark enough to be seen on white, and ever lighter in grey.
const MOMENT: [[f64; 3]; 5] = [
    [36.0, 14.0, 84.0],
    [22.0, 78.0, 142.0],
    [26.0, 128.0, 126.0],
    [92.0, 168.0, 74.0],
    [226.0, 178.0, 44.0],
];

/// Colour of a moment between the first (0) and the last (1).
pub fn moment(place: f64) -> [u8; 3] {
    blend(&MOMENT, place)
}

/// Colour at a place between 0 and 1 along the stops.
fn blend(stops: &[[f64; 3]], place: f64) -> [u8; 3] {
    let last = stops.len() - 1;
    let place = place.clamp(0.0, 1.0) * last as f64;
    let stop = (place as usize).min(last - 1);
    let part = place - stop as f64;
    std::array::from_fn(|tone| (stops[stop][tone] * (1.0 - part) + stops[stop + 1][tone] * part).round() as u8)
}
