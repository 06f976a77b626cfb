//! Pictures of the slabs: how they end, how they branch, and one of them through time.

pub mod animation;
pub mod drawing;
pub mod indexed;
mod margins;
mod path;
pub mod scale;
pub mod shade;

use std::path::Path;

use rayon::prelude::*;

use super::film::Film;
use super::refined::is_refined;
use super::slab;
use super::units::PERCENT;
use super::{Analysed, ReportError, numbers, save};
use crate::plan::Stages;
use crate::record::frames::Frame;
use drawing::Drawing;
use shade::Shade;

/// Room around a slab, spacings.
const MARGIN: f64 = 4.0;

/// A picture and what it shows.
pub struct Picture {
    pub file: String,
    pub title: String,
    pub caption: String,
    pub png: Vec<u8>,
}

/// Pictures on one colour scale.
pub struct Gallery {
    pub title: String,
    pub lead: String,
    pub pictures: Vec<Picture>,
}

/// A frame of a case that is to be drawn.
struct Wanted<'a> {
    case: &'a Analysed<'a>,
    film: &'a Film,
    frame: usize,
    file: String,
    title: String,
}

/// All that a study asks for: how every case ends; with `report.stages` some at its strains, the first of them in motion,
/// and all that branch where they do.
pub fn draw_all(cases: &[Analysed], stages: Option<&Stages>, folder: &Path) -> Result<Vec<Gallery>, ReportError> {
    let mut galleries = Vec::new();
    if let Some(stages) = stages {
        let title = format!("{} through time", stages.cases.join(", "));
        let mut gallery = gallery(title, &stage_frames(cases, stages), Shade::Stress, folder)?;
        gallery.pictures.extend(animation::draw(cases, stages, folder)?);
        galleries.push(gallery);
        let title = "At the first branch".to_owned();
        galleries.push(self::gallery(title, &branching(cases), Shade::Speed, folder)?);
    }
    galleries.push(gallery(
        match cases.iter().any(Analysed::has_crack) {
            true => "The broken slabs",
            false => "The slabs at the end",
        }
        .to_owned(),
        &endings(cases),
        Shade::Stress,
        folder,
    )?);
    let title = "Where elements became atoms".to_owned();
    galleries.push(gallery(title, &refined_meshes(cases), Shade::Size, folder)?);
    galleries.push(path::gallery(cases, folder)?);
    galleries.retain(|gallery| !gallery.pictures.is_empty());
    Ok(galleries)
}

/// Whether a report may have drawn a file of this name.
pub fn is_of_a_report(name: &str) -> bool {
    let kinds = ["slab-", "stage-", "branch-", "path-", "mesh-"];
    kinds.iter().any(|kind| name.starts_with(kind)) && name.ends_with(".png") || name == animation::FILE
}

fn with_film<'a>(cases: &'a [Analysed<'a>]) -> impl Iterator<Item = (&'a Analysed<'a>, &'a Film)> {
    cases.iter().filter_map(|case| Some((case, case.result.film.as_ref()?)))
}

