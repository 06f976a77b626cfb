//! Line charts: what they show, apart from how they are drawn.

mod labels;
mod legend;
mod ranges;
pub mod ranks;
pub mod scatter;

use std::fmt::Display;
use std::sync::Once;

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::{FontStyle, register_font};

use super::sweep::Key;
use super::{ReportError, numbers, palette};
use legend::Legend;
use ranges::ranges;
use ranks::OverRanks;
use scatter::Scatter;

/// Size of a chart, on a phone little less than its width, so that its text can be read there; and units of the drawing a unit of that: coordinates in the file are whole numbers.
const WIDTH: u32 = 480;
const HEIGHT: u32 = 320;
const FINE: i32 = 4;

/// nm in a millimetre.
const NM_IN_A_MM: f64 = 1e6;

const TEXT: i32 = 16;
const INK: RGBColor = RGBColor(34, 34, 34);
const FAINT: RGBColor = RGBColor(222, 222, 222);

/// Points of a curve that a page can show; more are thinned out so that every peak stays.
const MOST_POINTS: usize = 800;

/// How much of what is behind the band of an uncertainty it hides.
const SPREAD_OPACITY: f64 = 0.2;

/// Distance of the markers along x.
const MARKER_GAP: i32 = 64 * FINE;

/// Curves over one pair of axes.
pub struct Chart {
    /// Name of its file, unique within the page.
    pub id: String,
    pub title: String,
    /// What it shows, for the caption.
    pub caption: String,
    /// One of many of its kind, which a page may fold away.
    pub detail: bool,
    /// The table that holds its numbers.
    pub table: &'static str,
    /// Axis labels, with units.
    pub x: String,
    pub y: String,
    pub content: Content,
}

/// What stands between the axes.
pub enum Content {
    Curves(Vec<Curve>),
    Points(Scatter),
    Ranks(OverRanks),
}

/// One curve; a point without a finite y is a gap.
#[derive(Default)]
pub struct Curve {
    pub label: String,
    /// Chooses colour, dashes and marker; the same case has the same one in all charts.
    pub style: usize,
    pub points: Vec<(f64, f64)>,
    /// Uncertainty of y to either side, a point; empty where none is shown.
    pub spread: Vec<f64>,
    /// Each point is a measurement of its own, with a marker and a bar.
    pub dots: bool,
    /// What its colour and dashes stand for, where they stand for something.
    pub key: Option<Key>,
}

/// A chart as a file of its own and as part of a page.
pub struct Drawing {
    pub standalone: String,
    pub inline: String,
}

impl Chart {
    /// `width` is that of the file, nm.
    pub fn draw(&self, width: Option<f64>) -> Result<Drawing, ReportError> {
        let failed = |error: &dyn Display| ReportError::Figure {
            figure: self.id.clone(),
            reason: error.to_string(),
        };
        prepare_fonts();
        let curves = match &self.content {
            Content::Curves(curves) => curves.as_slice(),
            Content::Points(_) | Content::Ranks(_) => &[],
        };
        let legend = Legend::of(curves).map_err(|error| failed(&error))?;
        let size = (WIDTH as i32 * FINE, HEIGHT as i32 * FINE + legend.extra());
        let mut svg = String::new();
        {
            let root = SVGBackend::with_string(&mut svg, (size.0 as u32, size.1 as u32)).into_drawing_area();
            let drawn = match &self.content {
                Content::Curves(curves) => self.draw_on(curves, &legend, &root),
                Content::Points(scatter) => scatter.draw_on(&root, [&self.x, &self.y]),
                Content::Ranks(over_ranks) => over_ranks.draw_on(&root, [&self.x, &self.y]),
            };
            drawn.map_err(|error| failed(&error))?;
            root.present().map_err(|error| failed(&error))?;
        }
        let start = svg.find('\n').ok_or_else(|| failed(&"the drawing is empty"))?;
        let end = svg.rfind("</svg>").ok_or_else(|| failed(&"the drawing has no end"))?;
        Ok(self.wrap(&svg[start + 1..end], size, width))
    }

