//! What repeats of one case scatter by, and how long two of them stay together.

use super::series::Series;

/// Of a quantity in some repeats: in rising order the least, the quartiles with the median between them, and the most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scatter {
    pub count: usize,
    pub least: f64,
    pub lower: f64,
    pub median: f64,
    pub upper: f64,
    pub most: f64,
}

/// Repeats that differ by a smaller share have not parted.
const PARTED: f64 = 1e-6;

impl Scatter {
    /// Of the repeats that have the quantity; `None` where no two have.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut values: Vec<f64> = values.into_iter().collect();
        values.sort_by(f64::total_cmp);
        (values.len() > 1).then(|| {
            let [least, lower, median, upper, most] = [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| at(&values, share));
            Self {
                count: values.len(),
                least,
                lower,
                median,
                upper,
                most,
            }
        })
    }

    /// Whether the repeats have parted; where they have not, they are one run and tell nothing of chance.
    pub fn has_parted(&self) -> bool {
        self.most - self.least > PARTED * self.least.abs().max(self.most.abs())
    }

    /// From quartile to quartile: half of the repeats lie between.
    pub fn width(&self) -> f64 {
        self.upper - self.lower
    }
}

/// The number at a share of the way through ascending ones, linear between two of them.
fn at(ascending: &[f64], share: f64) -> f64 {
    let place = share * (ascending.len() - 1) as f64;
    let [low, high] = [place.floor(), place.ceil()].map(|place| ascending[place as usize]);
    low + (place - place.floor()) * (high - low)
}

/// Where two runs are first seen to differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parting {
    pub step: u64,
    /// ps
    pub time: f64,
}

/// Where other bonds break in one of two runs than in the other, or at another probe; `None` where the same ones do.
pub fn parting(one: &Series, other: &Series) -> Option<Parting> {
    let same = one.bonds.iter().zip(&other.bonds).take_while(|(a, b)| a == b).count();
    let next = [one, other].map(|series| series.bonds.get(same).map(|event| event.probe));
    let first = next.into_iter().flatten().min()?;
    let probe = one.probes.get(first as usize)?;
    Some(Parting {
        step: probe.step,
        time: probe.time,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::series::{BondEvent, Probe};

    #[test]
    fn half_of_the_repeats_lie_between_the_quartiles() {
        let scatter = Scatter::of([5.0, 1.0, 2.0, 4.0, 3.0]).unwrap();
        let numbers = [
            scatter.least,
            scatter.lower,
            scatter.median,
            scatter.upper,
            scatter.most,
        ];
        assert_eq!(numbers, [1.0, 2.0, 3.0, 4.0, 5.0]);
        assert_eq!(Scatter::of([1.0, 2.0]).unwrap().median, 1.5);
        assert_eq!([scatter.count, scatter.width() as usize], [5, 2]);
        assert!(Scatter::of([1.0]).is_none());
    }

    #[test]
    fn what_differs_by_rounding_has_not_parted() {
        let parted = |values: [f64; 2]| Scatter::of(values).unwrap().has_parted();
        assert!(!parted([176.0, 176.0 + 1e-9]) && parted([176.0, 176.1]) && !parted([0.0, 0.0]));
    }

    #[test]
    fn two_runs_part_where_the_first_other_bond_breaks() {
        let series = |columns: &[i32]| Series {
            probes: (0..9)
                .map(|probe| Probe {
                    step: 100 * probe,
                    time: probe as f64,
                    ..Probe::default()
                })
                .collect(),
            bonds: (2..)
                .zip(columns)
                .map(|(probe, &column)| BondEvent {
                    probe,
                    column,
                    row: 0,
                    direction: 0,
                    broken: true,
                })
                .collect(),
            ..Series::default()
        };
        let parted = |a: &[i32], b: &[i32]| parting(&series(a), &series(b)).map(|parting| parting.step);
        assert_eq!(parted(&[1, 2, 3], &[1, 2, 3]), None);
        assert_eq!(parted(&[1, 2, 3], &[1, 5, 3]), Some(300));
        assert_eq!(parted(&[1, 2, 3], &[1, 2]), Some(400), "one breaks more");
        assert_eq!(parted(&[], &[]), None);
    }
}
