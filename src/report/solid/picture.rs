//! Pictures of solids: their cells as they stand, seen along the shortest side, the nearer before the farther.

mod raster;

use std::path::Path;

use super::Analysed;
use super::series::along;
use crate::record::frames::{FieldMesh, Frame};
use crate::report::picture::drawing::Canvas;
use crate::report::picture::scale::Scale;
use crate::report::picture::shade::scale_end;
use crate::report::picture::{Gallery, Picture};
use crate::report::units::{GIGAPASCAL, PERCENT};
use crate::report::{Film, ReportError, numbers, palette, save};
use plotters::prelude::BitMapElement;
use raster::{Raster, View};

/// The scale ends at this quantile, so that a few torn cells do not darken all the rest.
const QUANTILE: f64 = 0.99;

/// Room around a solid, and the radius of an atom, spacings.
const MARGIN: f64 = 4.0;
const ATOM: f64 = 0.5;

/// Whether a report may have drawn a file of this name.
pub fn is_of_a_report(name: &str) -> bool {
    ["solid-", "first-break-"].iter().any(|start| name.starts_with(start)) && name.ends_with(".png")
}

type Solid = Film<[f64; 3]>;

/// A frame of a case that is to be drawn.
struct Wanted<'a> {
    case: &'a Analysed<'a>,
    film: &'a Solid,
    frame: usize,
    file: String,
}

/// The solids when their first bond breaks, and at their end.
pub fn galleries(cases: &[Analysed], folder: &Path) -> Result<Vec<Gallery>, ReportError> {
    let filmed = cases.iter().filter_map(|case| Some((case, case.solid.film.as_ref()?)));
    let filmed: Vec<(&Analysed, &Solid)> = filmed.collect();
    let first = filmed.iter().filter_map(|&(case, film)| {
        let time = case.findings.first_break?.time;
        let frame = film.nearest(time, |(time, _)| time)?;
        let file = format!("first-break-{}.png", case.file_part());
        Some(Wanted {
            case,
            film,
            frame,
            file,
        })
    });
    let last = filmed.iter().filter_map(|&(case, film)| {
        let frame = film.moments().len().checked_sub(1)?;
        let file = format!("solid-{}.png", case.file_part());
        Some(Wanted {
            case,
            film,
            frame,
            file,
        })
    });
    let galleries = [
        ("When bonds first change", first.collect::<Vec<_>>()),
        ("The solids at the end", last.collect()),
    ];
    let drawn = galleries
        .into_iter()
        .map(|(title, wanted)| gallery(title, &wanted, folder));
    let mut drawn = drawn.collect::<Result<Vec<_>, _>>()?;
    drawn.retain(|gallery| !gallery.pictures.is_empty());
    Ok(drawn)
}

/// What the colour stands for: of solids that a face pulls the stress along the pull, of others the displacement along it.
fn values(case: &Analysed, mesh: &FieldMesh<[f64; 3]>, frame: &Frame<[f64; 3]>) -> Vec<f64> {
    let direction = case.solid.specimen.direction;
    if is_pulled(case) {
        return frame
            .stress
            .iter()
            .map(|stress| along(stress, direction) * GIGAPASCAL)
            .collect();
    }
    let moved = |ends: &[u32]| {
        let nodes = &mesh.connectivity[ends[0] as usize..ends[1] as usize];
        let of_node = |&node: &u32| {
            (0..3)
                .map(|axis| frame.displacement[node as usize][axis] * direction[axis])
                .sum::<f64>()
        };
        nodes.iter().map(of_node).sum::<f64>() / nodes.len().max(1) as f64
    };
    mesh.offsets.windows(2).map(moved).collect()
}

fn is_pulled(case: &Analysed) -> bool {
    case.series().is_some_and(|series| series.is_driven)
}

/// Below which all but a few values are.
fn quantile(values: &[f64]) -> f64 {
    let mut sizes: Vec<f64> = values
        .iter()
        .map(|value| value.abs())
        .filter(|size| size.is_finite())
        .collect();
    sizes.sort_by(f64::total_cmp);
    let place = (QUANTILE * sizes.len().saturating_sub(1) as f64) as usize;
    sizes.get(place).copied().unwrap_or(0.0)
}

/// Draws pictures on one scale.
fn gallery(title: &str, wanted: &[Wanted], folder: &Path) -> Result<Gallery, ReportError> {
    let mut top = 0.0;
    for picture in wanted {
        let frame = picture.film.frame(picture.frame)?;
        top = f64::max(top, quantile(&values(picture.case, picture.film.cells(&frame), &frame)));
    }
    let limit = scale_end(top);
    let pictures = wanted.iter().map(|picture| picture.draw(limit, folder));
    let pictures = pictures.collect::<Result<Vec<_>, _>>()?;
    let end = numbers::tick(limit);
    let lead = match wanted.first().is_some_and(|picture| is_pulled(picture.case)) {
        true => format!(
            "Displacements to scale, seen along the shortest side. Colour is the virial stress along the pull, on the same scale in \
             all pictures (beyond ±{end} GPa the end colours)."
        ),
        false => format!(
            "Displacements to scale, seen along the shortest side. Colour is the displacement along the loading, on the same scale \
             in all pictures (beyond ±{end} nm the end colours)."
        ),
    };
    Ok(Gallery {
        title: title.to_owned(),
        lead,
        pictures,
    })
}

impl Wanted<'_> {
    fn draw(&self, limit: f64, folder: &Path) -> Result<Picture, ReportError> {
        let frame = self.film.frame(self.frame)?;
        let mesh = self.film.cells(&frame);
        let scale = Scale {
            label: if is_pulled(self.case) {
                "stress (GPa)"
            } else {
                "moved (nm)"
            },
            ends: [-limit, limit],
            colour: palette::stress,
        };
        let spacing = self.case.solid.specimen.spacing;
        let places: Vec<[f64; 3]> = mesh
            .points
            .iter()
            .zip(&frame.displacement)
            .map(|(point, moved)| [0, 1, 2].map(|axis| point[axis] + moved[axis]))
            .collect();
        let view = View::of(&mesh.points, &places, MARGIN * spacing);
        let colours: Vec<[u8; 3]> = values(self.case, mesh, &frame)
            .into_iter()
            .map(|value| scale.colour_of(value))
            .collect();
        let failed = |error: &dyn std::fmt::Display| ReportError::Figure {
            figure: self.file.clone(),
            reason: error.to_string(),
        };
        let [across, up] = view.ranges.clone();
        let corner = (across.start, up.end);
        let canvas = Canvas::named([across, up], view.names());
        let png = canvas.draw(&self.file, &scale, |chart, size| {
            let mut raster = Raster::new(&view, size);
            raster.paint(mesh, &places, &colours, ATOM * spacing);
            let size = size.map(|side| side as u32);
            let picture = BitMapElement::with_owned_buffer(corner, (size[0], size[1]), raster.pixels());
            chart.draw_series([picture.ok_or("the raster does not fit the picture")?])?;
            Ok(())
        });
        let png = png.map_err(|error| failed(&error))?;
        save(&folder.join(&self.file), &png)?;
        let [strain, time] = [frame.strain * PERCENT, frame.time].map(|value| numbers::significant(value, 3));
        let specimen = &self.case.solid.specimen;
        Ok(Picture {
            file: self.file.clone(),
            title: self.case.name().to_owned(),
            caption: format!(
                "At {time} ps, {strain} % strain. {} nodes stand for {} atoms.",
                numbers::count(specimen.nodes),
                numbers::count(specimen.atoms)
            ),
            png,
        })
    }
}
