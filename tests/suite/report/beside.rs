//! Values from elsewhere beside those of the cases.

use cgaft::plan::{COMPARED, Comparison, Expected};
use cgaft::report::{self, Study};

use super::{COLUMNS, rows, text, three_meshes, written};

fn expected(case: &str, keys: &[(&'static str, &str)], column: &'static str, value: f64) -> Expected {
    Expected {
        case: case.to_owned(),
        keys: keys.iter().map(|(key, word)| (*key, (*word).to_owned())).collect(),
        column,
        value,
    }
}

fn with_comparisons() -> Study {
    let left = [("wave", "longitudinal"), ("path", "left face")];
    let comparison = |name: &str, table, values| Comparison {
        name: name.to_owned(),
        file: format!("reference/{name}.csv"),
        notes: "The source tells no time of the start.".to_owned(),
        table,
        values,
    };
    let start = vec![
        expected("atoms", &[], "initiation_strain", 0.02),
        expected("coarse", &[], "first_branch_strain", 0.025),
    ];
    Study {
        comparisons: vec![
            comparison("start", "summary", start),
            comparison(
                "waves",
                "wave_arrival",
                vec![expected("mixed", &left, "reference_ps", 50.0)],
            ),
        ],
        ..three_meshes()
    }
}

#[test]
fn values_from_elsewhere_stand_beside_those_of_the_cases() {
    let folder = written(&with_comparisons());
    let table = rows(&folder, "comparison");
    let number = |row: usize, column: &str| table[row][column].parse::<f64>().unwrap();
    assert_eq!(table.len(), 5);
    let own: f64 = rows(&folder, "summary")[2]["initiation_strain"].parse().unwrap();
    assert_eq!([number(0, "measured"), number(0, "reference")], [own, 0.02]);
    assert!((number(0, "relative_difference") - (own / 0.02 - 1.0)).abs() < 1e-8);
    // The coarse case has no branch: there is nothing to compare.
    assert_eq!([&table[1]["measured"], &table[1]["relative_difference"]], ["", ""]);

    let arrivals = rows(&folder, "wave_arrival");
    let referred: Vec<_> = arrivals.iter().filter(|row| !row["reference_ps"].is_empty()).collect();
    assert_eq!(referred.len(), 1);
    let arrival = ["case", "wave", "path", "reference_ps"].map(|column| referred[0][column].as_str());
    assert_eq!(arrival, ["mixed", "longitudinal", "left face", "50.0"]);
    assert_eq!(table[2]["quantity"], "predicted_ps");
    assert_eq!(table[2]["measured"], referred[0]["predicted_ps"]);

    for file in ["report.html", "report.md"] {
        let page = text(&folder, file);
        assert!(
            page.contains("reference/start.csv") || page.contains("start.csv"),
            "{file}"
        );
        assert!(page.contains("Beside values from elsewhere"), "{file}");
        assert!(page.contains("The source tells no time of the start."), "{file}");
    }
    report::write(&three_meshes(), folder.path()).unwrap();
    assert!(
        !folder.path().join("tables/comparison.csv").exists(),
        "it is of an old study"
    );
}

/// What the table of solids has beside that of slabs.
const SUMMARY_OF_SOLIDS: &str = "core_s,modulus_gpa,peak_stress_gpa,peak_time_ps,peak_strain,first_break_time_ps,\
                                 first_break_strain,broken_bonds,period_ps,wave_speed_m_per_s";

#[test]
fn what_can_be_compared_is_in_the_tables() {
    for compared in &COMPARED {
        let columns = COLUMNS
            .iter()
            .chain([&super::precision::COLUMNS, &super::scaling::COLUMNS]);
        let (_, columns) = columns.into_iter().find(|(table, _)| *table == compared.table).unwrap();
        let columns: Vec<&str> = columns.split(',').collect();
        let keys = compared.keys.iter().map(|(key, _)| key).chain([&compared.row]);
        let of_solids =
            |column: &str| compared.table == "summary" && SUMMARY_OF_SOLIDS.split(',').any(|own| own == column);
        assert!(
            keys.chain(compared.values)
                .all(|column| columns.contains(column) || of_solids(column)),
            "{}",
            compared.table
        );
    }
    let folder = written(&three_meshes());
    for row in rows(&folder, "wave_arrival") {
        for (key, words) in COMPARED.iter().flat_map(|compared| compared.keys) {
            assert!(words.contains(&row[*key].as_str()), "{row:?}");
        }
    }
}