    /// Gives the drawing a name and a description for those who cannot see it.
    fn wrap(&self, body: &str, (wide, high): (i32, i32), width: Option<f64>) -> Drawing {
        let escape = |text: &str| {
            text.replace('&', "&amp;")
                .replace('<', "&lt;")
                .replace('>', "&gt;")
                .replace('"', "&quot;")
        };
        let (id, title, about) = (&self.id, escape(&self.title), escape(&self.describe()));
        let in_pixels = format!("width=\"{WIDTH}\" height=\"{}\"", high / FINE);
        let in_millimetres = |width: f64| {
            let height = width * f64::from(high) / f64::from(wide);
            format!(
                "width=\"{:.2}mm\" height=\"{:.2}mm\"",
                width / NM_IN_A_MM,
                height / NM_IN_A_MM
            )
        };
        let on_paper = width.map_or_else(|| in_pixels.clone(), in_millimetres);
        let rest = format!(
            "viewBox=\"0 0 {wide} {high}\" role=\"img\" \
             aria-labelledby=\"{id}-title {id}-about\">\n\
             <title id=\"{id}-title\">{title}</title>\n<desc id=\"{id}-about\">{about}</desc>\n\
             <g aria-hidden=\"true\">\n{body}</g>\n</svg>\n"
        );
        Drawing {
            standalone: format!("<svg xmlns=\"http://www.w3.org/2000/svg\" {on_paper} {rest}"),
            inline: format!("<svg {in_pixels} {rest}"),
        }
    }

    /// The course of every curve in words.
    fn describe(&self) -> String {
        let course = |curve: &Curve| {
            let mut seen = curve.points.iter().filter(|point| point.1.is_finite());
            let (Some(first), last) = (seen.next(), seen.next_back()) else {
                return format!("{}: no data.", curve.label);
            };
            let number = |value| numbers::significant(value, 3);
            let last = last.unwrap_or(first);
            let top = curve
                .points
                .iter()
                .filter(|point| point.1.is_finite())
                .max_by(|a, b| a.1.total_cmp(&b.1));
            let top = top.unwrap_or(first);
            format!(
                "{}: from {} at {} to {} at {}, highest {} at {}.",
                curve.label,
                number(first.1),
                number(first.0),
                number(last.1),
                number(last.0),
                number(top.1),
                number(top.0)
            )
        };
        let courses = match &self.content {
            Content::Curves(curves) => curves.iter().map(course).collect::<Vec<String>>().join(" "),
            Content::Points(scatter) => scatter.describe(),
            Content::Ranks(over_ranks) => over_ranks.describe(),
        };
        format!("{} over {}. {courses}", self.y, self.x)
    }

    fn draw_on<DB: DrawingBackend>(
        &self,
        curves: &[Curve],
        legend: &Legend,
        root: &DrawingArea<DB, Shift>,
    ) -> Result<(), DrawingAreaErrorKind<DB::ErrorType>> {
        root.fill(&WHITE)?;
        legend.draw(root)?;
        let font = ("sans-serif", TEXT * FINE).into_font().color(&INK);
        let (x, y) = ranges(curves);
        let mut chart = framed(root, legend.height() + 6 * FINE).build_cartesian_2d(x, y)?;
        chart
            .configure_mesh()
            .x_labels(6)
            .y_labels(7)
            .max_light_lines(0)
            .bold_line_style(FAINT.stroke_width(FINE as u32))
            .axis_style(INK.stroke_width(FINE as u32))
            .set_all_tick_mark_size(5 * FINE)
            .label_style(font.clone())
            .axis_desc_style(font)
            .x_label_formatter(&|value| numbers::tick(*value))
            .y_label_formatter(&|value| numbers::tick(*value))
            .x_desc(&self.x)
            .y_desc(&self.y)
            .draw()?;
        curves.iter().try_for_each(|curve| curve.draw_spread(&mut chart))?;
        curves.iter().try_for_each(|curve| curve.draw_on(&mut chart))
    }
}

/// A chart with room for the numbers and names of its axes, and so much above it.
fn framed<'a, DB: DrawingBackend>(root: &'a DrawingArea<DB, Shift>, above: i32) -> ChartBuilder<'a, 'a, DB> {
    let mut chart = ChartBuilder::on(root);
    chart
        .margin_left(4 * FINE)
        .margin_right(18 * FINE)
        .margin_bottom(4 * FINE)
        .margin_top(above)
        .x_label_area_size(48 * FINE)
        .y_label_area_size(74 * FINE);
    chart
}

type Axes<'a, DB> = ChartContext<'a, DB, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

impl Curve {
    fn stroke(&self) -> ShapeStyle {
        let [red, green, blue] = palette::LINES[self.style % palette::LINES.len()];
        RGBColor(red, green, blue).stroke_width(2 * FINE as u32)
    }

