//! Pictures of solids: their cells as they stand, the nearer before the farther.

mod motion;
mod raster;
mod view;

use std::path::Path;

use super::Analysed;
use super::series::along;
use crate::analysis::crack_surface::front::Directions;
use crate::mesh::solid::Solid as Mesh;
use crate::record::frames::{FieldMesh, Frame};
use crate::report::picture::drawing::Canvas;
use crate::report::picture::scale::Scale;
use crate::report::picture::shade::scale_end;
use crate::report::picture::{Gallery, Picture};
use crate::report::units::{GIGAPASCAL, PERCENT};
use crate::report::{Film, ReportError, numbers, palette, save};
use plotters::prelude::BitMapElement;
use raster::{DARKEST, Raster};
use view::{View, is_plate};

/// The scale ends at this quantile, so that a few torn cells do not darken all the rest.
const QUANTILE: f64 = 0.99;

/// Room around a solid, and the radius of an atom, spacings.
const MARGIN: f64 = 4.0;
const ATOM: f64 = 0.5;

/// Whether a report may have drawn a file of this name.
pub fn is_of_a_report(name: &str) -> bool {
    let kinds = ["solid-", "first-break-", "aslant-", "section-", "surface-"];
    kinds.iter().any(|start| name.starts_with(start)) && name.ends_with(".png") || name == motion::FILE
}

type Solid = Film<[f64; 3]>;

/// How much of a solid is shown, and from where.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shown {
    /// All of it, along its shortest side.
    FromAbove,
    Aslant,
    /// What is behind the middle of its width, aslant.
    Section,
    /// What is below the plane of the notch, aslant.
    BelowNotch,
}

impl Shown {
    fn is_whole(self) -> bool {
        matches!(self, Self::FromAbove | Self::Aslant)
    }
}

/// A frame of a case that is to be drawn.
struct Wanted<'a> {
    case: &'a Analysed<'a>,
    film: &'a Solid,
    frame: usize,
    shown: Shown,
    file: String,
}

/// The solids when their first bond breaks and at their end, one of them in motion, and blocks cut open.
pub fn galleries(cases: &[Analysed], folder: &Path) -> Result<Vec<Gallery>, ReportError> {
    let filmed = cases.iter().filter_map(|case| Some((case, case.solid.film.as_ref()?)));
    let filmed: Vec<(&Analysed, &Solid)> = filmed.collect();
    let first = filmed.iter().filter_map(|&(case, film)| {
        let time = case.findings.first_break?.time;
        let frame = film.nearest(time, |(time, _)| time)?;
        Some(wanted(case, film, frame, Shown::FromAbove, "first-break"))
    });
    let at_end = |shown: Shown, kind: &str| -> Vec<Wanted> {
        let is_block = |film: &Solid| !is_plate(&film.mesh.points);
        let shows = filmed.iter().filter(|(_, film)| shown.is_whole() || is_block(film));
        let at_end = shows.filter_map(|&(case, film)| {
            let last = film.moments().len().checked_sub(1)?;
            Some(wanted(case, film, last, shown, kind))
        });
        at_end.collect()
    };
    let galleries = [
        ("When bonds first change", first.collect::<Vec<_>>()),
        ("The solids at the end", at_end(Shown::FromAbove, "solid")),
        ("At the end, seen aslant", at_end(Shown::Aslant, "aslant")),
        ("At the end, cut through the middle", at_end(Shown::Section, "section")),
        (
            "At the end, what is below the plane of the notch",
            at_end(Shown::BelowNotch, "surface"),
        ),
    ];
    let drawn = galleries
        .into_iter()
        .map(|(title, wanted)| gallery(title, &wanted, folder));
    let mut drawn = drawn.collect::<Result<Vec<_>, _>>()?;
    if let Some(gallery) = drawn.get_mut(2) {
        gallery.pictures.extend(motion::draw(&filmed, folder)?);
    }
    drawn.retain(|gallery| !gallery.pictures.is_empty());
    Ok(drawn)
}

fn wanted<'a>(case: &'a Analysed<'a>, film: &'a Solid, frame: usize, shown: Shown, kind: &str) -> Wanted<'a> {
    let file = format!("{kind}-{}.png", case.file_part());
    Wanted {
        case,
        film,
        frame,
        shown,
        file,
    }
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

