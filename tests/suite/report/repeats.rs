//! Repeats of one case with noise of their own.

use super::{rows, text, three_meshes, written};

#[test]
fn repeats_have_medians_and_quartiles_and_what_has_not_parted_is_not_sampled() {
    let mut study = three_meshes();
    let first = study.cases[2].clone();
    study.cases = (1..=3)
        .map(|number| {
            let mut case = first.clone();
            case.name = format!("atoms-repeat-{number}");
            case.repeat_of = Some("atoms".to_owned());
            case
        })
        .collect();
    let folder = written(&study);
    let table = rows(&folder, "repeats");
    let start = table.iter().find(|row| row["quantity"] == "initiation_strain").unwrap();
    assert_eq!(
        [&start["case"], &start["found_in"], &start["is_sampled"]],
        ["atoms", "3", "false"]
    );
    assert_eq!(start["median"], start["least"]);
    let together = rows(&folder, "together");
    assert_eq!(together.len(), 2);
    assert!(
        together.iter().all(|row| row["together_ps"].is_empty()),
        "they are one run"
    );
    assert!(text(&folder, "report.md").contains("not sampled"));
}
