//! The names of curves above a chart, which grows by the rows that they take. Where a sweep has many curves, it names
//! colours and dashes instead of every curve; it is never higher than the plot.

use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::FontError;

use super::{Curve, FINE, INK, TEXT, WIDTH};
use crate::report::palette;
use crate::report::sweep::Key;

const LINE: i32 = 28 * FINE;
const GAP: i32 = 7 * FINE;
const ROW: i32 = 24 * FINE;
const LEFT: i32 = 78 * FINE;
const RIGHT: i32 = (WIDTH as i32 - 10) * FINE;

/// More curves of a sweep than this are named by colour and dashes.
const MOST_NAMED: usize = 6;

/// The plot below has the height of this many rows.
const MOST_ROWS: i32 = 9;

/// Where a line, a marker and a name of each entry stand, in rows.
pub struct Legend {
    entries: Vec<(Curve, (i32, i32))>,
    rows: i32,
}

/// What is to be named: every curve, or what their colours and dashes stand for.
fn named(curves: &[Curve]) -> Vec<Curve> {
    let entry = |label: &str, style: usize| Curve {
        label: label.to_owned(),
        style,
        ..Curve::default()
    };
    let keyed = curves.len() > MOST_NAMED && curves.iter().all(|curve| curve.key.is_some());
    if !keyed {
        // A curve that is alone needs no name, and has none.
        let named = curves.iter().filter(|curve| !curve.label.is_empty());
        return named.map(|curve| entry(&curve.label, curve.style)).collect();
    }
    let mut entries: Vec<Curve> = Vec::new();
    let keys = || {
        curves
            .iter()
            .filter_map(|curve| Some((curve.key.as_ref()?, Key::styles(curve.style))))
    };
    let colors = keys().map(|(key, [color, _])| (Some(&key.color), color));
    let dashes = keys().map(|(key, [_, dash])| (key.dash.as_ref(), dash));
    for (label, style) in colors.chain(dashes) {
        if let Some(label) = label.filter(|label| entries.iter().all(|entry| entry.label != **label)) {
            entries.push(entry(label, style));
        }
    }
    entries
}

impl Legend {
    pub fn of(curves: &[Curve]) -> Result<Self, FontError> {
        let font = ("sans-serif", TEXT * FINE).into_font();
        let length = |label: &str| font.box_size(label).map(|size| size.0 as i32);
        let (mut x, mut rows) = (LEFT, 1);
        let mut entries = Vec::new();
        let named = named(curves);
        let number = named.len();
        for (place, mut curve) in named.into_iter().enumerate() {
            let mut label = curve.label.clone();
            let mut kept = label.chars().count();
            while length(&label)? > RIGHT - LEFT - LINE - GAP && kept > 2 {
                kept -= 2;
                label = shortened(&curve.label, kept);
            }
            let width = LINE + GAP + length(&label)? + 2 * GAP;
            if x > LEFT && x + width > RIGHT {
                (x, rows) = (LEFT, rows + 1);
            }
            curve.label = label;
            let at = (x, ROW * 2 / 3 + (rows - 1) * ROW);
            if rows == MOST_ROWS {
                curve.label = format!("and {} more", number - place);
                entries.push((curve, at));
                break;
            }
            entries.push((curve, at));
            x += width;
        }
        Ok(Self { entries, rows })
    }

    /// Height that it takes at the top.
    pub fn height(&self) -> i32 {
        ROW / 6 + self.rows * ROW
    }

    /// Height beyond that of a single row.
    pub fn extra(&self) -> i32 {
        (self.rows - 1) * ROW
    }

    pub fn draw<DB: DrawingBackend>(
        &self,
        root: &DrawingArea<DB, plotters::coord::Shift>,
    ) -> Result<(), DrawingAreaErrorKind<DB::ErrorType>> {
        let font = ("sans-serif", TEXT * FINE).into_font().color(&INK);
        for (curve, (x, y)) in &self.entries {
            let ends = [(*x, *y), (x + LINE, *y)];
            match palette::DASHES[curve.style % palette::DASHES.len()] {
                None => root.draw(&PathElement::new(ends, curve.stroke()))?,
                Some((dash, pause)) => {
                    root.draw(&DashedPathElement::new(ends, dash * FINE, pause * FINE, curve.stroke()))?;
                }
            }
            root.draw(&curve.marker((x + LINE / 2, *y)))?;
            let place = (x + LINE + GAP, y - TEXT * FINE / 2);
            root.draw(&Text::new(curve.label.as_str(), place, font.clone()))?;
        }
        Ok(())
    }
}

/// The beginning and the end of a text, with so many letters in all: names of cases from a sweep differ at their end.
fn shortened(text: &str, kept: usize) -> String {
    let letters: Vec<char> = text.chars().collect();
    let half = kept / 2;
    let [start, end] = [&letters[..half], &letters[letters.len() - half..]].map(|part| part.iter().collect::<String>());
    format!("{start}…{end}")
}
