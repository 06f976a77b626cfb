//! Pictures of the broken slabs, with axes and one shared colour scale.

use std::fs;
use std::path::Path;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::chart::prepare_fonts;
use super::slab::{self, View};
use super::units::{GIGAPASCAL, PERCENT};
use super::{Analysed, ReportError, numbers, palette};
use crate::record::frames::{FieldMesh, Frame};

/// Pixels.
const WIDTH: u32 = 1240;
const EDGE: u32 = 12;
const LEFT: u32 = 110;
const RIGHT: u32 = 190;
const TOP: u32 = 16;
const BOTTOM: u32 = 84;
const TEXT: i32 = 27;
const TALLEST: f64 = 1600.0;
const INK: RGBColor = RGBColor(34, 34, 34);

/// The scale ends at this quantile of |sigma_yy|, so that a few torn atoms do not darken all the rest.
const QUANTILE: f64 = 0.995;

/// A picture and what it shows.
pub struct Picture {
    pub file: String,
    pub title: String,
    pub caption: String,
    pub png: Vec<u8>,
}

/// Pictures on one colour scale that ends at plus and minus `limit`, GPa.
pub struct Gallery {
    pub pictures: Vec<Picture>,
    pub limit: f64,
}

/// Draws the last frame of every case that has one.
pub fn draw_all(cases: &[Analysed], folder: &Path) -> Result<Gallery, ReportError> {
    let frames = cases
        .iter()
        .filter_map(|case| case.result.last_frame.as_ref().map(|(_, frame)| frame));
    let limit = scale_limit(frames);
    let mut pictures = Vec::new();
    for (index, case) in cases.iter().enumerate() {
        let Some((mesh, frame)) = &case.result.last_frame else {
            continue;
        };
        let spacing = case.result.setting.as_ref().map_or(0.0, |setting| setting.spacing);
        let Some(view) = slab::view(&slab::positions(mesh, frame), 4.0 * spacing) else {
            continue;
        };
        let file = format!("slab-{index}.png");
        let path = folder.join(&file);
        let drawing = Drawing {
            mesh,
            frame,
            spacing,
            view,
            limit,
        };
        drawing.draw(&path).map_err(|error| ReportError::Figure {
            figure: file.clone(),
            reason: error.to_string(),
        })?;
        let png = fs::read(&path).map_err(|source| ReportError::Write { path, source })?;
        pictures.push(Picture {
            file,
            title: case.name().to_owned(),
            caption: caption(case, frame),
            png,
        });
    }
    Ok(Gallery { pictures, limit })
}

/// Whether a report may have drawn a file of this name.
pub fn is_of_a_report(name: &str) -> bool {
    let number = name.strip_prefix("slab-").and_then(|rest| rest.strip_suffix(".png"));
    number.is_some_and(numbers::is_index)
}

fn caption(case: &Analysed, frame: &Frame) -> String {
    let strain = numbers::significant(frame.strain * PERCENT, 3);
    let time = numbers::significant(frame.time, 3);
    let sizes = case.result.setting.as_ref().map_or(String::new(), |setting| {
        let (nodes, atoms) = (numbers::count(setting.nodes), numbers::count(setting.represented_atoms));
        format!(" {nodes} nodes stand for {atoms} atoms.")
    });
    format!("At {strain} % strain, {time} ps.{sizes}")
}

/// GPa: the largest of the cases' quantiles, rounded up to a simple number.
fn scale_limit<'a>(frames: impl Iterator<Item = &'a Frame>) -> f64 {
    let quantile = |frame: &Frame| {
        let mut stress: Vec<f64> = frame.stress.iter().map(|cell| (cell[1] * GIGAPASCAL).abs()).collect();
        stress.retain(|value| value.is_finite());
        stress.sort_by(f64::total_cmp);
        stress
            .get((QUANTILE * stress.len().saturating_sub(1) as f64) as usize)
            .copied()
    };
    let top = frames.filter_map(quantile).fold(0.0, f64::max);
    if top <= 0.0 {
        return 1.0;
    }
    let power = 10f64.powf(top.log10().floor());
    let steps = [1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    numbers::round_significant(
        power * steps.into_iter().find(|step| step * power >= top).unwrap_or(10.0),
        2,
    )
}

struct Drawing<'a> {
    mesh: &'a FieldMesh,
    frame: &'a Frame,
    spacing: f64,
    view: View,
    limit: f64,
}

