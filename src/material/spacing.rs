use crate::potential::Interaction;

/// Squared lengths of half of the bonds of a site no longer than a radius, rising, all in spacings.
pub type Shells = fn(f64) -> Vec<f64>;

/// The lattice spacing at which the crystal of this potential has no pressure and the lowest energy.
///
/// The sum over bonds is scanned for sign changes of its derivative, which also finds the right state where
/// truncation makes the energy jump as a shell enters. `None`: the potential holds no crystal together.
pub fn zero_pressure_spacing(interaction: &Interaction, shells: Shells) -> Option<f64> {
    const SCAN: usize = 4000;
    const NARROWEST: f64 = 0.7;
    let widest = interaction.cutoff().min(1.3 * interaction.minimum());
    let narrowest = NARROWEST * interaction.minimum();
    let site = Site {
        interaction,
        bonds: shells(interaction.cutoff() / narrowest),
    };
    let spacings: Vec<f64> = (0..=SCAN)
        .map(|k| narrowest + (widest - narrowest) * k as f64 / SCAN as f64)
        .collect();
    let slopes: Vec<f64> = spacings.iter().map(|&spacing| site.slope(spacing)).collect();
    let rises = (0..SCAN).filter(|&k| slopes[k] < 0.0 && slopes[k + 1] >= 0.0);
    let crossings = rises.map(|k| site.bisect(spacings[k], spacings[k + 1]));
    let stable = crossings.filter(|&spacing| site.slope(spacing).abs() < 1e-6 * site.scale(spacing));
    stable.min_by(|&a, &b| site.energy(a).total_cmp(&site.energy(b)))
}

/// One site of the crystal and its bonds.
struct Site<'a> {
    interaction: &'a Interaction,
    /// Squared lengths of half of its bonds, in spacings: all that may be within the cutoff.
    bonds: Vec<f64>,
}

impl Site<'_> {
    fn bisect(&self, mut low: f64, mut high: f64) -> f64 {
        while high > low {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if self.slope(middle) < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    }

    fn energy(&self, spacing: f64) -> f64 {
        self.sum(spacing, |squared| self.interaction.evaluate(squared).energy)
    }

    /// Derivative of the energy with the logarithm of the spacing.
    fn slope(&self, spacing: f64) -> f64 {
        self.sum(spacing, |squared| self.interaction.evaluate(squared).slope * squared)
    }

    /// What the slope is compared with: the second derivative, without its sign.
    fn scale(&self, spacing: f64) -> f64 {
        self.sum(spacing, |squared| {
            (self.interaction.curvature(squared.sqrt()) * squared).abs()
        })
    }

    /// Bonds come by rising length, and beyond the cutoff all are worth nothing.
    fn sum(&self, spacing: f64, term: impl Fn(f64) -> f64) -> f64 {
        let cutoff = self.interaction.cutoff();
        let squared = self.bonds.iter().map(|length| length * spacing * spacing);
        squared.take_while(|&squared| squared < cutoff * cutoff).map(term).sum()
    }
}
