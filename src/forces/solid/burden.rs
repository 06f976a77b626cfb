//! What would fall to ranks that share a solid.

use super::{PART, bordering};
use crate::domain::{Burden, Domain};
use crate::material::Material;
use crate::mesh::solid::Solid;
use crate::mesh::solid::interfaces::Interfaces;

/// What falls to the busiest of so many ranks, for several numbers of them, in a solid of parts of blocks none of which has
/// opened.
pub fn burdens(mesh: &Solid, material: &Material, counts: &[u32]) -> Vec<Burden> {
    let interfaces = Interfaces::new(mesh, material.interaction.cutoff() / material.spacing);
    let burden = |&ranks: &u32| {
        let idle = Burden {
            ranks,
            work: 0.0,
            messages: 0,
            bytes: 0,
        };
        Domain::parts(ranks as usize, mesh, |_| PART).fold(idle, |most, part| {
            let needed = bordering(&part, &interfaces);
            let nodes = needed
                .iter()
                .map(|&element| mesh.elements[element as usize].shape.node_count());
            let bytes = (3 * size_of::<f64>() * nodes.sum::<usize>()) as u64;
            let mut peers: Vec<usize> = needed.iter().map(|&element| part.owner(element as usize)).collect();
            peers.sort_unstable();
            peers.dedup();
            Burden {
                ranks,
                work: most.work.max(part.grouped().len() as f64 / mesh.parts as f64),
                messages: most.messages.max(peers.len() as u32),
                bytes: most.bytes.max(bytes),
            }
        })
    };
    counts.iter().map(burden).collect()
}
