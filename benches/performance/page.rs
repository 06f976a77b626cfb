//! Tables as files, and the page that shows them.

use std::fs;
use std::path::{Path, PathBuf};

use super::clock;

/// Where the numbers are kept.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("reports/performance")
}

/// Where runs may leave what they compute.
pub fn scratch() -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/performance");
    fs::create_dir_all(&folder).expect("the scratch folder can be written");
    folder
}

fn file(table: &str) -> PathBuf {
    folder().join(format!("{table}.csv"))
}

/// Rows of a table, its head first; none if it was never written.
pub fn read(table: &str) -> Vec<Vec<String>> {
    let Ok(text) = fs::read_to_string(file(table)) else {
        return Vec::new();
    };
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .from_reader(text.as_bytes());
    let rows = reader.records().map(|row| row.expect("the table is sound"));
    rows.map(|row| row.iter().map(str::to_owned).collect()).collect()
}

pub fn write(table: &str, head: &[&str], rows: &[Vec<String>]) {
    fs::create_dir_all(folder()).expect("reports can be written");
    let mut writer = csv::Writer::from_path(file(table)).expect("reports can be written");
    writer.write_record(head).expect("reports can be written");
    rows.iter()
        .for_each(|row| writer.write_record(row).expect("reports can be written"));
    writer.flush().expect("reports can be written");
}

/// Three significant digits, thousands apart.
pub fn number(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let decimals = (2 - value.abs().log10().floor() as i32).max(0) as usize;
    let text = format!("{value:.decimals$}");
    let (whole, part) = text
        .split_once('.')
        .map_or((text.as_str(), ""), |(whole, part)| (whole, part.trim_end_matches('0')));
    let grouped: String = whole
        .chars()
        .enumerate()
        .flat_map(|(k, digit)| {
            let gap = (k > 0 && (whole.len() - k).is_multiple_of(3)).then_some(',');
            gap.into_iter().chain([digit])
        })
        .collect();
    if part.is_empty() {
        grouped
    } else {
        format!("{grouped}.{part}")
    }
}

/// On what was measured.
pub fn write_machine() {
    let processor = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = processor.lines().find(|line| line.starts_with("model name"));
    let model = model
        .and_then(|line| line.split_once(": "))
        .map_or("unknown", |(_, name)| name);
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let rows = [
        ["processor", model],
        ["cores", &cores.to_string()],
        [
            "programs that wanted to run at the start",
            &format!("{:.1}", clock::load()),
        ],
        ["commit", &commit()],
    ];
    write(
        "machine",
        &["machine", ""],
        &rows.map(|row| row.map(str::to_owned).to_vec()),
    );
}

fn commit() -> String {
    let output = std::process::Command::new("git")
        .args(["describe", "--always", "--dirty"])
        .output();
    output.map_or_else(
        |_| "unknown".to_owned(),
        |output| String::from_utf8_lossy(&output.stdout).trim().to_owned(),
    )
}

/// Puts the tables into the page, each between `<!-- table NAME -->` and `<!-- end -->`.
pub fn refresh() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/performance.md");
    let Ok(text) = fs::read_to_string(&path) else { return };
    let mut page = String::new();
    let mut rest = text.as_str();
    while let Some((before, after)) = rest.split_once("<!-- table ") {
        let (name, after) = after.split_once(" -->").expect("a table has a name");
        let (_, after) = after.split_once("<!-- end -->").expect("a table has an end");
        page.push_str(&format!(
            "{before}<!-- table {name} -->\n{}<!-- end -->",
            markdown(&read(name))
        ));
        rest = after;
    }
    page.push_str(rest);
    fs::write(&path, page).expect("the page can be written");
}

fn markdown(rows: &[Vec<String>]) -> String {
    let line = |row: &Vec<String>| format!("| {} |\n", row.join(" | "));
    let mut lines: Vec<String> = rows.iter().map(line).collect();
    if let Some(head) = rows.first() {
        lines.insert(1, format!("|{}\n", " --- |".repeat(head.len())));
    }
    lines.concat()
}
