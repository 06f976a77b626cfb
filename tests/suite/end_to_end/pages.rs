//! The pages of `docs` that people follow step by step: what stands in them runs.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use super::Workspace;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The blocks of code of a page: the language, and the text.
fn blocks(page: &str) -> Vec<(String, String)> {
    let text = fs::read_to_string(root().join("docs").join(page)).unwrap();
    let fenced = text.split("\n```").enumerate().filter(|(index, _)| index % 2 == 1);
    let block = |(_, block): (usize, &str)| {
        let (language, text) = block.split_once('\n').unwrap();
        (language.to_owned(), text.to_owned() + "\n")
    };
    fenced.map(block).collect()
}

/// Runs lines of shell with this cgaft on the PATH.
fn shell(place: &Workspace, lines: &str) -> Output {
    let programs = Path::new(env!("CARGO_BIN_EXE_cgaft")).parent().unwrap();
    let path = format!("{}:{}", programs.display(), std::env::var("PATH").unwrap());
    let output = Command::new("bash")
        .args(["-euc", lines])
        .env("PATH", path)
        .current_dir(place.path(""))
        .output();
    let output = output.unwrap();
    assert!(
        output.status.success(),
        "{lines}{}",
        String::from_utf8_lossy(&output.stderr)
    );
    output
}

fn python() -> PathBuf {
    let python =
        std::env::var_os("CGAFT_TEST_PYTHON").map_or_else(|| root().join("target/python/bin/python"), PathBuf::from);
    assert!(
        python.exists(),
        "there is no {}; `make test-setup` makes it",
        python.display()
    );
    python
}

/// Runs a script and gives what it prints.
fn run_python(place: &Workspace, script: &str) -> String {
    let output = Command::new(python())
        .args(["-c", script])
        .current_dir(place.path(""))
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{script}\n{}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn the_tutorial_leads_from_an_empty_folder_to_a_figure() {
    let place = Workspace::new();
    for (language, text) in blocks("tutorial.md") {
        match language.as_str() {
            "sh" => drop(shell(&place, &text)),
            "yaml" => fs::write(place.path("my-crack.yaml"), text).unwrap(),
            other => panic!("what is to be done with {other}?"),
        }
    }
    let figure = fs::read_to_string(place.path("figure-1.svg")).unwrap();
    assert!(
        figure.contains("width=\"86.00mm\"") && figure.contains("crack.length (nm)"),
        "{figure}"
    );
    let page = fs::read_to_string(place.path("results/my-crack/report.md")).unwrap();
    assert!(page.contains("**Strain at the start of the crack "), "{page}");
}

#[test]
fn the_python_page_reads_what_a_study_has_left() {
    // The study of the page has a refined case where this one has a mixed one, which is done sooner.
    let place = Workspace::new();
    place.cgaft("run", &["--only", "mixed"]).succeeded();
    let own = |text: &str| text.replace("quickstart", "slab").replace("refined", "mixed");
    let mut script = String::new();
    for (language, text) in blocks("python.md") {
        match language.as_str() {
            "sh" if text.contains("pip install") => {}
            "sh" => drop(shell(&place, &own(&text))),
            "python" => script += &own(&text),
            other => panic!("what is to be done with {other}?"),
        }
    }
    let said = run_python(&place, &script);
    for words in [" probes up to ", "σyy up to ", " atoms, ", " sites are single atoms"] {
        assert!(said.contains(words), "no `{words}` in {said}");
    }
}

#[test]
fn ovito_and_ase_see_every_site_of_a_case_with_what_it_carries() {
    const SEEN: &str = r#"
import ase.io, json
from ovito.io import import_file
source = import_file("mixed.xyz")
last = source.compute(source.source.num_frames - 1)
frames = ase.io.read("mixed.xyz", index=":")
atoms = frames[-1]
sizes = atoms.arrays["element_size"]
print(json.dumps({
    "pictures": [source.source.num_frames, len(frames)],
    "sites": [last.particles.count, len(atoms)],
    "sizes": sorted(set(sizes.tolist())),
    "stress": [float(max(last.particles["stress_yy_gpa"])), float(atoms.arrays["stress_yy_gpa"].max())],
    "speed": [float(max(last.particles["speed_m_per_s"])), float(atoms.arrays["speed_m_per_s"].max())],
    "strain": [last.attributes["strain"], atoms.info["strain"]],
}))
"#;
    let place = Workspace::new();
    place.cgaft("run", &["--only", "mixed"]).succeeded();
    shell(&place, "cgaft export ovito slab.yaml --case mixed");
    let seen: serde_json::Value = serde_json::from_str(&run_python(&place, SEEN)).unwrap();
    let sites: u64 = super::table(&place.results(), "summary")[1]["represented_atoms"]
        .parse()
        .unwrap();
    assert_eq!(seen["sites"], serde_json::json!([sites, sites]));
    assert!(seen["sizes"].as_array().unwrap().len() >= 2, "{seen}");
    for both in ["pictures", "stress", "speed", "strain"] {
        assert_eq!(seen[both][0], seen[both][1], "{both}");
        assert!(seen[both][0].as_f64().unwrap() > 0.0, "{both}: {seen}");
    }

    // Who wants single atoms gets fewer; what is not there is told.
    shell(&place, "cgaft export ovito slab.yaml --case mixed --atoms --into alone");
    let alone = fs::read_to_string(place.path("alone/mixed.xyz")).unwrap();
    assert!(alone.lines().next().unwrap().parse::<u64>().unwrap() < sites);
    let refused = Command::new(env!("CARGO_BIN_EXE_cgaft"))
        .args(["export", "ovito", "slab.yaml", "--case", "atoms"])
        .current_dir(place.path(""))
        .output()
        .unwrap();
    assert_eq!(refused.status.code(), Some(2));
    assert!(
        String::from_utf8_lossy(&refused.stderr)
            .contains("case `atoms` is not done; `cgaft study run slab.yaml --only atoms`")
    );
}
