//! The sweep of a study as axes: each a list of points, each point a change laid over a case.

use super::swept::{self, Swept, SweptValue};
use super::{label, range};
use crate::study::{CaseFile, Finding, Findings, Given, Name, Node, Place, Sweep, Value, read_tree};

/// What varies together: one path, or the paths of a `zip` group.
pub struct Axis {
    pub points: Vec<Point>,
}

pub struct Point {
    /// Part of the name of the case: `element-10`.
    pub name: String,
    pub place: Place,
    pub changes: Vec<Given<CaseFile>>,
    pub swept: Vec<Swept>,
}

/// One path with its values, before they are read as a change of a case.
struct Path<'a> {
    name: &'a str,
    place: Place,
    values: Vec<Node>,
}

/// The axes in the order of the file. Wrong paths, values and groups go to `findings` and are left out.
pub fn axes(sweep: &Sweep, findings: &Findings) -> Vec<Axis> {
    let mut groups: Vec<Vec<Path>> = Vec::new();
    for (path, node) in &sweep.0 {
        if path.text == "zip" {
            zip_groups(path, node, findings, &mut groups);
        } else {
            groups.extend(read_path(&path.text, path.place, node, findings).map(|path| vec![path]));
        }
    }
    let paths: Vec<&str> = groups.iter().flatten().map(|path| path.name).collect();
    let short = |path: &str| {
        let last = last_word(path);
        let unique = paths.iter().filter(|other| last_word(other) == last).count() == 1;
        if unique {
            last.to_owned()
        } else {
            path.replace('.', "-")
        }
    };
    let numbered = groups.iter().enumerate();
    numbered
        .map(|(number, group)| axis(number, group, &short, findings))
        .collect()
}

fn last_word(path: &str) -> &str {
    path.rsplit('.').next().unwrap_or(path)
}

/// `zip: {path: […], path: […]}`, or a list of such groups.
fn zip_groups<'a>(zip: &Name, node: &'a Node, findings: &Findings, groups: &mut Vec<Vec<Path<'a>>>) {
    let found: Vec<&Node> = match &node.value {
        Value::List(items) => items.iter().collect(),
        _ => vec![node],
    };
    for group in found {
        let Value::Map(entries) = &group.value else {
            let message = "expected a group of paths that go in step";
            let help = "write `zip: {specimen.length: [566 nm, 1127 nm], crack.length: [225 nm, 450 nm]}`";
            findings.add(Finding::at(group.place, message).help(help));
            continue;
        };
        let paths: Vec<Path> = entries
            .iter()
            .filter_map(|(key, values)| read_path(key.text(), key.place, values, findings))
            .collect();
        if let Some(first) = paths.first()
            && let Some(other) = paths.iter().find(|path| path.values.len() != first.values.len())
        {
            let message = format!(
                "the paths of a zip group go in step, but `{}` has {} and `{}` {}",
                first.name,
                values(first.values.len()),
                other.name,
                values(other.values.len())
            );
            findings.add(
                Finding::at(other.place, message)
                    .with(first.place, "other length")
                    .help("make the lists equally long"),
            );
            continue;
        }
        if paths.is_empty() {
            findings.add(Finding::at(zip.place, "this zip group has no paths").help("remove it"));
            continue;
        }
        groups.push(paths);
    }
}

fn values(number: usize) -> String {
    if number == 1 {
        "1 value".into()
    } else {
        format!("{number} values")
    }
}

fn read_path<'a>(name: &'a str, place: Place, node: &'a Node, findings: &Findings) -> Option<Path<'a>> {
    let values = match &node.value {
        Value::List(items) if !items.is_empty() => Ok(items.clone()),
        Value::Map(keys) => match keys.first() {
            // What is below a section is swept by its path.
            Some((
                key,
                Node {
                    value: Value::List(_) | Value::Map(_),
                    ..
                },
            )) => {
                let message = format!("`{name}` is swept by the paths of what is in it");
                let help = format!("write `{name}.{}: […]`", swept_below(keys));
                Err(Finding::at(key.place, message).help(help))
            }
            _ => range::values(node),
        },
        _ => Err(Finding::at(node.place, format!("`{name}` needs the values it takes"))
            .help("write a list such as [5, 10, 20], or {from: 0.1, to: 0.5, step: 0.1}")),
    };
    match values {
        Ok(values) => Some(Path { name, place, values }),
        Err(finding) => {
            findings.add(finding);
            None
        }
    }
}

/// The path from a section to the first list in it.
fn swept_below(keys: &[(Node, Node)]) -> String {
    let Some((key, node)) = keys.first() else {
        return String::new();
    };
    match &node.value {
        Value::Map(inner) if !inner.iter().any(|(key, _)| key.text() == "from") => {
            format!("{}.{}", key.text(), swept_below(inner))
        }
        _ => key.text().to_owned(),
    }
}

fn axis(number: usize, group: &[Path], short: &dyn Fn(&str) -> String, findings: &Findings) -> Axis {
    let length = group.first().map_or(0, |path| path.values.len());
    let labels: Vec<Vec<String>> = group.iter().map(|path| label::all(&path.values)).collect();
    let measured: Vec<Vec<SweptValue>> = group.iter().map(|path| swept::values(&path.values)).collect();
    let point = |index: usize| {
        let parts: Vec<String> = group
            .iter()
            .zip(&labels)
            .map(|(path, labels)| format!("{}-{}", short(path.name), labels[index]))
            .collect();
        let changes = group
            .iter()
            .map(|path| read_tree(&change(path, &path.values[index]), findings))
            .collect();
        Point {
            name: parts.join("-"),
            place: group[0].values[index].place,
            changes,
            swept: group
                .iter()
                .zip(&measured)
                .map(|(path, values)| Swept {
                    path: path.name.to_owned(),
                    axis: number,
                    value: values[index].clone(),
                })
                .collect(),
        }
    };
    Axis {
        points: (0..length).map(point).collect(),
    }
}

/// `a.b: value` written out as `{a: {b: value}}`; each word keeps its place within the path.
fn change(path: &Path, value: &Node) -> Node {
    // A quoted path has its quotes around it, and an alias stands elsewhere: then words cannot be told apart.
    let plain = path.place.end - path.place.start == path.name.len();
    let mut end = path.name.len();
    let mut node = value.clone();
    for word in path.name.rsplit('.') {
        let start = end - word.len();
        let place = if plain {
            Place {
                start: path.place.start + start,
                end: path.place.start + end,
            }
        } else {
            path.place
        };
        node = Node {
            place,
            value: Value::Map(vec![(Node::word(word, place), node)]),
        };
        end = start.saturating_sub(1);
    }
    node
}
