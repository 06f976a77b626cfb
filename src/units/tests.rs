use super::*;
use proptest::prelude::*;

/// Conversions by a factor that is no power of ten round twice.
const TWO_ROUNDINGS: f64 = 4.0 * f64::EPSILON;

fn message(text: &str, dimension: Dimension) -> String {
    parse(text, dimension).unwrap_err().to_string()
}

#[test]
fn quantities_read_as_people_type_them() {
    for (text, dimension, value) in [
        ("354 nm", Length, 354.0),
        ("354nm", Length, 354.0),
        ("0.354 um", Length, 354.0),
        (".354 µm", Length, 354.0),
        ("3.54e-7 m", Length, 354.0),
        ("2.2 Å", Length, 0.22),
        ("2.2 angstrom", Length, 0.22),
        ("1 ps", Time, 1.0),
        ("2 fs", Time, 0.002),
        ("60 s", Duration, 60.0),
        ("2 min", Duration, 120.0),
        ("0.415 eV", Energy, 0.415),
        ("415 meV", Energy, 0.415),
        ("2eV", Energy, 2.0),
        ("1e2eV", Energy, 100.0),
        ("802 u", Mass, 802.0),
        ("300 K", Temperature, 300.0),
        ("4.6e6 /s", Rate, 4.6e-6),
        ("4.6e6 1/s", Rate, 4.6e-6),
        ("4.6e6 s^-1", Rate, 4.6e-6),
        ("4.6e6 s⁻¹", Rate, 4.6e-6),
        ("20 m/s", Velocity, 0.02),
        ("320 eV/nm^2", Stiffness, 320.0),
        ("3.2 eV/Å²", Stiffness, 320.0),
        ("13.6 /nm", InverseLength, 13.6),
        ("1.36 1/Å", InverseLength, 13.6),
        ("1.2 %", Fraction, 0.012),
        ("-1.2%", Fraction, -0.012),
    ] {
        assert_eq!(parse(text, dimension), Ok(value), "{text}");
    }
}

#[test]
fn a_gigapascal_is_a_joule_over_a_volume() {
    let stress = parse("1.6 GPa", Stress).unwrap();
    assert!((stress * EV_PER_NM3_IN_GPA / 1.6 - 1.0).abs() < TWO_ROUNDINGS);
    let stiffness = parse("1 N/m", Stiffness).unwrap();
    assert!((stiffness - 6.241_509_074_460_763).abs() < TWO_ROUNDINGS * 10.0);
}

#[test]
fn the_constants_agree_with_each_other() {
    // CODATA 2022 gives the energy of 1 u apart, 931.494 103 72(29) MeV; the speed of light is 299792.458 nm/ps.
    let by_energy = 931.494_103_72e6 / 299_792.458_f64.powi(2);
    assert!((U_IN_EV_PS2_PER_NM2 / by_energy - 1.0).abs() < 1e-9);
    assert!((BOLTZMANN_EV_PER_K - 8.617_333_262e-5).abs() < 1e-14);
    assert!((EV_PER_NM3_IN_GPA - 0.160_217_663_4).abs() < 1e-15);
    let by_hand = EV_PER_NM3_IN_GPA * 1000.0 * 1e-9_f64.sqrt();
    assert!((EV_PER_NM3_SQRT_NM_IN_MPA_SQRT_M / by_hand - 1.0).abs() < TWO_ROUNDINGS);
    let kilogram = parse("1 kg", Mass).unwrap();
    assert!((kilogram * U_IN_KILOGRAM - 1.0).abs() < TWO_ROUNDINGS);
}

#[test]
fn a_bare_number_is_refused_with_what_to_write() {
    assert_eq!(message("354", Length), "`354` has no unit; write 354 nm");
    assert_eq!(message("4.6e6", Rate), "`4.6e6` has no unit; write 4.6e6 /s");
    assert_eq!(
        message("0.012", Fraction),
        "`0.012` has no unit; write 0.012 % or, if it is a ratio, 1.2 %"
    );
}

#[test]
fn a_wrong_dimension_is_named_both_ways() {
    assert_eq!(
        message("10 ps", Length),
        "expected a length such as 354 nm, found a time (`10 ps`)"
    );
    assert_eq!(
        message("4.6e6 /s", Velocity),
        "expected a velocity such as 20 m/s, found a rate (`4.6e6 /s`)"
    );
    assert_eq!(
        message("3 nm^4", Length),
        "expected a length such as 354 nm, found `3 nm^4`, which is of another kind"
    );
}

