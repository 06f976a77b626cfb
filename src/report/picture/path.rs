//! Where bonds broke: every broken bond of a case at its place in the reference configuration, coloured by the strain at
//! which it broke.

use std::path::Path;

use plotters::prelude::*;
use rayon::prelude::*;

use super::drawing::Canvas;
use super::margins::INK;
use super::scale::Scale;
use super::{Gallery, Picture};
use crate::analysis::path::{BrokenBond, broken_bonds};
use crate::analysis::series::Setting;
use crate::report::units::PERCENT;
use crate::report::{Analysed, ReportError, numbers, palette, save};

/// Radius of a bond, and of the ring where the crack leaves its plane, pixels.
const BOND: i32 = 3;
const RING: i32 = 18;

/// The paths of all cases whose bonds broke.
pub fn gallery(cases: &[Analysed], folder: &Path) -> Result<Gallery, ReportError> {
    let pictures: Vec<_> = cases.par_iter().map(|case| picture(case, folder)).collect();
    let pictures = pictures
        .into_iter()
        .filter_map(Result::transpose)
        .collect::<Result<_, _>>()?;
    Ok(Gallery {
        title: "Where bonds broke".to_owned(),
        lead: "Every broken bond at its place before the loading, coloured by the strain at which it broke; each picture has \
               its own scale. The black line is the notch. A ring marks where the crack left its plane. The numbers are in \
               the table path."
            .to_owned(),
        pictures,
    })
}

fn picture(case: &Analysed, folder: &Path) -> Result<Option<Picture>, ReportError> {
    let Some(setting) = case.result.setting.as_ref() else {
        return Ok(None);
    };
    let bonds = broken_bonds(&case.result.series, setting);
    let (Some(first), Some(last)) = (bonds.first(), bonds.last()) else {
        return Ok(None);
    };
    let file = format!("path-{}.png", case.file_part());
    let leaves = case.findings.leaves_plane.map(|leaves| (leaves.x, leaves.y));
    let png = draw(&file, &bonds, setting, leaves).map_err(|error| ReportError::Figure {
        figure: file.clone(),
        reason: error.to_string(),
    })?;
    save(&folder.join(&file), &png)?;
    let percent = |bond: &BrokenBond| numbers::significant(bond.strain * PERCENT, 3);
    let left = case.findings.leaves_plane.map_or(String::new(), |leaves| {
        let strain = numbers::significant(leaves.strain * PERCENT, 3);
        format!(" The crack leaves its plane at {strain} % strain.")
    });
    Ok(Some(Picture {
        file,
        title: case.name().to_owned(),
        caption: format!(
            "{} bonds broke from {} to {} % strain.{left}",
            numbers::count(bonds.len() as u64),
            percent(first),
            percent(last)
        ),
        png,
    }))
}

/// The bytes of the file.
fn draw(
    figure: &str,
    bonds: &[BrokenBond],
    setting: &Setting,
    leaves: Option<(f64, f64)>,
) -> Result<Vec<u8>, Box<dyn std::error::Error + Send + Sync>> {
    let strains = || bonds.iter().map(|bond| bond.strain * PERCENT);
    let scale = Scale {
        label: "strain (%)",
        ends: [
            strains().fold(f64::INFINITY, f64::min),
            strains().fold(f64::NEG_INFINITY, f64::max),
        ],
        colour: palette::moment,
    };
    let half = 0.5 * setting.height;
    Canvas::new([0.0..setting.length, -half..half]).draw(figure, &scale, |chart, _| {
        let notch = setting.notch().map(|x| (x, 0.0));
        chart.draw_series([PathElement::new(notch, INK.stroke_width(8))])?;
        let mark = |bond: &BrokenBond| {
            let [red, green, blue] = scale.colour_of(bond.strain * PERCENT);
            Circle::new((bond.x, bond.y), BOND, RGBColor(red, green, blue).filled())
        };
        chart.draw_series(bonds.iter().map(mark))?;
        chart.draw_series(leaves.map(|place| Circle::new(place, RING, INK.stroke_width(5))))?;
        Ok(())
    })
}
