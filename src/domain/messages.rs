//! What messages cost on the machine at hand.

use std::time::Instant;

use super::Ranks;

/// Times of messages and reductions, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MessageCost {
    /// Of the shortest message.
    pub latency: f64,
    /// What every byte adds.
    pub a_byte: f64,
    /// Of a reduction of one number, a doubling of the ranks.
    pub reduction: f64,
}

/// Numbers in a long message: those of a border of some hundred elements.
const LONG: usize = 16_384;
/// Messages that are timed; the fastest counts, because a rank may have to wait for its core.
const TIMES: usize = 101;

impl Ranks {
    /// Measures it, which takes milliseconds; all ranks do so together, and only the first learns it. `None` for a rank
    /// alone.
    pub fn message_cost(self) -> Option<MessageCost> {
        if self.count() == 1 {
            return None;
        }
        let mut numbers = vec![0.0; LONG];
        let [latency, long] = [1, LONG].map(|length| 0.5 * least(|| self.to_and_fro(&mut numbers[..length])));
        let reduction = least(|| {
            self.largest(0.0);
        });
        Some(MessageCost {
            latency,
            a_byte: (long - latency).max(0.0) / (LONG * size_of::<f64>()) as f64,
            reduction: reduction / (self.count() as f64).log2().ceil(),
        })
    }
}

/// The least time of something that is done several times, s.
fn least(mut work: impl FnMut()) -> f64 {
    let times = (0..TIMES).map(|_| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    });
    times.fold(f64::INFINITY, f64::min)
}
