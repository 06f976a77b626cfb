//! Times on the wall and sizes on the disk, as people say them.

/// `< 0.1 s`, `0.4 s`, `42 s`, `3 min 20 s`, `2 h 5 min`.
pub fn duration(seconds: f64) -> String {
    let whole = seconds.round() as u64;
    match whole {
        _ if seconds < 0.05 => "< 0.1 s".to_owned(),
        _ if seconds < 9.95 => format!("{seconds:.1} s"),
        0..=59 => format!("{whole} s"),
        60..=3599 => format!("{} min {} s", whole / 60, whole % 60),
        _ => format!("{} h {} min", whole / 3600, whole % 3600 / 60),
    }
}

/// `640 B`, `3.2 MB`.
pub fn bytes(bytes: u64) -> String {
    const UNITS: [&str; 4] = ["kB", "MB", "GB", "TB"];
    if bytes < 1000 {
        return format!("{bytes} B");
    }
    let mut amount = bytes as f64 / 1000.0;
    let mut unit = 0;
    while amount >= 1000.0 && unit + 1 < UNITS.len() {
        amount /= 1000.0;
        unit += 1;
    }
    format!("{amount:.1} {}", UNITS[unit])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amounts_read_as_people_say_them() {
        assert_eq!(
            [0.01, 0.41, 9.9, 42.4, 200.0, 7500.0].map(duration),
            ["< 0.1 s", "0.4 s", "9.9 s", "42 s", "3 min 20 s", "2 h 5 min"]
        );
        assert_eq!(
            [640, 3_210_000, 5_000_000_000].map(bytes),
            ["640 B", "3.2 MB", "5.0 GB"]
        );
    }
}