    /// A pale band as wide as the uncertainty.
    fn draw_spread<DB: DrawingBackend>(&self, chart: &mut Axes<DB>) -> Result<(), DrawingAreaErrorKind<DB::ErrorType>> {
        let bars: Vec<_> = self.points.iter().zip(&self.spread).collect();
        if self.dots {
            let bars = bars
                .into_iter()
                .filter(|(point, spread)| (point.1 + **spread).is_finite());
            let bar = |(point, spread): (&(f64, f64), &f64)| {
                PathElement::new(
                    [(point.0, point.1 - spread), (point.0, point.1 + spread)],
                    self.stroke(),
                )
            };
            chart.draw_series(bars.map(bar))?;
            return Ok(());
        }
        let pieces = bars.split(|(point, spread)| !(point.1 + **spread).is_finite());
        for piece in pieces.filter(|piece| piece.len() > 1) {
            let side = |sign: f64| {
                let points = piece.iter().map(|(point, spread)| (point.0, point.1 + sign * **spread));
                thinned(&points.collect::<Vec<_>>())
            };
            let outline = side(1.0).into_iter().chain(side(-1.0).into_iter().rev());
            let [red, green, blue] = palette::LINES[self.style % palette::LINES.len()];
            let fill = RGBColor(red, green, blue).mix(SPREAD_OPACITY);
            chart.draw_series([Polygon::new(outline.collect::<Vec<_>>(), fill)])?;
        }
        Ok(())
    }

    fn draw_on<DB: DrawingBackend>(&self, chart: &mut Axes<DB>) -> Result<(), DrawingAreaErrorKind<DB::ErrorType>> {
        for piece in self
            .points
            .split(|point| !point.1.is_finite())
            .filter(|piece| !piece.is_empty())
        {
            let points = thinned(piece);
            match palette::DASHES[self.style % palette::DASHES.len()] {
                None => chart.draw_series([PathElement::new(points, self.stroke())])?,
                Some((dash, pause)) => {
                    chart.draw_series(DashedLineSeries::new(points, dash * FINE, pause * FINE, self.stroke()))?
                }
            };
        }
        let seen = self.points.iter().filter(|point| point.1.is_finite());
        // Markers of different curves stand at different places.
        let start = chart.backend_coord(&(chart.x_range().start, 0.0)).0;
        let mut next = start + (self.style % 4 + 1) as i32 * MARKER_GAP / 5;
        let mut marks = Vec::new();
        for place in seen.map(|point| chart.backend_coord(point)) {
            if self.dots {
                marks.push(place);
            } else if place.0 >= next {
                marks.push(place);
                next += MARKER_GAP * ((place.0 - next) / MARKER_GAP + 1);
            }
        }
        let area = chart.plotting_area().strip_coord_spec();
        let (left, top) = area.get_base_pixel();
        marks
            .into_iter()
            .try_for_each(|(x, y)| area.draw(&self.marker((x - left, y - top))))
    }

    /// A dot, a square, a triangle or a diamond.
    fn marker(&self, at: (i32, i32)) -> Polygon<(i32, i32)> {
        let size = f64::from(5 * FINE);
        let (corners, turn): (u32, f64) =
            [(12, 0.0), (4, 0.125), (3, 0.25), (4, 0.0)][self.style / 2 % 2 * 2 + self.style % 2];
        let corner = |index: u32| {
            let angle = std::f64::consts::TAU * (f64::from(index) / f64::from(corners) + turn);
            (
                at.0 + (size * angle.cos()).round() as i32,
                at.1 - (size * angle.sin()).round() as i32,
            )
        };
        Polygon::new((0..corners).map(corner).collect::<Vec<_>>(), self.stroke().filled())
    }
}

/// Keeps the first, lowest, highest and last point of each stretch.
fn thinned(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    if points.len() <= MOST_POINTS {
        return points.to_vec();
    }
    let stretch = points.len().div_ceil(MOST_POINTS / 4);
    let keep = |piece: &[(f64, f64)]| {
        let by_height = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let mut kept: Vec<(f64, f64)> = [
            piece.first(),
            piece.iter().min_by(by_height),
            piece.iter().max_by(by_height),
            piece.last(),
        ]
        .into_iter()
        .flatten()
        .copied()
        .collect();
        kept.sort_by(|a, b| a.0.total_cmp(&b.0));
        kept.dedup();
        kept
    };
    points.chunks(stretch).flat_map(keep).collect()
}

/// The font with which plotters measures and paints text; it has none of its own.
pub fn prepare_fonts() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        // A font that cannot be read shows as an error of the first figure.
        let _ = register_font("sans-serif", FontStyle::Normal, dejavu::sans::regular());
    });
}
