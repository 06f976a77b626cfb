use super::*;
use crate::study::read_text;
use proptest::prelude::*;

/// Sections of a base that makes sense, in an order that tests may change.
const BASE: [&str; 7] = [
    "  material: {potential: {lennard-jones: {epsilon: 0.415 eV, sigma: 0.2277 nm, cutoff: 0.34 nm}}, mass: 802 u, thickness: 0.2087 nm}\n",
    "  specimen: {length: 1127 nm, width: 354 nm}\n",
    "  resolution: {element: 10}\n",
    "  crack: {length: 56 nm}\n",
    "  loading: {strain-rate: {rate: 4.6e6 /s, ramp: at-rest}}\n",
    "  run: {until: {strain: 1.2 %}}\n",
    "  probes: {every: 1 ps}\n",
];

fn base() -> String {
    format!("study: test\nbase:\n{}", BASE.concat())
}

fn planned(text: &str) -> Vec<PlannedCase> {
    plan(&read_text("test.yaml", text).unwrap())
        .unwrap_or_else(|error| panic!("{text}\n{error}"))
        .cases
}

fn with(rest: &str) -> Vec<PlannedCase> {
    planned(&(base() + rest))
}

fn names(cases: &[PlannedCase]) -> Vec<&str> {
    cases.iter().map(|case| case.name.as_str()).collect()
}

fn only_id(text: &str) -> CaseId {
    planned(text)[0].id.case
}

#[test]
fn the_cases_of_the_quickstart_keep_their_ids() {
    // Results on people's disks are found by them. Only what changes a result may change an id.
    let ids = planned(include_str!("../../studies/quickstart.yaml"))
        .into_iter()
        .map(|case| case.id.case.to_string());
    assert!(ids.eq(["67a51c3c986faba0", "595ed7a748c10740", "892c65f0ca525cf3"]));
}

#[test]
fn a_case_changes_only_what_it_names() {
    let cases = with("cases:\n  A: {}\n  B: {loading: {strain-rate: {rate: 9.2e6 /s}}, crack: {length: 225 nm}}\n");
    let [a, b] = [&cases[0].case, &cases[1].case];
    let crate::study::case::Loading::StrainRate { rate, ramp, .. } = b.slab().unwrap().loading else {
        panic!("it is pulled");
    };
    assert_eq!(rate, 9.2e-6);
    assert_eq!(ramp, crate::study::case::Ramp::AtRest);
    assert_eq!(b.slab().unwrap().crack.as_ref().unwrap().length, 225.0);
    let parts = |case: &Case| {
        let slab = case.slab().unwrap().clone();
        (slab.material, slab.specimen, case.run.clone())
    };
    assert_eq!(parts(a), parts(b));
}

#[test]
fn a_choice_of_another_kind_replaces_the_whole() {
    let cases = with(
        "cases:\n  A: {material: {potential: {morse: {depth: 0.4 eV, decay: 13.6 /nm, distance: 0.25 nm, cutoff: 0.4 nm}}}}\n",
    );
    let shape = &cases[0].case.slab().unwrap().material.atoms.potential.shape;
    assert!(matches!(
        shape,
        crate::study::case::PotentialShape::Morse { depth: 0.4, .. }
    ));
}

#[test]
fn a_smooth_end_sets_the_cutoff() {
    let cases = planned(&base().replace("cutoff: 0.34 nm", "at-cutoff: {smooth: {from: 0.342 nm, to: 0.433 nm}}"));
    assert_eq!(cases[0].case.slab().unwrap().material.atoms.potential.cutoff, 0.433);
}

#[test]
fn a_study_without_cases_is_one_case() {
    assert_eq!(names(&with("")), ["base"]);
}

#[test]
fn a_sweep_multiplies_every_case_and_its_last_line_varies_fastest() {
    let cases =
        with("cases:\n  A: {}\n  B: {}\nsweep:\n  resolution.element: [5, 10]\n  crack.length: [56 nm, 225 nm]\n");
    let expected = [
        "A-element-5-length-56nm",
        "A-element-5-length-225nm",
        "A-element-10-length-56nm",
        "A-element-10-length-225nm",
        "B-element-5-length-56nm",
        "B-element-5-length-225nm",
        "B-element-10-length-56nm",
        "B-element-10-length-225nm",
    ];
    assert_eq!(names(&cases), expected);
    assert_eq!(cases[2].case.element(), 10);
    assert_eq!(cases[3].case.slab().unwrap().crack.as_ref().unwrap().length, 225.0);
}

