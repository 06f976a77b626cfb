//! What a report says of specimens that are not what was asked for.

use cgaft::report::{Specimen, Study};

use super::{finished, rows, text, three_meshes, written};

/// A slab of 30 or so nm that becomes one of 14 element rows.
fn laid_out(width: f64) -> Specimen {
    Specimen {
        length: [115.0, 115.27],
        width: [width, 30.99],
        height_between_grips: [width - 4.2, 26.79],
        crack: Some([46.0, 46.0]),
        notch_end: Some("corner"),
        leftover_share: Some(0.05),
        leftover_where: vec!["at the grips", "at the right face"],
        grip_thickness: 2.213,
        grip_speed: 1.3e-3,
        computation: 7,
    }
}

fn three_widths() -> Study {
    let case = |name: &str, width: f64, wall: f64| {
        let mut case = finished(name, 1, 60_000, 0.018, wall);
        case.specimen = Some(laid_out(width));
        case
    };
    Study {
        cases: vec![case("width-30nm", 30.0, 41.0), case("width-31nm", 31.0, 37.0)],
        ..three_meshes()
    }
}

#[test]
fn cases_that_are_one_computation_are_told_and_none_is_faster() {
    let folder = written(&three_widths());
    for page in ["report.html", "report.md"] {
        let page = text(&folder, page);
        assert!(page.contains("One computation under several names"), "{page}");
        assert!(page.contains("width-31nm is width-30nm"), "{page}");
        assert!(page.contains("is the same computation under another name"), "{page}");
        assert!(
            !page.contains("times faster") && !page.contains("times slower"),
            "{page}"
        );
    }
}

#[test]
fn sizes_that_are_not_what_was_asked_for_are_told() {
    let folder = written(&three_widths());
    let page = text(&folder, "report.md");
    assert!(
        page.contains("in width-30nm the width is 30.99 nm instead of 30.00 nm"),
        "{page}"
    );
    assert!(!page.contains("in width-31nm the width"), "{page}");
    let row = &rows(&folder, "specimen")[0];
    assert_eq!(
        (row["width_asked_nm"].as_str(), row["width_nm"].as_str()),
        ("30.0", "30.99")
    );
    assert_eq!(row["notch_end"], "corner");
}
