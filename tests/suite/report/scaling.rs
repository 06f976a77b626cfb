//! What ranks gain.

use cgaft::domain::{Burden, MessageCost};
use cgaft::plan::{Comparison, Expected};
use cgaft::report::{CaseResult, Phase, Scaling, Study};
use cgaft::study::Growth;

use super::{finished, rows, text, three_meshes, written};

pub const COLUMNS: (&str, &str) = (
    "scaling",
    "of,case,ranks,elements,steps,inp_s,getm_s,elist_s,exc_s_per_step,solv_s_per_step,out_s,total_s,speedup,\
     efficiency,ideal_speedup",
);

/// Sums of numbers of nine digits.
const DIGITS: f64 = 1e-8;

/// A run of 8,000 steps.
fn run(name: &str, ranks: u32, phases: [(&str, f64); 9]) -> CaseResult {
    let mut case = finished(name, 10, 3_300, 0.9, 100.0);
    case.manifest.ranks = Some(ranks);
    case.manifest.cost = phases
        .map(|(name, seconds)| Phase {
            name: name.to_owned(),
            calls: 1,
            seconds,
        })
        .to_vec();
    case.manifest.messages = (ranks > 1).then_some(MessageCost {
        latency: 1e-6,
        a_byte: 1e-9,
        reduction: 2e-6,
    });
    case.digest = Some("0123456789abcdef0123".to_owned());
    case
}

fn gains(growth: Growth) -> Study {
    let phases = |share: f64, exchange: f64| {
        [
            ("mesh", 0.5),
            ("set-up", 1.25),
            ("cut", 0.25),
            ("neighbours", 10.0 * share),
            ("exchange", exchange),
            ("forces", 70.0 * share),
            ("motion", 10.0 * share),
            ("output", 5.0),
            ("publishing", 3.0),
        ]
    };
    let burden = |ranks: u32, messages: u32| Burden {
        ranks,
        work: 1.0 / f64::from(ranks),
        messages,
        bytes: 1_000 * u64::from(messages),
    };
    let source = [
        ("elements", 5120.0),
        ("steps", 1000.0),
        ("inp_s", 2.0),
        ("getm_s", 0.5),
        ("elist_s", 100.0),
        ("exc_s_per_step", 0.0),
        ("solv_s_per_step", 1.0),
        ("out_s", 2.5),
    ];
    let source = source.map(|(column, value)| Expected {
        case: "4".to_owned(),
        keys: Vec::new(),
        column,
        value,
    });
    Study {
        scaling: Some(Scaling {
            growth,
            burdens: vec![burden(1, 0), burden(2, 1), burden(4, 2)],
            compared: vec![Comparison {
                name: "table-4-2".to_owned(),
                file: "table-4-2.csv".to_owned(),
                notes: String::new(),
                table: "scaling",
                values: source.to_vec(),
            }],
        }),
        cases: vec![run("two", 2, phases(0.5, 0.8)), run("one", 1, phases(1.0, 0.0))],
        ..three_meshes()
    }
}

#[test]
fn speedups_of_a_fixed_size_are_those_of_the_equations_beside_the_prediction_and_the_source() {
    let folder = written(&gains(Growth::Fixed));
    let csv = text(&folder, "tables/scaling.csv");
    assert_eq!(csv.lines().next(), Some(COLUMNS.1));
    let table = rows(&folder, "scaling");
    let number = |row: usize, column: &str| table[row][column].parse::<f64>().unwrap();
    let is = |row: usize, column: &str, value: f64| {
        let found = number(row, column);
        assert!(
            (found / value - 1.0).abs() < DIGITS,
            "{column} of row {row}: {found}, not {value}"
        );
    };
    let names: Vec<_> = table
        .iter()
        .map(|row| (row["of"].as_str(), row["ranks"].as_str()))
        .collect();
    let expected = [
        ("measured", "1"),
        ("measured", "2"),
        ("prediction", "1"),
        ("prediction", "2"),
        ("prediction", "4"),
        ("table-4-2", "4"),
    ];
    assert_eq!(names, expected);
    // [Deng2011] Eq. (4-1), Eq. (4-4) by hand: 2 + 5 + 40.8 + 8 s of two ranks for 100 s of one.
    is(0, "total_s", 100.0);
    is(1, "solv_s_per_step", 40.8 / 8000.0);
    is(1, "total_s", 55.8);
    is(1, "speedup", 100.0 / 55.8);
    is(1, "efficiency", 50.0 / 55.8);
    // A tenth is serial.
    is(1, "ideal_speedup", 1.0 / 0.55);
    is(1, "getm_s", 0.25);
    is(2, "total_s", 100.0);
    // Two messages, 2 kB, two hops: 2 + 2 + 4 µs.
    is(4, "exc_s_per_step", 8e-6);
    is(4, "total_s", 10.0 + 22.5 + 8000.0 * 8e-6);
    // Four times its parallel part.
    is(5, "speedup", (4.5 + 4.0 * 1100.0 + 0.5) / (5.0 + 1100.0));
    for file in ["report.html", "report.md"] {
        let page = text(&folder, file);
        for told in [
            "2 of 2 cases done. 2 ranks are worth 1.79 times one, an efficiency of 0.896. Predicted for 4 ranks: ",
            "are the same in every byte",
            "negative for one processor",
            "no row of one processor",
            "SOLV (ms)",
        ] {
            assert!(page.contains(told), "{file}: {told}");
        }
    }
    for figure in ["scaling-speedup", "scaling-efficiency"] {
        let svg = text(&folder, &format!("figures/{figure}.svg"));
        assert!(svg.contains("prediction") && svg.contains("table-4-2"), "{figure}");
    }
}

#[test]
fn a_specimen_that_grows_is_worth_as_many_of_one_rank() {
    let folder = written(&gains(Growth::Scaled));
    let table = rows(&folder, "scaling");
    let number = |row: usize, column: &str| table[row][column].parse::<f64>().unwrap();
    assert!((number(1, "speedup") - 200.0 / 55.8).abs() < DIGITS * 4.0);
    // Set-up and output of the fourfold specimen, and the work of one rank.
    let total = 4.0 * 10.0 + 90.0 + 8000.0 * 8e-6;
    assert!((number(4, "total_s") / total - 1.0).abs() < DIGITS);
    assert_eq!(table[4]["elements"], "4400");
    let page = text(&folder, "report.md");
    assert!(
        page.contains("from 0.0300 GB of one rank follow 0.120 GB for each of 4"),
        "{page}"
    );
    assert!(!page.contains("same in every byte"), "these are several specimens");
}

#[test]
fn runs_of_one_case_that_differ_are_told() {
    let mut study = gains(Growth::Fixed);
    study.cases[1].digest = Some("another".to_owned());
    let page = text(&written(&study), "report.md");
    assert!(page.contains("NOT the same in every byte"));
}

#[test]
fn without_a_run_of_one_rank_nothing_is_predicted_and_the_page_says_what_stands_for_it() {
    let mut study = gains(Growth::Fixed);
    study.cases.truncate(1);
    let folder = written(&study);
    let table = rows(&folder, "scaling");
    assert!(table.iter().all(|row| row["of"] != "prediction"));
    assert!(text(&folder, "report.md").contains("No case has one rank"));
}
