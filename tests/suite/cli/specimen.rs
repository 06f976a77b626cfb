//! What becomes of a specimen when it is laid out, told before anything runs.

use super::{STUDY, Workspace};

fn checked(study: &str) -> String {
    let place = Workspace::new();
    place.write_study(study);
    place.cgaft(&["study", "check", "slab.yaml"]).succeeded().stdout
}

/// The study with one case, and this sweep.
fn swept(sweep: &str) -> String {
    let (base, _) = STUDY.split_once("cases:").unwrap();
    format!("{base}sweep:\n  {sweep}\n")
}

#[test]
fn widths_that_become_one_mesh_are_told_with_all_their_names() {
    let sweep = swept("specimen.width: [30 nm, 31 nm, 32 nm]");
    let told = checked(&sweep);
    assert!(
        told.contains("warning: width-30nm, width-31nm, width-32nm: one computation under several names"),
        "{told}"
    );
    assert!(told.contains("the width is 30.99 nm instead of 30 nm"), "{told}");
    assert!(!told.contains("instead of 31 nm"), "{told}");
    assert!(told.contains("26.78 (25.79)"), "{told}");
    let place = Workspace::new();
    place.write_study(&sweep);
    let run = place.cgaft(&["study", "run", "slab.yaml"]).succeeded();
    assert!(
        run.stdout.contains("one computation under several names"),
        "{}",
        run.stdout
    );
}

#[test]
fn notches_that_sever_the_same_bonds_are_one_computation() {
    // Between two places at which bonds of the three nearest shells cross the plane.
    let told = checked(&swept("crack.length: [46.02 nm, 46.05 nm, 47 nm]"));
    assert!(
        told.contains("warning: length-46.02nm, length-46.05nm: one computation under several names"),
        "{told}"
    );
}

#[test]
fn what_is_left_over_is_told_with_its_place_and_warned_of_where_it_is_much() {
    let sized = |element: u32| checked(&STUDY.replace("{element: 10}", &format!("{{element: {element}}}")));
    let whole = sized(4);
    assert!(
        !whole.contains("% at the") && whole.contains("none"),
        "block follows the element: {whole}"
    );
    let on_blocks_of_ten = |element: u32| {
        let study = STUDY.replace("width: 35.4 nm", "width: 35.4 nm, block: 10");
        checked(&study.replace("{element: 10}", &format!("{{element: {element}}}")))
    };
    let some = on_blocks_of_ten(4);
    assert!(some.contains("% at the grips") && !some.contains("warning"), "{some}");
    let many = on_blocks_of_ten(33);
    assert!(
        many.contains("warning: A, B, C:") && many.contains("of the atoms are in smaller elements than asked for"),
        "{many}"
    );
}

#[test]
fn one_specimen_that_comes_out_of_unlike_heights_is_told_and_one_block_for_all_makes_it_alike() {
    let sizes = "resolution.element: [5, 10, 20]";
    let unlike = checked(&swept(sizes));
    let told =
        "warning: element-5, element-10, element-20: one specimen asked for, 26.78 to 33.42 nm high between the grips";
    assert!(unlike.contains(told), "{unlike}");
    let alike = checked(&swept(sizes).replace("width: 35.4 nm", "width: 35.4 nm, block: 20"));
    assert!(!alike.contains("one specimen asked for"), "{alike}");
}
