//! What the system tells of memory.

use std::path::Path;

use crate::durable;

/// Bytes that are free.
pub fn free() -> Option<u64> {
    entry("/proc/meminfo", "MemAvailable:")
}

/// The most that this process has used so far, bytes.
pub fn peak() -> Option<u64> {
    entry("/proc/self/status", "VmHWM:")
}

/// Bytes that a line such as `MemAvailable:   24123456 kB` of a file stands for.
fn entry(file: &str, name: &str) -> Option<u64> {
    let table = durable::read_to_string(Path::new(file)).ok()?;
    let line = table.lines().find(|line| line.starts_with(name))?;
    let kibibytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(1024 * kibibytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(target_os = "linux")]
    fn this_process_uses_some_memory_and_leaves_some() {
        assert!(peak().unwrap() > 1024 * 1024 && free().unwrap() > 1024 * 1024);
    }
}