#[test]
fn a_range_has_the_decimals_that_were_typed() {
    let cases = with("sweep:\n  run.until.strain: {from: 0.1 %, to: 0.5 %, step: 0.1 %}\n");
    let strains: Vec<f64> = cases.iter().map(|case| case.case.run.until.strain.unwrap()).collect();
    assert_eq!(strains, [0.001, 0.002, 0.003, 0.004, 0.005]);
    assert_eq!(names(&cases)[2], "strain-0.3percent");
}

#[test]
fn a_range_ends_at_the_last_step_within_it() {
    let cases = with("sweep:\n  run.time-step: {from: 1 fs, to: 2.4 fs, step: 0.5 fs}\n");
    assert_eq!(names(&cases), ["time-step-1fs", "time-step-1.5fs", "time-step-2fs"]);
}

#[test]
fn zipped_paths_go_in_step() {
    let cases = with(
        "sweep:\n  zip:\n    specimen.length: [566 nm, 1127 nm]\n    crack.length: {from: 56 nm, to: 112 nm, step: 56 nm}\n",
    );
    assert_eq!(
        names(&cases),
        [
            "specimen-length-566nm-crack-length-56nm",
            "specimen-length-1127nm-crack-length-112nm"
        ]
    );
    let groups = with(
        "sweep:\n  zip:\n    - {crack.length: [56 nm, 60 nm], probes.every: [1 ps, 2 ps]}\n    - {resolution.element: [5, 10]}\n",
    );
    assert_eq!(groups.len(), 4);
    assert_eq!(names(&groups)[1], "length-56nm-every-1ps-element-10");
}

#[test]
fn a_swept_choice_is_named_by_its_kind() {
    let ends = "[{lennard-jones: {cutoff: 0.35 nm}}, {harmonic-bond: {stiffness: 300 eV/nm^2, distance: 0.25 nm, cutoff: 0.3 nm}}]";
    let cases = with(&format!("sweep:\n  material.potential: {ends}\n"));
    assert_eq!(names(&cases), ["potential-lennard-jones", "potential-harmonic-bond"]);
}

#[test]
fn swept_choices_are_named_by_what_they_hold() {
    let cases = with("sweep:\n  run.mass: [{blend: 0.5}, {blend: 0.65}]\n");
    assert_eq!(names(&cases), ["mass-blend-0.5", "mass-blend-0.65"]);
    let cases = with(
        "sweep:\n  material.potential.lennard-jones.at-cutoff: [{smooth: {from: 0.33 nm, to: 0.34 nm}}, {smooth: {from: 0.32 nm, to: 0.34 nm}}]\n",
    );
    assert_eq!(
        names(&cases),
        [
            "at-cutoff-smooth-from-0.33nm-to-0.34nm",
            "at-cutoff-smooth-from-0.32nm-to-0.34nm"
        ]
    );
}

#[test]
fn the_name_of_a_case_does_not_depend_on_how_a_quantity_is_spelled() {
    let spelled = |lengths: &str| names(&with(&format!("sweep:\n  crack.length: {lengths}\n"))).join(" ");
    assert_eq!(spelled("[100 nm, 0.2 um]"), "length-100nm length-200nm");
    assert_eq!(spelled("[1000 Å, 200.0 nm]"), "length-100nm length-200nm");
    let rates = with("sweep:\n  loading.strain-rate.rate: [4.6 us^-1, 9.20e6 /s]\n");
    assert_eq!(names(&rates), ["rate-4.6e6-per-s", "rate-9.2e6-per-s"]);
}

/// Changes whenever old results would no longer be recognised; then `identity::CASE_FORMAT` should go up on purpose.
#[test]
fn the_identity_of_a_known_case_stays() {
    // Said and not left to its default, which may change without a change of format.
    let text = base().replace("run: {", "run: {time-step: {fraction: 0.8}, ");
    assert_eq!(only_id(&text).to_string(), "e464a427b54cc196");
}

