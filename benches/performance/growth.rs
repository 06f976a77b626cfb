//! How the cost of a step grows: with elements, atoms, edges, cutoffs and open interfaces.

use super::page;
use super::specimens;

const HEAD: [&str; 6] = [
    "specimen",
    "atoms",
    "elements",
    "open interfaces",
    "ns of a core an element and step",
    "million atom-steps a core-second",
];

/// What is varied, and the specimens.
const SERIES: [(&str, &[&str]); 6] = [
    (
        "growth-elements",
        &["elements-71k", "elements-200k", "elements-1M", "elements-7M"],
    ),
    ("growth-atoms", &["atoms-71k", "atoms-200k", "atoms-1M"]),
    ("growth-edge", &["edge-5", "elements-1M", "edge-20", "edge-40"]),
    ("growth-summation", &["elements-1M", "gauss2", "nodal"]),
    (
        "growth-cutoff",
        &[
            "elements-1M",
            "elements-smooth",
            "elements-far",
            "atoms-200k",
            "atoms-smooth",
            "atoms-far",
        ],
    ),
    (
        "growth-open",
        &["elements-1M", "notch-quarter", "notch-half", "notch-most"],
    ),
];

pub fn measure() {
    let mut known: Vec<(&str, specimens::Measured)> = Vec::new();
    for (table, cases) in SERIES {
        let mut rows = Vec::new();
        for &case in cases {
            let measured = match known.iter().find(|(name, _)| *name == case) {
                Some((_, measured)) => *measured,
                None => specimens::measure(case, 0.5),
            };
            known.push((case, measured));
            let row = [
                case.to_owned(),
                page::number(measured.atoms as f64),
                page::number(measured.elements as f64),
                page::number(measured.open_interfaces as f64),
                page::number(1e9 * measured.step / measured.elements as f64),
                page::number(measured.rate()),
            ];
            eprintln!("  {}", row.join(" | "));
            rows.push(row.to_vec());
        }
        page::write(table, &HEAD, &rows);
    }
}
