//! All pictures of one case, one after the other: an animated PNG, which browsers show as they are.

use std::fs;
use std::io::BufWriter;
use std::path::Path;

use super::shade::{Shade, scale_end};
use super::{MARGIN, Picture, read};
use crate::plan::Stages;
use crate::report::film::Film;
use crate::report::slab;
use crate::report::units::PERCENT;
use crate::report::{Analysed, ReportError, numbers};

pub const FILE: &str = "motion.png";

const WIDTH: usize = 480;
const TALLEST: usize = 480;
const PICTURES_A_SECOND: u16 = 10;

/// Colours of the scale; white is one more.
const COLOURS: usize = 63;

/// The case of the stages in motion; `None` where it has fewer than two pictures.
pub fn draw(cases: &[Analysed], stages: &Stages, folder: &Path) -> Result<Option<Picture>, ReportError> {
    let case = cases.iter().find(|case| case.name() == stages.case);
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
    let path = folder.join(FILE);
    strip.write(film, spacing, &path)?;
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
        png: fs::read(&path).map_err(|source| ReportError::Write { path, source })?,
    }))
}

/// What all pictures have in common.
struct Strip {
    view: slab::View,
    size: [usize; 2],
    limit: f64,
    palette: Vec<[u8; 3]>,
}

impl Strip {
    fn of(film: &Film, spacing: f64) -> Result<Option<Strip>, ReportError> {
        let count = film.moments().len();
        if count < 2 {
            return Ok(None);
        }
        let last = read(film, count - 1, FILE)?;
        let Some(view) = slab::view(&slab::positions(&film.mesh, &last), MARGIN * spacing) else {
            return Ok(None);
        };
        let height = WIDTH as f64 * (view.y[1] - view.y[0]) / (view.x[1] - view.x[0]);
        let limit = scale_end(Shade::Speed.quantile(&film.mesh, &last));
        let scale = (0..COLOURS).map(|step| Shade::Speed.colour(step as f64 / (COLOURS - 1) as f64));
        Ok(Some(Strip {
            view,
            size: [WIDTH, (height as usize).clamp(20, TALLEST)],
            limit,
            palette: scale.chain([[255; 3]]).collect(),
        }))
    }

    fn write(&self, film: &Film, spacing: f64, path: &Path) -> Result<(), ReportError> {
        let count = film.moments().len();
        let failed = |error: png::EncodingError| ReportError::Figure {
            figure: FILE.to_owned(),
            reason: error.to_string(),
        };
        let file = fs::File::create(path).map_err(|source| ReportError::Write {
            path: path.to_owned(),
            source,
        })?;
        let [width, height] = self.size.map(|pixels| pixels as u32);
        let mut encoder = png::Encoder::new(BufWriter::new(file), width, height);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_palette(self.palette.as_flattened());
        encoder.set_compression(png::Compression::Best);
        encoder.set_animated(count as u32, 0).map_err(failed)?;
        encoder.set_frame_delay(1, PICTURES_A_SECOND).map_err(failed)?;
        let mut writer = encoder.write_header().map_err(failed)?;
        for index in 0..count {
            let frame = read(film, index, FILE)?;
            let colours = Shade::Speed.colours(&film.mesh, &frame, self.limit);
            let pixels = slab::paint(&film.mesh, &frame, spacing, self.view, &colours, self.size);
            writer.write_image_data(&self.indexed(&pixels)).map_err(failed)?;
        }
        writer.finish().map_err(failed)
    }

    /// The nearest colour of the palette for every pixel.
    fn indexed(&self, pixels: &[u8]) -> Vec<u8> {
        let mut last = ([255; 3], self.palette.len() as u8 - 1);
        let nearest = |pixel: [u8; 3]| {
            let off = |colour: &[u8; 3]| {
                let tones = colour.iter().zip(pixel);
                tones.map(|(&a, b)| (i32::from(a) - i32::from(b)).pow(2)).sum::<i32>()
            };
            (0..self.palette.len()).min_by_key(|&index| off(&self.palette[index]))
        };
        let index = |pixel: &[u8]| {
            let pixel = [pixel[0], pixel[1], pixel[2]];
            if pixel != last.0 {
                last = (pixel, nearest(pixel).unwrap_or_default() as u8);
            }
            last.1
        };
        pixels.chunks_exact(3).map(index).collect()
    }
}
