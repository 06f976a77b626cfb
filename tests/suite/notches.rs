//! Notches from either edge and inside, as the mesh cuts them, as a run follows them and as the analysis sees them.

use std::sync::atomic::AtomicBool;

use cgaft::analysis::crack::{Tip, Tracker};
use cgaft::analysis::frame::Frame;
use cgaft::analysis::path::broken_bonds;
use cgaft::analysis::series::{BondEvent, CrackFrom, Series, Setting};
use cgaft::analysis::stress_intensity::handbook;
use cgaft::analysis::waves::Face;
use cgaft::analysis::{Findings, analyse};
use cgaft::domain::Ranks;
use cgaft::lattice::triangular::NEAREST;
use cgaft::plan::plan;
use cgaft::record::{SERIES_FILE, read_series};
use cgaft::setup::{self, run_case};
use cgaft::solver::Solver;
use cgaft::study::{self, case::Case};

use super::synthetic;

/// Rounding of places in nm.
const EXACT: f64 = 1e-9;

/// Runs that are half turns of each other differ in the order of their sums, which atoms that collide behind a crack make
/// grow: up to its start they are equal to this share, and a tip is where that of the other run is to within so many spacings.
const AT_START: f64 = 1e-3;
const TIP_SPACINGS: f64 = 4.0;
const SPEED_SHARE: f64 = 0.1;
/// Bins of the profile lie otherwise after half a turn, and few of them are in the fit of so small a slab.
const NEAR_TIP_SHARE: f64 = 0.05;

/// The slab of the tests in one case, with this notch, these elements and this end.
fn case(crack: &str, element: u32, until: &str) -> Case {
    let text = std::fs::read_to_string("tests/studies/slab.yaml").expect("it is there");
    let (base, _) = text.split_once("cases:").expect("it has cases");
    let text = base
        .replace("crack: {edge: left, length: 8 nm}", &format!("crack: {crack}"))
        .replace("{strain: 6 %, crack-length: 15 nm}", until)
        + &format!("cases:\n  one: {{resolution: {{element: {element}}}}}\n");
    let read = study::read_text("study.yaml", &text).expect("it can be read");
    let planned = plan(&read).unwrap_or_else(|error| panic!("{crack}: {error}"));
    planned.cases.into_iter().next().expect("it has a case").case
}

fn solver(crack: &str, element: u32) -> Solver {
    let case = case(crack, element, "{strain: 6 %}");
    setup::slab::solver(&case, case.slab().unwrap()).unwrap_or_else(|error| panic!("{crack}: {error}"))
}

fn run(crack: &str, element: u32, until: &str) -> (Setting, Series, Findings) {
    let folder = tempfile::tempdir().expect("there is room");
    let (stop, mut quiet) = (AtomicBool::new(false), |_: &str| ());
    let case = case(crack, element, until);
    run_case(&case, folder.path(), Ranks::alone(), 1, &stop, &mut |_| (), &mut quiet).expect("it runs to its end");
    let (setting, series) = read_series::<Setting>(&folder.path().join(SERIES_FILE)).expect("it is published");
    let findings = analyse(&series, &setting);
    (setting, series, findings)
}

/// Where the middle of the slab of the tests is, from its left edge, nm: what half a turn leaves in place.
fn middle() -> f64 {
    let solver = solver("{length: 8 nm}", 1);
    let sites = &solver.mesh().sites;
    0.5 * (sites.right() - sites.left()) * solver.mesh().spacing
}

/// Every nearest-neighbour bond of a specimen as one that breaks.
fn bonds(solver: &Solver) -> Vec<BondEvent> {
    let sites = &solver.mesh().sites;
    let ends = sites
        .iter()
        .flat_map(|site| (0..3).map(move |direction| (site, direction)));
    let there = ends.filter(|&([column, row], direction)| {
        let [right, up] = NEAREST[direction];
        sites.index([column + right, row + up]).is_some()
    });
    let event = |([column, row], direction): ([i32; 2], usize)| BondEvent {
        probe: 0,
        column,
        row,
        direction: direction as u8,
        broken: true,
    };
    there.map(event).collect()
}

