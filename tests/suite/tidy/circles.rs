//! No two files import each other, and no more of them do in a circle.
//!
//! A file may use what stands in the file of its folder (`super::`), which in turn names it: that is no circle.

use std::collections::{BTreeMap, BTreeSet};

use super::{Source, sources};

/// A file as the compiler names it: `report::tables` is `["report", "tables"]`.
type Module = Vec<String>;

fn module(source: &Source) -> Module {
    let inside = source.path.strip_prefix("src").unwrap().with_extension("");
    inside.iter().map(|part| part.to_str().unwrap().to_owned()).collect()
}

/// The paths that a text uses: those of its `use` lines, and those that begin with `super` or `crate` elsewhere.
fn paths(code: &str) -> Vec<Module> {
    let mut found = Vec::new();
    for (at, _) in code.match_indices("use ") {
        let before = code[..at].rsplit('\n').next().unwrap_or_default().trim();
        if before.is_empty() || before.starts_with("pub") {
            let end = code[at..].find(';').map_or(code.len(), |end| at + end);
            expand(code[at + "use ".len()..end].trim(), &[], &mut found);
        }
    }
    // A file may use what stands below it without naming it in a `use`.
    let below = code
        .lines()
        .filter_map(|line| line.rsplit_once("mod ")?.1.strip_suffix(';'));
    found.extend(below.map(|name| vec![name.to_owned()]));
    for head in ["super::", "crate::"] {
        for (at, _) in code.match_indices(head) {
            let is_inside =
                code[..at].ends_with(|letter: char| letter.is_alphanumeric() || letter == '_' || letter == ':');
            if !is_inside {
                let end = code[at..].find(|letter: char| !letter.is_alphanumeric() && letter != '_' && letter != ':');
                let path = &code[at..end.map_or(code.len(), |end| at + end)];
                found.push(
                    path.split("::")
                        .filter(|part| !part.is_empty())
                        .map(str::to_owned)
                        .collect(),
                );
            }
        }
    }
    found
}

/// `a::{b, c::{d, e}}` is `a::b`, `a::c::d` and `a::c::e`.
fn expand(tree: &str, before: &[String], found: &mut Vec<Module>) {
    let (head, group) = tree.split_once('{').unwrap_or((tree, ""));
    let name = head.split(" as ").next().unwrap_or_default();
    let mut path = before.to_vec();
    path.extend(
        name.split("::")
            .map(str::trim)
            .filter(|part| !part.is_empty() && *part != "self")
            .map(str::to_owned),
    );
    if group.is_empty() {
        found.push(path);
        return;
    }
    let (mut depth, mut start) = (0, 0);
    for (at, letter) in group.char_indices() {
        match letter {
            '{' => depth += 1,
            '}' if depth == 0 => {
                expand(group[start..at].trim(), &path, found);
                break;
            }
            '}' => depth -= 1,
            ',' if depth == 0 => {
                expand(group[start..at].trim(), &path, found);
                start = at + 1;
            }
            _ => {}
        }
    }
}

/// The file that a path leads to, seen from a file.
fn target(path: &Module, from: &Module, files: &BTreeSet<Module>) -> Option<Module> {
    let mut absolute = match path.first()?.as_str() {
        "crate" => Vec::new(),
        _ => from.clone(),
    };
    for part in path.iter().filter(|part| *part != "crate") {
        match part.as_str() {
            "super" => drop(absolute.pop()),
            _ => absolute.push(part.clone()),
        }
    }
    while !absolute.is_empty() && !files.contains(&absolute) {
        absolute.pop();
    }
    (!absolute.is_empty() && !from.starts_with(&absolute)).then_some(absolute)
}

/// The first circle of files found, each of which imports the next.
fn circle(texts: &BTreeMap<Module, String>) -> Option<Vec<Module>> {
    let files: BTreeSet<Module> = texts.keys().cloned().collect();
    let arrows: BTreeMap<&Module, BTreeSet<Module>> = texts
        .iter()
        .map(|(file, code)| {
            (
                file,
                paths(code)
                    .iter()
                    .filter_map(|path| target(path, file, &files))
                    .collect(),
            )
        })
        .collect();
    let mut done = BTreeSet::new();
    fn visit(
        file: &Module,
        arrows: &BTreeMap<&Module, BTreeSet<Module>>,
        way: &mut Vec<Module>,
        done: &mut BTreeSet<Module>,
    ) -> Option<Vec<Module>> {
        if let Some(at) = way.iter().position(|earlier| earlier == file) {
            return Some(way[at..].to_vec());
        }
        if !done.insert(file.clone()) {
            return None;
        }
        way.push(file.clone());
        let found = arrows[file].iter().find_map(|next| visit(next, arrows, way, done));
        way.pop();
        found
    }
    files
        .iter()
        .find_map(|file| visit(file, &arrows, &mut Vec::new(), &mut done))
}

#[test]
fn files_do_not_import_each_other() {
    let texts = sources("src")
        .iter()
        .map(|source| (module(source), source.code()))
        .collect();
    let names = |circle: Vec<Module>| {
        circle
            .iter()
            .map(|file| file.join("::"))
            .collect::<Vec<_>>()
            .join(" -> ")
    };
    assert_eq!(
        circle(&texts).map(names),
        None,
        "move what they share into a file below both"
    );
}

#[test]
fn circles_are_found_however_the_imports_are_written() {
    let house = |files: &[(&str, &str)]| {
        let texts = files.iter().map(|(file, code)| {
            let file = file.split("::").map(str::to_owned).collect();
            (file, (*code).to_owned())
        });
        circle(&texts.collect()).map(|circle| circle.len())
    };
    let back = "use super::a;\n";
    for there in [
        "use super::b::Thing;\n",
        "use super::{Other, b::{self, Thing}};\n",
        "pub(super) use crate::{units, report::b::Thing};\n",
        "fn f() { super::b::g() }\n",
    ] {
        assert_eq!(
            house(&[("report", "mod a; mod b;"), ("report::a", there), ("report::b", back)]),
            Some(2),
            "{there}"
        );
    }
    let three = [
        ("report", ""),
        ("report::a", "use super::b::X;\n"),
        ("report::b", "use super::c::Y;\n"),
        ("report::c", "use super::a::Z;\n"),
    ];
    assert_eq!(house(&three), Some(3));
    assert_eq!(house(&three[..3]), None);
    let through_a_parent = [
        ("report", ""),
        ("report::figures", "use super::tables::all;\n"),
        ("report::tables", "pub mod cost;\nfn all() { cost::columns() }\n"),
        ("report::tables::cost", "use crate::report::figures::Chart;\n"),
    ];
    assert_eq!(house(&through_a_parent), Some(3));
    let parent = [("report", "mod a;\nuse a::X;\n"), ("report::a", "use super::Shared;\n")];
    assert_eq!(house(&parent), None, "a folder and its file");
}
