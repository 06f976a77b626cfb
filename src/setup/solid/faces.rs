//! Which sites and nodes belong to a face of a solid.

use super::plan::Laid;
use crate::lattice::fcc;
use crate::mesh::solid::Solid as Mesh;
use crate::mesh::solid::sites::Outline;
use crate::study::case::solid::{Axis, Depth, Face, Side};

/// A site on the border of a depth belongs to it, whatever rounding says: nm.
const ON_THE_BORDER: f64 = 1e-6;

impl Laid {
    /// Whether a site is no deeper below a face than this.
    pub fn is_within(&self, site: [i32; 3], face: Face, depth: Depth) -> bool {
        let axis = face.axis.index();
        match (&self.plan.sites.outline, depth) {
            (Outline::Rhombohedron(extent), Depth::Layers(layers)) => {
                let from_face = match face.side {
                    Side::Low => site[axis],
                    Side::High => extent[axis] - 1 - site[axis],
                };
                i64::from(from_face) < i64::from(layers)
            }
            (_, depth) => {
                let from_face = match face.side {
                    Side::Low => self.height(site, face.axis),
                    Side::High => self.thickness(face.axis) - self.height(site, face.axis),
                };
                from_face <= self.depth(face.axis, depth) + ON_THE_BORDER
            }
        }
    }

    /// Whether a site has no neighbour that is nearer to a face.
    pub fn is_on(&self, site: [i32; 3], face: Face) -> bool {
        if let Outline::Rhombohedron(extent) = &self.plan.sites.outline {
            let axis = face.axis.index();
            return match face.side {
                Side::Low => site[axis] == 0,
                Side::High => site[axis] == extent[axis] - 1,
            };
        }
        // A box is cut straight, whatever the planes of the crystal: some sites on its face have neighbours beside them alone.
        let outward = self.outward(face);
        let height = self.height(site, face.axis);
        let room = match face.side {
            Side::Low => height,
            Side::High => self.thickness(face.axis) - height,
        };
        let frame = &self.plan.sites.frame;
        let steps = fcc::NEAREST
            .into_iter()
            .flat_map(|vector| [vector, vector.map(|part| -part)]);
        let rises = steps.map(|vector| {
            let step = frame.place(vector);
            (0..3).map(|axis| step[axis] * outward[axis]).sum::<f64>()
        });
        let highest = rises.fold(0.0, f64::max);
        highest > room + ON_THE_BORDER
    }

    /// Whether a site lies in the layer at a distance from the low face of an axis, nm.
    pub fn is_in_layer(&self, site: [i32; 3], axis: Axis, at: f64) -> bool {
        let layer = match &self.plan.sites.outline {
            Outline::Rhombohedron(_) => self.depth(axis, Depth::Layers(1)),
            // Thick enough for a site of every plane of the crystal that has few.
            Outline::Box(_) => self.plan.spacing,
        };
        let from_plane = self.height(site, axis) - at;
        (-0.5 * layer..0.5 * layer).contains(&from_plane)
    }

    /// Distance of a site from the low face of an axis, nm; half a layer more for blocks, whose faces are midway between layers.
    fn height(&self, site: [i32; 3], axis: Axis) -> f64 {
        let place = self.plan.sites.frame.place(site);
        let normal = self.normal(axis);
        let height: f64 = (0..3).map(|part| place[part] * normal[part]).sum();
        match &self.plan.sites.outline {
            Outline::Rhombohedron(_) => height + 0.5 * self.depth(axis, Depth::Layers(1)),
            Outline::Box(_) => height,
        }
    }

    /// Nodes of the elements that lie whole within a depth below a face.
    pub fn nodes_within(&self, mesh: &Mesh, face: Face, depth: Depth) -> Vec<u32> {
        let is_whole = |element: &usize| {
            let element = mesh.elements[*element];
            // An element is convex: it is within where its nodes are.
            let corners = element.corners().into_iter();
            corners
                .map(|local| element.site(local))
                .all(|site| self.is_within(site, face, depth))
        };
        let elements = (0..mesh.elements.len()).filter(is_whole);
        elements
            .flat_map(|element| mesh.nodes_of(element))
            .map(|node| node as u32)
            .collect()
    }
}
