use std::path::Path;

use serde_json::json;

use super::estimate::estimates;
use super::survey::{self, Common};
use super::terminal::Terminal;
use super::{CliError, format, room, specimen, warnings};
use crate::plan::PlannedCase;
use crate::setup::{Estimate, cautions};

/// `cgaft study check FILE`
pub fn check(common: &Common) -> Result<u8, CliError> {
    let plan = survey::read(&common.study)?;
    let estimates = estimates(&plan, &plan.cases)?;
    let sized: Vec<_> = plan
        .cases
        .iter()
        .map(|case| case.name.as_str())
        .zip(&estimates)
        .collect();
    let sizes = plan.cases.iter().zip(&estimates);
    let cases: Vec<_> = sizes.map(|(planned, estimate)| to_json(planned, estimate)).collect();
    let laid: Vec<_> = plan
        .cases
        .iter()
        .zip(estimates.iter().map(|estimate| &estimate.specimen))
        .collect();
    let of_steps = sized
        .iter()
        .filter_map(|&(name, estimate)| Some((name, warning(estimate)?)));
    let of_methods = plan.cases.iter().zip(&estimates).flat_map(|(planned, estimate)| {
        let cautions = cautions(&planned.case, estimate.time()).into_iter();
        cautions.map(|caution| (planned.name.as_str(), caution))
    });
    let of_runs = warnings::once(of_steps.chain(of_methods));
    let needed = estimates.iter().map(|estimate| estimate.disk_bytes).sum();
    let of_disk = room::warning(Path::new("results"), needed);
    let mut warnings = specimen::warnings(&laid);
    let most_ranks = plan
        .cases
        .iter()
        .filter_map(|planned| planned.case.execution.ranks)
        .max();
    let of_ranks = most_ranks.and_then(warnings::of_ranks);
    warnings.extend(of_runs.into_iter().chain(of_ranks).chain(of_disk));
    let json = json!({ "study": plan.study, "cases": cases, "warnings": warnings });
    let terminal = Terminal {
        quiet: false,
        json: common.json,
    };
    terminal.result(&json, || {
        let mut rows = vec![HEAD.map(str::to_owned).to_vec()];
        rows.extend(sized.iter().map(|(name, estimate)| row(name, estimate)));
        let total: f64 = estimates.iter().map(|estimate| estimate.seconds).sum();
        format!(
            "{}\n{NOTES}\n{}\n{}{}: no mistakes; {}, about {} on one core\n",
            format::table(&rows),
            specimen::tables(&laid),
            warnings
                .iter()
                .map(|warning| format!("{warning}\n"))
                .collect::<String>(),
            plan.study,
            format::count(plan.cases.len(), "case"),
            format::duration(total)
        )
    })?;
    Ok(0)
}

/// What the heads of the columns have no room for.
const NOTES: &str = "disk: pictures, series and checkpoint, at most; about: wall time on one core
";

const HEAD: [&str; 9] = [
    "case",
    "nodes",
    "elements",
    "atoms",
    "steps",
    "time step / limit",
    "memory",
    "disk",
    "about",
];

/// Share of the limit of the crystal at rest above which a breaking one is likely to undercut the time step.
const RISKY: f64 = 0.9;

fn warning(estimate: &Estimate) -> Option<String> {
    let share = estimate.time_step / estimate.stability_limit;
    (share > RISKY).then(|| {
        format!(
            "the time step is {:.0} % of the limit of the crystal at rest; what collides behind a crack is \
             stiffer, and the run may end there: `time-step: auto` takes half of it",
            100.0 * share
        )
    })
}

fn row(name: &str, estimate: &Estimate) -> Vec<String> {
    vec![
        name.to_owned(),
        estimate.nodes.to_string(),
        estimate.elements.to_string(),
        estimate.represented_atoms.to_string(),
        estimate.steps.to_string(),
        format!(
            "{:.3} / {:.3} fs",
            1e3 * estimate.time_step,
            1e3 * estimate.stability_limit
        ),
        format::bytes(estimate.memory_bytes),
        format::bytes(estimate.disk_bytes),
        format::duration(estimate.seconds),
    ]
}

fn to_json(planned: &PlannedCase, estimate: &Estimate) -> serde_json::Value {
    let mut json = json!({
        "case": planned.name,
        "nodes": estimate.nodes,
        "elements": estimate.elements,
        "represented_atoms": estimate.represented_atoms,
        "leftover_share": estimate.specimen.leftover_share(),
        "specimen": specimen::to_json(&estimate.specimen),
        "steps": estimate.steps,
        "time_step_ps": estimate.time_step,
        "stability_limit_ps": estimate.stability_limit,
        "memory_bytes": estimate.memory_bytes,
        "disk_bytes": estimate.disk_bytes,
        "estimated_s": estimate.seconds,
    });
    if !planned.swept.is_empty() {
        json["swept"] = survey::swept(planned);
    }
    json
}
