use crate::lattice::triangular;
use crate::potential::Interaction;

/// The lattice spacing at which the crystal of this potential has no pressure and the lowest energy.
///
/// The sum over bonds is scanned for sign changes of its derivative, which also finds the right state where
/// truncation makes the energy jump as a shell enters. `None`: the potential holds no crystal together.
pub fn zero_pressure_spacing(interaction: &Interaction) -> Option<f64> {
    const SCAN: usize = 4000;
    const NARROWEST: f64 = 0.7;
    let widest = interaction.cutoff().min(1.3 * interaction.minimum());
    let narrowest = NARROWEST * interaction.minimum();
    let spacing = |k: usize| narrowest + (widest - narrowest) * k as f64 / SCAN as f64;
    let crossings = (0..SCAN).filter_map(|k| {
        let [low, high] = [spacing(k), spacing(k + 1)];
        let rises = slope(interaction, low) < 0.0 && slope(interaction, high) >= 0.0;
        rises.then(|| bisect(interaction, low, high))
    });
    let stable = crossings.filter(|&spacing| slope(interaction, spacing).abs() < 1e-6 * scale(interaction, spacing));
    stable.min_by(|&a, &b| energy(interaction, a).total_cmp(&energy(interaction, b)))
}

fn bisect(interaction: &Interaction, mut low: f64, mut high: f64) -> f64 {
    while high > low {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if slope(interaction, middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// Energy of one site.
fn energy(interaction: &Interaction, spacing: f64) -> f64 {
    sum(interaction, spacing, |squared| interaction.evaluate(squared).energy)
}

/// Derivative of the energy with the logarithm of the spacing.
fn slope(interaction: &Interaction, spacing: f64) -> f64 {
    sum(interaction, spacing, |squared| {
        interaction.evaluate(squared).slope * squared
    })
}

/// What the slope is compared with: the second derivative, without its sign.
fn scale(interaction: &Interaction, spacing: f64) -> f64 {
    sum(interaction, spacing, |squared| {
        (interaction.curvature(squared.sqrt()) * squared).abs()
    })
}

fn sum(interaction: &Interaction, spacing: f64, term: impl Fn(f64) -> f64) -> f64 {
    let bonds = triangular::half_vectors_within(interaction.cutoff() / spacing);
    bonds
        .into_iter()
        .map(|bond| term(f64::from(triangular::squared_length(bond)) * spacing * spacing))
        .sum()
}
