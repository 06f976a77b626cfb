//! PNG files of few colours, which are a third as large as those of all.

use std::collections::HashMap;

use super::scale::Scale;
use crate::report::ReportError;

/// Colours of a scale, and greys from ink to paper.
const SCALE: usize = 192;
const GREYS: usize = 16;

/// Colours of a scale that is shaded, and how many shades of each.
const SHADED: usize = 48;
const SHADES: usize = 5;

/// The colours of the pictures of one scale.
pub struct Palette {
    colours: Vec<[u8; 3]>,
    known: HashMap<[u8; 3], u8>,
}

impl Palette {
    pub fn of(scale: &Scale) -> Self {
        let place = |step: usize| step as f64 / (SCALE - 1) as f64;
        let scale = (0..SCALE).map(|step| (scale.colour)(place(step)));
        let greys = (0..GREYS).map(|step| [(34 + step * 221 / (GREYS - 1)) as u8; 3]);
        Self {
            colours: scale.chain(greys).collect(),
            known: HashMap::new(),
        }
    }

    /// With shades of the colours of the scale down to this brightness, fewer of them.
    pub fn shaded(scale: &Scale, darkest: f64) -> Self {
        let tone = |number: usize| {
            let colour = (scale.colour)((number / SHADES) as f64 / (SHADED - 1) as f64);
            let bright = 1.0 - (1.0 - darkest) * (number % SHADES) as f64 / (SHADES - 1) as f64;
            colour.map(|tone| (f64::from(tone) * bright).round() as u8)
        };
        let greys = Self::of(scale).colours.split_off(SCALE);
        Self {
            colours: (0..SHADED * SHADES).map(tone).chain(greys).collect(),
            known: HashMap::new(),
        }
    }

    /// The nearest colour for every pixel.
    pub fn indexed(&mut self, pixels: &[u8]) -> Vec<u8> {
        let Self { colours, known } = self;
        let nearest = |pixel: [u8; 3]| {
            let off = |colour: &[u8; 3]| {
                let tones = colour.iter().zip(pixel);
                tones.map(|(&a, b)| (i32::from(a) - i32::from(b)).pow(2)).sum::<i32>()
            };
            let index = (0..colours.len()).min_by_key(|&index| off(&colours[index]));
            index.unwrap_or_default() as u8
        };
        let index = |pixel: &[u8]| {
            let pixel = [pixel[0], pixel[1], pixel[2]];
            *known.entry(pixel).or_insert_with(|| nearest(pixel))
        };
        pixels.chunks_exact(3).map(index).collect()
    }

    /// The bytes of a file of pictures of a size, shown one after the other at so many a second where there are several.
    pub fn encode(
        &mut self,
        figure: &str,
        [width, height]: [usize; 2],
        pace: u16,
        pictures: &mut dyn ExactSizeIterator<Item = Result<Vec<u8>, ReportError>>,
    ) -> Result<Vec<u8>, ReportError> {
        let failed = |error: png::EncodingError| ReportError::Figure {
            figure: figure.to_owned(),
            reason: error.to_string(),
        };
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width as u32, height as u32);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_palette(self.colours.as_flattened());
        encoder.set_compression(png::Compression::Best);
        if pictures.len() > 1 {
            encoder.set_animated(pictures.len() as u32, 0).map_err(failed)?;
            encoder.set_frame_delay(1, pace).map_err(failed)?;
        }
        let mut writer = encoder.write_header().map_err(failed)?;
        for pixels in pictures {
            writer.write_image_data(&self.indexed(&pixels?)).map_err(failed)?;
        }
        writer.finish().map_err(failed)?;
        Ok(bytes)
    }
}
