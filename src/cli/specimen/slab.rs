//! Slabs in words.

use serde_json::{Value, json};

use super::{Laid, MANY_LEFTOVERS, METRES_PER_SECOND, NOTABLE, digits, size};
use crate::cli::{format, warnings};
use crate::mesh::cut::NotchEnd;
use crate::setup::slab::estimate::Specimen;
use crate::setup::{self, Leftovers, Size};

pub const HEAD: [&str; 9] = [
    "case",
    "length",
    "width",
    "between grips",
    "crack",
    "notch ends",
    "grips",
    "grip speed",
    "left over",
];

/// What the heads of the columns have no room for.
pub const NOTES: &str =
    "lengths in nm as laid out of whole elements; in brackets what was asked for, where that differs
left over: share of the atoms in smaller elements than asked for, because no larger one fits there
";

pub fn row(name: &str, specimen: &Specimen) -> Vec<String> {
    let geometry = &specimen.geometry;
    let notch = geometry.notch;
    vec![
        name.to_owned(),
        size(geometry.length),
        size(geometry.width),
        size(geometry.height),
        notch.map_or_else(|| "-".to_owned(), |notch| size(notch.length)),
        notch.map_or("-", |notch| end(notch.end)).to_owned(),
        digits(geometry.grip_thickness),
        match geometry.grip_speed {
            0.0 => "at rest".to_owned(),
            speed => format!("{} m/s", digits(speed * METRES_PER_SECOND)),
        },
        specimen
            .leftovers
            .map_or_else(|| "-".to_owned(), |leftovers| left_over(&leftovers)),
    ]
}

pub fn to_json(specimen: &Specimen) -> Value {
    let geometry = &specimen.geometry;
    let pair = |size: Size| json!({ "asked": size.asked, "actual": size.actual });
    let places = specimen.leftovers.map(|leftovers| {
        let places = leftovers.by_share().into_iter();
        places
            .map(|(place, share)| json!({ "where": place, "share": share }))
            .collect::<Vec<Value>>()
    });
    json!({
        "length_nm": pair(geometry.length),
        "width_nm": pair(geometry.width),
        "height_between_grips_nm": pair(geometry.height),
        "crack_nm": geometry.notch.map(|notch| pair(notch.length)),
        "notch_end": geometry.notch.map(|notch| end(notch.end)),
        "grip_thickness_nm": geometry.grip_thickness,
        "grip_speed_m_per_s": geometry.grip_speed * METRES_PER_SECOND,
        "leftovers": places,
    })
}

/// Where a notch ends.
pub fn end(end: NotchEnd) -> &'static str {
    match end {
        NotchEnd::Corner => "corner",
        NotchEnd::WithinEdge => "within an edge",
        NotchEnd::Atoms => "atoms",
    }
}

/// What is to be known of one that is not what was asked for.
pub fn warnings(specimen: &Specimen) -> Vec<String> {
    let texts = [sizes_warning(specimen), leftover_warning(specimen)];
    texts.into_iter().flatten().collect()
}

/// A case and its slab.
type Slab<'a> = (&'a str, &'a Specimen);

/// Cases that ask for one specimen and are laid out as several, because their elements are of unlike size.
pub fn unlike_specimens(cases: &[Laid]) -> Option<String> {
    let slabs = cases.iter().filter_map(|(planned, specimen)| match specimen {
        setup::Specimen::Slab(slab) => Some((planned.name.as_str(), slab)),
        setup::Specimen::Solid(_) => None,
    });
    let cases: Vec<Slab> = slabs.collect();
    let sizes = |(_, specimen): &Slab| (specimen.geometry.length, specimen.geometry.width);
    let is_alike = |case: &&Slab, other: &&Slab| {
        let [(length, width), (other_length, other_width)] = [sizes(case), sizes(other)];
        length.asked == other_length.asked && width.asked == other_width.asked
    };
    cases.iter().find_map(|first| {
        let alike: Vec<&Slab> = cases.iter().filter(|case| is_alike(&first, case)).collect();
        let heights = alike.iter().map(|(_, specimen)| specimen.geometry.height.actual);
        let least = heights.clone().fold(f64::INFINITY, f64::min);
        let most = heights.fold(0.0, f64::max);
        let names: Vec<&str> = alike.iter().map(|(name, _)| *name).collect();
        (most > (1.0 + NOTABLE) * least).then(|| {
            format!(
                "warning: {}: one specimen asked for, {} to {} nm high between the grips as laid out; with one \
                 `specimen.block` that all their elements fit, they are alike",
                warnings::listed(&names),
                digits(least),
                digits(most)
            )
        })
    })
}

fn sizes_warning(specimen: &Specimen) -> Option<String> {
    let sizes = specimen.geometry.sizes().into_iter();
    let off: Vec<String> = sizes
        .filter(|(_, size)| size.error().abs() > NOTABLE)
        .map(|(name, size)| {
            format!(
                "the {name} is {} nm instead of {} nm",
                digits(size.actual),
                digits(size.asked)
            )
        })
        .collect();
    (!off.is_empty()).then(|| format!("laid out of whole elements, {}", off.join(", ")))
}

fn leftover_warning(specimen: &Specimen) -> Option<String> {
    let leftovers = specimen
        .leftovers
        .filter(|leftovers| leftovers.share() > MANY_LEFTOVERS)?;
    Some(format!(
        "{} of the atoms are in smaller elements than asked for ({}): take smaller elements, a larger specimen, or a \
         `specimen.block` that they fit",
        format::share(leftovers.share()),
        left_over(&leftovers)
    ))
}

/// `none`, `4.2 % at the grips, 0.6 % at the right face`.
pub fn left_over(leftovers: &Leftovers) -> String {
    let places = leftovers.by_share();
    if places.is_empty() {
        return format::share(0.0);
    }
    let place = |(place, share): (&str, f64)| format!("{} {place}", format::share(share));
    places.into_iter().map(place).collect::<Vec<_>>().join(", ")
}
