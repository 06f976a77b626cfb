//! Whether the tests see a formula that is a few per cent wrong.

use std::path::Path;
use std::process::Command;

use crate::verify::table::{Chapter, Gate};

#[test]
fn every_formula_made_wrong_by_two_to_five_per_cent_is_caught_by_a_fast_test() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let own = root.join("target/python/bin/python");
    let python = if own.exists() {
        own.as_path()
    } else {
        Path::new("python3")
    };
    let ended = Command::new(python)
        .arg(root.join("tests/wrong_formulas.py"))
        .output()
        .expect("Python is here: `make test-setup` installs it");
    let [told, complaints] = [&ended.stdout, &ended.stderr].map(|text| String::from_utf8_lossy(text).into_owned());
    assert!(ended.status.success(), "{told}\n{complaints}");
    // `132 of 132 wrong formulas caught in 90 s`
    let words: Vec<&str> = told.lines().last().unwrap_or_default().split(' ').collect();
    let [caught, all] = [0, 2].map(|place| words.get(place).and_then(|word| word.parse().ok()).unwrap_or(f64::NAN));
    let mut gate = Gate::new(Chapter::Gates, "wrong formulas");
    let claim = "formulas made wrong by 2 to 5 %, one at a time, that fail a fast test";
    gate.near(claim, "tests/wrong_formulas.txt", caught, all, 0.0);
    gate.close();
}
