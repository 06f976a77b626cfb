//! What becomes of specimens when they are laid out of whole elements, in words.

pub mod slab;
pub mod solid;

use serde_json::Value;

use super::{format, warnings};
use crate::plan::PlannedCase;
use crate::setup::{Size, Specimen};

/// A case and its specimen.
pub type Laid<'a> = (&'a PlannedCase, &'a Specimen);

/// Differences from what was asked for beyond this share are told.
const NOTABLE: f64 = 0.01;

/// More of the atoms in smaller elements than asked for make it another mesh than the one asked for.
const MANY_LEFTOVERS: f64 = 0.1;

/// nm/ps in m/s.
pub const METRES_PER_SECOND: f64 = crate::units::NM_PER_PS_IN_M_PER_S;

/// The tables of the specimens, a table a kind, each with what its heads have no room for.
pub fn tables(cases: &[Laid]) -> String {
    let mut slabs = vec![slab::HEAD.map(str::to_owned).to_vec()];
    let mut solids = vec![solid::HEAD.map(str::to_owned).to_vec()];
    for (planned, specimen) in cases {
        match specimen {
            Specimen::Slab(laid) => slabs.push(slab::row(&planned.name, laid)),
            Specimen::Solid(laid) => solids.push(solid::row(planned, laid)),
        }
    }
    let kinds = [(slabs, slab::NOTES), (solids, solid::NOTES)];
    let told = kinds.iter().filter(|(rows, _)| rows.len() > 1);
    let told = told.map(|(rows, notes)| format!("{}\n{notes}", format::table(rows)));
    told.collect::<Vec<_>>().join("\n")
}

pub fn to_json(specimen: &Specimen) -> Value {
    match specimen {
        Specimen::Slab(laid) => slab::to_json(laid),
        Specimen::Solid(laid) => solid::to_json(laid),
    }
}

/// What is to be known of specimens that are not what was asked for.
pub fn warnings(cases: &[Laid]) -> Vec<String> {
    let own = cases.iter().flat_map(|(planned, specimen)| {
        let texts = match specimen {
            Specimen::Slab(slab) => slab::warnings(slab),
            Specimen::Solid(solid) => solid::warnings(solid),
        };
        let texts = texts.into_iter().chain(absent_warning(planned, specimen));
        texts.map(|text| (planned.name.as_str(), text))
    });
    let own = warnings::once(own);
    let all = own.into_iter().chain(slab::unlike_specimens(cases));
    all.chain(one_computation(cases)).collect()
}

/// The cases that are computed on one mesh with one notch and are loaded alike.
fn one_computation(cases: &[Laid]) -> Vec<String> {
    let key = |(planned, specimen): &Laid| (specimen.computation(), planned.id.ranks, planned.id.threads);
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

fn absent_warning(planned: &PlannedCase, specimen: &Specimen) -> Option<String> {
    let absent = match specimen {
        Specimen::Slab(slab) => i64::from(slab.absent?),
        Specimen::Solid(solid) => i64::from(solid.absent?),
    };
    let elements = match absent {
        1 => "single atom".to_owned(),
        edge => format!("element of {edge} atoms per edge"),
    };
    let is_of_case = absent == i64::from(planned.case.element());
    Some(match is_of_case {
        true => format!("no {elements} is left beside the regions, which take the whole specimen"),
        false => format!("no {elements} has room in the region that asks for it"),
    })
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
