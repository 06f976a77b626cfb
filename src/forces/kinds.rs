//! The strings of every kind of interface, and the nodes that carry them.

use super::certified::Certificate;
use super::rows;
use super::strings::CarriedString;
use super::summation::{SampledString, Summation};
use crate::mesh::interfaces::{InterfaceKind, Interfaces};

/// The strings of one kind of interface.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct KindStrings {
    pub strings: Vec<SampledString>,
    /// How many nodes of each triangle they act on, and their corners: these first.
    pub reach: usize,
    pub corners: [[usize; 3]; 2],
    /// The strings as these nodes carry them.
    pub carried: Vec<CarriedString>,
    /// Whether they are the two of an edge as in the crystal, or the one bond of a corner.
    pub is_edge: bool,
    pub is_corner: bool,
}

impl KindStrings {
    fn new(summation: Summation, kind: &InterfaceKind, certificate: Option<Certificate>) -> Self {
        let strings = kind.strings.iter();
        // What is looked at nowhere still shows whether the lattice is regular.
        let strings: Vec<SampledString> = strings
            .map(|&string| SampledString::new(summation, &kind.elements, string))
            .filter(|string| string.is_nearest || !string.samples.is_empty())
            .collect();
        let acts = |side: usize, corner: usize| {
            let weight_at = |local: [i32; 2]| kind.elements[side].shape_functions(local)[corner];
            strings.iter().any(|sampled| {
                let last = sampled.string.count - 1;
                [0, last]
                    .iter()
                    .any(|&t| weight_at(sampled.string.ends(t)[side]) != 0.0)
            })
        };
        let corners = [0, 1].map(|side| {
            let mut corners = [0, 1, 2];
            // Stable: the corners on which strings act come first.
            corners.sort_by_key(|&corner| !acts(side, corner));
            corners
        });
        let reach = [0, 1].map(|side| (0..3).filter(|&corner| acts(side, corner)).count());
        let carried: Vec<CarriedString> = strings
            .iter()
            .map(|sampled| CarriedString::new(&kind.elements, &corners, sampled, certificate))
            .collect();
        Self {
            is_edge: rows::is_edge(&carried) && reach == [2, 2],
            is_corner: rows::is_corner(&carried) && reach == [1, 1],
            strings,
            reach: reach[0].max(reach[1]),
            corners,
            carried,
        }
    }
}

/// The strings of every kind of interface under a rule.
pub struct SampledStrings {
    of_kind: Vec<KindStrings>,
    /// For each interface whether its strings count even when it is open; empty where none does.
    kept: Vec<bool>,
}

impl SampledStrings {
    /// With what few places along strings are certified for, which counts where every bond is summed.
    pub fn new(interfaces: &Interfaces, summation: Summation, certificate: Option<Certificate>) -> Self {
        let certificate = certificate.filter(|_| summation == Summation::Exact);
        let kinds = interfaces.kinds.iter();
        let of_kind = kinds.map(|kind| KindStrings::new(summation, kind, certificate));
        let mut strings = Self {
            kept: Vec::new(),
            of_kind: of_kind.collect(),
        };
        strings.go_over_to(interfaces, summation);
        strings
    }

    /// Goes over to other interfaces of the same kinds.
    pub fn go_over_to(&mut self, interfaces: &Interfaces, summation: Summation) {
        let kept = interfaces.pairs.iter().map(|pair| !pair.severed);
        self.kept = kept.filter(|_| summation.keeps_strings()).collect();
    }

    /// The strings of a kind of interface.
    #[inline(always)]
    pub fn of(&self, kind: u32) -> &KindStrings {
        &self.of_kind[kind as usize]
    }

    /// Whether the strings of an interface count even when it is open.
    #[inline(always)]
    pub fn are_kept(&self, interface: usize) -> bool {
        self.kept.get(interface) == Some(&true)
    }

    /// Whether a kind of interface has strings at all.
    pub fn are_there(&self, kind: u32) -> bool {
        !self.of_kind[kind as usize].strings.is_empty()
    }
}