#[test]
fn mesh_and_analysis_sever_the_same_bonds() {
    let mut notches = Vec::new();
    for length in ["0.3 nm", "1 nm", "2.2 nm", "4.123 nm", "8 nm", "16.9 nm"] {
        notches.extend(["left", "right"].map(|edge| format!("{{edge: {edge}, length: {length}}}")));
        notches
            .extend(["10.1 nm", "11 nm"].map(|center| format!("{{edge: none, center: {center}, length: {length}}}")));
    }
    for edge in ["left", "right"] {
        notches.extend(["corner", "mid-edge"].map(|end| format!("{{edge: {edge}, length: 8 nm, end: {end}}}")));
    }
    for (crack, element) in notches.iter().flat_map(|crack| [(crack, 1), (crack, 10)]) {
        let solver = solver(crack, element);
        let frame = Frame::of(solver.setting());
        let tracker = Tracker::new(&frame.setting(solver.setting())).expect("there is a crack");
        let mut severed = 0;
        for bond in bonds(&solver) {
            let [right, up] = NEAREST[usize::from(bond.direction)];
            let [a, b] = [[bond.column, bond.row], [bond.column + right, bond.row + up]];
            let is_severed = solver.mesh().severed(a, b);
            assert_eq!(tracker.is_cut(&frame.event(&bond)), is_severed, "{crack}: {bond:?}");
            severed += usize::from(is_severed);
        }
        assert!(severed > 0, "{crack}");
        let tip = tracker.tip().x;
        let end = solver.setting().crack_length;
        assert!(
            tip < end && end - tip <= 0.5 * solver.setting().spacing + EXACT,
            "{crack}: {tip} of {end}"
        );
    }
}

#[test]
fn a_notch_from_the_right_is_half_a_turn_of_one_from_the_left_wherever_it_ends() {
    for end in ["", ", end: corner", ", end: mid-edge"] {
        let [left, right] = ["left", "right"].map(|edge| solver(&format!("{{edge: {edge}, length: 7.7 nm{end}}}"), 10));
        let severed = |solver: &Solver| {
            let frame = Frame::of(solver.setting());
            let cut = bonds(solver).into_iter().filter(|bond| {
                let [right, up] = NEAREST[usize::from(bond.direction)];
                let [a, b] = [[bond.column, bond.row], [bond.column + right, bond.row + up]];
                solver.mesh().severed(a, b)
            });
            let mut places: Vec<[i32; 3]> = cut
                .map(|bond| frame.event(&bond))
                .map(|bond| [bond.column, bond.row, i32::from(bond.direction)])
                .collect();
            places.sort_unstable();
            let first = places[0];
            places
                .iter()
                .map(|bond| [bond[0] - first[0], bond[1], bond[2]])
                .collect::<Vec<_>>()
        };
        assert_eq!(severed(&left), severed(&right), "{end}");
        let [a, b] = [&left, &right].map(|solver| (solver.mesh().cut.unwrap().end(solver.mesh()), solver.setting()));
        assert_eq!(a.0, b.0);
        assert!((a.1.crack_length - b.1.crack_length).abs() < EXACT, "{end}");
        let [_, edge] = b.1.notch();
        assert!((edge - 2.0 * middle()).abs() < EXACT);
    }
}

/// Tips of two runs at the same probes, the second turned around a place.
fn assert_alike(found: [&Findings; 2], spacing: f64, turned: impl Fn(Tip) -> Tip, label: &str) {
    let [one, other] = found;
    let starts = found.map(|found| found.initiation.expect("the crack starts"));
    let off = (starts[0].strain / starts[1].strain - 1.0).abs();
    assert!(off < AT_START, "{label}: start {starts:?}");
    for (probe, (a, b)) in one.tips.iter().zip(&other.tips).enumerate() {
        let b = turned(*b);
        let near = (a.x - b.x).hypot(a.y - b.y) < TIP_SPACINGS * spacing;
        assert!(near, "{label}, probe {probe}: {a:?} {b:?}");
    }
    // A crack in large elements may have crossed so small a slab before a window is full.
    match found.map(Findings::peak_speed) {
        [Some(a), Some(b)] => assert!((a / b - 1.0).abs() < SPEED_SHARE, "{label}: speed {a} {b}"),
        [a, b] => assert_eq!(a, b, "{label}: speed"),
    }
}