#[test]
fn identity_is_of_the_values_and_not_of_the_text() {
    let id = only_id(&base());
    let spelled_otherwise = base()
        .replace("1127 nm", "1.127 um")
        .replace("4.6e6 /s", "4.6 us^-1")
        .replace("802 u", "8.02e2 Da");
    assert_eq!(only_id(&spelled_otherwise), id);
    assert_eq!(
        only_id(&format!(
            "# a comment\n{}",
            base().replace("{element: 10}", "{element: 10} # atoms per edge")
        )),
        id
    );
    assert_eq!(
        only_id(&base().replace("{element: 10}", "{element: 10, regions: []}")),
        id
    );
    let in_case =
        base().replace("  crack: {length: 56 nm}\n", "") + "cases:\n  A: {crack: {length: 56 nm, edge: left}}\n";
    assert_eq!(only_id(&in_case), id);
    let in_sweep = base().replace("  crack: {length: 56 nm}\n", "") + "sweep:\n  crack.length: [56 nm]\n";
    assert_eq!(only_id(&in_sweep), id);
}

#[test]
fn identity_ignores_how_a_case_is_carried_out_and_what_is_shown_of_it() {
    let id = only_id(&base());
    let otherwise =
        base().replace("run: {", "run: {ranks: 4, threads: 2, checkpoint-every: 1 h, ") + "  observe: [crack]\n";
    assert_eq!(only_id(&otherwise), id);
}

#[test]
fn cases_that_differ_in_ranks_or_threads_alone_have_runs_of_their_own() {
    let id = only_id(&base());
    let cases = with("sweep:\n  run.ranks: [1, 2]\n");
    assert_eq!(
        cases[0].case.slab().unwrap().specimen,
        cases[1].case.slab().unwrap().specimen
    );
    let ids: Vec<String> = cases.iter().map(|case| case.id.to_string()).collect();
    assert_eq!(ids, [format!("{id}-r1"), format!("{id}-r2")]);
    let cases = with(
        "cases:\n  A: {run: {threads: 2}}\n  B: {run: {ranks: 2, threads: 2}}\n  C: {}\n  D: {crack: {length: 60 nm}}\n",
    );
    let ids: Vec<String> = cases.iter().map(|case| case.id.to_string()).collect();
    assert_eq!(ids[..3], [format!("{id}-t2"), format!("{id}-r2-t2"), id.to_string()]);
    assert_eq!(ids[3], cases[3].id.case.to_string(), "nothing is compared with it");
}

#[test]
fn cases_that_differ_in_more_or_in_nothing_keep_their_ids() {
    let cases = with("cases:\n  A: {run: {ranks: 1}}\n  B: {run: {ranks: 2}, crack: {length: 60 nm}}\n");
    assert!(cases.iter().all(|case| case.id == RunId::of(&case.case)));
    let cases = with("cases:\n  A: {run: {ranks: 2}}\n  B: {run: {ranks: 2}}\n");
    assert!(cases.iter().all(|case| case.id == RunId::of(&case.case)));
}

#[test]
fn a_study_of_scaling_tells_every_number_of_ranks_apart() {
    let scaled = "report: {scaling: scaled}\nsweep:\n  zip: {run.ranks: [1, 2], specimen.width: [177 nm, 354 nm]}\n";
    let ids: Vec<RunId> = with(scaled).iter().map(|case| case.id).collect();
    assert_ne!(ids[0].case, ids[1].case);
    assert_eq!(ids.iter().map(|id| id.ranks).collect::<Vec<_>>(), [Some(1), Some(2)]);
}

#[test]
fn identity_changes_with_every_value() {
    let id = only_id(&base());
    for (old, new) in [
        ("0.415 eV", "0.4150000000000001 eV"),
        ("802 u", "803 u"),
        ("element: 10", "element: 9"),
        ("at-rest", "initial-velocity"),
        ("1 ps", "2 ps"),
        ("  crack: {length: 56 nm}\n", ""),
        ("{strain: 1.2 %}", "{strain: 1.2 %, time: 1 us}"),
    ] {
        assert!(base().contains(old));
        assert_ne!(only_id(&base().replace(old, new)), id, "{new}");
    }
}

#[test]
fn the_end_of_the_notch_belongs_to_the_identity_and_is_written_only_where_it_is_given() {
    let notch = |crack: &str| base().replace("crack: {length: 56 nm}", crack);
    let [plain, corner, middle] = [
        "crack: {length: 56 nm}",
        "crack: {length: 56 nm, end: corner}",
        "crack: {length: 56 nm, end: mid-edge}",
    ]
    .map(|crack| planned(&notch(crack)).remove(0));
    assert!(corner.id != plain.id && middle.id != plain.id && corner.id != middle.id);
    assert!(!write_case(&plain).contains("end:"));
    for (case, end) in [(&corner, "end: corner"), (&middle, "end: mid-edge")] {
        let written = write_case(case);
        assert!(written.contains(end), "{written}");
        assert_eq!(only_id(&written), case.id.case);
    }
}

