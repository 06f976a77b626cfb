//! How the figures of a report are drawn as files of their own.

use crate::study::{Finding, Findings, Study};

/// Widths that a page may have, nm: 10 mm to 1 m.
const WIDTHS: std::ops::RangeInclusive<f64> = 1e7..=1e9;

/// Width of a figure, nm; `None` where it is left to who shows it.
pub fn width(study: &Study, findings: &Findings) -> Option<f64> {
    let figures = study.content.report.right()?.figures.right()?;
    let (width, place) = (figures.width.right()?.value, figures.width.place()?);
    if !WIDTHS.contains(&width) {
        let message = "a figure is from 10 mm to 1 m wide";
        findings.add(
            Finding::at(place, message).help("write for example `figures: {width: 86 mm}`, a column of a journal"),
        );
        return None;
    }
    Some(width)
}
