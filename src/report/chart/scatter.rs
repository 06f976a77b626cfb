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
    /// What has a cost and no error, such as the reference itself: drawn at the lower edge.
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
        let mut chart = framed(root, 12 * FINE).build_cartesian_2d(
            across.clone().log_scale().with_key_points(ticks(&across)),
            up.clone().log_scale().with_key_points(ticks(&up)),
        )?;
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
        let floor = |mark: &Mark| (mark.x, up.start);
        let at = self
            .points
            .iter()
            .map(|point| (point.x, point.y))
            .chain(self.marks.iter().map(floor));
        let dots: Vec<(i32, i32)> = at.map(|place| chart.backend_coord(&place)).collect();
        let names = self
            .points
            .iter()
            .map(|point| &point.name)
            .chain(self.marks.iter().map(|mark| &mark.name));
        let mut sizes = Vec::new();
        for name in names {
            let (width, height) = root.estimate_text_size(name, &small)?;
            sizes.push((width as i32, height as i32));
        }
        let places = labels::places(&dots, &sizes, DOT);
        for (mark, place) in self.marks.iter().zip(&places[self.points.len()..]) {
            let size = DOT * 3 / 2;
            let corners = [(0, -size), (size, 0), (0, size), (-size, 0)];
            let diamond = Polygon::new(corners, mark.group.map_or(INK, color).filled());
            let name = Text::new(mark.name.clone(), *place, small.clone());
            chart.draw_series([EmptyElement::at(floor(mark)) + diamond + name])?;
        }
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

/// 1, 2 and 5 of every decade within a range; of more than three decades the powers of ten alone.
fn ticks(range: &std::ops::Range<f64>) -> Vec<f64> {
    let decades = range.start.log10().floor() as i32..=range.end.log10().ceil() as i32;
    let steps: &[f64] = match range.end / range.start > 1e3 {
        true => &[1.0],
        false => &[1.0, 2.0, 5.0],
    };
    let all = decades.flat_map(|decade| steps.iter().map(move |step| step * 10f64.powi(decade)));
    all.filter(|tick| range.contains(tick)).collect()
}

fn span(values: impl Iterator<Item = f64>) -> std::ops::Range<f64> {
    let (low, high) = values.fold((f64::INFINITY, 0.0_f64), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    low / ROOM..high * ROOM
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_decades_with_their_twos_and_fives_where_there_is_room() {
        let near = |found: Vec<f64>, wanted: &[f64]| {
            found.len() == wanted.len() && found.iter().zip(wanted).all(|(a, b)| (a / b - 1.0).abs() < 1e-12)
        };
        assert!(near(ticks(&(0.3..12.0)), &[0.5, 1.0, 2.0, 5.0, 10.0]));
        assert!(near(ticks(&(0.5e-2..2e2)), &[0.01, 0.1, 1.0, 10.0, 100.0]));
    }
}
