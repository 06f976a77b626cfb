//! A case with the keys and units of a study file, every choice spelled out.

mod slab;
mod solid;

use crate::{
    study::case::{
        AtCutoff, Body, Case, Execution, MassMatrix, Material, Noise, Potential, PotentialShape, Ramp, Run, Slab,
        SnapshotInterval, Solid, Summation, TimeStep, Until, solid::PulseShape,
    },
    units::{self, Dimension},
};
use serde_json::{Map, Value, json};

/// The case as it would be typed: what `explain_difference` compares. How it is carried out is not among it.
pub fn spelled(case: &Case) -> Value {
    let Case {
        body,
        run,
        probes,
        snapshots,
        execution: _,
    } = case;
    let mut whole = match body {
        Body::Slab(slab) => slab_spelled(slab),
        Body::Solid(solid) => solid_spelled(solid),
    };
    let gauges = whole.as_object_mut().and_then(|whole| whole.shift_remove("gauges"));
    whole["run"] = running(run);
    whole["probes"] = json!({ "every": time(probes.every) });
    if let Some(gauges) = gauges {
        whole["gauges"] = gauges;
    }
    if let Some(every) = snapshots.every {
        whole["snapshots"] = json!({ "every": interval(every) });
    }
    whole
}

fn slab_spelled(slab: &Slab) -> Value {
    let Slab {
        material,
        specimen,
        resolution,
        crack,
        loading,
        gauges,
    } = slab;
    let regions: Vec<Value> = resolution.regions.iter().map(slab::region).collect();
    let mut whole = json!({
        "material": atoms(&material.atoms),
        "specimen": slab::specimen(specimen),
        "resolution": { "element": resolution.element, "regions": regions },
    });
    if let Some(refine) = &resolution.refine {
        whole["resolution"]["refine"] = slab::refine(refine);
    }
    whole["material"]["thickness"] = length(material.thickness);
    // The order of a study file: the crack stands between its specimen and its load.
    if let Some(crack) = crack {
        whole["crack"] = slab::notch(crack);
    }
    whole["loading"] = slab::load(loading);
    if !gauges.is_empty() {
        whole["gauges"] = slab::gauges(gauges);
    }
    whole
}

fn solid_spelled(solid: &Solid) -> Value {
    let spelled = solid::spelled(solid);
    let parts = [
        ("material", Some(atoms(&solid.material))),
        ("specimen", Some(spelled.specimen)),
        ("resolution", Some(spelled.resolution)),
        ("notch", spelled.notch),
        ("held", spelled.held),
        ("loading", Some(spelled.loading)),
        ("gauges", spelled.gauges),
    ];
    let given = parts
        .into_iter()
        .filter_map(|(key, value)| Some((key.to_owned(), value?)));
    given.collect::<Map<_, _>>().into()
}

fn atoms(material: &Material) -> Value {
    json!({ "potential": potential(&material.potential), "mass": quantity(material.mass, Dimension::Mass) })
}

fn ramp(ramp: Ramp) -> &'static str {
    match ramp {
        Ramp::InitialVelocity => "initial-velocity",
        Ramp::AtRest => "at-rest",
    }
}

fn pulse_shape(shape: PulseShape) -> &'static str {
    match shape {
        PulseShape::HalfSine => "half-sine",
        PulseShape::Gaussian => "gaussian",
    }
}

/// How a case is carried out, as it would be typed into `run`.
pub fn spelled_execution(execution: &Execution) -> Map<String, Value> {
    let mut map = Map::new();
    if let Some(ranks) = execution.ranks {
        map.insert("ranks".into(), ranks.into());
    }
    if let Some(threads) = execution.threads {
        map.insert("threads".into(), threads.into());
    }
    map.insert(
        "checkpoint-every".into(),
        quantity(execution.checkpoint_every, Dimension::Duration),
    );
    map
}

fn quantity(value: f64, dimension: Dimension) -> Value {
    units::format(value, dimension).into()
}

fn length(value: f64) -> Value {
    quantity(value, Dimension::Length)
}

fn time(value: f64) -> Value {
    quantity(value, Dimension::Time)
}

fn potential(potential: &Potential) -> Value {
    let (name, mut values) = match potential.shape {
        PotentialShape::LennardJones { epsilon, sigma } => (
            "lennard-jones",
            json!({ "epsilon": quantity(epsilon, Dimension::Energy), "sigma": length(sigma) }),
        ),
        PotentialShape::Morse { depth, decay, distance } => (
            "morse",
            json!({
                "depth": quantity(depth, Dimension::Energy),
                "decay": quantity(decay, Dimension::InverseLength),
                "distance": length(distance),
            }),
        ),
        PotentialShape::HarmonicBond { stiffness, distance } => (
            "harmonic-bond",
            json!({ "stiffness": quantity(stiffness, Dimension::Stiffness), "distance": length(distance) }),
        ),
    };
    values["cutoff"] = length(potential.cutoff);
    values["at-cutoff"] = match potential.at_cutoff {
        AtCutoff::Truncated => "truncated".into(),
        AtCutoff::Shifted => "shifted".into(),
        AtCutoff::Smooth { from } => json!({ "smooth": { "from": length(from), "to": length(potential.cutoff) } }),
    };
    json!({ name: values })
}

fn running(run: &Run) -> Value {
    let Run {
        until,
        time_step,
        summation,
        mass,
        relax,
        noise,
    } = run;
    let time_step = match *time_step {
        TimeStep::Auto { fraction } => json!({ "fraction": fraction }),
        TimeStep::Given(step) => time(step),
    };
    let summation = match *summation {
        Summation::Exact => json!("exact"),
        Summation::Gauss { points } => json!({ "gauss": points }),
        Summation::StrictGauss { points } => json!({ "gauss": { "points": points, "strict": true } }),
        Summation::Nodal => json!("nodal"),
    };
    let mass = match *mass {
        MassMatrix::Lumped => json!("lumped"),
        MassMatrix::Blend(share) => json!({ "blend": share }),
    };
    let mut spelled = json!({ "until": stop(until), "time-step": time_step, "summation": summation, "mass": mass });
    if let Some(strain) = relax {
        spelled["relax"] = json!({ "strain": quantity(*strain, Dimension::Fraction) });
    }
    if let Some(Noise { amplitude, seed }) = noise {
        spelled["noise"] = json!({ "amplitude": amplitude, "seed": seed });
    }
    spelled
}

fn stop(until: &Until) -> Value {
    let conditions = [
        (
            "strain",
            until.strain.map(|strain| quantity(strain, Dimension::Fraction)),
        ),
        ("time", until.time.map(time)),
        ("crack-length", until.crack_length.map(length)),
        ("arrest", until.arrest.map(time)),
        ("after-branch", until.after_branch.map(time)),
        ("leaves-the-plane", until.leaves_the_plane.map(time)),
    ];
    conditions
        .into_iter()
        .filter_map(|(name, value)| Some((name.to_owned(), value?)))
        .collect::<Map<_, _>>()
        .into()
}

fn interval(every: SnapshotInterval) -> Value {
    match every {
        SnapshotInterval::Strain(strain) => format!("{} strain", units::format(strain, Dimension::Fraction)).into(),
        SnapshotInterval::Time(every) => time(every),
    }
}
