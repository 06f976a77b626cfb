//! Time that does not depend on what else the machine does.

use std::fs;
use std::time::Instant;

/// Seconds of a core that this thread has had so far.
pub fn thread_seconds() -> f64 {
    let text = fs::read_to_string("/proc/thread-self/schedstat").expect("Linux tells the time of a thread");
    let nanoseconds: f64 = text
        .split_whitespace()
        .next()
        .and_then(|word| word.parse().ok())
        .expect("a number");
    1e-9 * nanoseconds
}

/// Seconds of a core that finished children and theirs have had so far, to a hundredth.
pub fn children_seconds() -> f64 {
    let text = fs::read_to_string("/proc/self/stat").expect("Linux tells the time of a process");
    let (_, after_name) = text.rsplit_once(')').expect("the name stands in brackets");
    let ticks = after_name.split_whitespace().skip(13).take(2);
    ticks.map(|word| word.parse::<f64>().expect("a number")).sum::<f64>() / 100.0
}

/// Programs that want to run, over the last minute.
pub fn load() -> f64 {
    let text = fs::read_to_string("/proc/loadavg").unwrap_or_default();
    text.split_whitespace()
        .next()
        .and_then(|word| word.parse().ok())
        .unwrap_or(f64::NAN)
}

/// Seconds of a core that something takes in this thread.
pub fn core_seconds(work: impl FnOnce()) -> f64 {
    let start = thread_seconds();
    work();
    thread_seconds() - start
}

/// Seconds by the clock on the wall.
pub fn wall_seconds(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

pub fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    let middle = numbers.len() / 2;
    if numbers.len() % 2 == 1 {
        numbers[middle]
    } else {
        0.5 * (numbers[middle - 1] + numbers[middle])
    }
}

/// The median of some measurements.
pub fn median_of(times: usize, mut measure: impl FnMut() -> f64) -> f64 {
    median((0..times).map(|_| measure()).collect())
}

/// Does something with a number of threads for all that is computed in parallel.
pub fn with_threads<R: Send>(threads: usize, work: impl FnOnce() -> R + Send) -> R {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.expect("threads can be started").install(work)
}
