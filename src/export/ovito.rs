//! Pictures of a run as atoms: extended XYZ, which OVITO and ASE open.
//!
//! An element carries its sites along, so each of them is an atom here: at the place that the corners of its element give
//! it, with the stress and the size of the element. Positions stand in Å, as both programs take them; all else in the
//! units of the other files.

use std::io::{self, Write};

use crate::record::frames::{FieldMesh, Frame, Row as _, Tensor as _, Vector};
use crate::units::{EV_PER_NM3_IN_GPA, NM_PER_PS_IN_M_PER_S};

/// nm in Å.
const ANGSTROM: f64 = 10.0;

/// Depth of the cell of a plane, Å; it repeats in no direction.
const DEPTH: f64 = 1.0;

/// Which sites are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sites {
    /// Those that elements carry, and single atoms.
    All,
    /// Single atoms alone.
    Atoms,
}

/// A site: the cell that it belongs to, and the nodes that carry it, each with its share.
struct Site {
    cell: usize,
    carriers: [(usize, f64); 6],
}

/// What an element is by its cells: a picture shows an octahedron as two pyramids on one square, one after the other.
#[derive(Clone, Copy)]
enum Shape<'a> {
    Atom(u32),
    Triangle(&'a [u32]),
    Tetrahedron(&'a [u32]),
    /// Two opposite nodes on each of its axes.
    Octahedron([[u32; 2]; 3]),
    /// The second pyramid of an octahedron, whose sites are those of the first.
    Counted,
}

fn shape<V>(mesh: &FieldMesh<V>, cell: usize) -> Shape<'_> {
    let nodes = |cell: usize| {
        let [start, end] = [0, 1].map(|next| mesh.offsets[cell + next] as usize);
        &mesh.connectivity[start..end]
    };
    match *nodes(cell) {
        [atom] => Shape::Atom(atom),
        [_, _, _] => Shape::Triangle(nodes(cell)),
        [a, b, c, d, tip] => match mesh.offsets.get(cell + 2).map(|_| nodes(cell + 1)) {
            // The same square, seen from its other side.
            Some(&[first, _, third, _, other]) if [first, third] == [a, c] || [first, third] == [c, a] => {
                Shape::Octahedron([[a, c], [b, d], [tip, other]])
            }
            _ => Shape::Counted,
        },
        _ => Shape::Tetrahedron(nodes(cell)),
    }
}

/// How many sites a picture has.
pub fn count<V>(mesh: &FieldMesh<V>, which: Sites) -> usize {
    let of_cell = |cell: usize| {
        let size = mesh.element_size[cell] as usize;
        let tetrahedron = size * (size * size - 1) / 6;
        match (shape(mesh, cell), which) {
            (Shape::Atom(_), _) => 1,
            (_, Sites::Atoms) | (Shape::Counted, _) => 0,
            (Shape::Triangle(_), _) => size * (size + 1) / 2,
            (Shape::Tetrahedron(_), _) => tetrahedron,
            (Shape::Octahedron(_), _) => size * size * size - 2 * tetrahedron,
        }
    };
    (0..mesh.element_size.len()).map(of_cell).sum()
}

/// Writes one picture.
pub fn write<V: Vector>(out: &mut impl Write, mesh: &FieldMesh<V>, frame: &Frame<V>, which: Sites) -> io::Result<()> {
    let [low, high] = extent(mesh, frame);
    let edges = [0, 1, 2].map(|axis| high[axis] - low[axis]);
    let components = V::Stress::COMPONENTS.iter();
    let stresses: Vec<String> = components.map(|name| format!("stress_{name}_gpa:R:1")).collect();
    writeln!(out, "{}", count(mesh, which))?;
    writeln!(
        out,
        "Lattice=\"{} 0 0 0 {} 0 0 0 {}\" Origin=\"{} {} {}\" pbc=\"F F F\" \
         Properties=species:S:1:pos:R:3:displacement:R:3:velocity:R:3:speed_m_per_s:R:1:{}:damage:R:1:element_size:I:1 \
         Time={} strain={} step={}",
        edges[0],
        edges[1],
        edges[2],
        low[0],
        low[1],
        low[2],
        stresses.join(":"),
        frame.time,
        frame.strain,
        frame.step
    )?;
    for cell in 0..mesh.element_size.len() {
        for site in sites(mesh, cell, which) {
            write_site(out, mesh, frame, &site)?;
        }
    }
    Ok(())
}

