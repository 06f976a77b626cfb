//! All pictures of one case, one after the other: an animated PNG, which browsers show as they are.

use std::path::Path;

use super::raster::{DARKEST, Raster};
use super::view::View;
use super::{ATOM, MARGIN, Solid, places, quantile, scale, values};
use crate::report::picture::Picture;
use crate::report::picture::indexed::Palette;
use crate::report::picture::shade::scale_end;
use crate::report::solid::Analysed;
use crate::report::{ReportError, numbers, save};

pub const FILE: &str = "motion.png";

const WIDTH: usize = 480;
const TALLEST: usize = 480;
const PICTURES_A_SECOND: u16 = 8;

/// The first of the cases that has more pictures than one, aslant.
pub fn draw(filmed: &[(&Analysed, &Solid)], folder: &Path) -> Result<Option<Picture>, ReportError> {
    let Some(&(case, film)) = filmed.iter().find(|(_, film)| film.moments().len() > 1) else {
        return Ok(None);
    };
    let moments = film.moments();
    let mesh = &film.mesh;
    let last = film.frame(moments.len() - 1)?;
    let spacing = case.solid.specimen.spacing;
    let view = View::aslant(&mesh.points, &places(mesh, &last), MARGIN * spacing);
    let [across, up] = view.ranges.each_ref().map(|range| range.end - range.start);
    let height = (WIDTH as f64 * up / across) as usize;
    let size = [WIDTH, height.clamp(20, TALLEST)];
    let limit = scale_end(quantile(&values(case, mesh, &last)));
    let scale = scale(case, limit);
    let paint = |number: usize| {
        let frame = film.frame(number)?;
        let values = values(case, mesh, &frame).into_iter();
        let colours: Vec<Option<[u8; 3]>> = values.map(|value| Some(scale.colour_of(value))).collect();
        let mut raster = Raster::new(&view, size);
        raster.paint(mesh, &places(mesh, &frame), &colours, ATOM * spacing);
        Ok(raster.pixels())
    };
    let mut pictures = (0..moments.len()).map(paint);
    let png = Palette::shaded(&scale, DARKEST).encode(FILE, size, PICTURES_A_SECOND, &mut pictures)?;
    save(&folder.join(FILE), &png)?;
    let [from, to] = [moments[0].0, last.time].map(|time| numbers::significant(time, 3));
    Ok(Some(Picture {
        file: FILE.to_owned(),
        title: format!("{} in motion", case.name()),
        caption: format!("{} pictures from {from} to {to} ps.", moments.len()),
        png,
    }))
}
