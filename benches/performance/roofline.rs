//! What one core of this machine can do at best, and what the steps reach of it.

mod figure;
mod kernels;

use cgaft::lattice::triangular;
use cgaft::material::Material;
use cgaft::mesh::Mesh;
use cgaft::mesh::interfaces::Interfaces;
use cgaft::setup;
use cgaft::study::case::Summation;

use super::specimens::{self, Measured};
use super::{clock, page};

/// A specimen on the roofline.
pub struct Point {
    pub name: &'static str,
    /// Flops a byte that the step needs.
    pub intensity: f64,
    /// Thousand million flops a second.
    pub reached: f64,
}

/// What the machine can do.
pub struct Roof {
    /// Thousand million flops a second, multiply-adds of 64-bit numbers.
    pub flops: f64,
    /// Thousand million bytes a second from memory, and from a cache.
    pub memory: f64,
    pub cache: f64,
}

const CASES: [&str; 5] = [
    "elements-7M",
    "elements-7M-gauss2",
    "elements-far",
    "atoms-1M",
    "atoms-far",
];

pub fn measure() {
    let roof = kernels::roof();
    let mut rows = vec![
        vec![
            "peak multiply-adds".to_owned(),
            String::new(),
            page::number(roof.flops),
            String::new(),
        ],
        vec![
            "memory, GB/s".to_owned(),
            String::new(),
            page::number(roof.memory),
            String::new(),
        ],
        vec![
            "cache, GB/s".to_owned(),
            String::new(),
            page::number(roof.cache),
            String::new(),
        ],
    ];
    let points = CASES.map(|name| {
        let need = need(name);
        let Measured { step, .. } = specimens::measure(name, 0.5);
        let point = Point {
            name,
            intensity: need.flops / need.bytes,
            reached: 1e-9 * need.flops / step,
        };
        rows.push(vec![
            name.to_owned(),
            page::number(point.intensity),
            page::number(point.reached),
            page::number(100.0 * point.reached / roof.flops.min(point.intensity * roof.memory)),
        ]);
        eprintln!("  {}", rows[rows.len() - 1].join(" | "));
        point
    });
    let head = ["what", "flops a byte needed", "Gflop/s reached", "% of the roof"];
    page::write("roofline", &head, &rows);
    figure::draw(&roof, &points, &page::folder().join("roofline.svg"));
    eprintln!("  at {:.1} programs that want to run", clock::load());
}

/// Arithmetic and traffic that one step needs, however it is programmed.
struct Need {
    flops: f64,
    bytes: f64,
}

/// The slope of the potential from the vector of a bond, and the force: d d, 1/r^2, its third power, two terms, times d.
const FLOPS_A_BOND: f64 = 12.0;
/// Difference of two positions, and the force added to both.
const FLOPS_BETWEEN_ATOMS: f64 = 6.0;
/// p + t q, and the sums of f and t f.
const FLOPS_ALONG_A_STRING: f64 = 10.0;
/// p a + q b, and the force on three nodes.
const FLOPS_IN_A_TRIANGLE: f64 = 14.0;
/// The ends of a string from the maps of two triangles, and its two sums to their nodes.
const FLOPS_A_STRING: f64 = 40.0;
/// Two kicks and a drift.
const FLOPS_A_NODE: f64 = 12.0;
/// Position and velocity read and written, mass and force read; positions read and forces written to compute these.
const BYTES_A_NODE: f64 = 120.0;
/// Its number in a list.
const BYTES_A_PARTNER: f64 = 4.0;

fn need(name: &str) -> Need {
    let case = specimens::case("specimens", name);
    let slab = case.slab().expect("it is a slab");
    let material: Material = setup::slab::material(slab).expect("the material is sound");
    let plan = setup::slab::mesh_plan(slab, &case.run.until, &material);
    let mesh = Mesh::new(&plan.expect("the mesh is sound"));
    let cutoff = material.interaction.cutoff() / material.spacing;
    let vectors = triangular::half_vectors_within(cutoff).len() as f64;
    let interfaces = Interfaces::new(&mesh, cutoff);
    let [mut bonds, mut strings] = [0.0; 2];
    for pair in &interfaces.pairs {
        for string in &interfaces.kinds[pair.kind as usize].strings {
            strings += 1.0;
            bonds += match case.run.summation {
                Summation::Gauss { points } | Summation::StrictGauss { points } => {
                    f64::from(string.count.min(points as i32 + 2))
                }
                Summation::Exact | Summation::Nodal => f64::from(string.count),
            };
        }
    }
    let triangles = mesh.triangles as f64;
    let atom_bonds = (mesh.elements.len() - mesh.triangles) as f64 * vectors;
    let nodes = mesh.node_count() as f64;
    Need {
        flops: triangles * vectors * (FLOPS_A_BOND + FLOPS_IN_A_TRIANGLE)
            + bonds * (FLOPS_A_BOND + FLOPS_ALONG_A_STRING)
            + strings * FLOPS_A_STRING
            + atom_bonds * (FLOPS_A_BOND + FLOPS_BETWEEN_ATOMS)
            + nodes * FLOPS_A_NODE,
        bytes: nodes * BYTES_A_NODE + atom_bonds * BYTES_A_PARTNER,
    }
}
