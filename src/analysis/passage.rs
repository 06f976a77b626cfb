//! When a pulse passes gauges, and how fast it is between them.

/// The pulse is what is above this share of the greatest signal, so that neither ripples on its back nor its tails count.
const SHARE: f64 = 0.5;

/// When a pulse passes, ps: the middle of what is first above half of the greatest magnitude of its signal. `None` where it has
/// not passed by the end.
pub fn passage(time: &[f64], signal: &[f64]) -> Option<f64> {
    let level = SHARE * signal.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let above = |row: usize| signal[row].abs() - level;
    let rows = signal.len();
    let first = (1..rows).find(|&row| above(row) > 0.0)?;
    let behind = (first..rows).find(|&row| above(row) <= 0.0)?;
    // Where the level is crossed between a row and the next one.
    let crossing = |row: usize| {
        let [before, after] = [above(row), above(row + 1)];
        time[row] + (time[row + 1] - time[row]) * before / (before - after)
    };
    let mut points = vec![(crossing(first - 1), 0.0)];
    points.extend((first..behind).map(|row| (time[row], above(row))));
    points.push((crossing(behind - 1), 0.0));
    let [mut area, mut moment] = [0.0; 2];
    for ends in points.windows(2) {
        let [(from, low), (to, high)] = [ends[0], ends[1]];
        let width = to - from;
        area += 0.5 * width * (low + high);
        // Of a trapezoid about the time 0.
        moment += width * (from * (2.0 * low + high) + to * (low + 2.0 * high)) / 6.0;
    }
    (area > 0.0).then(|| moment / area)
}

/// Speed between two gauges, nm/ps, each a place (nm) and when the pulse passed it, ps.
pub fn speed([from, to]: [(f64, f64); 2]) -> Option<f64> {
    let speed = ((to.0 - from.0) / (to.1 - from.1)).abs();
    (speed.is_finite() && speed > 0.0).then_some(speed)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a time step, by which trapezoids between rows miss the middle of a smooth pulse.
    const MISSED: f64 = 0.01;

    /// A Gaussian, and its reflection from a free end that comes back 40 ps after it.
    fn signal(middle: f64, sign: f64) -> (Vec<f64>, Vec<f64>) {
        let time: Vec<f64> = (0..300).map(|row| 0.37 * f64::from(row)).collect();
        let hump = |time: f64| (-(time / 5.0).powi(2)).exp();
        let value = time
            .iter()
            .map(|time| sign * (hump(time - middle) + hump(time - middle - 40.0)));
        (time.clone(), value.collect())
    }

    #[test]
    fn a_pulse_passes_with_its_middle_whatever_its_sign_and_before_it_comes_back() {
        for (middle, sign) in [(23.3, 1.0), (31.1, -1.0)] {
            let (time, value) = signal(middle, sign);
            let found = passage(&time, &value).unwrap();
            assert!((found - middle).abs() < MISSED * 0.37, "{found} for {middle}");
        }
    }

    #[test]
    fn what_has_not_passed_has_no_time() {
        let (time, value) = signal(200.0, 1.0);
        assert_eq!(passage(&time[..100], &[0.0; 100]), None);
        let cut = time.partition_point(|&time| time < 50.0);
        let (_, late) = signal(49.0, 1.0);
        assert_eq!(passage(&time[..cut], &late[..cut]), None);
        assert!(passage(&time[..cut], &value[..cut]).is_none());
    }

    #[test]
    fn the_speed_is_the_way_over_the_time_in_either_direction() {
        assert_eq!(speed([(20.0, 10.0), (60.0, 30.0)]), Some(2.0));
        assert_eq!(speed([(20.0, 30.0), (60.0, 10.0)]), Some(2.0));
        assert_eq!(speed([(20.0, 10.0), (60.0, 10.0)]), None);
    }
}
