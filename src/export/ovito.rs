//! Pictures of a run as atoms: extended XYZ, which OVITO and ASE open.
//!
//! An element carries its sites along, so each of them is an atom here: at the place that the corners of its element give
//! it, with the stress and the size of the element. Positions stand in Å, as both programs take them; all else in the
//! units of the other files.

use std::io::{self, Write};

use crate::record::frames::{FieldMesh, Frame};
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

/// A site: the nodes that carry it, each with its share.
struct Site {
    cell: usize,
    carriers: [(usize, f64); 3],
}

/// How many sites a picture has.
pub fn count(mesh: &FieldMesh, which: Sites) -> usize {
    let of_cell = |size: &u32| match (*size, which) {
        (1, _) => 1,
        (_, Sites::Atoms) => 0,
        (size, Sites::All) => size as usize * (size as usize + 1) / 2,
    };
    mesh.element_size.iter().map(of_cell).sum()
}

/// Writes one picture.
pub fn write(out: &mut impl Write, mesh: &FieldMesh, frame: &Frame, which: Sites) -> io::Result<()> {
    let [low, high] = extent(mesh, frame);
    writeln!(out, "{}", count(mesh, which))?;
    writeln!(
        out,
        "Lattice=\"{} 0 0 0 {} 0 0 0 {DEPTH}\" Origin=\"{} {} {}\" pbc=\"F F F\" \
         Properties=species:S:1:pos:R:3:displacement:R:3:velocity:R:3:speed_m_per_s:R:1:stress_xx_gpa:R:1:stress_yy_gpa:R:1:\
         stress_xy_gpa:R:1:damage:R:1:element_size:I:1 Time={} strain={} step={}",
        high[0] - low[0],
        high[1] - low[1],
        low[0],
        low[1],
        -0.5 * DEPTH,
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

fn write_site(out: &mut impl Write, mesh: &FieldMesh, frame: &Frame, site: &Site) -> io::Result<()> {
    let of = |field: &[[f64; 2]]| -> [f64; 2] {
        [0, 1].map(|axis| {
            site.carriers
                .iter()
                .map(|(node, share)| share * field[*node][axis])
                .sum()
        })
    };
    let [place, displacement, velocity] = [&mesh.points, &frame.displacement, &frame.velocity].map(|field| of(field));
    let [x, y] = [0, 1].map(|axis| (place[axis] + displacement[axis]) * ANGSTROM);
    let [u, v] = displacement.map(|part| part * ANGSTROM);
    // Å per ps, so that one may be had from the other.
    let [vx, vy] = velocity.map(|part| part * ANGSTROM);
    let speed = velocity[0].hypot(velocity[1]) * NM_PER_PS_IN_M_PER_S;
    let [xx, yy, xy] = frame.stress[site.cell].map(|stress| stress * EV_PER_NM3_IN_GPA);
    let (damage, size) = (frame.damage[site.cell], mesh.element_size[site.cell]);
    writeln!(
        out,
        "X {x:.6} {y:.6} 0 {u:.6} {v:.6} 0 {vx:.6} {vy:.6} 0 {speed:.4} {xx:.6} {yy:.6} {xy:.6} {damage:.4} {size}"
    )
}

/// The sites of a cell: an atom, or those between the three corners of a triangle, along its edges and inside.
fn sites(mesh: &FieldMesh, cell: usize, which: Sites) -> Vec<Site> {
    let [start, end] = [0, 1].map(|next| mesh.offsets[cell + next] as usize);
    match (&mesh.connectivity[start..end], which) {
        (&[atom], _) => vec![Site {
            cell,
            carriers: [(atom as usize, 1.0), (atom as usize, 0.0), (atom as usize, 0.0)],
        }],
        (&[a, b, c], Sites::All) => {
            let last = mesh.element_size[cell].max(2) - 1;
            let steps = f64::from(last);
            let site = |(along, up): (u32, u32)| {
                let [along, up] = [along, up].map(|step| f64::from(step) / steps);
                Site {
                    cell,
                    carriers: [(a as usize, 1.0 - along - up), (b as usize, along), (c as usize, up)],
                }
            };
            let places = (0..=last).flat_map(|up| (0..=last - up).map(move |along| (along, up)));
            places.map(site).collect()
        }
        _ => Vec::new(),
    }
}

/// The corners of the rectangle that holds all nodes, Å.
fn extent(mesh: &FieldMesh, frame: &Frame) -> [[f64; 2]; 2] {
    let mut ends = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for (place, by) in mesh.points.iter().zip(&frame.displacement) {
        for axis in 0..2 {
            let at = (place[axis] + by[axis]) * ANGSTROM;
            ends[0][axis] = ends[0][axis].min(at);
            ends[1][axis] = ends[1][axis].max(at);
        }
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

    fn lines(which: Sites) -> Vec<String> {
        let (mesh, frame) = picture();
        let mut out = Vec::new();
        write(&mut out, &mesh, &frame, which).unwrap();
        String::from_utf8(out).unwrap().lines().map(str::to_owned).collect()
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
