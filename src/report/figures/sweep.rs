//! Headline quantities over what a sweep varies.

use crate::plan::{self, Comparison};
use crate::report::Analysed;
use crate::report::chart::{Chart, Content, Curve};
use crate::report::headline::{self, Headline};
use crate::report::numbers::capital;
use crate::report::palette;
use crate::report::sweep::{self, Series};

/// Beginning of the names of their files.
pub const START: &str = "sweep-";

/// A chart for each quantity that has a value in two cases or more.
pub fn charts(cases: &[Analysed], comparisons: &[Comparison]) -> Vec<Chart> {
    let Some((key, series)) = sweep::series(cases) else {
        return Vec::new();
    };
    let chart = |headline: &Headline| {
        let mut curves: Vec<Curve> = series
            .iter()
            .enumerate()
            .map(|(index, series)| curve(headline, index, series))
            .collect();
        let known = curves.iter().flat_map(|curve| &curve.points);
        let known = known.filter(|point| point.1.is_finite()).count();
        curves.extend(references(headline, &series, comparisons));
        (known > 1).then(|| Chart {
            id: format!("{START}{}", headline.id),
            detail: false,
            table: "summary",
            title: format!("{} over {}", capital(headline.name), key.path),
            caption: caption(headline, series.len()),
            x: key.heading(),
            y: format!("{} ({})", headline.name, headline.unit),
            content: Content::Curves(curves),
        })
    };
    headline::all(cases).into_iter().filter_map(chart).collect()
}

fn caption(headline: &Headline, series: usize) -> String {
    let lines = match series {
        1 => "Each point is a case.",
        _ => "Each point is a case; lines join cases that differ in this key alone.",
    };
    match headline.error {
        "" => lines.to_owned(),
        error => format!("{lines} Bars: {error}."),
    }
}

fn curve(headline: &Headline, index: usize, series: &Series) -> Curve {
    let values = series.cases.iter().map(|(x, case)| (x, (headline.of)(case)));
    let point = |(x, value): (&f64, Option<(f64, Option<f64>)>)| match value {
        Some((value, error)) => ((*x, value), error.unwrap_or(f64::NAN)),
        None => ((*x, f64::NAN), f64::NAN),
    };
    let (points, spread) = values.map(point).unzip();
    Curve {
        label: series.name.clone(),
        style: palette::style(index % palette::LINES.len(), index % palette::DASHES.len()),
        points,
        spread,
        dots: true,
        ..Curve::default()
    }
}

/// What comes from elsewhere for these cases, a line for each file.
fn references(headline: &Headline, series: &[Series], comparisons: &[Comparison]) -> Vec<Curve> {
    let of = |comparison: &Comparison| {
        let cases = series.iter().flat_map(|series| &series.cases);
        let known = |(x, case): &(f64, &Analysed)| {
            let one = std::slice::from_ref(comparison);
            let value = plan::reference(one, "summary", headline.column, case.name(), &[])?;
            Some((*x, value * headline.factor))
        };
        let mut points: Vec<(f64, f64)> = cases.filter_map(known).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        points.dedup();
        (!points.is_empty()).then(|| Curve {
            label: comparison.name.clone(),
            style: palette::style(palette::LINES.len() - 1, 1),
            points,
            dots: true,
            ..Curve::default()
        })
    };
    comparisons.iter().filter_map(of).collect()
}
