//! The number of threads is no part of a result.

use super::{PATIENCE, Program, Workspace, assert_same_results};

#[test]
fn one_thread_and_two_write_the_same_bytes() {
    let [one, two] = ["1", "2"].map(|threads| {
        let place = Workspace::new();
        place.cgaft("run", &["--threads", threads]).succeeded();
        place
    });
    for case in ["coarse", "mixed", "atoms"] {
        assert_same_results(&one.case(case), &two.case(case));
    }
}

#[test]
fn a_case_computed_alone_is_the_case_of_the_study() {
    let place = Workspace::new();
    place.cgaft("run", &["--only", "mixed"]).succeeded();
    let study = place.case("mixed");
    let alone = place.path("alone");
    let solve = &mut place.solver(&study.join("case.yaml"), &alone, &["--threads", "1"]);
    Program::start(solve, &place).wait(PATIENCE).succeeded();
    assert_same_results(&alone, &study);
}