#[test]
fn a_difference_is_told_in_the_words_of_the_study() {
    let changed = base()
        .replace("4.6e6 /s", "9.2e6 /s")
        .replace("  crack: {length: 56 nm}\n", "")
        .replace(
            "{element: 10}",
            "{element: 10, regions: [{band: {half-width: 9 nm, element: 1}}]}",
        );
    let [old, new] = [base(), changed].map(|text| spelled(&planned(&text)[0].case));
    assert_eq!(explain_difference(&old, &old), Vec::<String>::new());
    let expected = [
        "resolution.regions: [] -> [{band: {half-width: 9 nm, element: 1}}]",
        "crack: {edge: left, length: 56 nm} -> (not given)",
        "loading.strain-rate.rate: 4.6e6 /s -> 9.2e6 /s",
    ];
    assert_eq!(explain_difference(&old, &new), expected);
}

#[test]
fn a_written_case_is_short_enough_to_read() {
    let text = write_case(&planned(&base())[0]);
    assert!(
        text.contains("  loading: {strain-rate: {mode: I, rate: 4.6e6 /s, ramp: at-rest}}\n"),
        "{text}"
    );
    assert!(text.contains("cases:\n  base: {}\n"), "{text}");
    assert!(
        text.lines().all(|line| line.len() <= 120) && text.lines().count() < 40,
        "{text}"
    );
}

proptest! {
    #[test]
    fn an_expansion_is_a_product_of_distinct_cases_in_a_fixed_order(
        cases in 1usize..4,
        elements in prop::collection::btree_set(3u32..40, 1..5),
        first in 20u32..80,
        steps in 0u32..6,
    ) {
        let elements: Vec<u32> = elements.into_iter().collect();
        let text = format!(
            "{}cases:\n{}sweep:\n  resolution.element: {elements:?}\n  crack.length: {{from: {first}.5 nm, to: {}.5 nm, step: 1 nm}}\n",
            base(),
            (0..cases).map(|case| format!("  C{case}: {{}}\n")).collect::<String>(),
            first + steps,
        );
        let plan = planned(&text);
        prop_assert_eq!(plan.len(), cases * elements.len() * (steps as usize + 1));
        let unique: std::collections::BTreeSet<&str> = plan.iter().map(|case| case.name.as_str()).collect();
        prop_assert_eq!(unique.len(), plan.len());
        for (index, case) in plan.iter().enumerate() {
            let length = index % (steps as usize + 1);
            let element = index / (steps as usize + 1) % elements.len();
            prop_assert_eq!(case.case.element(), elements[element]);
            prop_assert_eq!(case.case.slab().unwrap().crack.as_ref().unwrap().length, f64::from(first) + 0.5 + length as f64);
        }
        prop_assert_eq!(plan, planned(&text));
    }

    #[test]
    fn identity_does_not_depend_on_the_order_of_keys_or_on_where_they_stand(
        order in Just((0..BASE.len()).collect::<Vec<_>>()).prop_shuffle(),
        moved in prop::collection::vec(any::<bool>(), BASE.len()),
    ) {
        let mut text = "base:\n  specimen: {block: 10}\n".to_owned();
        let section = |in_case: bool| {
            let parts = order.iter().filter(|part| moved[**part] == in_case && **part != 1);
            parts.map(|part| BASE[*part].to_owned()).collect::<String>()
        };
        text += &section(false);
        text += "cases:\n  A:\n    specimen: {width: 354 nm, length: 1127 nm}\n";
        text += &section(true).replace("  ", "    ");
        text += "study: test\n";
        prop_assert_eq!(only_id(&text), only_id(&base()));
    }

    #[test]
    fn a_slip_anywhere_is_answered_and_never_a_panic(at in 0usize..700, change in "\\PC{0,3}") {
        let text = base() + "cases:\n  A: {}\nsweep:\n  resolution.element: [5, 10]\n";
        let at = at.min(text.len() - 1);
        let text = format!("{}{change}{}", &text[..at], &text[at + 1..]);
        if let Err(error) = read_text("test.yaml", &text).and_then(|study| plan(&study)) {
            prop_assert!(!error.mistakes().is_empty());
            prop_assert!(!error.render(true).is_empty());
        }
    }
}
