//! House rules that a compiler does not check.

mod circles;

use std::fs;
use std::path::{Path, PathBuf};

/// A module imports only from the floors below its own.
const FLOORS: [&[&str]; 10] = [
    &["units", "lanes", "durable"],
    &["lattice", "potential", "study"],
    &["mesh", "material", "plan"],
    &["state", "domain", "store"],
    &["forces", "integrator", "loading", "analysis", "executor"],
    &["relaxation"],
    &["solver"],
    &["record"],
    &["setup", "export", "report"],
    &["cli"],
];

/// What stands for a crate or a system service in the text of a source file, and the modules that may use it.
const OWNERS: [(&str, &[&str]); 16] = [
    ("polars", &["report"]),
    ("plotters", &["report"]),
    ("colorous", &["report"]),
    ("hdf5::", &["record"]),
    ("serde_saphyr", &["study"]),
    ("csv::", &["plan"]),
    ("use mpi::", &["domain"]),
    ("rustix", &["domain"]),
    ("Command::new(", &["executor"]),
    ("remove_dir", &["store"]),
    ("fs::rename", &["durable", "store"]),
    // What is read must have an end, which `durable` sees to.
    ("File::open(", &["durable"]),
    ("fs::read(", &["durable"]),
    ("fs::read_to_string(", &["durable"]),
    ("println!", &[]),
    ("process::exit", &[]),
];

const FORBIDDEN: [&str; 11] = [
    "/home/",
    "/tmp",
    "/root/",
    "/work/",
    "TODO",
    "FIXME",
    "XXX",
    "todo!",
    "unimplemented!",
    "dbg!",
    "#[ignore",
];

const LONGEST_FILE: usize = 400;
const LONGEST_ARCHITECTURE: usize = 200;

struct Source {
    /// Relative to the repository.
    path: PathBuf,
    text: String,
}

impl Source {
    /// Top-level module; `None` for the crate root and the binaries.
    fn module(&self) -> Option<String> {
        let inside = self.path.strip_prefix("src").ok()?;
        let first = inside.components().next()?.as_os_str().to_str()?;
        let name = first.strip_suffix(".rs").unwrap_or(first);
        (!["lib", "bin"].contains(&name)).then(|| name.to_owned())
    }

    /// The text without comments and unit tests.
    fn code(&self) -> String {
        if self.path.file_name().is_some_and(|name| name == "tests.rs") {
            return String::new();
        }
        let without_tests = self.text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        let lines = without_tests
            .lines()
            .map(|line| line.split("//").next().unwrap_or_default());
        lines.collect::<Vec<_>>().join("\n")
    }

    /// Everything that is a test.
    fn tests(&self) -> &str {
        let is_test = self.path.starts_with("tests") || self.path.file_name().is_some_and(|name| name == "tests.rs");
        if is_test {
            &self.text
        } else {
            self.text.split_once("#[cfg(test)]").map_or("", |(_, tests)| tests)
        }
    }
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Every Rust file below a folder.
fn sources(folder: &str) -> Vec<Source> {
    let mut found = Vec::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = fs::read_to_string(&path).unwrap();
                found.push(Source {
                    path: path.strip_prefix(root()).unwrap().to_owned(),
                    text,
                });
            }
        }
    }
    assert!(!found.is_empty(), "no sources in {folder}");
    found
}

fn floor(module: &str) -> Option<usize> {
    FLOORS.iter().position(|modules| modules.contains(&module))
}

/// Modules of this crate that a text names, as `crate::module` or `crate::{module, …}`.
fn imports(code: &str) -> Vec<String> {
    let mut modules = Vec::new();
    for (at, _) in code.match_indices("crate::") {
        // `$crate::` and names such as `my_crate::` are something else.
        if code[..at].ends_with(|letter: char| letter.is_alphanumeric() || letter == '_') {
            continue;
        }
        let rest = &code[at + "crate::".len()..];
        match rest.strip_prefix('{') {
            Some(group) => modules.extend(group_heads(group)),
            None => modules.extend(identifier(rest)),
        }
    }
    modules
}

/// First names in `a::b, c::{d, e}, f}…`.
fn group_heads(group: &str) -> Vec<String> {
    let mut depth = 0;
    let mut at_head = true;
    let mut heads = Vec::new();
    for (at, letter) in group.char_indices() {
        match letter {
            '}' if depth == 0 => break,
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => at_head = true,
            _ if at_head && !letter.is_whitespace() => {
                heads.extend(identifier(&group[at..]));
                at_head = false;
            }
            _ => {}
        }
    }
    heads
}

