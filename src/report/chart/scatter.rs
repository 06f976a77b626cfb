//! Points over two logarithmic axes: what something costs against how wrong it is.

use plotters::coord::Shift;
use plotters::coord::combinators::{LogCoord, WithKeyPoints};
use plotters::prelude::*;

use super::labels::{self, Label};
use super::{FAINT, FINE, INK, TEXT, framed};
use crate::report::{numbers, palette};

/// Decades are too coarse for the ends of the axes: they reach this factor beyond the points.
const ROOM: f64 = 1.6;

/// Share of the height for what has no error, below the others.
const STRIP: f64 = 0.16;

/// Radius of a point.
const DOT: i32 = 4 * FINE;

type Axis = WithKeyPoints<LogCoord<f64>>;
type Axes<'a, DB> = ChartContext<'a, DB, Cartesian2d<Axis, Axis>>;

/// Points with names, the best of them joined, and costs that have no error of their own.
#[derive(Default)]
pub struct Scatter {
    pub points: Vec<Point>,
    /// What has a cost and no error, such as the reference itself: drawn in a strip of its own below the axis of errors.
    pub marks: Vec<Mark>,
}

pub struct Mark {
    pub name: String,
    pub x: f64,
    /// Whose reference it is.
    pub group: Option<usize>,
}

pub struct Point {
    /// A short name that stands beside the point, where there is room.
    pub name: String,
    pub x: f64,
    pub y: f64,
    /// Points of one group have one colour, outline and dashes, and their best ones are joined.
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
        let small = ("sans-serif", TEXT * FINE * 7 / 8).into_font().color(&INK);
        let costs = self.points.iter().map(|point| point.x);
        let across = span(costs.chain(self.marks.iter().map(|mark| mark.x)));
        let up = span(self.points.iter().map(|point| point.y));
        let strip = (up.end / up.start).powf(STRIP);
        let none = up.start / strip.sqrt();
        let lowest = if self.marks.is_empty() {
            up.start
        } else {
            up.start / strip
        };
        let mut upwards = ticks(&up);
        upwards.extend((!self.marks.is_empty()).then_some(none));
        let mut chart = framed(root, 12 * FINE).build_cartesian_2d(
            across.clone().log_scale().with_key_points(ticks(&across)),
            (lowest..up.end).log_scale().with_key_points(upwards),
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
            .y_label_formatter(&|value| match *value < up.start {
                true => "none".to_owned(),
                false => numbers::tick(*value),
            })
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
            // Nothing is nearer than the reference itself.
            let reference = self.marks.iter().find(|mark| mark.group == Some(group));
            best.extend(reference.map(|mark| (mark.x, none)));
            let stroke = color(group).stroke_width(2 * FINE as u32);
            match palette::DASHES[group % palette::DASHES.len()] {
                None => chart.draw_series([PathElement::new(best, stroke)])?,
                Some((dash, pause)) => {
                    chart.draw_series(DashedLineSeries::new(best, dash * FINE, pause * FINE, stroke))?
                }
            };
        }
        let floor = |mark: &Mark| (mark.x, none);
        if !self.marks.is_empty() {
            let border = [across.start, across.end].map(|x| (x, up.start));
            chart.draw_series([PathElement::new(border, INK.stroke_width(FINE as u32))])?;
        }
        let at = self
            .points
            .iter()
            .map(|point| (point.x, point.y))
            .chain(self.marks.iter().map(floor));
        let dots: Vec<(i32, i32)> = at.map(|place| chart.backend_coord(&place)).collect();
        let (wide, high) = chart.plotting_area().get_pixel_range();
        let bounds = [wide.start, high.start, wide.end - wide.start, high.end - high.start];
        let needed = self
            .points
            .iter()
            .map(|point| point.is_best)
            .chain(self.marks.iter().map(|_| true));
        let names = self
            .points
            .iter()
            .map(|point| &point.name)
            .chain(self.marks.iter().map(|mark| &mark.name));
        let names: Vec<&String> = names.collect();
        let mut labels = Vec::new();
        for ((at, name), is_needed) in dots.into_iter().zip(&names).zip(needed) {
            let (width, height) = root.estimate_text_size(name, &small)?;
            labels.push(Label {
                at,
                size: (width as i32, height as i32),
                is_needed,
            });
        }
        let named = |chart: &mut Axes<DB>, at: (f64, f64), number: usize, place: Option<(i32, i32)>| {
            let name = place.map(|place| Text::new(names[number].clone(), place, small.clone()));
            chart.draw_series(name.map(|name| EmptyElement::at(at) + name))?;
            Ok::<(), DrawingAreaErrorKind<DB::ErrorType>>(())
        };
        let places = labels::places(&labels, DOT, bounds);
        for (number, point) in self.points.iter().enumerate() {
            let (at, corners) = ((point.x, point.y), corners(Some(point.group)));
            match point.is_best {
                true => {
                    chart.draw_series([EmptyElement::at(at) + Polygon::new(corners, color(point.group).filled())])?
                }
                false => {
                    let outline: Vec<_> = corners.iter().chain(&corners[..1]).copied().collect();
                    let stroke = color(point.group).stroke_width(FINE as u32);
                    chart.draw_series([EmptyElement::at(at) + PathElement::new(outline, stroke)])?
                }
            };
            named(&mut chart, at, number, places[number])?;
        }
        for (number, mark) in (self.points.len()..).zip(&self.marks) {
            let dot = Polygon::new(corners(mark.group), mark.group.map_or(INK, color).filled());
            chart.draw_series([EmptyElement::at(floor(mark)) + dot])?;
            named(&mut chart, floor(mark), number, places[number])?;
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

/// The outline of a point: a dot, a square or a triangle by its group; what is of none is a diamond.
fn corners(group: Option<usize>) -> Vec<(i32, i32)> {
    let (count, turn, size) = match group.map(|group| group % 3) {
        Some(0) => (16, 0.0, 1.0),
        Some(1) => (4, 0.125, 1.2),
        Some(_) => (3, 0.25, 1.3),
        None => (4, 0.0, 1.4),
    };
    let corner = |index: u32| {
        let angle = std::f64::consts::TAU * (f64::from(index) / f64::from(count) + turn);
        let radius = size * f64::from(DOT);
        (
            (radius * angle.cos()).round() as i32,
            -(radius * angle.sin()).round() as i32,
        )
    };
    (0..count).map(corner).collect()
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