fn endings<'a>(cases: &'a [Analysed<'a>]) -> Vec<Wanted<'a>> {
    let ending = |(case, film): (&'a Analysed<'a>, &'a Film)| {
        Some(Wanted {
            case,
            film,
            frame: film.moments().len().checked_sub(1)?,
            file: format!("slab-{}.png", case.file_part()),
            title: case.name().to_owned(),
        })
    };
    with_film(cases).filter_map(ending).collect()
}

/// The meshes of cases whose elements become atoms: when the crack starts, and at the end.
fn refined_meshes<'a>(cases: &'a [Analysed<'a>]) -> Vec<Wanted<'a>> {
    let refined = with_film(cases).filter(|(case, _)| is_refined(case));
    let moments = refined.flat_map(|(case, film)| {
        let start = case.findings.initiation.map(|start| start.time);
        let at_start = start.and_then(|start| Some((film.nearest(start, |(time, _)| time)?, "at the start")));
        let last = film.moments().len().checked_sub(1);
        let moments = at_start.into_iter().chain(last.map(|last| (last, "at the end")));
        moments.map(move |moment| (case, film, moment))
    });
    let wanted = |(case, film, (frame, when)): (&'a Analysed<'a>, &'a Film, (usize, &str))| Wanted {
        case,
        film,
        frame,
        file: format!("mesh-{}-{frame}.png", case.file_part()),
        title: format!("{} {when}", case.name()),
    };
    moments.map(wanted).collect()
}

fn branching<'a>(cases: &'a [Analysed<'a>]) -> Vec<Wanted<'a>> {
    let fork = |(case, film): (&'a Analysed<'a>, &'a Film)| {
        let branch = case.findings.first_branch()?;
        Some(Wanted {
            case,
            film,
            frame: film.nearest(branch.time, |(time, _)| time)?,
            file: format!("branch-{}.png", case.file_part()),
            title: case.name().to_owned(),
        })
    };
    with_film(cases).filter_map(fork).collect()
}

/// The cases one after the other, each through all its strains.
fn stage_frames<'a>(cases: &'a [Analysed<'a>], stages: &Stages) -> Vec<Wanted<'a>> {
    let named = |name: &String| with_film(cases).find(|(case, _)| case.name() == name);
    let shown = stages.cases.iter().filter_map(named);
    let moments = shown.flat_map(|(case, film)| stages.strains.iter().map(move |strain| (case, film, *strain)));
    let percent = |strain: f64| numbers::significant(strain * PERCENT, 3);
    let wanted = |(case, film, strain): (&'a Analysed<'a>, &'a Film, f64)| {
        Some(Wanted {
            case,
            film,
            frame: film.nearest(strain, |(_, strain)| strain)?,
            file: format!("stage-{}-{}percent.png", case.file_part(), percent(strain)),
            title: format!("{} at {} %", case.name(), percent(strain)),
        })
    };
    moments.filter_map(wanted).collect()
}

/// Draws pictures on one scale.
fn gallery(title: String, wanted: &[Wanted], shade: Shade, folder: &Path) -> Result<Gallery, ReportError> {
    let quantile = |picture: &Wanted| {
        let frame = picture.frame()?;
        Ok(shade.quantile(picture.film.cells(&frame), &frame))
    };
    let tops: Vec<Result<f64, ReportError>> = wanted.par_iter().map(quantile).collect();
    let top = tops
        .into_iter()
        .try_fold(0.0, |top, next| Ok::<_, ReportError>(f64::max(top, next?)))?;
    let limit = shade::scale_end(top);
    let pictures: Vec<_> = wanted
        .par_iter()
        .map(|picture| picture.draw(shade, limit, folder))
        .collect();
    let pictures = pictures
        .into_iter()
        .filter_map(Result::transpose)
        .collect::<Result<_, _>>()?;
    let end = numbers::tick(limit);
    let lead = match shade {
        Shade::Stress => {
            let direction = match wanted.iter().any(|picture| picture.case.has_crack()) {
                true => "across the crack plane",
                false => "in the direction of the pull",
            };
            format!(
                "Displacements to scale. Colour is the virial stress σyy {direction}, on the same scale in all pictures (beyond \
                 ±{end} GPa the end colours); black is empty space, grey are the grips."
            )
        }
        Shade::Size => {
            "Displacements to scale. Colour is the number of atoms per edge of an element: dark are single atoms, black is \
                        empty space. At the start: the picture taken nearest to it."
                .to_owned()
        }
        Shade::Speed => format!(
            "The pictures taken nearest to the moments at which the cracks first branch. Colour is the speed of the \
             particles, on the same scale in all pictures (beyond {end} m/s the end colour), so that waves show."
        ),
    };
    Ok(Gallery { title, lead, pictures })
}

impl Wanted<'_> {
    fn frame(&self) -> Result<Frame, ReportError> {
        Ok(self.film.frame(self.frame)?)
    }

    /// `None` where there is nothing to be seen.
    fn draw(&self, shade: Shade, limit: f64, folder: &Path) -> Result<Option<Picture>, ReportError> {
        let frame = &self.frame()?;
        let mesh = self.film.cells(frame);
        let setting = self.case.result.setting.as_ref();
        let [spacing, height] = setting.map_or([0.0, f64::INFINITY], |setting| [setting.spacing, setting.height]);
        let Some(view) = slab::view(&slab::positions(mesh, frame), MARGIN * spacing) else {
            return Ok(None);
        };
        let drawing = Drawing {
            mesh,
            frame,
            spacing,
            height,
            view,
            shade,
            limit,
        };
        let png = drawing.draw(&self.file).map_err(|error| ReportError::Figure {
            figure: self.file.clone(),
            reason: error.to_string(),
        })?;
        save(&folder.join(&self.file), &png)?;
        Ok(Some(Picture {
            file: self.file.clone(),
            title: self.title.clone(),
            caption: self.caption(frame.time, frame.strain),
            png,
        }))
    }

    fn caption(&self, time: f64, strain: f64) -> String {
        let [strain, time] = [strain * PERCENT, time].map(|value| numbers::significant(value, 3));
        let after = self.case.findings.initiation.map_or(String::new(), |start| {
            let after = self.film.moments()[self.frame].0 - start.time;
            let when = if after < 0.0 { "before" } else { "after" };
            format!(", {} ps {when} the crack starts", numbers::significant(after.abs(), 3))
        });
        let sizes = self.case.result.setting.as_ref().map_or(String::new(), |setting| {
            let (nodes, atoms) = (numbers::count(setting.nodes), numbers::count(setting.represented_atoms));
            format!(" {nodes} nodes stand for {atoms} atoms.")
        });
        format!("At {strain} % strain, {time} ps{after}.{sizes}")
    }
}