#[test]
fn an_unknown_unit_brings_the_nearest_one() {
    assert_eq!(message("354 mn", Length), "`mn` is not a unit; did you mean `nm`?");
    assert_eq!(message("354 Nm", Length), "`Nm` is not a unit; did you mean `nm`?");
    assert_eq!(message("1.6 gpa", Stress), "`gpa` is not a unit; did you mean `GPa`?");
    assert_eq!(message("0.4 ev", Energy), "`ev` is not a unit; did you mean `eV`?");
    assert_eq!(
        message("3 fortnight", Time),
        "`fortnight` is not a unit; a time is written such as 10 ps"
    );
}

#[test]
fn what_is_no_number_is_refused() {
    assert_eq!(
        message("wide", Length),
        "expected a length such as 354 nm, found `wide`"
    );
    assert_eq!(
        message("nan nm", Length),
        "expected a length such as 354 nm, found `nan nm`"
    );
    assert_eq!(message("1,5 nm", Length), "`1,5 nm` has a decimal comma; write 1.5 nm");
    assert!(message("1e999 nm", Length).contains("beyond what a 64-bit number holds"));
    assert!(message("1e-99999999999 nm", Length).contains("beyond what a 64-bit number holds"));
    assert!(message("1 nm^99", Length).contains("`nm^99` is not a unit"));
}

#[test]
fn quantities_are_written_as_people_read_them() {
    assert_eq!(format(354.0, Length), "354 nm");
    assert_eq!(format(4.6e-6, Rate), "4.6e6 /s");
    assert_eq!(format(0.012, Fraction), "1.2 %");
    assert_eq!(format(0.02, Velocity), "20 m/s");
    assert_eq!(format(-0.0, Length), "0 nm");
    assert_eq!(format(0.00012, Length), "0.00012 nm");
    assert_eq!(format(1e-7, Length), "1e-7 nm");
}

proptest! {
    #[test]
    fn what_is_written_reads_back_to_the_same_bits(value in proptest::num::f64::NORMAL, kind in 0..Dimension::ALL.len()) {
        // Beyond these a shifted exponent leaves the range of a f64 on the way.
        prop_assume!((1e-280..1e280).contains(&value.abs()));
        let dimension = Dimension::ALL[kind];
        prop_assert_eq!(parse(&format(value, dimension), dimension).unwrap().to_bits(), value.to_bits());
    }

    #[test]
    fn a_prefix_never_changes_the_bits(whole in 0u32..1_000_000, decimals in 0u32..1000) {
        let nanometres = parse(&format!("{whole}.{decimals:03} nm"), Length).unwrap();
        let micrometres = parse(&format!("{whole}.{decimals:03}e-3 um"), Length).unwrap();
        let angstroms = parse(&format!("{whole}{}.{} Å", decimals / 100, format!("{decimals:03}").split_off(1)), Length).unwrap();
        prop_assert_eq!(nanometres.to_bits(), micrometres.to_bits());
        prop_assert_eq!(nanometres.to_bits(), angstroms.to_bits());
    }

    #[test]
    fn no_text_makes_it_panic(text in "\\PC{0,40}", kind in 0..Dimension::ALL.len()) {
        let _ = parse(&text, Dimension::ALL[kind]);
    }
}

#[test]
fn units_that_go_by_another_name_here_are_told_as_what_they_are() {
    for (text, dimension, told) in [
        (
            "1e9 Hz",
            Rate,
            "`Hz` is not a unit; 1 Hz is 1 /s; a rate is written such as 4.6e6 /s",
        ),
        (
            "1 GHz",
            Rate,
            "`GHz` is not a unit; 1 GHz is 1e9 /s; a rate is written such as 4.6e6 /s",
        ),
        (
            "63.5 g/mol",
            Mass,
            "`mol` is not a unit; 1 g/mol is 1 u; a mass is written such as 802 u",
        ),
        (
            "9.5 kcal/mol",
            Energy,
            "`kcal` is not a unit; 1 kcal/mol is 0.0433641 eV; an energy is written such as 0.415 eV",
        ),
        (
            "40 kJ/mol",
            Energy,
            "`mol` is not a unit; 1 kJ/mol is 0.0103643 eV; an energy is written such as 0.415 eV",
        ),
    ] {
        assert_eq!(message(text, dimension), told);
    }
    // Half a unit of its last digit.
    const SIX_DIGITS: f64 = 5e-6;
    // CODATA 2022: the constant of Avogadro.
    let of_a_mole = 1e3 / 6.022_140_76e23 / EV_IN_JOULE;
    assert!((of_a_mole / 0.0103643 - 1.0).abs() < SIX_DIGITS);
}
