//! Cases whose elements become atoms on the way.

use super::Analysed;
use super::numbers::count;

/// Whether the mesh of a case has changed.
pub fn is_refined(case: &Analysed) -> bool {
    let nodes = case.result.series.probes.iter().map(|row| row.nodes);
    nodes.clone().zip(nodes.skip(1)).any(|(before, after)| after > before)
}

/// `Beware: the crack of refined outran its refinement: …`
pub fn outrun(case: &Analysed) -> Option<String> {
    let outruns = case.result.series.probes.last()?.outruns;
    let times = (outruns > 0.0).then(|| count(outruns as u64))?;
    Some(format!(
        "Beware: the crack of {} outran its refinement: {times} interfaces between elements opened before these had become \
         atoms. Where it did, elements have carried it, which open late and along their edges.",
        case.name()
    ))
}
