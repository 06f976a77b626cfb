//! A specimen made periodic: nodes outside one period follow their images inside it.

use std::collections::HashMap;

use cgaft::lattice::triangular;
use cgaft::mesh::Mesh;
use cgaft::mesh::element::Element;
use cgaft::state::State;

/// Number of every element by its shape and place.
pub fn numbered(mesh: &Mesh) -> HashMap<Element, usize> {
    mesh.elements
        .iter()
        .enumerate()
        .map(|(number, element)| (*element, number))
        .collect()
}

pub fn moved(element: &Element, [columns, rows]: [i32; 2]) -> Element {
    Element {
        column: element.column + columns,
        row: element.row + rows,
        ..*element
    }
}

/// Nodes that follow, whom, and how far from there they stand.
pub struct Ghosts(Vec<(usize, usize, [f64; 2])>);

impl Ghosts {
    /// Every element outside the core follows the one inside that lies whole periods away.
    pub fn new(mesh: &Mesh, period: [i32; 2], is_core: impl Fn(&Element) -> bool) -> Self {
        const FARTHEST: i32 = 10;
        let numbers = numbered(mesh);
        let mut pairs = Vec::new();
        for (number, element) in mesh
            .elements
            .iter()
            .enumerate()
            .filter(|(_, element)| !is_core(element))
        {
            let image = |periods: i32| {
                let vector = period.map(|part| -periods * part);
                let image = moved(element, vector);
                is_core(&image)
                    .then(|| numbers.get(&image))
                    .flatten()
                    .map(|&image| (image, vector))
            };
            let image = (-FARTHEST..=FARTHEST).find_map(image);
            let (image, vector) = image.expect("every element has an image in the core");
            let shift = triangular::position(vector).map(|part| -part * mesh.spacing);
            let both = mesh.nodes_of(number).zip(mesh.nodes_of(image));
            pairs.extend(both.map(|(ghost, node)| (ghost, node, shift)));
        }
        Self(pairs)
    }

    /// Takes the followers' own motion away.
    pub fn hold(&self, state: &mut State) {
        for &(ghost, _, _) in &self.0 {
            (0..2).for_each(|axis| state.mobility[axis][ghost] = 0.0);
        }
    }

    pub fn follow(&self, state: &mut State) {
        for &(ghost, image, shift) in &self.0 {
            (0..2).for_each(|axis| state.position[axis][ghost] = state.position[axis][image] + shift[axis]);
        }
    }

    pub fn holds(&self, node: usize) -> bool {
        self.0.binary_search_by_key(&node, |pair| pair.0).is_ok()
    }
}
