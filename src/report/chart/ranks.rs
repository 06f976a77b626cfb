//! Something over the number of ranks, which doubles from tick to tick.

use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;

use super::{FAINT, FINE, INK, TEXT, framed};
use crate::report::{numbers, palette};

/// Curves and marks over ranks.
pub struct OverRanks {
    pub lines: Vec<Line>,
    /// Whether the value doubles from tick to tick too; otherwise it runs from 0 to a little above 1.
    pub doubles: bool,
}

pub struct Line {
    pub label: String,
    pub style: Style,
    /// Ranks and value.
    pub points: Vec<(u32, f64)>,
}

/// What a line is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// Thin and full.
    Ideal,
    /// Filled marks.
    Measured,
    /// Dashed.
    Prediction,
    /// Open marks.
    Compared,
}

/// Above the largest value, so that marks at the border are whole.
const ROOM: f64 = 0.08;
/// Length of a piece of a line in the legend.
const SAMPLE: i32 = 28 * FINE;

impl OverRanks {
    pub fn draw_on<DB: DrawingBackend>(
        &self,
        root: &DrawingArea<DB, Shift>,
        [x, y]: [&str; 2],
    ) -> Result<(), DrawingAreaErrorKind<DB::ErrorType>> {
        root.fill(&WHITE)?;
        let legend = self.draw_legend(root)?;
        let font = ("sans-serif", TEXT * FINE).into_font().color(&INK);
        let points = || {
            self.lines
                .iter()
                .flat_map(|line| &line.points)
                .map(|point| self.place(point))
        };
        let right = points().map(|place| place.0).fold(1.0, f64::max);
        let top = points().map(|place| place.1).fold(1.0, f64::max);
        let low = points().map(|place| place.1).fold(0.0, f64::min);
        let mut chart = framed(root, legend + 6 * FINE)
            .build_cartesian_2d(0.0..right * (1.0 + 0.5 * ROOM), low..top * (1.0 + ROOM))?;
        let doubled = |value: &f64| numbers::tick(value.exp2());
        let plain = |value: &f64| numbers::tick(*value);
        let y_label: &dyn Fn(&f64) -> String = if self.doubles { &doubled } else { &plain };
        chart
            .configure_mesh()
            .x_labels(right as usize + 2)
            .y_labels(if self.doubles { top as usize + 2 } else { 6 })
            .max_light_lines(0)
            .bold_line_style(FAINT.stroke_width(FINE as u32))
            .axis_style(INK.stroke_width(FINE as u32))
            .set_all_tick_mark_size(5 * FINE)
            .label_style(font.clone())
            .axis_desc_style(font)
            .x_label_formatter(&doubled)
            .y_label_formatter(y_label)
            .x_desc(x)
            .y_desc(y)
            .draw()?;
        for line in &self.lines {
            let places: Vec<(f64, f64)> = line.points.iter().map(|point| self.place(point)).collect();
            let (color, size) = (line.color(), 5 * FINE);
            match line.style {
                Style::Ideal => chart.draw_series([PathElement::new(places, color.stroke_width(FINE as u32))])?,
                Style::Prediction => {
                    let stroke = color.stroke_width(2 * FINE as u32);
                    chart.draw_series(DashedLineSeries::new(places, 8 * FINE, 5 * FINE, stroke))?
                }
                Style::Measured => {
                    chart.draw_series(places.into_iter().map(|place| Circle::new(place, size, color.filled())))?
                }
                Style::Compared => chart.draw_series(
                    places
                        .into_iter()
                        .map(|place| Circle::new(place, size, color.stroke_width(2 * FINE as u32))),
                )?,
            };
        }
        Ok(())
    }

    /// A piece and a name of each line, in a row; gives the height used.
    fn draw_legend<DB: DrawingBackend>(
        &self,
        root: &DrawingArea<DB, Shift>,
    ) -> Result<i32, DrawingAreaErrorKind<DB::ErrorType>> {
        let font = ("sans-serif", TEXT * FINE).into_font().color(&INK);
        let (gap, y) = (7 * FINE, 16 * FINE);
        let mut x = 78 * FINE;
        for line in &self.lines {
            line.sample_on(root, [x, y])?;
            let label = Text::new(
                line.label.clone(),
                (x + SAMPLE + gap, y - TEXT * FINE / 2),
                font.clone(),
            );
            root.draw(&label)?;
            x += SAMPLE + 3 * gap + root.estimate_text_size(&line.label, &font)?.0 as i32;
        }
        Ok(28 * FINE)
    }

    fn place(&self, &(ranks, value): &(u32, f64)) -> (f64, f64) {
        let across = f64::from(ranks).log2();
        (across, if self.doubles { value.log2() } else { value })
    }

    /// Every line by its ends.
    pub fn describe(&self) -> String {
        let ends = |line: &Line| {
            let (first, last) = (line.points.first()?, line.points.last()?);
            let end = |(ranks, value): &(u32, f64)| format!("{} at {ranks}", numbers::significant(*value, 3));
            Some(format!("{}: from {} to {}.", line.label, end(first), end(last)))
        };
        self.lines.iter().filter_map(ends).collect::<Vec<_>>().join(" ")
    }
}

impl Line {
    fn color(&self) -> RGBColor {
        let color = match self.style {
            Style::Ideal => return RGBColor(150, 150, 150),
            Style::Measured | Style::Prediction => 0,
            Style::Compared => 1,
        };
        let [red, green, blue] = palette::LINES[color];
        RGBColor(red, green, blue)
    }

    /// A piece of it for the legend, from here on.
    fn sample_on<DB: DrawingBackend>(
        &self,
        root: &DrawingArea<DB, Shift>,
        [x, y]: [i32; 2],
    ) -> Result<(), DrawingAreaErrorKind<DB::ErrorType>> {
        let ends = [(x, y), (x + SAMPLE, y)];
        let mark = (x + SAMPLE / 2, y);
        let (color, size) = (self.color(), 5 * FINE);
        match self.style {
            Style::Ideal => root.draw(&PathElement::new(ends, color.stroke_width(FINE as u32))),
            Style::Prediction => {
                let stroke = color.stroke_width(2 * FINE as u32);
                root.draw(&DashedPathElement::new(ends, 8 * FINE, 5 * FINE, stroke))
            }
            Style::Measured => root.draw(&Circle::new(mark, size, color.filled())),
            Style::Compared => root.draw(&Circle::new(mark, size, color.stroke_width(2 * FINE as u32))),
        }
    }
}
