//! Crack speed over time with what happens to it: one chart a case whose crack starts.

use super::super::tables::{path_name, wave_name};
use super::super::{Analysed, branching};
use crate::analysis::waves::Arrival;
use crate::report::chart::{Chart, Content, Curve};

/// Time before the start that is shown, and after the last event, as shares of the time of that.
const BEFORE: f64 = 0.1;
const BEYOND: f64 = 0.4;

/// A chart for every case in which the crack starts, and branches or meets a wave.
pub fn charts(cases: &[Analysed]) -> Vec<Chart> {
    let cases = cases.iter().enumerate();
    cases.filter_map(|(index, case)| chart(index, case)).collect()
}

fn chart(index: usize, case: &Analysed) -> Option<Chart> {
    let start = case.findings.initiation?.time;
    let branch = branching::after_start(case);
    let rayleigh = case.rayleigh_speed()?;
    let arrivals = &case.findings.arrivals;
    let last = arrivals.iter().map(Arrival::at_tip).chain(branch).reduce(f64::max)?;
    let rows = case.result.series.probes.iter().zip(&case.findings.speeds);
    let shown = -BEFORE * last..(1.0 + BEYOND) * last;
    let rows = rows.filter(|(row, _)| shown.contains(&(row.time - start)));
    let (speed, spread): (Vec<(f64, f64)>, Vec<f64>) = rows
        .map(|(row, speed)| {
            let [value, error] = speed.map_or([f64::NAN; 2], |speed| [speed.value, speed.error]);
            ((row.time - start, value / rayleigh), error / rayleigh)
        })
        .unzip();
    let top = speed.iter().map(|point| point.1).fold(0.0, f64::max);
    let mark = |style: usize, label: String, time: f64| Curve {
        label,
        style,
        points: vec![(time, 0.0), (time, top)],
        spread: Vec::new(),
    };
    let mut curves = vec![
        Curve {
            label: "speed".to_owned(),
            style: 0,
            points: speed,
            spread,
        },
        mark(4, "start".to_owned(), 0.0),
    ];
    curves.extend(branch.map(|branch| mark(1, "first branch".to_owned(), branch)));
    let styles = [2, 3, 5, 6, 9];
    let mut in_time: Vec<&Arrival> = arrivals.iter().collect();
    in_time.sort_by(|a, b| a.at_tip().total_cmp(&b.at_tip()));
    let waves = in_time.into_iter().zip(styles).map(|(arrival, style)| {
        let from = path_name(arrival).replace(" faces", "").replace(" face", "");
        mark(style, format!("{}, {from}", wave_name(arrival)), arrival.at_tip())
    });
    curves.extend(waves);
    Some(Chart {
        id: format!("arrivals-{index}"),
        detail: false,
        table: "crack_speed",
        title: format!("Crack speed of {}, branching and returning waves", case.name()),
        caption: "Speed of the foremost tip over the Rayleigh speed; time counts from the start of the crack. Vertical lines: \
                  its start, its first branch if it has one, and when waves sent out at the start are back at the running tip by \
                  their speeds. The band is the standard error of the speed."
            .to_owned(),
        x: "time after the crack starts (ps)".to_owned(),
        y: "crack speed / c_R".to_owned(),
        content: Content::Curves(curves),
    })
}
