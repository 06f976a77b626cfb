//! What is allowed and told before it is computed.

use super::{STUDY, Workspace};

#[test]
fn pictures_that_a_run_ends_before_are_warned_of() {
    let place = Workspace::new();
    let observe = |every: &str| {
        STUDY.replace(
            "observe: [crack]",
            &format!("observe: [crack, {{snapshots: {{every: {every}}}}}]"),
        )
    };
    for (every, is_late) in [("7 % strain", true), ("1 us", true), ("1 % strain", false)] {
        place.write_study(&observe(every));
        let told = place.cgaft(&["study", "check", "slab.yaml"]).succeeded().stdout;
        assert_eq!(
            told.contains("has none but those of its start and its end"),
            is_late,
            "{every}: {told}"
        );
        assert_eq!(
            told.contains("warning: A, B, C: with a picture every "),
            is_late,
            "{every}: {told}"
        );
    }
}
