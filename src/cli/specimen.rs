//! What becomes of specimens when they are laid out of whole elements, in words.

use serde_json::{Value, json};

use super::{format, warnings};
use crate::mesh::cut::NotchEnd;
use crate::plan::PlannedCase;
use crate::setup::{Leftovers, Size, Specimen};

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

/// Differences from what was asked for beyond this share are told.
const NOTABLE: f64 = 0.01;

/// More of the atoms in smaller elements than asked for make it another mesh than the one asked for.
const MANY_LEFTOVERS: f64 = 0.1;

/// A case and its specimen.
pub type Laid<'a> = (&'a PlannedCase, &'a Specimen);

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
        format!("{} m/s", digits(geometry.grip_speed * METRES_PER_SECOND)),
        specimen
            .leftovers
            .map_or_else(|| "-".to_owned(), |leftovers| left_over(&leftovers)),
    ]
}

/// nm/ps in m/s.
pub const METRES_PER_SECOND: f64 = crate::units::NM_PER_PS_IN_M_PER_S;

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

/// What is to be known of specimens that are not what was asked for.
pub fn warnings(cases: &[Laid]) -> Vec<String> {
    let own = cases.iter().flat_map(|(planned, specimen)| {
        let texts = [
            sizes_warning(specimen),
            leftover_warning(specimen),
            absent_warning(planned, specimen),
        ];
        texts.into_iter().flatten().map(|text| (planned.name.as_str(), text))
    });
    let own = warnings::once(own);
    let all = own.into_iter().chain(unlike_specimens(cases));
    all.chain(one_computation(cases)).collect()
}

/// Cases that ask for one specimen and are laid out as several, because their elements are of unlike size.
fn unlike_specimens(cases: &[Laid]) -> Option<String> {
    let sizes = |(_, specimen): &Laid| (specimen.geometry.length, specimen.geometry.width);
    let is_alike = |case: &&Laid, other: &&Laid| {
        let [(length, width), (other_length, other_width)] = [sizes(case), sizes(other)];
        length.asked == other_length.asked && width.asked == other_width.asked
    };
    cases.iter().find_map(|first| {
        let alike: Vec<&Laid> = cases.iter().filter(|case| is_alike(&first, case)).collect();
        let heights = alike.iter().map(|(_, specimen)| specimen.geometry.height.actual);
        let least = heights.clone().fold(f64::INFINITY, f64::min);
        let most = heights.fold(0.0, f64::max);
        let names: Vec<&str> = alike.iter().map(|(planned, _)| planned.name.as_str()).collect();
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

/// The cases that are computed on one mesh with one notch and are loaded alike.
pub fn one_computation(cases: &[Laid]) -> Vec<String> {
    let key = |(planned, specimen): &Laid| (specimen.computation, planned.id.ranks, planned.id.threads);
    let mut groups: Vec<(_, Vec<&str>)> = Vec::new();
    for laid @ (planned, _) in cases {
        let key = key(laid);
        match groups.iter_mut().find(|(known, _)| *known == key) {
            Some((_, names)) => names.push(&planned.name),
            None => groups.push((key, vec![&planned.name])),
        }
    }
    let several = groups.iter().filter(|(_, names)| names.len() > 1);
    several
        .map(|(_, names)| {
            format!(
                "warning: {}: one computation under several names; mesh, notch and loading are the same, and nothing can \
                 differ between them",
                warnings::listed(names)
            )
        })
        .collect()
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

fn absent_warning(planned: &PlannedCase, specimen: &Specimen) -> Option<String> {
    let absent = specimen.absent?;
    let elements = match absent {
        1 => "single atom".to_owned(),
        edge => format!("element of {edge} atoms per edge"),
    };
    let is_of_case = i64::from(absent) == i64::from(planned.case.resolution.element);
    Some(match is_of_case {
        true => format!("no {elements} is left beside the regions, which take the whole specimen"),
        false => format!("no {elements} has room in the region that asks for it"),
    })
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

/// `115.3 (115)`; alone where that is what was asked for.
fn size(size: Size) -> String {
    let [asked, actual] = [size.asked, size.actual].map(digits);
    if asked == actual {
        actual
    } else {
        format!("{actual} ({asked})")
    }
}

/// Four digits, no trailing zeros.
fn digits(value: f64) -> String {
    let decimals = (3 - value.abs().log10().floor() as i32).clamp(0, 6) as usize;
    let text = format!("{value:.decimals$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_four_digits_and_no_empty_ones() {
        assert_eq!(digits(26.7812), "26.78");
        assert_eq!(digits(115.0), "115");
        assert_eq!(digits(1127.4), "1127");
        assert_eq!(digits(0.2277), "0.2277");
    }
}
