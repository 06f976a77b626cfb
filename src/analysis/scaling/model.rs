//! What more ranks would take, from a run of one, the cut of the mesh and the cost of messages.

use super::Times;
use crate::domain::{Burden, MessageCost};

/// The times of as many ranks as bear this burden, from the run of one rank.
///
/// Set-up and output stay with every rank, or with the first: they grow with the specimen (`growth` times that of one
/// rank). Searches and steps shrink to the work of the busiest rank. A step ends with one message from every neighbour,
/// which nothing hides, and with one reduction, whose hops double the ranks they reach. Every rank has a core with its
/// memory for itself.
pub fn predicted(one: &Times, growth: f64, burden: &Burden, messages: &MessageCost) -> Times {
    let work = growth * burden.work;
    let hops = f64::from(burden.ranks).log2().ceil();
    let exchange = f64::from(burden.messages) * messages.latency
        + burden.bytes as f64 * messages.a_byte
        + hops * messages.reduction;
    Times {
        ranks: burden.ranks,
        steps: one.steps,
        input: growth * one.input,
        map: one.map.map(|map| growth * map),
        lists: work * one.lists,
        exchange,
        solve: work * one.solve_alone() + exchange,
        output: growth * one.output,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ONE: Times = Times {
        ranks: 1,
        steps: 100.0,
        input: 2.0,
        map: None,
        lists: 8.0,
        exchange: 0.0,
        solve: 0.1,
        output: 1.0,
    };

    const MESSAGES: MessageCost = MessageCost {
        latency: 1e-5,
        a_byte: 1e-9,
        reduction: 2e-5,
    };

    #[test]
    fn four_ranks_take_what_a_hand_computes() {
        let burden = Burden {
            ranks: 4,
            work: 0.3,
            messages: 2,
            bytes: 10_000,
        };
        let four = predicted(&ONE, 1.0, &burden, &MESSAGES);
        // Two latencies, 10 kB and two hops: 20 + 10 + 40 µs.
        assert!((four.exchange - 7e-5).abs() < 1e-15);
        assert!((four.solve - 0.030_07).abs() < 1e-15);
        assert!((four.total() - (2.0 + 2.4 + 3.007 + 1.0)).abs() < 1e-12);
        let grown = predicted(&ONE, 4.0, &Burden { work: 0.25, ..burden }, &MESSAGES);
        assert!((grown.total() - (8.0 + 8.0 + 10.007 + 4.0)).abs() < 1e-12);
    }

    #[test]
    fn one_rank_takes_what_was_measured() {
        let burden = Burden {
            ranks: 1,
            work: 1.0,
            messages: 0,
            bytes: 0,
        };
        assert_eq!(predicted(&ONE, 1.0, &burden, &MESSAGES), ONE);
    }
}
