//! Speedup and efficiency over ranks.

use super::{Findings, Of, Row};
use crate::plan::SCALING;
use crate::report::chart::ranks::{Line, OverRanks, Style};
use crate::report::chart::{Chart, Content};

/// The charts of a study of scaling.
pub fn charts(findings: &Findings) -> Vec<Chart> {
    if findings.rows.is_empty() {
        return Vec::new();
    }
    let most = findings.rows.iter().map(|row| row.times.ranks).max().unwrap_or(1);
    let speedup = chart(
        "scaling-speedup",
        "Speedup over ranks",
        "Time of one processor for a specimen of the size, over that of so many.",
        "speedup",
        OverRanks {
            lines: lines(findings, "ideal", &[(1, 1.0), (most, f64::from(most))], |row| {
                row.speedup
            }),
            doubles: true,
        },
    );
    let efficiency = chart(
        "scaling-efficiency",
        "Efficiency over ranks",
        "Speedup over the number of ranks.",
        "efficiency",
        OverRanks {
            lines: lines(findings, "ideal", &[(1, 1.0), (most, 1.0)], |row| row.efficiency),
            doubles: false,
        },
    );
    vec![speedup, efficiency]
}

fn chart(id: &str, title: &str, about: &str, y: &str, content: OverRanks) -> Chart {
    Chart {
        id: id.to_owned(),
        detail: false,
        table: SCALING,
        title: title.to_owned(),
        caption: format!(
            "{about} Filled marks are measured; the dashed line is a prediction from the run of one rank, the cut of this mesh \
             and the measured cost of messages; open marks are what the study compares with."
        ),
        x: "ranks".to_owned(),
        y: y.to_owned(),
        content: Content::Ranks(content),
    }
}

fn lines(findings: &Findings, ideal: &str, ideal_points: &[(u32, f64)], value: impl Fn(&Row) -> f64) -> Vec<Line> {
    let mut lines = vec![Line {
        label: ideal.to_owned(),
        style: Style::Ideal,
        points: ideal_points.to_vec(),
    }];
    for row in &findings.rows {
        let (label, style) = match &row.of {
            Of::Case(_) => ("measured", Style::Measured),
            Of::Prediction => ("prediction", Style::Prediction),
            Of::Other(name) => (name.as_str(), Style::Compared),
        };
        let point = (row.times.ranks, value(row));
        match lines.iter_mut().find(|line| line.label == label) {
            Some(line) => line.points.push(point),
            None => lines.push(Line {
                label: label.to_owned(),
                style,
                points: vec![point],
            }),
        }
    }
    lines
}