fn identifier(text: &str) -> Option<String> {
    let end = text
        .find(|letter: char| !letter.is_alphanumeric() && letter != '_')
        .unwrap_or(text.len());
    (end > 0).then(|| text[..end].to_owned())
}

/// `super::super::` that leads out of the top-level module.
fn climbs_out(source: &Source, code: &str) -> bool {
    let depth = source.path.components().count() - 1;
    code.contains(&"super::".repeat(depth))
}

#[test]
fn imports_go_down_only() {
    let mut complaints = Vec::new();
    for source in sources("src") {
        let Some(module) = source.module() else { continue };
        let path = source.path.display();
        let Some(own_floor) = floor(&module) else {
            complaints.push(format!(
                "{path}: module `{module}` stands on no floor; add it to ARCHITECTURE.md and here"
            ));
            continue;
        };
        let code = source.code();
        if climbs_out(&source, &code) {
            complaints.push(format!("{path}: leaves its module by `super::`; write `crate::`"));
        }
        for import in imports(&code).into_iter().filter(|import| *import != module) {
            match floor(&import) {
                Some(floor) if floor < own_floor => {}
                Some(floor) => complaints.push(format!(
                    "{path}: `{module}` (floor {own_floor}) imports `{import}` (floor {floor}); only floors below may be used"
                )),
                None => complaints.push(format!("{path}: imports unknown module `{import}`")),
            }
        }
    }
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
}

#[test]
fn imports_are_found_however_they_are_written() {
    let code = "use crate::store::Store;\nuse crate::{plan::{self, Plan}, study};\nlet x = crate::units::parse();";
    assert_eq!(imports(code), ["store", "plan", "study", "units"]);
    assert!(imports("$crate::x; my_crate::y").iter().all(|module| module == "x"));
}

#[test]
fn each_crate_and_service_has_one_home() {
    let mut complaints = Vec::new();
    for source in sources("src") {
        let module = source.module().unwrap_or_default();
        let code = source.code();
        for (word, owners) in OWNERS {
            if !owners.contains(&module.as_str()) && code.contains(word) {
                let owners = if owners.is_empty() {
                    "nobody".to_owned()
                } else {
                    owners.join(", ")
                };
                complaints.push(format!(
                    "{}: `{word}` may be used by {owners} only",
                    source.path.display()
                ));
            }
        }
    }
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
}

#[test]
fn files_are_short_and_finished() {
    let mut complaints = Vec::new();
    for source in sources("src").iter().chain(&sources("tests")) {
        let path = source.path.display();
        let lines = source.text.lines().count();
        if lines > LONGEST_FILE {
            complaints.push(format!(
                "{path}: {lines} lines; split it by idea (at most {LONGEST_FILE})"
            ));
        }
        if source.path.starts_with("src") {
            let found = FORBIDDEN.iter().filter(|word| source.text.contains(**word));
            complaints.extend(found.map(|word| format!("{path}: contains `{word}`")));
        }
    }
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
}

#[test]
fn the_architecture_page_is_short_and_names_every_module() {
    let page = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    assert!(
        page.lines().count() < LONGEST_ARCHITECTURE,
        "it must stay readable in one sitting"
    );
    for source in sources("src") {
        if let Some(module) = source.module() {
            assert!(page.contains(&format!("`{module}`")), "it does not name `{module}`");
        }
    }
}

/// `[Deng2011] Eq. (3-31)` and the like: the source, the kind of place and its number.
fn source_tags(text: &str) -> Vec<String> {
    let mut tags = Vec::new();
    for (at, _) in text.match_indices("[Deng2011]") {
        let words: Vec<&str> = text[at..].split_whitespace().take(3).collect();
        tags.push(words.join(" ").trim_end_matches(['.', ',', ';', ':', '`']).to_owned());
    }
    tags
}

#[test]
fn every_formula_taken_from_the_source_is_tested() {
    let mut sources_and_tests = sources("src");
    sources_and_tests.extend(sources("tests"));
    let tested: Vec<String> = sources_and_tests
        .iter()
        .flat_map(|source| source_tags(source.tests()))
        .collect();
    let mut complaints = Vec::new();
    for source in sources("src") {
        for tag in source_tags(&source.text) {
            if !tested.contains(&tag) {
                complaints.push(format!("{}: no test mentions {tag}", source.path.display()));
            }
        }
    }
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
}
