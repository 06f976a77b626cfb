//! A solid as asked for and as laid out, and its elements by kind.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};

use super::intensity::Intensity;
use super::plan::Laid;
use super::words;
use crate::material::Material;
use crate::mesh::solid::element::Shape as ElementShape;
use crate::mesh::solid::sites::Outline;
use crate::mesh::solid::{Plan, Solid as Mesh};
use crate::setup::Size;
use crate::study::case::solid::{Notch, Shape};
use crate::study::case::{Body, Case, Solid};

/// Solids with more sites than this are not meshed to be counted.
pub const MESHED: u64 = 10_000_000;

/// Elements of one shape and size.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Kind {
    /// `tetrahedron`, `octahedron` or `atom`.
    pub name: &'static str,
    /// Cells an edge of the block it is a part of; 1 for atoms.
    pub size: u32,
    pub number: u64,
    pub nodes_each: u64,
    pub sites_each: u64,
}

/// A solid as it is laid out.
#[derive(Clone, Debug, PartialEq)]
pub struct Specimen {
    /// Distance between the faces of each axis, nm, and its name.
    pub edges: [(&'static str, Size); 3],
    /// Blocks along each axis, where it is made of blocks.
    pub blocks: Option<[u32; 3]>,
    /// Blocks that are left out.
    pub slot: Option<u64>,
    /// How deep a severed plane is, and where it lies, nm.
    pub severed: Option<[Size; 2]>,
    /// Its stress intensity at rest, where a traction opens it.
    pub intensity: Option<Intensity>,
    /// The faces that do not move, in words.
    pub held: Option<String>,
    /// What loads it, in words.
    pub loading: String,
    /// Where the loading pulls, of length 1.
    pub direction: [f64; 3],
    /// Distance of nearest neighbours, nm.
    pub spacing: f64,
    /// By falling size.
    pub kinds: Vec<Kind>,
    pub nodes: u64,
    pub elements: u64,
    pub sites: u64,
    /// Share of the sites in smaller elements than asked for; `None` where nobody has laid the elements.
    pub leftover_share: Option<f64>,
    /// The first of the sizes asked for that no element has.
    pub absent: Option<u32>,
    /// Equal for cases that are one computation, however they were asked for.
    pub computation: u64,
}

impl Specimen {
    pub fn of(case: &Case, solid: &Solid, laid: &Laid, material: &Material) -> Self {
        let kinds = kinds(&laid.plan);
        let sum = |each: fn(&Kind) -> u64| kinds.iter().map(|kind| kind.number * each(kind)).sum();
        let [nodes, elements, sites]: [u64; 3] = [sum(|kind| kind.nodes_each), sum(|_| 1), sum(|kind| kind.sites_each)];
        let wanted: Vec<u32> = solid.resolution.regions.iter().map(|region| region.element).collect();
        let wanted: Vec<u32> = wanted.into_iter().chain([solid.resolution.element]).collect();
        let is_meshed = site_count(&laid.plan) <= MESHED;
        let smaller = kinds.iter().filter(|kind| !wanted.contains(&kind.size));
        let leftover: u64 = smaller.map(|kind| kind.number * kind.sites_each).sum();
        let has = |size: &&u32| !kinds.iter().any(|kind| kind.size == **size);
        Self {
            edges: edges(solid, laid),
            blocks: match solid.specimen.shape {
                Shape::Blocks(blocks) => Some(blocks),
                Shape::Box { .. } => None,
            },
            slot: slot(solid),
            severed: laid.severed(solid),
            intensity: laid.intensity(solid, material),
            held: solid.held.as_ref().map(|held| words::held(solid, held, laid)),
            loading: words::loading(solid, laid),
            direction: laid.pull_direction(solid),
            spacing: laid.plan.spacing,
            leftover_share: is_meshed.then(|| leftover as f64 / sites.max(1) as f64),
            absent: wanted.iter().rev().find(has).copied().filter(|_| is_meshed),
            computation: computation(case, solid, laid, &kinds),
            kinds,
            nodes,
            elements,
            sites,
        }
    }
}

/// Sites, exactly for blocks and by volume for a box.
pub fn site_count(plan: &Plan) -> u64 {
    let cells = |from: [i32; 3], to: [i32; 3]| (0..3).map(|axis| (to[axis] - from[axis]) as u64).product::<u64>();
    let whole = match &plan.sites.outline {
        Outline::Rhombohedron(extent) => cells([0; 3], *extent),
        Outline::Box(size) => {
            let volume: f64 = size.iter().product();
            let site = crate::lattice::fcc::SITE_VOLUME * plan.spacing.powi(3);
            (volume / site) as u64
        }
    };
    let removed: u64 = plan.sites.removed.iter().map(|slot| cells(slot.from, slot.to)).sum();
    whole.saturating_sub(removed)
}

/// Counted in the mesh, unless blocks fill the solid anyhow or it is too large for a question: then as if they filled it.
fn kinds(plan: &Plan) -> Vec<Kind> {
    let sites = site_count(plan);
    if sites > MESHED || is_filled(plan) {
        return if_filled(u32::from(plan.element), sites);
    }
    let mesh = Mesh::new(plan);
    let mut numbers: BTreeMap<(i32, &'static str), Kind> = BTreeMap::new();
    for element in &mesh.elements {
        let name = name(element.shape);
        let kind = numbers.entry((-element.size, name)).or_insert_with(|| Kind {
            name,
            size: element.size as u32,
            number: 0,
            nodes_each: element.shape.node_count() as u64,
            sites_each: element.site_count(),
        });
        kind.number += 1;
    }
    numbers.into_values().collect()
}

/// Whether whole blocks of one size fill a solid.
fn is_filled(plan: &Plan) -> bool {
    let Outline::Rhombohedron(extent) = plan.sites.outline else {
        return false;
    };
    let cuts = plan.sites.removed.iter().flat_map(|slot| [slot.from, slot.to]);
    let is_whole = |site: [i32; 3]| site.iter().all(|number| number % i32::from(plan.element) == 0);
    plan.regions.is_empty() && cuts.chain([extent]).all(is_whole)
}

fn if_filled(size: u32, sites: u64) -> Vec<Kind> {
    let kind = |name, number, nodes_each, sites_each| Kind {
        name,
        size,
        number,
        nodes_each,
        sites_each,
    };
    if size == 1 {
        return vec![kind("atom", sites, 1, 1)];
    }
    let n = u64::from(size);
    let (blocks, tetrahedron) = (sites / (n * n * n), (n * n - 1) * n / 6);
    vec![
        kind("octahedron", blocks, 6, n * n * n - 2 * tetrahedron),
        kind("tetrahedron", 2 * blocks, 4, tetrahedron),
    ]
}

fn name(shape: ElementShape) -> &'static str {
    match shape {
        ElementShape::Low | ElementShape::High => "tetrahedron",
        ElementShape::Octahedron => "octahedron",
        ElementShape::Atom => "atom",
    }
}

/// A box is what is asked for; blocks are whole by themselves.
fn edges(solid: &Solid, laid: &Laid) -> [(&'static str, Size); 3] {
    let names = words::axes(solid);
    let length = |axis: usize| {
        let edge = laid.edges[axis];
        edge.iter().map(|part| part * part).sum::<f64>().sqrt()
    };
    [0, 1, 2].map(|axis| {
        let size = Size {
            asked: length(axis),
            actual: length(axis),
        };
        (names[axis], size)
    })
}

fn slot(solid: &Solid) -> Option<u64> {
    match solid.notch {
        Some(Notch::Slot { from, to }) => Some((0..3).map(|axis| u64::from(to[axis] - from[axis])).product()),
        _ => None,
    }
}

fn computation(case: &Case, solid: &Solid, laid: &Laid, kinds: &[Kind]) -> u64 {
    let mut rest = solid.clone();
    rest.specimen.block = 0;
    rest.specimen.shape = Shape::Blocks([0; 3]);
    rest.resolution.element = 0;
    rest.resolution.regions.clear();
    rest.notch = rest.notch.filter(|notch| matches!(notch, Notch::Plane { .. }));
    let rest = Case {
        body: Body::Solid(rest),
        ..case.clone()
    };
    let rest = serde_json::to_string(&rest).unwrap_or_default();
    let mut hasher = DefaultHasher::new();
    let sites = format!("{:?}", laid.plan.sites);
    (rest, sites, kinds).hash(&mut hasher);
    if kinds.len() > 1 {
        format!("{:?}", laid.plan.regions).hash(&mut hasher);
    }
    hasher.finish()
}
