//! How a choice that has values of its own is written in full.

/// Choices, and each with its key and its values.
const IN_FULL: [(&str, &str); 22] = [
    (
        "lennard-jones",
        "potential: {lennard-jones: {epsilon: 0.415 eV, sigma: 0.2277 nm, cutoff: 0.34 nm}}",
    ),
    (
        "morse",
        "potential: {morse: {depth: 0.4 eV, decay: 13.6 /nm, distance: 0.2556 nm, cutoff: 0.4 nm}}",
    ),
    (
        "harmonic-bond",
        "potential: {harmonic-bond: {stiffness: 320 eV/nm^2, distance: 0.2556 nm, cutoff: 0.28 nm}}",
    ),
    ("smooth", "at-cutoff: {smooth: {from: 0.34 nm, to: 0.43 nm}}"),
    ("strain-rate", "loading: {strain-rate: {rate: 4.6e6 /s}}"),
    ("velocity", "loading: {velocity: {face: a2-high, speed: 20 m/s}}"),
    (
        "traction",
        "loading: {traction: {face: a2-high, stress: [0 GPa, 1.6 GPa, 0 GPa]}}",
    ),
    (
        "opposed-tractions",
        "loading: {opposed-tractions: {axis: a2, thickness: a3, stress: [0 GPa, 1.6 GPa, 0 GPa]}}",
    ),
    (
        "pulse",
        "loading: {pulse: {face: a3-high, duration: 10 ps, pressure: 0.1 GPa}}",
    ),
    (
        "impact",
        "loading: {impact: {face: a3-high, radius: 50 nm, speed: 100 m/s}}",
    ),
    (
        "ball",
        "regions: [{ball: {center: [10 nm, 20 nm, 1 nm], radius: 5 nm, element: 1}}]",
    ),
    (
        "cylinder",
        "regions: [{cylinder: {along: a3, center: [10 nm, 20 nm, 1 nm], radius: 5 nm, element: 1}}]",
    ),
    (
        "slab",
        "regions: [{slab: {normal: a2, at: 40 nm, half-width: 5 nm, element: 1}}]",
    ),
    (
        "plane",
        "notch: {plane: {normal: a2, at: 40 nm, from: a1-low, depth: 20 nm}}",
    ),
    ("blocks", "notch: {blocks: {from: [0, 20, 0], to: [10, 21, 1]}}"),
    ("gauges", "observe: [{gauges: {axis: a3, at: [10 nm, 20 nm]}}]"),
    ("gauss", "summation: {gauss: 2}"),
    ("blend", "mass: {blend: 0.65}"),
    ("snapshots", "observe: [{snapshots: {every: 0.5 % strain}}]"),
    ("band", "regions: [{band: {half-width: 8.8 nm, element: 1}}]"),
    (
        "box",
        "regions: [{box: {from: [20 nm, -5 nm], to: [30 nm, 5 nm], element: 1}}]",
    ),
    (
        "disc",
        "regions: [{disc: {center: [46 nm, 0 nm], radius: 9 nm, element: 1}}]",
    ),
];

/// `at-cutoff: {smooth: {from: …, to: …}}` for `smooth`.
pub fn in_full(choice: &str) -> String {
    let known = IN_FULL.iter().find(|(name, _)| *name == choice);
    known.map_or_else(|| format!("{choice}: {{...}}"), |(_, example)| (*example).to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::schema;
    use serde_json::Value;

    /// Names of the choices that have values, wherever the schema offers them beside others.
    fn choices(schema: &Value, found: &mut Vec<String>) {
        for offered in ["oneOf", "anyOf"].iter().filter_map(|key| schema[key].as_array()) {
            for choice in offered {
                let names = choice["properties"].as_object().into_iter().flatten();
                let required = choice["required"].as_array().map_or(0, Vec::len);
                found.extend(names.filter(|_| required == 1).map(|(name, _)| name.clone()));
            }
        }
        match schema {
            Value::Object(map) => map.values().for_each(|inner| choices(inner, found)),
            Value::Array(list) => list.iter().for_each(|inner| choices(inner, found)),
            _ => {}
        }
    }

    #[test]
    fn every_choice_with_values_is_shown_in_full_and_right() {
        let schema = schema();
        let mut found = Vec::new();
        choices(&schema, &mut found);
        let text = schema.to_string();
        assert!(found.contains(&"smooth".to_owned()), "{found:?}");
        // What a word in a unit stands for, and parts that have no short form, are no choices that can be left bare.
        found.retain(|name| !["fraction", "points", "stages", "cases"].contains(&name.as_str()));
        for name in found {
            let example = in_full(&name);
            assert!(!example.contains("..."), "no example of `{name}`");
            let (key, value) = example.split_once(": ").unwrap();
            assert!(text.contains(&format!("\"{key}\":")), "`{key}` is no key of a study");
            assert!(value.contains(&format!("{{{name}: ")), "{example}");
        }
    }
}
