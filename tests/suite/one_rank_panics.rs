//! The second rank panics while the others wait for it. A test looks how the job ends.

use cgaft::domain;

fn main() {
    let (ranks, _session) = domain::start().expect("mpirun has started several ranks");
    assert_ne!(ranks.rank(), 1, "rank 1 panics");
    ranks.wait_for_all();
    std::thread::sleep(std::time::Duration::MAX);
}
