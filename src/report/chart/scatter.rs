//! Points over two logarithmic axes: what something costs against how wrong it is.

use plotters::coord::Shift;
use plotters::prelude::*;

use super::{FAINT, FINE, INK, TEXT, framed, labels};
use crate::report::{numbers, palette};

/// Decades are too coarse for the ends of the axes: they reach this factor beyond the points.
const ROOM: f64 = 1.6;

/// Radius of a point.
const DOT: i32 = 4 * FINE;

/// Points with names, the best of them joined, and costs that have no error of their own.
#[derive(Default)]
pub struct Scatter {
    pub points: Vec<Point>,
    /// What is drawn as an upright line at its cost, such as the reference itself.
    pub marks: Vec<Mark>,
}

pub struct Mark {
    pub name: String,
    pub x: f64,
    /// Whose reference it is.
    pub group: Option<usize>,
}

pub struct Point {
    /// A short name that stands beside the point.
    pub name: String,
    pub x: f64,
    pub y: f64,
    /// Points of one group have one colour, and their best ones are joined.
    pub group: usize,
    /// Nothing else of its group is both cheaper and nearer.
    pub is_best: bool,
}

impl Scatter {
    pub fn draw_on<DB: DrawingBackend>(
        &self,
        root: &DrawingArea<DB, Shift>,
        [x, y]: [&str; 2],
    ) -> Result<(), DrawingAreaErrorKind<DB::ErrorType>> {
        root.fill(&WHITE)?;
        let font = ("sans-serif", TEXT * FINE).into_font().color(&INK);
        let small = ("sans-serif", TEXT * FINE * 3 / 4).into_font().color(&INK);
        let costs = self.points.iter().map(|point| point.x);
        let across = span(costs.chain(self.marks.iter().map(|mark| mark.x)));
        let up = span(self.points.iter().map(|point| point.y));
        let mut chart = framed(root, 12 * FINE).build_cartesian_2d(across.log_scale(), up.clone().log_scale())?;
        chart
            .configure_mesh()
            .x_labels(6)
            .y_labels(6)
            .max_light_lines(0)
            .bold_line_style(FAINT.stroke_width(FINE as u32))
            .axis_style(INK.stroke_width(FINE as u32))
            .set_all_tick_mark_size(5 * FINE)
            .label_style(font.clone())
            .axis_desc_style(font)
            .x_label_formatter(&|value| numbers::tick(*value))
            .y_label_formatter(&|value| numbers::tick(*value))
            .x_desc(x)
            .y_desc(y)
            .draw()?;
        for (level, mark) in self.marks.iter().enumerate() {
            let line = [(mark.x, up.start), (mark.x, up.end)];
            let stroke = mark.group.map_or(INK, color).stroke_width(2 * FINE as u32);
            chart.draw_series(DashedLineSeries::new(line, 6 * FINE, 4 * FINE, stroke))?;
            // Names of marks that stand close are on lines of their own.
            let below = (level as i32 % 4) * TEXT * FINE;
            let name = Text::new(mark.name.clone(), (5 * FINE, below), small.clone());
            chart.draw_series([EmptyElement::at((mark.x, up.end)) + name])?;
        }
        let groups = self
            .points
            .iter()
            .map(|point| point.group)
            .max()
            .map_or(0, |last| last + 1);
        for group in 0..groups {
            let best = self.points.iter().filter(|point| point.group == group && point.is_best);
            let mut best: Vec<(f64, f64)> = best.map(|point| (point.x, point.y)).collect();
            best.sort_by(|a, b| a.0.total_cmp(&b.0));
            chart.draw_series([PathElement::new(best, color(group).stroke_width(2 * FINE as u32))])?;
        }
        let dots: Vec<(i32, i32)> = self
            .points
            .iter()
            .map(|point| chart.backend_coord(&(point.x, point.y)))
            .collect();
        let mut sizes = Vec::new();
        for point in &self.points {
            let (width, height) = root.estimate_text_size(&point.name, &small)?;
            sizes.push((width as i32, height as i32));
        }
        let places = labels::places(&dots, &sizes, DOT);
        for (point, place) in self.points.iter().zip(places) {
            let style = match point.is_best {
                true => color(point.group).filled(),
                false => color(point.group).stroke_width(FINE as u32),
            };
            let dot = Circle::new((0, 0), DOT, style);
            let name = Text::new(point.name.clone(), place, small.clone());
            chart.draw_series([EmptyElement::at((point.x, point.y)) + dot + name])?;
        }
        Ok(())
    }

    /// The best points in words.
    pub fn describe(&self) -> String {
        let best = self.points.iter().filter(|point| point.is_best);
        let words = best.map(|point| {
            let [x, y] = [point.x, point.y].map(|value| numbers::significant(value, 3));
            format!("{}: {y} at {x}", point.name)
        });
        words.collect::<Vec<_>>().join("; ")
    }
}

fn color(group: usize) -> RGBColor {
    let [red, green, blue] = palette::LINES[group % palette::LINES.len()];
    RGBColor(red, green, blue)
}

fn span(values: impl Iterator<Item = f64>) -> std::ops::Range<f64> {
    let (low, high) = values.fold((f64::INFINITY, 0.0_f64), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    low / ROOM..high * ROOM
}
