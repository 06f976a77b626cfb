//! Numbers and tables as people read them.

/// `< 0.1 s`, `0.4 s`, `42 s`, `3 min 20 s`, `2 h 5 min`.
pub fn duration(seconds: f64) -> String {
    let whole = seconds.round() as u64;
    match whole {
        _ if seconds < 0.05 => "< 0.1 s".to_owned(),
        _ if seconds < 9.95 => format!("{seconds:.1} s"),
        0..=59 => format!("{whole} s"),
        60..=3599 => format!("{} min {} s", whole / 60, whole % 60),
        _ => format!("{} h {} min", whole / 3600, whole % 3600 / 60),
    }
}

/// `none`, `< 0.1 %`, `1.4 %`.
pub fn share(share: f64) -> String {
    match 100.0 * share {
        0.0 => "none".to_owned(),
        percent if percent < 0.05 => "< 0.1 %".to_owned(),
        percent => format!("{percent:.1} %"),
    }
}

/// `640 B`, `3.2 MB`.
pub fn bytes(bytes: u64) -> String {
    const UNITS: [&str; 4] = ["kB", "MB", "GB", "TB"];
    if bytes < 1000 {
        return format!("{bytes} B");
    }
    let mut amount = bytes as f64 / 1000.0;
    let mut unit = 0;
    while amount >= 1000.0 && unit + 1 < UNITS.len() {
        amount /= 1000.0;
        unit += 1;
    }
    format!("{amount:.1} {}", UNITS[unit])
}

/// Columns side by side, the first to the left, the others to the right; no trailing spaces.
pub fn table(rows: &[Vec<String>]) -> String {
    columns(rows, |column| column > 0)
}

/// Columns side by side, all to the left.
pub fn list(rows: &[Vec<String>]) -> String {
    columns(rows, |_| false)
}

fn columns(rows: &[Vec<String>], to_the_right: impl Fn(usize) -> bool) -> String {
    let length = |cell: &String| cell.chars().count();
    let count = rows.iter().map(Vec::len).max().unwrap_or(0);
    let widths: Vec<usize> = (0..count)
        .map(|column| {
            rows.iter()
                .filter_map(|row| row.get(column))
                .map(length)
                .max()
                .unwrap_or(0)
        })
        .collect();
    let mut text = String::new();
    for row in rows {
        let cells = row.iter().zip(&widths).enumerate().map(|(column, (cell, &width))| {
            if to_the_right(column) {
                format!("{cell:>width$}")
            } else {
                format!("{cell:<width$}")
            }
        });
        text.push_str(cells.collect::<Vec<_>>().join("  ").trim_end());
        text.push('\n');
    }
    text
}

/// "1 case", "2 cases".
pub fn count(number: usize, word: &str) -> String {
    format!("{number} {word}{}", if number == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amounts_read_as_people_say_them() {
        assert_eq!(
            [0.01, 0.41, 9.9, 42.4, 200.0, 7500.0].map(duration),
            ["< 0.1 s", "0.4 s", "9.9 s", "42 s", "3 min 20 s", "2 h 5 min"]
        );
        assert_eq!([0.0, 0.0003, 0.0141].map(share), ["none", "< 0.1 %", "1.4 %"]);
        assert_eq!(
            [640, 3_210_000, 5_000_000_000].map(bytes),
            ["640 B", "3.2 MB", "5.0 GB"]
        );
    }

    #[test]
    fn columns_line_up() {
        let rows = [
            vec!["case".to_owned(), "nodes".to_owned()],
            vec!["A".to_owned(), "12".to_owned()],
        ];
        assert_eq!(table(&rows), "case  nodes\nA        12\n");
        assert_eq!(list(&rows), "case  nodes\nA     12\n");
    }
}