impl Drawing<'_> {
    fn draw(&self, path: &Path) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        prepare_fonts();
        let View { x, y } = self.view;
        let inner = WIDTH - EDGE - LEFT - RIGHT;
        let height = (f64::from(inner) * (y[1] - y[0]) / (x[1] - x[0])).clamp(60.0, TALLEST) as u32;
        let root = BitMapBackend::new(path, (WIDTH, height + TOP + BOTTOM)).into_drawing_area();
        root.fill(&WHITE)?;
        let font = ("sans-serif", TEXT).into_font().color(&INK);
        let mut chart = ChartBuilder::on(&root)
            .margin_left(EDGE)
            .margin_top(TOP)
            .margin_right(RIGHT)
            .x_label_area_size(BOTTOM)
            .y_label_area_size(LEFT)
            .build_cartesian_2d(x[0]..x[1], y[0]..y[1])?;
        let (wide, high) = chart.plotting_area().dim_in_pixel();
        let size = [wide as usize, high as usize];
        let pixels = slab::paint(self.mesh, self.frame, self.spacing, self.view, self.limit, size);
        let picture = BitMapElement::with_owned_buffer((x[0], y[1]), (wide, high), pixels);
        chart.draw_series([picture.ok_or("the raster does not fit the picture")?])?;
        chart
            .configure_mesh()
            .disable_mesh()
            .x_labels(8)
            .y_labels(5)
            .set_all_tick_mark_size(8)
            .axis_style(INK.stroke_width(2))
            .label_style(font.clone())
            .axis_desc_style(font)
            .x_label_formatter(&|value| numbers::tick(*value))
            .y_label_formatter(&|value| numbers::tick(*value))
            .x_desc("x from the left edge (nm)")
            .y_desc("y (nm)")
            .draw()?;
        self.draw_scale(&root, height as i32)?;
        root.present()?;
        Ok(())
    }

    /// The colour bar, right of the picture and as high as it.
    fn draw_scale(
        &self,
        root: &DrawingArea<BitMapBackend, plotters::coord::Shift>,
        height: i32,
    ) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        let font = ("sans-serif", TEXT).into_font().color(&INK);
        let (left, right, top) = ((WIDTH - RIGHT) as i32 + 28, (WIDTH - RIGHT) as i32 + 60, TOP as i32);
        let (from, to) = (top + 52, top + height - TEXT / 2);
        for row in from..to {
            let share = 1.0 - 2.0 * f64::from(row - from) / f64::from((to - from - 1).max(1));
            let [red, green, blue] = palette::stress(share);
            root.draw(&PathElement::new(
                [(left, row), (right, row)],
                RGBColor(red, green, blue),
            ))?;
        }
        root.draw(&Text::new("σyy (GPa)", (left - 6, top - 2), font.clone()))?;
        let centred = font.pos(Pos::new(HPos::Left, VPos::Center));
        for share in [-1.0, -0.5, 0.0, 0.5, 1.0] {
            let row = to - 1 - (f64::from(to - from - 1) * (0.5 + 0.5 * share)) as i32;
            root.draw(&PathElement::new([(right, row), (right + 7, row)], INK.stroke_width(2)))?;
            root.draw(&Text::new(
                numbers::tick(share * self.limit),
                (right + 14, row),
                centred.clone(),
            ))?;
        }
        Ok(())
    }
}