fn write_site<V: Vector>(out: &mut impl Write, mesh: &FieldMesh<V>, frame: &Frame<V>, site: &Site) -> io::Result<()> {
    let of = |field: &[V]| -> [f64; 3] {
        let mut sum = [0.0; 3];
        for &(node, share) in &site.carriers {
            let components = sum.iter_mut().zip(V::flat(&field[node..=node]));
            components.for_each(|(sum, component)| *sum += share * component);
        }
        sum
    };
    let [place, displacement, velocity] = [&mesh.points, &frame.displacement, &frame.velocity].map(|field| of(field));
    let position = [0, 1, 2].map(|axis| (place[axis] + displacement[axis]) * ANGSTROM);
    let speed = velocity
        .iter()
        .map(|component| component * component)
        .sum::<f64>()
        .sqrt()
        * NM_PER_PS_IN_M_PER_S;
    let stress = V::Stress::flat(&frame.stress[site.cell..=site.cell]).iter();
    let stress: Vec<String> = stress
        .map(|stress| format!("{:.6}", stress * EV_PER_NM3_IN_GPA))
        .collect();
    let (damage, size) = (frame.damage[site.cell], mesh.element_size[site.cell]);
    writeln!(
        out,
        "X {} {} {} {speed:.4} {} {damage:.4} {size}",
        in_space::<V>(position),
        in_space::<V>(displacement.map(|part| part * ANGSTROM)),
        // Å per ps, so that one may be had from the other.
        in_space::<V>(velocity.map(|part| part * ANGSTROM)),
        stress.join(" ")
    )
}

/// Three components; a plane has none out of it.
fn in_space<V: Vector>(vector: [f64; 3]) -> String {
    let [x, y, z] = vector;
    match V::WIDTH {
        2 => format!("{x:.6} {y:.6} 0"),
        _ => format!("{x:.6} {y:.6} {z:.6}"),
    }
}

/// The sites of a cell: an atom, or those between the nodes of an element, at its edges and inside.
fn sites<V>(mesh: &FieldMesh<V>, cell: usize, which: Sites) -> Vec<Site> {
    let site = |carriers: &[(u32, f64)]| {
        let mut all = [(carriers[0].0 as usize, 0.0); 6];
        let own = all.iter_mut().zip(carriers);
        own.for_each(|(place, &(node, share))| *place = (node as usize, share));
        Site { cell, carriers: all }
    };
    let size = mesh.element_size[cell];
    match (shape(mesh, cell), which) {
        (Shape::Atom(atom), _) => vec![site(&[(atom, 1.0)])],
        (_, Sites::Atoms) | (Shape::Counted, _) => Vec::new(),
        // Tetrahedra have one site less along an edge than their blocks.
        (Shape::Triangle(nodes), _) => simplex(nodes, size - 1).iter().map(|at| site(at)).collect(),
        (Shape::Tetrahedron(nodes), _) => simplex(nodes, size - 2).iter().map(|at| site(at)).collect(),
        (Shape::Octahedron(axes), _) => octahedron(axes, size - 1).iter().map(|at| site(at)).collect(),
    }
}

/// The sites between the corners of a triangle or of a tetrahedron with so many steps an edge, by their volume coordinates.
fn simplex(nodes: &[u32], steps: u32) -> Vec<Vec<(u32, f64)>> {
    let steps_at_least_one = f64::from(steps.max(1));
    let share = |number: u32| f64::from(number) / steps_at_least_one;
    let flat = nodes.len() == 3;
    let mut found = Vec::new();
    for out in 0..=if flat { 0 } else { steps } {
        for up in 0..=steps - out {
            for along in 0..=steps - out - up {
                let shares = [
                    1.0 - share(along) - share(up) - share(out),
                    share(along),
                    share(up),
                    share(out),
                ];
                found.push(nodes.iter().copied().zip(shares).collect());
            }
        }
    }
    found
}

/// The sites of an octahedron with so many steps an edge, around a centre that is the mean of its six nodes, as in
/// [`crate::mesh::solid::element`].
fn octahedron(axes: [[u32; 2]; 3], steps: u32) -> Vec<Vec<(u32, f64)>> {
    let m = steps as i32;
    let all = (-m..=m).flat_map(|w| (-m..=m).flat_map(move |v| (-m..=m).map(move |u| [u, v, w])));
    // Sums of two lattice coordinates each: the three together are even.
    let own = all.filter(|at| {
        let far: i32 = at.iter().map(|along| along.abs()).sum();
        far <= m && (at.iter().sum::<i32>() + 3 * m) % 2 == 0
    });
    own.map(|at| {
        let along = at.map(|along| f64::from(along) / f64::from(m));
        let rest = (1.0 - along.iter().map(|along| along.abs()).sum::<f64>()) / 6.0;
        let ends = axes.iter().zip(along);
        ends.flat_map(|(&[high, low], along)| [(high, along.max(0.0) + rest), (low, (-along).max(0.0) + rest)])
            .collect()
    })
    .collect()
}