#[test]
fn a_crack_from_the_right_runs_as_one_from_the_left_after_half_a_turn() {
    for element in [1, 10] {
        let until = "{strain: 6 %, crack-length: 13 nm}";
        let [left, right] =
            ["left", "right"].map(|edge| run(&format!("{{edge: {edge}, length: 8 nm}}"), element, until));
        let edge = 2.0 * middle();
        let turned = |tip: Tip| Tip {
            x: edge - tip.x,
            y: -tip.y,
            ..tip
        };
        let label = format!("element {element}");
        assert_alike([&left.2, &right.2], left.0.spacing, turned, &label);
        let start = left.2.initiation.unwrap().probe - 1;
        for (a, b) in left.1.probes[..start].iter().zip(&right.1.probes) {
            for (a, b) in a.j_integral.into_iter().zip(b.j_integral) {
                let is_alike = a.is_nan() && b.is_nan() || (a - b).abs() <= AT_START * a.abs().max(1e-3);
                assert!(is_alike, "{label}: J {a} {b}");
            }
        }
        let k = [&left.2, &right.2].map(|found| found.near_tip.map(|fit| fit.value));
        match k {
            [Some(a), Some(b)] => assert!((a / b - 1.0).abs() < NEAR_TIP_SHARE, "{label}: K {k:?}"),
            [a, b] => assert_eq!(a, b, "{label}"),
        }
        let first = right.2.tips[0];
        let foremost = right.2.tips.iter().map(|tip| tip.x).fold(edge, f64::min);
        assert!((first.x - (edge - 8.0)).abs() < left.0.spacing, "{label}: {first:?}");
        assert!(foremost <= edge - 11.0, "{label}: {foremost}");
        assert!(right.2.arrivals.iter().all(|arrival| arrival.face != Face::Left));
        let bonds = broken_bonds(&right.1, &right.0);
        assert!(bonds.iter().any(|bond| bond.x < first.x) && bonds.iter().all(|bond| bond.x < edge));
    }
}

#[test]
fn both_tips_of_a_notch_in_the_middle_run_alike_and_the_right_one_is_followed() {
    let center = middle();
    let crack = format!("{{edge: none, center: {center} nm, length: 10 nm}}");
    let (setting, series, found) = run(&crack, 1, "{strain: 8 %, crack-length: 9 nm}");
    assert!((setting.crack_length - 5.0).abs() < EXACT, "half of it");
    // The half that runs left, as a crack from a right edge that is the middle.
    let other = Setting {
        crack_from: CrackFrom::Right { edge: center },
        length: setting.length - center,
        ..setting.clone()
    };
    let left = analyse(&series, &other);
    let turned = |tip: Tip| Tip {
        x: 2.0 * center - tip.x,
        y: -tip.y,
        ..tip
    };
    assert_alike([&found, &left], setting.spacing, turned, "both tips");
    let first = found.tips[0];
    let foremost = found.tips.iter().map(|tip| tip.x).fold(0.0, f64::max);
    assert!((first.x - (center + 5.0)).abs() < setting.spacing, "{first:?}");
    assert!(
        (first.arc_length - 5.0).abs() < setting.spacing && foremost >= center + 8.7,
        "{foremost}"
    );
    assert!(found.arrivals.iter().all(|arrival| arrival.face == Face::TopAndBottom));
    assert!(handbook::between_grips(&setting, handbook::Grips::Clamped, 0.01).is_none());
    assert!(handbook::under_stress(&setting, 1.0).is_none());
    let bonds = broken_bonds(&series, &setting);
    for side in [-1.0, 1.0] {
        assert!(
            bonds.iter().any(|bond| side * (bond.x - center) > 5.5),
            "both halves are in the table"
        );
    }
}

