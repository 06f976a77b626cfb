//! Cracks and slip of a solid, picture by picture.

use super::Solid;
use super::specimen::Crystal;
use crate::analysis::crack_surface::arms::{Arm, arms};
use crate::analysis::crack_surface::branches::{Branch, branches};
use crate::analysis::crack_surface::dislocated::{Counts, counts};
use crate::analysis::crack_surface::front::{Directions, front, normal_speed, roughness};
use crate::analysis::crack_surface::grown::{Root, grown};
use crate::analysis::crack_surface::{Areas, How, Joints};
use crate::mesh::solid::Solid as Mesh;
use crate::mesh::solid::bonds::Bonds;
use crate::report::{Film, ReportError};

/// Directions of branches that are looked for, from straight ahead, degrees: the traces of {111} planes in a film.
const BRANCHES: [f64; 2] = [60.0, -60.0];

/// Width of the strips in which a front is looked at, spacings.
const STRIP: f64 = 10.0;

/// What has opened and slid at one moment. Lengths in nm.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// ps
    pub time: f64,
    /// Nominal strain, where the loading prescribes one.
    pub strain: Option<f64>,
    pub areas: Areas,
    /// How far the crack has come from the notch, in strips along its front; empty without a straight notch.
    pub front: Vec<f64>,
    /// Of the front, normal to itself, since the picture before, nm/ps.
    pub speed: Option<f64>,
    /// Root of the mean square height of the surface, near its sides and in its middle.
    pub roughness: [Option<f64>; 2],
    pub branches: Vec<Branch>,
    /// Slip along the same directions.
    pub slip_bands: Vec<Branch>,
    /// Cracks from where a ball has struck.
    pub arms: Vec<Arm>,
    /// Of solids with atoms alone.
    pub atoms: Option<Counts>,
}

/// One a picture; empty where there are none.
pub fn surfaces(solid: &Solid) -> Result<Vec<Surface>, ReportError> {
    let (Some(crystal), Some(film)) = (&solid.crystal, &solid.film) else {
        return Ok(Vec::new());
    };
    let mesh = Mesh::new(&crystal.plan);
    if mesh.node_count() != film.mesh.points.len() {
        return Ok(Vec::new());
    }
    let is_driven = solid.series.as_ref().is_some_and(|series| series.is_driven);
    let mut surfaces: Vec<Surface> = Vec::new();
    let look = Look::new(crystal, &mesh);
    for frame in 0..film.moments().len() {
        let mut surface = look.at(film, frame)?;
        surface.strain = surface.strain.filter(|_| is_driven);
        if let (Some(directions), Some(before)) = (&look.directions, surfaces.last()) {
            let time = surface.time - before.time;
            surface.speed = Some(normal_speed(&before.front, &surface.front, time, directions));
        }
        surfaces.push(surface);
    }
    Ok(surfaces)
}

/// What is the same for all pictures of a case.
struct Look<'a> {
    crystal: &'a Crystal,
    mesh: &'a Mesh,
    joints: Joints<'a>,
    /// Of solids with atoms alone.
    bonds: Option<Bonds>,
    root: Root<'a>,
    directions: Option<Directions>,
}

impl<'a> Look<'a> {
    fn new(crystal: &'a Crystal, mesh: &'a Mesh) -> Self {
        Self {
            joints: Joints::new(mesh, crystal.breaking_length),
            bonds: (mesh.parts == 0).then(|| Bonds::new(mesh, &[])),
            root: Root::of(mesh),
            directions: Directions::of(mesh),
            crystal,
            mesh,
        }
    }

