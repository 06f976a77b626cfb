//! Pictures with axes in nm and a colour scale above them.

use std::error::Error;
use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

use super::indexed::Palette;
use super::margins::{BOTTOM, EDGE, INK, LEFT, RIGHT, TALLEST, TEXT, TOP, WIDTH};
use super::scale::Scale;
use super::shade::Shade;
use crate::record::frames::{FieldMesh, Frame};
use crate::report::chart::prepare_fonts;
use crate::report::numbers;
use crate::report::slab::{self, View};

type Failure = Box<dyn Error + Send + Sync>;
type Axes<'a, 'b> = ChartContext<'a, BitMapBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// A part of the plane to scale, nm, with its axes.
pub struct Canvas {
    view: [Range<f64>; 2],
    /// Of its axes.
    names: [&'static str; 2],
    /// Of the part inside the axes, pixels.
    height: u32,
    /// How dark the colours of the scale may be shaded; `None` where they are not.
    darkest: Option<f64>,
}

impl Canvas {
    /// Of a slab.
    pub fn new(view: [Range<f64>; 2]) -> Self {
        Self::named(view, ["x from the left edge (nm)", "y (nm)"], None)
    }

    pub fn named(view: [Range<f64>; 2], names: [&'static str; 2], darkest: Option<f64>) -> Self {
        let inner = WIDTH - EDGE - LEFT - RIGHT;
        let [x, y] = [0, 1].map(|axis| view[axis].end - view[axis].start);
        let height = (f64::from(inner) * y / x).clamp(97.0, TALLEST) as u32;
        Self {
            view,
            names,
            height,
            darkest,
        }
    }

    /// The bytes of a file that shows what is drawn between the axes.
    pub fn draw(
        &self,
        figure: &str,
        scale: &Scale,
        content: impl FnOnce(&mut Axes, [usize; 2]) -> Result<(), Failure>,
    ) -> Result<Vec<u8>, Failure> {
        prepare_fonts();
        let size = (WIDTH, self.height + TOP + BOTTOM);
        let mut picture = vec![0; 3 * (size.0 * size.1) as usize];
        self.draw_on(
            &BitMapBackend::with_buffer(&mut picture, size).into_drawing_area(),
            scale,
            content,
        )?;
        let mut pictures = [Ok(picture)].into_iter();
        let size = [size.0, size.1].map(|side| side as usize);
        let mut palette = match self.darkest {
            Some(darkest) => Palette::shaded(scale, darkest),
            None => Palette::of(scale),
        };
        Ok(palette.encode(figure, size, 1, &mut pictures)?)
    }

    fn draw_on(
        &self,
        root: &DrawingArea<BitMapBackend, Shift>,
        scale: &Scale,
        content: impl FnOnce(&mut Axes, [usize; 2]) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        root.fill(&WHITE)?;
        let font = ("sans-serif", TEXT).into_font().color(&INK);
        let [x, y] = self.view.clone();
        let mut chart = ChartBuilder::on(root)
            .margin_left(EDGE)
            .margin_top(TOP)
            .margin_right(RIGHT)
            .x_label_area_size(BOTTOM)
            .y_label_area_size(LEFT)
            .build_cartesian_2d(x, y)?;
        let (wide, high) = chart.plotting_area().dim_in_pixel();
        content(&mut chart, [wide as usize, high as usize])?;
        chart
            .configure_mesh()
            .disable_mesh()
            .x_labels(8)
            .y_labels(5)
            .set_all_tick_mark_size(13)
            .axis_style(INK.stroke_width(3))
            .label_style(font.clone())
            .axis_desc_style(font)
            .x_label_formatter(&|value| numbers::tick(*value))
            .y_label_formatter(&|value| numbers::tick(*value))
            .x_desc(self.names[0])
            .y_desc(self.names[1])
            .draw()?;
        scale.draw(root)?;
        root.present()?;
        Ok(())
    }
}

/// One frame of a slab, ready to be drawn.
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
    pub fn draw(&self, figure: &str) -> Result<Vec<u8>, Failure> {
        let View { x, y } = self.view;
        let canvas = Canvas::new([x[0]..x[1], y[0]..y[1]]);
        canvas.draw(figure, &self.shade.scale(self.limit), |chart, size| {
            let colours = self
                .shade
                .colours_between_grips(self.mesh, self.frame, self.limit, self.height);
            let pixels = slab::paint(
                self.mesh,
                self.frame,
                self.spacing,
                self.view,
                &colours,
                self.shade.empty(),
                size,
            );
            let [wide, high] = size.map(|side| side as u32);
            let picture = BitMapElement::with_owned_buffer((x[0], y[1]), (wide, high), pixels);
            chart.draw_series([picture.ok_or("the raster does not fit the picture")?])?;
            Ok(())
        })
    }
}