#[test]
fn a_run_with_a_crack_from_the_right_goes_on_from_its_checkpoint_as_if_it_had_not_stopped() {
    let make = || solver("{edge: right, length: 8 nm}", 10);
    let folder = tempfile::tempdir().expect("there is room");
    let (setting, series, _) = run("{edge: right, length: 8 nm}", 10, "{strain: 6 %, crack-length: 11 nm}");
    drop(folder);
    assert!(matches!(setting.crack_from, CrackFrom::Right { .. }));
    let frame = Frame::of(&setting);
    let seen = frame.series(&series);
    let mut whole = Tracker::new(&frame.setting(&setting)).expect("there is a crack");
    whole.follow(&seen.bonds);
    let mut parted = whole.parted();
    parted.iter_mut().for_each(|event| *event = frame.event(event));
    assert!(!parted.is_empty());
    let mut checkpoint = make().checkpoint();
    checkpoint.kept.parted_bonds = parted;
    let place = |event: &BondEvent| (event.column, event.row, event.direction);
    checkpoint.kept.parted_bonds.sort_unstable_by_key(place);
    let mut resumed = make();
    resumed.restore(&checkpoint).expect("it is of this specimen");
    assert_eq!(resumed.checkpoint(), checkpoint);
}

/// A made-up run, and the same after half a turn.
fn turned(setting: &Setting, series: &Series) -> (Setting, Series) {
    let rows = 2 * setting.crack_row.unwrap() - 1;
    let right = Setting {
        left_x: 0.5 * f64::from(rows) * setting.spacing - setting.left_x - setting.length,
        crack_from: CrackFrom::Right { edge: setting.length },
        ..setting.clone()
    };
    let mut there = series.clone();
    for bond in &mut there.bonds {
        let [along, up] = NEAREST[usize::from(bond.direction)];
        (bond.column, bond.row) = (-bond.column - along, rows - bond.row - up);
    }
    let bins = series.profile_x.len();
    there.profile_x = series.profile_x.iter().rev().map(|x| setting.length - x).collect();
    there.profiles = series
        .profiles
        .chunks(bins)
        .flat_map(|row| row.iter().rev().copied())
        .collect();
    (right, there)
}

#[test]
fn what_is_found_of_a_crack_from_the_right_is_told_in_its_specimen() {
    let setting = synthetic::setting();
    let series = synthetic::crack_run(&setting, 0.018, 1.0);
    let left = analyse(&series, &setting);
    let (of_right, there) = turned(&setting, &series);
    let right = analyse(&there, &of_right);
    let is_near = |a: f64, b: f64| (a - b).abs() < 1e-6;
    assert_eq!(left.tips.len(), right.tips.len());
    for (a, b) in left.tips.iter().zip(&right.tips) {
        assert!(is_near(a.x, setting.length - b.x) && is_near(a.y, -b.y) && is_near(a.arc_length, b.arc_length));
    }
    assert!(left.branches.len() > 1 && left.branches.len() == right.branches.len());
    for (a, b) in left.branches.iter().zip(&right.branches) {
        assert!(is_near(a.x, setting.length - b.x) && is_near(a.y, -b.y) && a.probe == b.probe);
        let turn = (b.angle - a.angle).abs();
        assert!(
            is_near(turn, 180.0) && b.angle.abs() <= 180.0,
            "{} {}",
            a.angle,
            b.angle
        );
    }
    assert_eq!(left.initiation, right.initiation);
    let [a, b] = [&left, &right].map(|found| found.near_tip.expect("it is fitted").value);
    assert!(is_near(a, b) && left.ahead.len() == right.ahead.len());
    assert!(left.ahead.windows(2).all(|bins| bins[0].distance < bins[1].distance));
    assert!(right.ahead.windows(2).all(|bins| bins[0].distance < bins[1].distance));
    let [leaves, turned] = [left.leaves_plane, right.leaves_plane].map(|leaves| leaves.expect("its branch does"));
    assert!(is_near(leaves.x, setting.length - turned.x) && is_near(leaves.y, -turned.y));
    let faces: Vec<Face> = right.arrivals.iter().map(|arrival| arrival.face).collect();
    assert!(faces.contains(&Face::Right) && !faces.contains(&Face::Left));
    let bonds = [(&series, &setting), (&there, &of_right)].map(|(series, setting)| broken_bonds(series, setting));
    for (a, b) in bonds[0].iter().zip(&bonds[1]) {
        assert!(is_near(a.x, setting.length - b.x) && is_near(a.y, -b.y) && a.direction == b.direction);
    }
}
