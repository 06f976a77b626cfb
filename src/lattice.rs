//! Perfect crystals: where the sites are and which vectors join neighbours.

pub mod fcc;
pub mod triangular;
