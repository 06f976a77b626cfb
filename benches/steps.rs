//! Time of one step, in represented atoms a second: `cargo bench`.

use cgaft::forces::{Forces, Measure, Summation};
use cgaft::loading::{Grip, Stretching};
use cgaft::material::Material;
use cgaft::mesh::cut::Crack;
use cgaft::mesh::sites::Layout;
use cgaft::mesh::solid;
use cgaft::mesh::solid::sites::{Frame, Outline, Sites};
use cgaft::mesh::{Mesh, Plan};
use cgaft::potential::{AtCutoff, CutPotential, Interaction, LennardJones};
use cgaft::solver::{Settings, Solver, TimeStep, Until};
use divan::Bencher;
use divan::counter::ItemsCount;

fn main() {
    divan::main();
}

/// The source's material at 0.34 nm, reduced units.
fn material() -> Material {
    let shape = LennardJones {
        epsilon: 1.0,
        sigma: 1.0,
    };
    let law = CutPotential::new(shape, 0.34 / 0.2277, AtCutoff::Truncated);
    Material::new(Interaction::LennardJones(law), 1.0).expect("the potential binds")
}

/// The slab of the quickstart, cracked.
fn slab(element: u16) -> Mesh {
    let layout = Layout {
        block: 10,
        rows: 16,
        triangles: 81,
    };
    let spacing = material().spacing;
    Mesh::new(&Plan {
        layout,
        element,
        regions: vec![],
        crack: Some(Crack::of_length(180.0)),
        grip_rows: 10,
        spacing,
    })
}

fn solver(element: u16) -> Solver {
    let mesh = slab(element);
    let loading = Stretching::new(&mesh, 1e-4, Grip::Clamped, true);
    let settings = Settings {
        time_step: TimeStep::Auto { fraction: 0.5 },
        summation: Summation::Exact,
        consistent_mass: 0.0,
        refine: None,
        relax: false,
        noise: None,
        until: Until::default(),
        probe_every: f64::INFINITY,
        snapshot_every: None,
        checkpoint_every: std::time::Duration::MAX,
        thickness: 1.0,
    };
    Solver::new(mesh, material(), loading, settings).expect("the slab starts")
}

#[divan::bench(args = [1, 4, 10, 20])]
fn step(bencher: Bencher, element: u16) {
    let mut solver = solver(element);
    let atoms = solver.mesh().sites.len();
    bencher
        .counter(ItemsCount::new(atoms))
        .bench_local(|| solver.advance().expect("the step is stable"));
}

#[divan::bench(args = [1, 10])]
fn forces_energy_and_stress(bencher: Bencher, element: u16) {
    let mesh = slab(element);
    let mut position = mesh.node_positions();
    let mut force = mesh.node_positions();
    let atoms = mesh.sites.len();
    let mut forces = Forces::new(mesh, material());
    let mut measure = Measure::default();
    bencher.counter(ItemsCount::new(atoms)).bench_local(|| {
        forces
            .compute_and_measure(&mut position, &mut force, &mut measure)
            .expect("the lattice is sound");
    });
}

#[divan::bench(args = [1, 10])]
fn broken_bonds(bencher: Bencher, element: u16) {
    let mesh = slab(element);
    let position = mesh.node_positions();
    let forces = Forces::new(mesh, material());
    bencher.bench_local(|| forces.broken_bonds(&position));
}

#[divan::bench(args = [1, 10])]
fn set_up(bencher: Bencher, element: u16) {
    bencher.bench_local(|| solver(element));
}

/// A film of 400 blocks of a thousand atoms in elements, or a block of as many atoms; bonds as in the source, or to 2.5 sigma.
#[divan::bench(args = [(10, 0.34 / 0.2277), (1, 0.34 / 0.2277), (1, 2.5)])]
fn forces_on_solids(bencher: Bencher, (element, cutoff): (u16, f64)) {
    let shape = LennardJones {
        epsilon: 1.0,
        sigma: 1.0,
    };
    let law = CutPotential::new(shape, cutoff, AtCutoff::Truncated);
    let material = Material::face_centred_cubic(Interaction::LennardJones(law), 1.0).expect("the potential binds");
    let extent = if element > 1 { [200, 200, 10] } else { [74; 3] };
    let mesh = solid::Solid::new(&solid::Plan {
        sites: Sites {
            outline: Outline::Rhombohedron(extent),
            frame: Frame::of_blocks(material.spacing),
            removed: vec![],
            cut: None,
        },
        element,
        regions: vec![],
        spacing: material.spacing,
    });
    let mut position = mesh.node_positions();
    let mut force = mesh.node_positions();
    let atoms = mesh.site_count();
    let mut forces = cgaft::forces::solid::Forces::new(mesh, material);
    bencher.counter(ItemsCount::new(atoms)).bench_local(|| {
        forces.compute(&mut position, &mut force).expect("the lattice is sound");
    });
}
