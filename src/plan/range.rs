//! Ranges of a sweep: `{from: 0.1, to: 0.5, step: 0.1}` is exactly 0.1, 0.2, 0.3, 0.4, 0.5, as typed decimals.

use crate::{
    study::{Finding, Node, Value, nearest},
    units::Decimal,
};

const KEYS: [&str; 3] = ["from", "to", "step"];

/// Values of one range; more than this is a slip in the step.
const MOST_VALUES: i128 = 10_000;

/// The values of a range, each a word with the unit of its ends, at the place of the range.
pub fn values(node: &Node) -> Result<Vec<Node>, Finding> {
    let Value::Map(entries) = &node.value else {
        return Ok(Vec::new());
    };
    if let Some((key, _)) = entries.iter().find(|(key, _)| !KEYS.contains(&key.text())) {
        let message = format!("`{}` is not a key of a range", key.text());
        let help = match nearest(key.text(), &KEYS) {
            Some(near) => format!("did you mean `{near}`?"),
            None => HELP.to_owned(),
        };
        return Err(Finding::at(key.place, message).help(help));
    }
    let end = |name: &str| {
        let node = node
            .get(name)
            .ok_or_else(|| Finding::at(node.place, format!("this range has no `{name}`")).help(HELP))?;
        let (number, unit) = Decimal::split(node.text().trim())
            .ok_or_else(|| Finding::at(node.place, format!("`{name}` of a range must be a number")).help(HELP))?;
        Ok((node, number, unit.trim()))
    };
    let ((first, from, unit), (last, to, to_unit), (by, step, step_unit)) = (end("from")?, end("to")?, end("step")?);
    for (node, other) in [(last, to_unit), (by, step_unit)] {
        if other != unit {
            let message = format!(
                "the units of a range must be the same: `{}` and `{}`",
                first.text(),
                node.text()
            );
            return Err(Finding::at(node.place, message)
                .with(first.place, "the other one")
                .help("write all three in one unit"));
        }
    }
    let exponent = from.exponent().min(to.exponent()).min(step.exponent());
    let count = |number: &Decimal, node: &Node| {
        number
            .count(exponent)
            .ok_or_else(|| Finding::at(node.place, "the numbers of this range differ too much in size").help(HELP))
    };
    let (from, to, step) = (count(&from, first)?, count(&to, last)?, count(&step, by)?);
    if step <= 0 || to < from {
        let message = format!(
            "a range goes upwards, and from {} to {} by {} does not",
            first.text(),
            last.text(),
            by.text()
        );
        return Err(
            Finding::at(by.place, message).help("swap its ends or change the sign of the step; a list may go any way")
        );
    }
    let number = (to - from) / step + 1;
    if number > MOST_VALUES {
        let message = format!("this range has {number} values; at most {MOST_VALUES} fit into a study");
        return Err(Finding::at(by.place, message).help("widen the step"));
    }
    let blank = if unit.is_empty() { "" } else { " " };
    let value = |index| format!("{}{blank}{unit}", Decimal::scaled(from + index * step, exponent));
    Ok((0..number).map(|index| Node::word(value(index), node.place)).collect())
}

const HELP: &str = "write {from: 0.1, to: 0.5, step: 0.1}, with a unit where the value needs one";
