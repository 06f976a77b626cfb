//! Cases as input of other programs.

use std::fs;

use super::{STUDY, Workspace};

const ATOMS: &str = "{resolution: {element: 1}, specimen: {length: 15 nm, width: 13.3 nm}, crack: {length: 5 nm}}";

fn workspace(change: impl Fn(&str) -> String) -> Workspace {
    let place = Workspace::new();
    place.write_study(&change(
        &STUDY.replace("B: {crack: {length: 50 nm}}", &format!("B: {ATOMS}")),
    ));
    place
}

const EXPORT: [&str; 7] = ["export", "lammps", "slab.yaml", "--case", "B", "--into", "there"];

#[test]
fn an_all_atom_case_becomes_a_script_and_a_data_file_that_say_what_they_are() {
    let place = workspace(str::to_owned);
    let said = place.cgaft(&EXPORT).succeeded();
    assert!(said.stdout.contains("lmp -in in.B"), "{}", said.stdout);
    let [script, data] = ["in.B", "data.B"].map(|file| fs::read_to_string(place.path("there").join(file)).unwrap());
    for words in [
        "study   slab (slab.yaml)",
        "lmp -in in.B",
        "units lj\n",
        "read_data data.B\n",
        "lj/cut 2",
    ] {
        assert!(script.contains(words), "{words}: {script}");
    }
    assert!(data.starts_with("# LAMMPS data of case `B` of study `slab`"));
    let atoms = data.lines().nth(2).unwrap();
    let rows = data.split_once("Velocities\n\n").unwrap().1.lines().count();
    assert_eq!(atoms, format!("{rows} atoms"));
    let json = place.cgaft(&[&EXPORT[..6], &["elsewhere", "--json"]].concat()).json();
    assert_eq!(json["atoms"], rows);
}

#[test]
fn an_all_atom_solid_becomes_a_script_with_its_loading_and_a_data_file() {
    let place = Workspace::new();
    let solid = include_str!("../../studies/solid.yaml");
    place.write_study(solid);
    place
        .cgaft(&["export", "lammps", "slab.yaml", "--case", "atoms"])
        .succeeded();
    let [script, data] = ["in.atoms", "data.atoms"].map(|file| fs::read_to_string(place.path(file)).unwrap());
    for words in [
        "dimension 3\nboundary s s s\n",
        "group loading type ",
        "fix held held setforce 0.0 0.0 0.0",
        "variable sigma_yy equal ",
    ] {
        assert!(script.contains(words), "{words}: {script}");
    }
    assert!(data.contains("\n1728 atoms\n3 atom types\n"), "{}", &data[..200]);
    let refused = place.cgaft(&["export", "lammps", "slab.yaml", "--case", "mixed", "--into", "there"]);
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.contains("single atoms only"), "{}", refused.stderr);
}

#[test]
fn what_a_person_may_have_edited_is_never_overwritten() {
    let place = workspace(str::to_owned);
    place.cgaft(&EXPORT).succeeded();
    let script = place.path("there/in.B");
    fs::write(&script, "edited").unwrap();
    let refused = place.cgaft(&EXPORT);
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.contains("--into"), "{}", refused.stderr);
    assert_eq!(fs::read_to_string(script).unwrap(), "edited");
}

#[test]
fn what_lammps_has_not_is_refused_in_words_and_nothing_is_written() {
    let lennard_jones = "{lennard-jones: {epsilon: 0.415 eV, sigma: 0.2277 nm, cutoff: 0.34 nm, at-cutoff: truncated}}";
    let morse = "{morse: {depth: 0.343 eV, decay: 13.6 /nm, distance: 0.2866 nm, \
                 at-cutoff: {smooth: {from: 0.45 nm, to: 0.5 nm}}}}";
    let harmonic = "{harmonic-bond: {stiffness: 320 eV/nm^2, distance: 0.25 nm, cutoff: 0.34 nm}}";
    let cases: [(&str, &str, &str); 4] = [
        ("element: 1}", "element: 10}", "single atoms only"),
        (lennard_jones, morse, "Morse potential with a smooth cutoff"),
        (lennard_jones, harmonic, "`harmonic-bond`"),
        ("  B:", "  branching:", "has no case `B`"),
    ];
    for (old, new, words) in cases {
        let place = workspace(|study| study.replace(old, new));
        let refused = place.cgaft(&EXPORT);
        assert_eq!(refused.code, Some(2), "{}", refused.stderr);
        assert!(refused.stderr.contains(words), "{}", refused.stderr);
        assert!(!place.path("there").exists());
    }
}
