//! The names of curves above a chart, which grows by the rows that they take.

use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::FontError;

use super::{Curve, FINE, INK, TEXT, WIDTH};
use crate::report::palette;

const LINE: i32 = 28 * FINE;
const GAP: i32 = 7 * FINE;
const ROW: i32 = 24 * FINE;
const LEFT: i32 = 78 * FINE;
const RIGHT: i32 = (WIDTH as i32 - 10) * FINE;

/// Where a line, a marker and a name of each curve stand, in rows.
pub struct Legend<'a> {
    entries: Vec<(&'a Curve, String, (i32, i32))>,
    rows: i32,
}

impl<'a> Legend<'a> {
    pub fn of(curves: &'a [Curve]) -> Result<Self, FontError> {
        let font = ("sans-serif", TEXT * FINE).into_font();
        let length = |label: &str| font.box_size(label).map(|size| size.0 as i32);
        let (mut x, mut rows) = (LEFT, 1);
        let mut entries = Vec::new();
        for curve in curves {
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
            entries.push((curve, label, (x, ROW * 2 / 3 + (rows - 1) * ROW)));
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
        for (curve, label, (x, y)) in &self.entries {
            let ends = [(*x, *y), (x + LINE, *y)];
            match palette::DASHES[curve.style % palette::DASHES.len()] {
                None => root.draw(&PathElement::new(ends, curve.stroke()))?,
                Some((dash, pause)) => {
                    root.draw(&DashedPathElement::new(ends, dash * FINE, pause * FINE, curve.stroke()))?;
                }
            }
            root.draw(&curve.marker((x + LINE / 2, *y)))?;
            let place = (x + LINE + GAP, y - TEXT * FINE / 2);
            root.draw(&Text::new(label.as_str(), place, font.clone()))?;
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
