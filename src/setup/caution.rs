//! What is allowed and should be known before a case is computed.

use crate::study::case::{Case, Summation};

/// Sentences about the method that a case has chosen.
pub fn cautions(case: &Case) -> Vec<String> {
    match case.run.summation {
        Summation::Exact | Summation::StrictGauss { .. } => vec![],
        Summation::Gauss { points } => vec![format!(
            "`summation: {{gauss: {points}}}` looks at some bonds of a string only: once bonds part the energy may drift; \
             the report tells by how much"
        )],
        Summation::Nodal => vec![
            "`summation: nodal` fails the patch test: uncracked it is 43 % too soft with 10 atoms an edge (2.20 against \
             3.92 GPa at 1 %), and the report gives no K that takes the moduli of the lattice"
                .to_owned(),
        ],
    }
}
