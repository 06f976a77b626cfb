//! What of a solid is broken.

use crate::forces::solid::Forces;

/// The interfaces that were whole at the start. Where the potential reaches far, none is ever summed as one: then nothing is
/// known to be broken.
#[derive(Clone, Debug, PartialEq)]
pub struct Broken {
    /// Interfaces that are open from the start, ascending.
    from_the_start: Vec<u32>,
    /// How many interfaces each element has.
    of_elements: Vec<u32>,
}

impl Broken {
    /// Nothing has broken yet.
    pub fn new(forces: &Forces) -> Self {
        let mut of_elements = vec![0; forces.mesh().elements.len()];
        for interface in 0..forces.interface_count() {
            let beside = forces.beside(interface as u32);
            beside
                .into_iter()
                .for_each(|element| of_elements[element as usize] += 1);
        }
        Self {
            from_the_start: forces.open_interfaces(),
            of_elements,
        }
    }

    /// Interfaces that have opened.
    fn opened(&self, forces: &Forces) -> impl Iterator<Item = u32> {
        let open = forces.open_interfaces().into_iter();
        open.filter(|number| self.from_the_start.binary_search(number).is_err())
    }

    /// How many interfaces have opened.
    pub fn count(&self, forces: &Forces) -> usize {
        self.opened(forces).count()
    }

    /// Of each element the share of its interfaces that have opened; zero where it has none.
    pub fn shares(&self, forces: &Forces) -> Vec<f64> {
        let mut opened = vec![0_u32; self.of_elements.len()];
        for interface in self.opened(forces) {
            let beside = forces.beside(interface);
            beside.into_iter().for_each(|element| opened[element as usize] += 1);
        }
        let shares = opened.into_iter().zip(&self.of_elements);
        shares
            .map(|(opened, &all)| f64::from(opened) / f64::from(all.max(1)))
            .collect()
    }
}
