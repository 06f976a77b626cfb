//! All pictures of one case, one after the other: an animated PNG, which browsers show as they are.

use std::path::Path;

use rayon::prelude::*;

use super::indexed::Palette;
use super::shade::{Shade, scale_end};
use super::{MARGIN, Picture};
use crate::plan::Stages;
use crate::report::film::Film;
use crate::report::slab;
use crate::report::units::PERCENT;
use crate::report::{Analysed, ReportError, numbers, save};

pub const FILE: &str = "motion.png";

const WIDTH: usize = 400;
const TALLEST: usize = 400;
const PICTURES_A_SECOND: u16 = 10;

/// The first case of the stages in motion; `None` where it has fewer than two pictures.
pub fn draw(cases: &[Analysed], stages: &Stages, folder: &Path) -> Result<Option<Picture>, ReportError> {
    let case = cases
        .iter()
        .find(|case| Some(case.name()) == stages.cases.first().map(String::as_str));
    let Some((case, film)) = case.and_then(|case| Some((case, case.result.film.as_ref()?))) else {
        return Ok(None);
    };
    let moments = film.moments();
    let [Some(first), Some(last)] = [moments.first(), moments.last()] else {
        return Ok(None);
    };
    let spacing = case.result.setting.as_ref().map_or(0.0, |setting| setting.spacing);
    let Some(strip) = Strip::of(film, spacing)? else {
        return Ok(None);
    };
    let png = strip.encode(film, spacing)?;
    save(&folder.join(FILE), &png)?;
    let strain = |moment: &(f64, f64)| numbers::significant(moment.1 * PERCENT, 3);
    Ok(Some(Picture {
        file: FILE.to_owned(),
        title: format!("{} in motion", case.name()),
        caption: format!(
            "{} pictures from {} to {} % strain; colour is the speed of the particles, to {} m/s.",
            moments.len(),
            strain(first),
            strain(last),
            numbers::tick(strip.limit)
        ),
        png,
    }))
}

/// What all pictures have in common.
struct Strip {
    view: slab::View,
    size: [usize; 2],
    limit: f64,
}

impl Strip {
    fn of(film: &Film, spacing: f64) -> Result<Option<Strip>, ReportError> {
        let count = film.moments().len();
        if count < 2 {
            return Ok(None);
        }
        let last = film.frame(count - 1)?;
        let Some(view) = slab::view(&slab::positions(film.cells(&last), &last), MARGIN * spacing) else {
            return Ok(None);
        };
        let height = WIDTH as f64 * (view.y[1] - view.y[0]) / (view.x[1] - view.x[0]);
        let limit = scale_end(Shade::Speed.quantile(film.cells(&last), &last));
        Ok(Some(Strip {
            view,
            size: [WIDTH, (height as usize).clamp(20, TALLEST)],
            limit,
        }))
    }

    /// The bytes of its file.
    fn encode(&self, film: &Film, spacing: f64) -> Result<Vec<u8>, ReportError> {
        let paint = |index: usize| {
            let frame = film.frame(index)?;
            let colours = Shade::Speed.colours(film.cells(&frame), &frame, self.limit);
            let empty = Shade::Speed.empty();
            Ok(slab::paint(
                film.cells(&frame),
                &frame,
                spacing,
                self.view,
                &colours,
                empty,
                self.size,
            ))
        };
        let pictures: Vec<_> = (0..film.moments().len()).into_par_iter().map(paint).collect();
        Palette::of(&Shade::Speed.scale(self.limit)).encode(
            FILE,
            self.size,
            PICTURES_A_SECOND,
            &mut pictures.into_iter(),
        )
    }
}
