//! Masses in the units of the program.

use cgaft::plan::plan;
use cgaft::{setup, study};

#[test]
fn a_mass_unit_at_a_nanometre_a_picosecond_has_the_kinetic_energy_of_the_si() {
    // 1.66053906892e-27 kg (1000 m/s)^2 in joule, over 1.602176634e-19 J. [CODATA 2022]
    let of_a_unit = 1.660_539_068_92e-27 * 1e6 / 1.602_176_634e-19;
    let plan = plan(&study::read("quickstart.yaml").expect("it is shipped")).expect("it is right");
    let case = &plan.cases[0].case;
    let found = setup::slab::material(case.slab().expect("it is a slab"))
        .expect("it binds")
        .site_mass;
    assert!(
        (found / (case.slab().expect("it is a slab").material.atoms.mass * of_a_unit) - 1.0).abs() < 1e-12,
        "{found}"
    );
}
