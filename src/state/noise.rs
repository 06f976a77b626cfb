//! Small random displacements: what tells a result of the specimen from one of its rounding.

use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

use super::State;

/// Displaces every node that is free to move, along each axis by less than an amplitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// In spacings of the lattice.
    pub amplitude: f64,
    pub seed: u64,
}

/// Numbers that a site may draw.
const DRAWS: u128 = 4;

impl Noise {
    /// What it may put into a specimen of a mass, eV: no mode of it is faster than 2 over the stability limit, ps, so that the mean energy of
    /// a displacement is at most m omega^2 a^2/6 an axis.
    pub fn most_energy<const D: usize>(self, mass: f64, spacing: f64, stability_limit: f64) -> f64 {
        let fastest = 2.0 * self.amplitude * spacing / stability_limit;
        mass * D as f64 * fastest * fastest / 6.0
    }

    /// Displaces the nodes of a state, each of which stands at a site of the lattice. A site has its own place in the sequence
    /// of the generator, so that its displacement depends on the seed and the site alone: not on who asks, nor on the mesh.
    pub fn displace<const D: usize>(self, state: &mut State<D>, spacing: f64, site_of: impl Fn(usize) -> [i32; D]) {
        let start = Pcg64::seed_from_u64(self.seed);
        for node in 0..state.nodes() {
            if !state.has(node) {
                continue;
            }
            let mut generator = start.clone();
            generator.advance(place(site_of(node)));
            for axis in 0..D {
                let drawn = even(generator.next_u64());
                if state.mobility[axis][node] > 0.0 {
                    state.position[axis][node] += self.amplitude * spacing * drawn;
                }
            }
        }
    }
}

/// Where the numbers of a site begin.
fn place<const D: usize>(site: [i32; D]) -> u128 {
    let along = |place: u128, component: i32| (place << 32) + u128::from(component.wrapping_sub(i32::MIN) as u32);
    DRAWS * site.into_iter().fold(0, along)
}

/// Evenly from -1 to 1, of all 53 bits that a number has.
fn even(word: u64) -> f64 {
    const STEP: f64 = 1.0 / (1u64 << 52) as f64;
    (word >> 11) as f64 * STEP - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    const NODES: i32 = 4000;

    fn at_rest() -> State {
        let places = || vec![0.0; NODES as usize];
        State::at_rest([places(), places()], vec![1.0; NODES as usize])
    }

    fn displaced(seed: u64, site_of: impl Fn(usize) -> [i32; 2]) -> State {
        let mut state = at_rest();
        Noise { amplitude: 2.0, seed }.displace(&mut state, 1.0, site_of);
        state
    }

    #[test]
    fn noise_is_even_and_of_its_amplitude() {
        // Of so many even numbers from -2 to 2 the mean is 0 and the mean square 4/3, each within five of its deviations.
        let state = displaced(7, |node| [node as i32 % 100 - 50, node as i32 / 100 - 20]);
        let count = f64::from(2 * NODES);
        let all = || state.position.iter().flatten();
        let [mean, square] = [all().sum::<f64>() / count, all().map(|x| x * x).sum::<f64>() / count];
        assert!(all().all(|x| x.abs() < 2.0));
        assert!(mean.abs() < 5.0 * (4.0 / 3.0 / count).sqrt(), "{mean}");
        assert!(
            (square - 4.0 / 3.0).abs() < 5.0 * (64.0 / 45.0 / count).sqrt(),
            "{square}"
        );
        let product: f64 = state.position[0]
            .iter()
            .zip(&state.position[1])
            .map(|(x, y)| x * y)
            .sum();
        assert!(product.abs() < 5.0 * 4.0 / 3.0 * f64::from(NODES).sqrt(), "{product}");
    }

    #[test]
    fn the_noise_of_a_site_depends_on_the_seed_and_the_site_alone() {
        let forwards = displaced(7, |node| [node as i32, -3]);
        let backwards = displaced(7, |node| [NODES - 1 - node as i32, -3]);
        for axis in 0..2 {
            let mut turned = backwards.position[axis].clone();
            turned.reverse();
            assert_eq!(forwards.position[axis], turned);
        }
        assert_ne!(forwards, displaced(8, |node| [node as i32, -3]));
    }

    #[test]
    fn noise_puts_no_more_energy_in_than_oscillators_of_the_highest_frequency_take() {
        // Springs of stiffness 9 on masses of 1: omega = 3, and the limit is 2/3.
        let state = displaced(7, |node| [node as i32, 3]);
        let stored: f64 = state.position.iter().flatten().map(|x| 4.5 * x * x).sum();
        let most = Noise {
            amplitude: 2.0,
            seed: 7,
        }
        .most_energy::<2>(f64::from(NODES), 1.0, 2.0 / 3.0);
        const SCATTER: f64 = 0.05;
        assert!((stored / most - 1.0).abs() < SCATTER, "{stored} of {most}");
    }

    #[test]
    fn what_is_held_stays() {
        let mut state = at_rest();
        state.mobility[1][5] = 0.0;
        Noise {
            amplitude: 1.0,
            seed: 1,
        }
        .displace(&mut state, 1.0, |node| [node as i32, 0]);
        assert!(state.position[1][5] == 0.0 && state.position[0][5] != 0.0);
    }
}
