//! Crack speed over time with what happens to it: one chart a case whose crack starts.

use crate::analysis::waves::{Arrival, Face, Wave};
use crate::report::Analysed;
use crate::report::chart::{Chart, Content, Curve};
use crate::report::palette;
use crate::report::tables::first_branch::{self, at_running_tip};
use crate::report::tables::wave_arrival::{path_name, wave_name};

/// Time before the start that is shown, and after the last event, as shares of the time of that.
const BEFORE: f64 = 0.1;
const BEYOND: f64 = 0.4;

/// Styles of the other lines: in colours that no wave has.
const START: usize = palette::style(4, 0);
const BRANCH: usize = palette::style(1, 1);
const LEAVES_PLANE: usize = palette::style(6, 1);

/// One colour a wave and one dash a face, in all figures.
fn style(arrival: &Arrival) -> usize {
    let color = match arrival.wave {
        Wave::Longitudinal => 2,
        Wave::Transverse => 3,
        Wave::Rayleigh => 5,
    };
    let dash = match arrival.face {
        Face::Left | Face::Right => 2,
        Face::TopAndBottom => 3,
    };
    palette::style(color, dash)
}

/// A chart for every case in which the crack starts, and leaves its plane, branches or meets a wave.
pub fn charts(cases: &[Analysed]) -> Vec<Chart> {
    cases.iter().filter_map(chart).collect()
}

fn chart(case: &Analysed) -> Option<Chart> {
    let start = case.findings.initiation?.time;
    let marks = [
        (LEAVES_PLANE, "leaves the plane", first_branch::leaves_after_start(case)),
        (BRANCH, "first branch", first_branch::after_start(case)),
    ];
    let rayleigh = case.rayleigh_speed()?;
    let mut arrivals: Vec<(&Arrival, f64)> = at_running_tip(case).collect();
    arrivals.sort_by(|a, b| a.1.total_cmp(&b.1));
    let times = arrivals.iter().map(|arrival| arrival.1);
    let last = times.chain(marks.iter().filter_map(|mark| mark.2)).reduce(f64::max)?;
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
        ..Curve::default()
    };
    let mut curves = vec![
        Curve {
            label: "speed".to_owned(),
            style: 0,
            points: speed,
            spread,
            ..Curve::default()
        },
        mark(START, "start".to_owned(), 0.0),
    ];
    let marks = marks.into_iter();
    curves.extend(marks.filter_map(|(style, label, time)| Some(mark(style, label.to_owned(), time?))));
    let waves = arrivals.into_iter().map(|(arrival, time)| {
        let from = path_name(arrival).replace(" faces", "").replace(" face", "");
        mark(style(arrival), format!("{}, {from}", wave_name(arrival)), time)
    });
    curves.extend(waves);
    Some(Chart {
        id: format!("arrivals-{}", case.file_part()),
        detail: false,
        table: "crack_speed",
        title: format!("Crack speed of {}, branching and returning waves", case.name()),
        caption: "Speed of the foremost tip over the Rayleigh speed; time counts from the start of the crack. Vertical lines: \
                  its start, when it leaves its plane and its first branch if it has them, and when waves \
                  sent out at the start are back at the running tip by their speeds; those that come after the end of the run \
                  are not shown. A wave has one colour, a face one kind of line. The band is the standard error of the speed."
            .to_owned(),
        x: "time after the crack starts (ps)".to_owned(),
        y: "crack speed / c_R".to_owned(),
        content: Content::Curves(curves),
    })
}
