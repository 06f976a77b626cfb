//! One picture of a slab, with axes and a colour scale.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::indexed::Palette;
use super::shade::Shade;
use crate::record::frames::{FieldMesh, Frame};
use crate::report::chart::prepare_fonts;
use crate::report::numbers;
use crate::report::slab::{self, View};

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

/// One frame, ready to be drawn.
pub struct Drawing<'a> {
    pub mesh: &'a FieldMesh,
    pub frame: &'a Frame,
    pub spacing: f64,
    /// Height between the grips, nm.
    pub height: f64,
    pub view: View,
    pub shade: Shade,
    /// What the end colours stand for, in the unit of the shade.
    pub limit: f64,
}

impl Drawing<'_> {
    /// The bytes of its file.
    pub fn draw(&self, figure: &str) -> Result<Vec<u8>, Box<dyn std::error::Error + Send + Sync>> {
        prepare_fonts();
        let View { x, y } = self.view;
        let inner = WIDTH - EDGE - LEFT - RIGHT;
        let height = (f64::from(inner) * (y[1] - y[0]) / (x[1] - x[0])).clamp(60.0, TALLEST) as u32;
        let size = (WIDTH, height + TOP + BOTTOM);
        let mut picture = vec![0; 3 * (size.0 * size.1) as usize];
        self.draw_on(
            &BitMapBackend::with_buffer(&mut picture, size).into_drawing_area(),
            height,
        )?;
        let mut pictures = [Ok(picture)].into_iter();
        let size = [size.0, size.1].map(|side| side as usize);
        Ok(Palette::of(self.shade).encode(figure, size, 1, &mut pictures)?)
    }

    fn draw_on(
        &self,
        root: &DrawingArea<BitMapBackend, plotters::coord::Shift>,
        height: u32,
    ) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        let View { x, y } = self.view;
        root.fill(&WHITE)?;
        let font = ("sans-serif", TEXT).into_font().color(&INK);
        let mut chart = ChartBuilder::on(root)
            .margin_left(EDGE)
            .margin_top(TOP)
            .margin_right(RIGHT)
            .x_label_area_size(BOTTOM)
            .y_label_area_size(LEFT)
            .build_cartesian_2d(x[0]..x[1], y[0]..y[1])?;
        let (wide, high) = chart.plotting_area().dim_in_pixel();
        let size = [wide as usize, high as usize];
        let colours = self
            .shade
            .colours_between_grips(self.mesh, self.frame, self.limit, self.height);
        let pixels = slab::paint(self.mesh, self.frame, self.spacing, self.view, &colours, size);
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
        self.draw_scale(root, height as i32)?;
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
            let share = 1.0 - f64::from(row - from) / f64::from((to - from - 1).max(1));
            let [red, green, blue] = self.shade.colour(self.shade.low() + (1.0 - self.shade.low()) * share);
            root.draw(&PathElement::new(
                [(left, row), (right, row)],
                RGBColor(red, green, blue),
            ))?;
        }
        root.draw(&Text::new(self.shade.label(), (left - 6, top - 2), font.clone()))?;
        let centred = font.pos(Pos::new(HPos::Left, VPos::Center));
        for place in [0.0, 0.25, 0.5, 0.75, 1.0] {
            let share = self.shade.low() + (1.0 - self.shade.low()) * place;
            let row = to - 1 - (f64::from(to - from - 1) * place) as i32;
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