/// Of a case, from minus to plus a limit.
fn scale(case: &Analysed, limit: f64) -> Scale {
    Scale {
        label: if is_pulled(case) { "stress (GPa)" } else { "moved (nm)" },
        ends: [-limit, limit],
        colour: palette::stress,
    }
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
    let pictures = wanted
        .iter()
        .filter_map(|picture| picture.draw(limit, folder).transpose());
    let pictures = pictures.collect::<Result<Vec<_>, _>>()?;
    let end = numbers::tick(limit);
    let seen = match wanted.first().map(|picture| picture.shown) {
        Some(Shown::FromAbove) => "Displacements to scale, seen along the shortest side.",
        _ => "Displacements to scale, without perspective.",
    };
    let lead = match wanted.first().is_some_and(|picture| is_pulled(picture.case)) {
        true => format!(
            "{seen} Colour is the virial stress along the pull, on the same scale in all pictures (beyond ±{end} GPa the end \
             colours)."
        ),
        false => format!(
            "{seen} Colour is the displacement along the loading, on the same scale in all pictures (beyond ±{end} nm the end \
             colours)."
        ),
    };
    Ok(Gallery {
        title: title.to_owned(),
        lead,
        pictures,
    })
}

/// Where the nodes of a mesh are.
fn places(mesh: &FieldMesh<[f64; 3]>, frame: &Frame<[f64; 3]>) -> Vec<[f64; 3]> {
    let nodes = mesh.points.iter().zip(&frame.displacement);
    nodes
        .map(|(point, moved)| [0, 1, 2].map(|axis| point[axis] + moved[axis]))
        .collect()
}

impl Wanted<'_> {
    /// Of each cell whether it is shown; `None` where there is no notch that tells.
    fn cells(&self) -> Option<Vec<bool>> {
        let mesh = &self.film.mesh;
        if self.shown.is_whole() {
            return Some(vec![true; mesh.element_size.len()]);
        }
        let crystal = self.case.solid.crystal.as_ref()?;
        let directions = Directions::of(&Mesh::new(&crystal.plan))?;
        let is_shown = |ends: &[u32]| {
            let nodes = &mesh.connectivity[ends[0] as usize..ends[1] as usize];
            let sum = |axis: usize| nodes.iter().map(|&node| mesh.points[node as usize][axis]).sum::<f64>();
            let middle = [0, 1, 2].map(|axis| sum(axis) / nodes.len() as f64);
            let [_, up, along] = directions.coordinates(middle);
            match self.shown {
                Shown::BelowNotch => up < 0.0,
                // Who looks aslant at a block stands on its high side of z.
                _ => along < 0.5,
            }
        };
        Some(mesh.offsets.windows(2).map(is_shown).collect())
    }

    fn draw(&self, limit: f64, folder: &Path) -> Result<Option<Picture>, ReportError> {
        let Some(cells) = self.cells() else { return Ok(None) };
        let frame = self.film.frame(self.frame)?;
        let mesh = self.film.cells(&frame);
        let scale = scale(self.case, limit);
        let spacing = self.case.solid.specimen.spacing;
        let places = places(mesh, &frame);
        let view = match self.shown {
            Shown::FromAbove => View::from_above(&mesh.points, &places, MARGIN * spacing),
            _ => View::aslant(&mesh.points, &places, MARGIN * spacing),
        };
        let values = values(self.case, mesh, &frame).into_iter().zip(cells);
        let colours: Vec<Option<[u8; 3]>> = values
            .map(|(value, is_shown)| is_shown.then(|| scale.colour_of(value)))
            .collect();
        let failed = |error: &dyn std::fmt::Display| ReportError::Figure {
            figure: self.file.clone(),
            reason: error.to_string(),
        };
        let [across, up] = view.ranges.clone();
        let corner = (across.start, up.end);
        let canvas = Canvas::named([across, up], view.names, Some(DARKEST));
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
        Ok(Some(Picture {
            file: self.file.clone(),
            title: self.case.name().to_owned(),
            caption: format!(
                "At {time} ps, {strain} % strain. {} nodes stand for {} atoms.",
                numbers::count(specimen.nodes),
                numbers::count(specimen.atoms)
            ),
            png,
        }))
    }
}
