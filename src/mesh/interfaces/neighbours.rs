//! Which triangles are near each other, and which a cut parts.

use super::shift;
use crate::mesh::Mesh;
use crate::mesh::element::Element;

/// The sites within reach of an element, relative to its anchor, row by row.
pub fn surrounding(element: &Element, around: &[[i32; 2]]) -> Vec<[i32; 2]> {
    let origin = [-element.column, -element.row];
    let reached = border(element).flat_map(|site| around.iter().map(move |&vector| shift(site, vector, 1)));
    let outside = reached.filter(|&site| !element.contains(site));
    let mut sites: Vec<[i32; 2]> = outside.map(|site| shift(site, origin, 1)).collect();
    sites.sort_unstable_by_key(|&[column, row]| [row, column]);
    sites.dedup();
    sites
}

/// Lists the triangles that hold sites in the surrounding of one; returns whether it also meets atoms or free surface.
pub fn collect(mesh: &Mesh, element: &Element, surrounding: &[[i32; 2]], neighbours: &mut Vec<u32>) -> bool {
    neighbours.clear();
    let mut exposed = false;
    for &offset in surrounding {
        match mesh.owner_of([element.column + offset[0], element.row + offset[1]]) {
            Some(other) if other < mesh.triangles => {
                if neighbours.last() != Some(&(other as u32)) {
                    neighbours.push(other as u32);
                }
            }
            _ => exposed = true,
        }
    }
    neighbours.sort_unstable();
    neighbours.dedup();
    exposed
}

/// Whether a cut severs an element from a site within reach that a triangle holds.
pub fn borders_cut(mesh: &Mesh, element: &Element, around: &[[i32; 2]]) -> bool {
    if !is_near_cut(mesh, element, around) {
        return false;
    }
    let pairs = border(element).flat_map(|site| around.iter().map(move |&vector| (site, shift(site, vector, 1))));
    pairs
        .filter(|&(site, other)| mesh.severed(site, other))
        .any(|(_, other)| mesh.owner_of(other).is_some_and(|owner| owner < mesh.triangles))
}

/// The sites along the edges of an element.
fn border(element: &Element) -> impl Iterator<Item = [i32; 2]> + use<> {
    let element = *element;
    let locals = element
        .locals()
        .filter(move |&[p, q]| p == 0 || q == 0 || p + q == element.size - 1);
    locals.map(move |local| element.site(local))
}

/// Whether an element has sites so near to the cut that one of these vectors may cross it.
fn is_near_cut(mesh: &Mesh, element: &Element, around: &[[i32; 2]]) -> bool {
    let Some(cut) = mesh.cut else { return false };
    let reach = around.iter().map(|vector| vector[1].abs()).max().unwrap_or(0);
    let [lowest, highest] = [element.lowest_row(), element.lowest_row() + element.size - 1];
    lowest < cut.row + reach && highest >= cut.row - reach
}

pub fn is_severed(mesh: &Mesh, first: &Element, second: &Element, around: &[[i32; 2]]) -> bool {
    let Some(cut) = mesh.cut else { return false };
    if !is_near_cut(mesh, first, around) || !is_near_cut(mesh, second, around) {
        return false;
    }
    let pairs = first
        .sites()
        .flat_map(|site| around.iter().map(move |v| (site, [site[0] + v[0], site[1] + v[1]])));
    pairs.into_iter().any(|(a, b)| second.contains(b) && cut.severs(a, b))
}
