//! The roofline as a picture.

use std::path::Path;

use plotters::prelude::*;
use plotters::style::{FontStyle, register_font};

use super::{Point, Roof};

const SIZE: (u32, u32) = (800, 520);
const INK: RGBColor = RGBColor(34, 34, 34);
const FAINT: RGBColor = RGBColor(222, 222, 222);
/// After Okabe and Ito.
const ROOF: RGBColor = RGBColor(0, 114, 178);
const REACHED: RGBColor = RGBColor(213, 94, 0);

/// Flops a byte that the picture spans.
const SPAN: [f64; 2] = [0.1, 100.0];

pub fn draw(roof: &Roof, points: &[Point], path: &Path) {
    draw_on(roof, points, path).expect("the picture can be drawn");
}

fn draw_on(roof: &Roof, points: &[Point], path: &Path) -> Result<(), Box<dyn std::error::Error>> {
    register_font("sans-serif", FontStyle::Normal, dejavu::sans::regular()).map_err(|_| "the font is unusable")?;
    let root = SVGBackend::new(path, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let text = ("sans-serif", 15).into_font().color(&INK);
    let mut chart = ChartBuilder::on(&root)
        .margin(16)
        .x_label_area_size(48)
        .y_label_area_size(64)
        .build_cartesian_2d((SPAN[0]..SPAN[1]).log_scale(), (0.3..2.0 * roof.flops).log_scale())?;
    chart
        .configure_mesh()
        .x_desc("flops a byte")
        .y_desc("Gflop/s of a core")
        .label_style(text.clone())
        .bold_line_style(FAINT)
        .light_line_style(WHITE)
        .draw()?;
    for (name, bandwidth) in [("memory", roof.memory), ("cache", roof.cache)] {
        let ridge = roof.flops / bandwidth;
        let line = [SPAN[0], ridge, SPAN[1]].map(|x| (x, roof.flops.min(x * bandwidth)));
        chart.draw_series(LineSeries::new(line, ROOF.stroke_width(2)))?;
        let label = format!("{name} {bandwidth:.0} GB/s");
        let place = (1.4 * SPAN[0], SPAN[0] * bandwidth);
        chart.draw_series([Text::new(label, place, text.clone())])?;
    }
    let label = format!("multiply-adds {:.0} Gflop/s", roof.flops);
    chart.draw_series([Text::new(label, (0.2 * SPAN[1], 1.3 * roof.flops), text.clone())])?;
    for point in points {
        let place = (point.intensity, point.reached);
        chart.draw_series([Circle::new(place, 5, REACHED.filled())])?;
        let beside = (1.1 * point.intensity, 1.04 * point.reached);
        chart.draw_series([Text::new(point.name, beside, text.clone())])?;
    }
    root.present()?;
    Ok(())
}
