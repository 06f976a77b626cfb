//! What ranks gain, in words.

use super::{Findings, Of, Row, number};
use crate::report::{CaseResult, Study};
use crate::study::Growth;

/// `2 ranks are 1.7 times as fast as one: efficiency 0.85. Predicted for 512 ranks: efficiency 0.41.`
pub fn verdict(findings: &Findings) -> Option<String> {
    let last = |wanted: fn(&Of) -> bool| findings.rows.iter().rev().find(|row| wanted(&row.of));
    let measured = last(|of| matches!(of, Of::Case(_)))?;
    let told = |row: &Row| {
        format!(
            "{} times one, an efficiency of {}",
            number(row.speedup),
            number(row.efficiency)
        )
    };
    let mut text = format!("{} ranks are worth {}.", measured.times.ranks, told(measured));
    if let Some(predicted) = last(|of| *of == Of::Prediction) {
        text.push_str(&format!(
            " Predicted for {} ranks: {}.",
            predicted.times.ranks,
            told(predicted)
        ));
    }
    Some(text)
}

/// A topic and what is to be said of it.
pub fn notes(study: &Study, findings: &Findings) -> Vec<(&'static str, String)> {
    let Some(scaling) = &study.scaling else {
        return Vec::new();
    };
    let cases = &study.cases;
    let notes = [
        ("Same bits", same_bits(scaling.growth, cases)),
        ("Elements", blocks(cases)),
        ("Steps", Some(STEPS.to_owned())),
        ("One processor", Some(one_processor(scaling.growth, findings))),
        ("Misprints", Some(MISPRINTS.to_owned())),
        ("Prediction", prediction(findings)),
        ("Memory", memory(scaling.growth, cases, findings)),
    ];
    notes
        .into_iter()
        .filter_map(|(topic, text)| Some((topic, text?)))
        .collect()
}

const STEPS: &str = "INP is everything before the first step (mesh, set-up) but for GETM, the cut of the specimen between the \
     ranks, at first and anew; ELIST the search for neighbours, of which surfaces alone have need; EXC what ranks send each other in a step, and how \
     long they wait for it; SOLV a step: forces, motion, the bound of the time step and EXC; OUT probes, pictures, checkpoints \
     and the published files. EXC and SOLV are times of a step, the others of the run, all of the first rank by the clock on \
     the wall. The total is INP + GETM + ELIST + N SOLV + OUT [Deng (2011), Eq. (4-1)], the speedup T(1)/T(P) with T(1) of a \
     specimen as large, the efficiency the speedup over P [Eq. (4-4)], the ideal speedup 1/(γ + (1 − γ)/P) with γ = (INP + \
     GETM + OUT)/T(1) [Eq. (4-2)].";

const MISPRINTS: &str = "The source prints Eq. (4-3) with γ − (1 − γ)/P, which is negative for one processor and small γ; \
     Amdahl's law, which is meant, has the sum. In Eq. (4-2) it prints T_PUT for T_OUT.";

/// What is counted of a solid.
fn blocks(cases: &[CaseResult]) -> Option<String> {
    let is_of_blocks = |case: &CaseResult| case.solid.as_ref().is_some_and(|solid| solid.specimen.blocks.is_some());
    cases
        .iter()
        .any(is_of_blocks)
        .then(|| "Blocks, as in the source: each is two tetrahedra and an octahedron.".to_owned())
}

/// Whether runs of one case have left the same bytes.
fn same_bits(growth: Growth, cases: &[CaseResult]) -> Option<String> {
    let digests: Option<Vec<&String>> = cases.iter().map(|case| case.digest.as_ref()).collect();
    let digests = digests.filter(|digests| growth == Growth::Fixed && digests.len() > 1)?;
    let names: Vec<&str> = cases.iter().map(|case| case.name.as_str()).collect();
    let names = names.join(", ");
    Some(match digests.iter().all(|digest| *digest == digests[0]) {
        true => format!(
            "The series, the pictures and the last checkpoint of {names} are the same in every byte (BLAKE3 {}…).",
            &digests[0][..16]
        ),
        false => format!(
            "What {names} have computed is NOT the same in every byte: a defect of the program, please report it."
        ),
    })
}

fn one_processor(growth: Growth, findings: &Findings) -> String {
    let mut text = match findings.one {
        Some(_) => "T(1) is measured here.".to_owned(),
        None => {
            "No case has one rank, so T(1) is that of the fewest, as if their parallel part had no loss.".to_owned()
        }
    };
    if findings.rows.iter().any(|row| matches!(row.of, Of::Other(_))) {
        text.push_str(
            " The source prints no row of one processor: its T(1) is taken from the row of the fewest, the time of their \
             parallel part (ELIST and N SOLV without EXC) times their number, as if they lost nothing.",
        );
    }
    if growth == Growth::Scaled {
        text.push_str(
            " The specimen of P ranks is P times that of one, and so is its T(1): all that one rank does grows with the \
             number of elements.",
        );
    }
    text
}

/// What every rank of the largest specimen would hold.
fn memory(growth: Growth, cases: &[CaseResult], findings: &Findings) -> Option<String> {
    let last = findings.rows.iter().rev().find(|row| row.of == Of::Prediction)?;
    let one = cases.iter().find(|case| case.manifest.ranks == Some(1))?;
    let bytes = one.manifest.peak_memory.filter(|_| growth == Growth::Scaled)?;
    let ranks = last.times.ranks;
    Some(format!(
        "Every rank holds the whole mesh: from {} GB of one rank follow {} GB for each of {ranks}.",
        number(bytes * 1e-9),
        number(bytes * 1e-9 * growth.with(ranks))
    ))
}

fn prediction(findings: &Findings) -> Option<String> {
    let messages = findings.messages?;
    findings.rows.iter().find(|row| row.of == Of::Prediction)?;
    let micro = |seconds: f64| number(seconds * 1e6);
    Some(format!(
        "No run, but SOLV = w SOLV(1) + EXC and EXC = m l + b/B + ⌈log₂ P⌉ r. The work w of the busiest rank, the m ranks that \
         it hears from and the bytes b that they send come from cutting this very mesh between P ranks; the latency l = {} µs, \
         the bandwidth B = {} GB/s and the reduction r = {} µs from messages between the ranks of a run here. ELIST shrinks \
         with w; INP, GETM and OUT stay, because every rank makes and cuts the whole mesh and the first writes alone. Every rank is thought \
         to have a core with its memory for itself, nothing to hide messages behind, and no network slower than what was \
         measured.",
        micro(messages.latency),
        number(1e-9 / messages.a_byte),
        micro(messages.reduction)
    ))
}
