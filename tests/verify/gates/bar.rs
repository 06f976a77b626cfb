//! The bar of Deng (2011), Figs. 4-6 to 4-8, as shipped: how it vibrates, and its stiffness at rest.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use crate::verify::table::{Chapter, Gate};

const CASES: &str = "elements,elements-stretched,elements-pressed,narrow,narrow-atoms";

/// A bar ten times as long as wide is no thin one: its sides move too, and bending rides on its waves.
const THIN_BAR: f64 = 5e-3;
/// Elements of ten slow waves as long as four bars by less.
const ATOMS: f64 = 1e-2;
/// A strain of 0.025 % to either side hardens and softens bonds, which the mean of both leaves to second order.
const MODULUS: f64 = 1e-3;

/// The rows of a table by case, each by column; what is empty is left out.
fn rows(table: &Path) -> BTreeMap<String, BTreeMap<String, f64>> {
    let text = fs::read_to_string(table).expect("the report has this table");
    let mut lines = text.lines().map(|line| line.split(','));
    let columns: Vec<&str> = lines.next().expect("it has a first line").skip(1).collect();
    let row = |mut cells: std::str::Split<'_, char>| {
        let case = cells.next().unwrap_or_default().to_owned();
        let numbers = columns.iter().zip(cells);
        let numbers = numbers.filter_map(|(column, cell)| Some(((*column).to_owned(), cell.parse().ok()?)));
        (case, numbers.collect())
    };
    lines.map(row).collect()
}

#[test]
fn a_bar_in_elements_vibrates_as_a_thin_one_of_its_own_stiffness_and_as_one_in_atoms() {
    // Period 4 L sqrt(rho/E)
    let folder = tempfile::tempdir().expect("there is room");
    let run = Command::new(env!("CARGO_BIN_EXE_cgaft"))
        .args(["study", "run", "wave-bar.yaml", "--only", CASES, "--results", "."])
        .current_dir(folder.path())
        .output()
        .expect("cgaft starts");
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let found = rows(&folder.path().join("wave-bar/tables/summary.csv"));
    let number = |case: &str, column: &str| found[case][column];
    let mean = |column: &str| 0.5 * (number("elements-stretched", column) + number("elements-pressed", column));
    let mut gate = Gate::new(Chapter::Waves, "5 a bar");
    gate.within(
        "Young's modulus along <110>, GPa",
        "4 x 4 x 40 blocks of ten at rest, mean of stretched and pressed",
        mean("modulus_at_rest_gpa"),
        number("elements", "modulus_of_crystal_gpa"),
        MODULUS,
    );
    gate.within(
        "period, ps, against 4 L sqrt(rho/E) with this modulus",
        "4 x 4 x 40 blocks of ten",
        number("elements", "period_ps"),
        mean("bar_period_at_rest_ps"),
        THIN_BAR,
    );
    gate.within(
        "period, ps, against that in atoms",
        "2 x 2 x 20 blocks of ten",
        number("narrow", "period_ps"),
        number("narrow-atoms", "period_ps"),
        ATOMS,
    );
    gate.close();
}
