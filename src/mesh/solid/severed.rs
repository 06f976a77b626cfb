//! What a cut severs among the elements of a solid.

use super::Solid;
use super::cut::layer;
use super::element::Element;
use crate::lattice::fcc;

/// Distance of second neighbours, spacings.
pub const SECOND_NEIGHBOURS: f64 = 1.415;

/// An element that is no atom with nearest neighbours inside it that a cut severs: its bonds cannot be summed by classes.
pub fn severed_element(mesh: &Solid) -> Option<usize> {
    mesh.sites.cut?;
    let is_parted = |part: &usize| {
        let element = mesh.elements[*part];
        let has_severed = |local: [i32; 3]| {
            let neighbours = fcc::NEAREST.map(|vector| plus(local, vector));
            let mut inside = neighbours.into_iter().filter(|&other| element.has_local(other));
            inside.any(|other| mesh.sites.severs(element.site(local), element.site(other)))
        };
        straddles(mesh, &[element]) && element.locals().any(has_severed)
    };
    (0..mesh.parts).find(is_parted)
}

/// Whether a cut severs a site of an element from a first or second neighbour in another; `facing` are the local coordinates
/// of those sites that have such neighbours.
pub fn is_severed_between(mesh: &Solid, first: u32, second: u32, facing: &[[i32; 3]]) -> bool {
    let [one, other] = [first, second].map(|number| mesh.elements[number as usize]);
    if !straddles(mesh, &[one, other]) {
        return false;
    }
    let half = fcc::half_vectors_within(SECOND_NEIGHBOURS).into_iter();
    let vectors: Vec<[i32; 3]> = half.flat_map(|vector| [vector, vector.map(|part| -part)]).collect();
    facing.iter().any(|&local| {
        let site = one.site(local);
        let neighbours = vectors.iter().map(|&vector| plus(site, vector));
        let mut there = neighbours.filter(|&neighbour| other.contains(neighbour));
        there.any(|neighbour| mesh.sites.severs(site, neighbour))
    })
}

/// Whether some nodes of elements lie on the one side of the plane of a cut, and some on the other.
fn straddles(mesh: &Solid, elements: &[Element]) -> bool {
    let Some(cut) = mesh.sites.cut else { return false };
    let corners = elements.iter().flat_map(|element| {
        let corners = element.corners().into_iter();
        corners.map(|corner| layer(cut.normal, element.site(corner)) < cut.layer)
    });
    let (mut below, mut above) = (false, false);
    corners.for_each(|is_below| *(if is_below { &mut below } else { &mut above }) = true);
    below && above
}

fn plus(site: [i32; 3], vector: [i32; 3]) -> [i32; 3] {
    std::array::from_fn(|axis| site[axis] + vector[axis])
}
