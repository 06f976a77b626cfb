//! The JSON Schema, with which an editor completes and checks a study.

use std::fs;
use std::path::Path;

use cgaft::plan::starter;
use cgaft::study;

use super::right_studies;

#[test]
fn every_study_fits_the_schema() {
    let validator = jsonschema::draft7::new(&study::schema()).unwrap();
    let texts = right_studies()
        .into_iter()
        .map(|path| (path.display().to_string(), fs::read_to_string(&path).unwrap()));
    for (name, text) in texts.chain([("starter".to_owned(), starter("fresh"))]) {
        let options = serde_saphyr::options! { strict_booleans: true };
        let value: serde_json::Value = serde_saphyr::from_str_with_options(&text, options).unwrap();
        let errors: Vec<String> = validator
            .iter_errors(&value)
            .map(|error| format!("{}: {error}", error.instance_path()))
            .collect();
        assert!(errors.is_empty(), "{name}: {errors:#?}");
    }
}

/// Most slips can be seen by an editor that knows the schema; what needs arithmetic cannot.
#[test]
fn the_schema_refuses_wrong_keys_variants_and_bare_numbers() {
    let validator = jsonschema::draft7::new(&study::schema()).unwrap();
    for name in [
        "unknown_key",
        "unknown_variant",
        "unknown_word",
        "unit_missing",
        "not_a_number",
        "whole_number_expected",
    ] {
        let path = format!("{}/tests/study_files/bad/{name}.yaml", env!("CARGO_MANIFEST_DIR"));
        let value: serde_json::Value = serde_saphyr::from_str(&fs::read_to_string(path).unwrap()).unwrap();
        assert!(!validator.is_valid(&value), "{name}");
    }
}

#[test]
fn an_editor_sees_wrong_units_and_wrong_paths_of_a_sweep() {
    let validator = jsonschema::draft7::new(&study::schema()).unwrap();
    let is_valid = |text: &str| validator.is_valid(&serde_saphyr::from_str::<serde_json::Value>(text).unwrap());
    let right = starter("fresh");
    let with = |from: &str, to: &str| {
        assert!(right.contains(from), "{from}");
        right.replace(from, to)
    };
    assert!(is_valid(&right));
    for (from, to) in [
        ("length: 46 nm", "length: 60 ps"),
        ("epsilon: 0.415 eV", "epsilon: 0.415 ev"),
        ("rate: 9.81e7 /s", "rate: 9.81e7 s"),
        ("mass: 802 u", "mass: 802 nm"),
        ("strain: 3.5 %", "strain: 3.5"),
        ("every: 0.25 % strain", "every: 0.25 %"),
    ] {
        assert!(!is_valid(&with(from, to)), "{to}");
    }
    for (from, to) in [
        ("rate: 9.81e7 /s", "rate: 98.1 us^-1"),
        ("length: 46 nm", "length: 460 Å"),
        ("every: 0.25 % strain", "every: 2.5 ps"),
    ] {
        assert!(is_valid(&with(from, to)), "{to}");
    }
    let sweep = |path: &str| format!("{right}\nsweep:\n  {path}: [1, 2]\n");
    for (path, is_right) in [
        ("resolution.element", true),
        ("loading.strain-rate.rate", true),
        ("material.potential.morse.depth", true),
        ("run.until.strain", true),
        ("resolution.elements", false),
        ("element", false),
    ] {
        assert_eq!(is_valid(&sweep(path)), is_right, "{path}");
    }
}

#[test]
fn the_schema_describes_every_property() {
    fn look(root: &serde_json::Value, node: &serde_json::Value, bare: &mut Vec<String>) {
        let properties = node["properties"].as_object().into_iter().flatten();
        for (key, value) in properties {
            let name = value["$ref"].as_str().and_then(|path| path.rsplit('/').next());
            let referred = name.map(|name| &root["definitions"][name]["description"]);
            // A choice is described where it is offered.
            let is_choice =
                !node["description"].is_null() && node["required"].as_array().is_some_and(|keys| keys.len() == 1);
            if value["description"].is_null() && !is_choice && referred.is_none_or(serde_json::Value::is_null) {
                bare.push(key.clone());
            }
        }
        match node {
            serde_json::Value::Object(map) => map.values().for_each(|inner| look(root, inner, bare)),
            serde_json::Value::Array(list) => list.iter().for_each(|inner| look(root, inner, bare)),
            _ => {}
        }
    }
    let schema = study::schema();
    let mut bare = Vec::new();
    look(&schema, &schema, &mut bare);
    assert!(bare.is_empty(), "no description: {bare:?}");
}

/// `CGAFT_WRITE_SCHEMA=1 cargo test` writes it anew.
#[test]
fn the_schema_file_is_what_the_types_say() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("schemas/study.schema.json");
    let text = serde_json::to_string_pretty(&study::schema()).unwrap() + "\n";
    if std::env::var_os("CGAFT_WRITE_SCHEMA").is_some() {
        fs::write(&path, &text).unwrap();
    }
    assert!(
        fs::read_to_string(&path).unwrap() == text,
        "stale: run the tests with CGAFT_WRITE_SCHEMA=1"
    );
}
