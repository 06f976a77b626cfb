//! What a run says at its end, and its exit code.

use std::path::Path;

use crate::executor::{Ending, exit};

pub fn conclusion(endings: &[Ending], report: Option<&Path>, code: u8) -> String {
    let Some(report) = report else {
        let held_back = endings
            .iter()
            .filter(|ending| matches!(ending, Ending::NotStarted))
            .count();
        return if code == exit::INTERRUPTED {
            "stopped; the same command goes on from the last checkpoints\n".to_owned()
        } else if held_back > 0 {
            format!(
                "Slurm has {} of {} cases and no room for the others now; the same command hands them over when some have \
                 ended, and without --detach as soon as they have\n",
                endings.len() - held_back,
                endings.len()
            )
        } else {
            "Slurm has them; `cgaft study status` tells how far they are, and the same command without --detach waits \
             and builds the report\n"
                .to_owned()
        };
    };
    let failed = endings
        .iter()
        .filter(|ending| matches!(ending, Ending::Failed(_)))
        .count();
    let failed = if failed > 0 {
        format!("{failed} of {} cases failed\n", endings.len())
    } else {
        String::new()
    };
    format!("{failed}report: {}\n", report.display())
}

pub fn exit_code(endings: &[Ending], stopped: bool) -> u8 {
    let all_done = endings.iter().all(|ending| {
        matches!(
            ending,
            Ending::Done(_) | Ending::DoneElsewhere(_) | Ending::HandedOver(_)
        )
    });
    match (all_done, stopped) {
        (true, _) => 0,
        (false, true) => exit::INTERRUPTED,
        (false, false) => 1,
    }
}