/// The corners of the box that holds all nodes, Å.
fn extent<V: Vector>(mesh: &FieldMesh<V>, frame: &Frame<V>) -> [[f64; 3]; 2] {
    let mut ends = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for (place, by) in mesh.points.iter().zip(&frame.displacement) {
        let components = V::flat(std::slice::from_ref(place))
            .iter()
            .zip(V::flat(std::slice::from_ref(by)));
        for (axis, (place, by)) in components.enumerate() {
            let at = (place + by) * ANGSTROM;
            ends[0][axis] = ends[0][axis].min(at);
            ends[1][axis] = ends[1][axis].max(at);
        }
    }
    if V::WIDTH == 2 {
        ends[0][2] = -0.5 * DEPTH;
        ends[1][2] = 0.5 * DEPTH;
    }
    ends
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A triangle of four atoms per edge, 3 nm long, and an atom beside it; the triangle is stretched by a tenth along x.
    fn picture() -> (FieldMesh, Frame) {
        let mesh = FieldMesh {
            points: vec![[0.0, 0.0], [3.0, 0.0], [0.0, 3.0], [5.0, 0.0]],
            connectivity: vec![0, 1, 2, 3],
            offsets: vec![0, 3, 4],
            element_size: vec![4, 1],
        };
        let frame = Frame {
            time: 2.0,
            displacement: vec![[0.0; 2], [0.3, 0.0], [0.0; 2], [0.0; 2]],
            velocity: vec![[0.0; 2], [0.0; 2], [0.0; 2], [0.003, 0.004]],
            stress: vec![[0.0, 1.0, 0.0], [0.0; 3]],
            damage: vec![0.0, 1.0],
            ..Frame::default()
        };
        (mesh, frame)
    }

    fn written<V: Vector>(mesh: &FieldMesh<V>, frame: &Frame<V>, which: Sites) -> Vec<String> {
        let mut out = Vec::new();
        write(&mut out, mesh, frame, which).unwrap();
        String::from_utf8(out).unwrap().lines().map(str::to_owned).collect()
    }

    fn lines(which: Sites) -> Vec<String> {
        let (mesh, frame) = picture();
        written(&mesh, &frame, which)
    }

    #[test]
    fn every_site_of_a_block_in_elements_stands_where_its_shape_functions_put_it() {
        use crate::mesh::solid::element::{Element, Shape};
        // A block of five cells with its lattice vectors along the axes, and nodes at places that no affine field gives.
        let parts = Shape::OF_BLOCK.map(|shape| Element {
            shape,
            size: 5,
            anchor: [0; 3],
        });
        let corners: Vec<[i32; 3]> = parts.iter().flat_map(|part| part.corners()).collect();
        let displacement: Vec<[f64; 3]> = (0..14).map(|node| [0.1 * f64::from(node % 5), 0.3, -0.1]).collect();
        let mesh = FieldMesh {
            points: corners.iter().map(|corner| corner.map(f64::from)).collect(),
            connectivity: vec![0, 1, 2, 3, 6, 8, 7, 9, 4, 6, 9, 7, 8, 5, 10, 12, 11, 13],
            offsets: vec![0, 4, 9, 14, 18],
            element_size: vec![5; 4],
        };
        let frame = Frame {
            displacement: displacement.clone(),
            velocity: vec![[0.0; 3]; 14],
            stress: vec![[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]; 4],
            damage: vec![0.0; 4],
            ..Frame::default()
        };
        // What rounds to nothing has no sign.
        let unsigned = |text: String| text.replace("-0.000000", "0.000000");
        let mut found: Vec<String> = written(&mesh, &frame, Sites::All)[2..]
            .iter()
            .map(|line| line.split_whitespace().skip(1).take(3).collect::<Vec<_>>().join(" "))
            .map(unsigned)
            .collect();
        let mut expected = Vec::new();
        let mut first = 0;
        for part in parts {
            for local in part.locals() {
                let weights = part.shape_functions(local);
                let place = [0, 1, 2].map(|axis| {
                    let of_node = |corner: usize| weights[corner] * displacement[first + corner][axis];
                    let moved: f64 = (0..part.shape.node_count()).map(of_node).sum();
                    ANGSTROM * (f64::from(local[axis]) + moved)
                });
                expected.push(unsigned(place.map(|component| format!("{component:.6}")).join(" ")));
            }
            first += part.shape.node_count();
        }
        assert_eq!((found.len(), count(&mesh, Sites::All)), (125, 125));
        found.sort();
        expected.sort();
        assert_eq!(found, expected);
    }

    #[test]
    fn every_site_of_an_element_stands_where_its_corners_carry_it() {
        let lines = lines(Sites::All);
        assert_eq!(lines[0], "11");
        assert_eq!(lines.len(), 2 + 11);
        // The second site along the lower edge: 1 nm, stretched by a tenth.
        assert!(lines[3].starts_with("X 11.000000 0.000000 0 1.000000 "), "{}", lines[3]);
        assert!(lines[3].ends_with(" 4"), "{}", lines[3]);
        assert!(lines[3].contains(&format!(" {EV_PER_NM3_IN_GPA:.6} ")), "{}", lines[3]);
        assert!(
            lines[12].contains(" 5.0000 ") && lines[12].ends_with(" 1.0000 1"),
            "{}",
            lines[12]
        );
    }

    #[test]
    fn atoms_may_be_had_alone() {
        let lines = lines(Sites::Atoms);
        assert_eq!((lines[0].as_str(), lines.len()), ("1", 3));
        assert!(lines[2].starts_with("X 50.000000 "), "{}", lines[2]);
    }
}
