//! The forces on sites, several sites side by side.

use multiversion::multiversion;

use super::Contacts;
use crate::forces::lanes::Lanes;
use crate::potential::{CutPotential, PairShape};

/// Sites computed at a time.
const WIDTH: usize = 8;

/// Forces on consecutive sites, from the one with this number on.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx2+fma", "x86_64+avx2+fma"))]
pub fn sum_chunk<S: PairShape>(contacts: &Contacts, law: &CutPotential<S>, from: usize, x: &mut [f64], y: &mut [f64]) {
    let count = x.len();
    let mut at = 0;
    while at < count {
        if at + WIDTH <= count {
            let [sum_x, sum_y] = sum_lanes::<S, WIDTH>(contacts, law, from + at);
            sum_x.store(x, at);
            sum_y.store(y, at);
            at += WIDTH;
        } else {
            let [sum_x, sum_y] = sum_lanes::<S, 1>(contacts, law, from + at);
            sum_x.store(x, at);
            sum_y.store(y, at);
            at += 1;
        }
    }
}

/// Every lane goes through its own partners in their order; one that has no more waits for the others.
#[inline(always)]
fn sum_lanes<S: PairShape, const W: usize>(contacts: &Contacts, law: &CutPotential<S>, from: usize) -> [Lanes<W>; 2] {
    let [site_x, site_y] = &contacts.position;
    let [here_x, here_y] = [Lanes::<W>::load(site_x, from), Lanes::<W>::load(site_y, from)];
    let start = &contacts.start[from..=from + W];
    let mut longest = 0;
    for lane in 0..W {
        longest = longest.max(start[lane + 1] - start[lane]);
    }
    let [mut sum_x, mut sum_y] = [Lanes::default(); 2];
    for slot in 0..longest {
        let [mut there_x, mut there_y] = [[0.0; W]; 2];
        let mut counts = [0.0; W];
        let mut any_severed = false;
        let mut severed = [false; W];
        for lane in 0..W {
            let entry = start[lane] + slot;
            if entry < start[lane + 1] {
                let partner = contacts.partners[entry as usize];
                let other = partner.site();
                there_x[lane] = site_x[other];
                there_y[lane] = site_y[other];
                severed[lane] = partner.severed();
                any_severed |= severed[lane];
                counts[lane] = contacts.count(from + lane, other);
            } else {
                // Anything that is not at the site itself.
                there_x[lane] = here_x[lane] + contacts.spacing;
                there_y[lane] = here_y[lane];
            }
        }
        let [dx, dy] = [Lanes(there_x) - here_x, Lanes(there_y) - here_y];
        let squared = dx.mul_add(dx, dy * dy);
        let mut slopes = law.slopes(squared.0);
        if any_severed {
            for lane in (0..W).filter(|&lane| severed[lane]) {
                slopes[lane] = law.repulsion(squared[lane], contacts.spacing).slope;
            }
        }
        let pull = Lanes(slopes) * Lanes(counts);
        sum_x = pull.mul_add(dx, sum_x);
        sum_y = pull.mul_add(dy, sum_y);
    }
    [sum_x, sum_y]
}
