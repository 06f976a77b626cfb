//! Numbers and tables as people read them.

use comfy_table::CellAlignment;

pub use crate::units::amounts::{bytes, duration};

/// `none`, `< 0.1 %`, `1.4 %`.
pub fn share(share: f64) -> String {
    match 100.0 * share {
        0.0 => "none".to_owned(),
        percent if percent < 0.05 => "< 0.1 %".to_owned(),
        percent => format!("{percent:.1} %"),
    }
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
    const BETWEEN: u16 = 2;
    let mut table = comfy_table::Table::new();
    table.load_preset(comfy_table::presets::NOTHING).add_rows(rows);
    for (index, column) in table.column_iter_mut().enumerate() {
        column.set_padding((if index == 0 { 0 } else { BETWEEN }, 0));
        if to_the_right(index) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    table.trim_fmt() + "\n"
}

/// "1 case", "2 cases".
pub fn count(number: usize, word: &str) -> String {
    format!("{number} {word}{}", if number == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_read_as_people_say_them() {
        assert_eq!([0.0, 0.0003, 0.0141].map(share), ["none", "< 0.1 %", "1.4 %"]);
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