    fn at(&self, film: &Film<[f64; 3]>, number: usize) -> Result<Surface, ReportError> {
        let frame = film.frame(number)?;
        let place = |axis: usize| {
            let nodes = film.mesh.points.iter().zip(&frame.displacement);
            nodes.map(|(point, moved)| point[axis] + moved[axis]).collect()
        };
        let position = [0, 1, 2].map(place);
        let parted = self.joints.parted(&position);
        let is_crack = grown(&parted, &self.root, self.mesh.spacing);
        let mut surface = Surface {
            time: frame.time,
            strain: Some(frame.strain),
            areas: Areas::of(&parted, &is_crack),
            atoms: self.bonds.as_ref().map(|bonds| counts(self.mesh, bonds, &position)),
            ..Surface::default()
        };
        if let Some(directions) = &self.directions {
            let strips = (directions.width / (STRIP * self.mesh.spacing)).round().max(1.0);
            surface.front = front(&parted, &is_crack, &self.root, directions, strips as usize);
            surface.roughness = roughness(&parted, &is_crack, directions);
            surface.branches = branches(&parted, &is_crack, directions, &BRANCHES);
            let is_slip: Vec<bool> = parted.iter().map(|piece| piece.how == How::Slid).collect();
            surface.slip_bands = branches(&parted, &is_slip, directions, &BRANCHES);
        }
        if let Some([struck, normal]) = self.crystal.struck {
            surface.arms = arms(&parted, &is_crack, struck, normal);
        }
        Ok(surface)
    }
}

impl Surface {
    pub fn crack(&self) -> f64 {
        self.areas.crack.iter().sum()
    }

    pub fn slip(&self) -> f64 {
        self.areas.slip.iter().sum()
    }

    /// Mean, least and most of the front.
    pub fn front(&self) -> Option<[f64; 3]> {
        let strips = self.front.len() as f64;
        let least = self.front.iter().copied().reduce(f64::min)?;
        let most = self.front.iter().copied().reduce(f64::max)?;
        Some([self.front.iter().sum::<f64>() / strips, least, most])
    }
}

/// What keeps its direction: a branch of the crack from a notch, a band of slip, or a crack from where a ball has struck.
#[derive(Clone, Debug, PartialEq)]
pub struct Kept {
    pub kind: &'static str,
    /// When it is first seen, ps.
    pub time: f64,
    pub degrees: f64,
    /// Where a branch begins: ahead of the notch and above its plane.
    pub start: Option<[f64; 2]>,
    /// At the end.
    pub length: f64,
    /// From when it is first seen to the end, nm/ps.
    pub speed: Option<f64>,
}

/// What is looked for from a notch.
type Kind = (&'static str, fn(&Surface) -> &Vec<Branch>);
const KINDS: [Kind; 2] = [
    ("branch", |surface| &surface.branches),
    ("slip band", |surface| &surface.slip_bands),
];

/// Two sightings of a crack are within this of each other, degrees.
const SAME: f64 = 20.0;

/// What keeps its direction at the end, each with its past.
pub fn kept(surfaces: &[Surface]) -> Vec<Kept> {
    let Some(last) = surfaces.last() else { return Vec::new() };
    let [branches, slips] = KINDS.map(|(kind, of)| {
        let kept = of(last).iter().filter_map(move |branch| {
            let same = |surface: &Surface| {
                of(surface)
                    .iter()
                    .find(|other| other.degrees == branch.degrees)
                    .copied()
            };
            let (time, first) = surfaces
                .iter()
                .find_map(|surface| Some((surface.time, same(surface)?)))?;
            Some(Kept {
                kind,
                time,
                degrees: branch.degrees,
                start: Some(first.start),
                length: branch.length,
                speed: pace([time, first.length], [last.time, branch.length]),
            })
        });
        kept.collect::<Vec<_>>()
    });
    let arms = last.arms.iter().filter_map(|arm| {
        let is_same = |other: &&Arm| {
            let apart = (other.degrees - arm.degrees).rem_euclid(360.0);
            apart.min(360.0 - apart) <= SAME
        };
        let first = surfaces
            .iter()
            .find(|surface| surface.arms.iter().any(|other| is_same(&other)))?;
        let then = first.arms.iter().find(is_same)?;
        Some(Kept {
            kind: "from the ball",
            time: first.time,
            degrees: arm.degrees,
            start: None,
            length: arm.length,
            speed: pace([first.time, then.length], [last.time, arm.length]),
        })
    });
    branches.into_iter().chain(slips).chain(arms).collect()
}

fn pace([then, from]: [f64; 2], [now, to]: [f64; 2]) -> Option<f64> {
    (now > then).then(|| (to - from) / (now - then))
}
