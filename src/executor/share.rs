//! How the cores of a machine are shared between cases.

/// Jobs at once and the threads of each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Share {
    pub jobs: usize,
    pub threads: u32,
}

/// Speed of a case on n threads over its speed on one is n to this power: threads wait for each other at every step.
const THREAD_EFFICIENCY: f64 = 0.9;

/// The share with which cases of these estimated times (s on one thread) are done first; what the user gave is kept.
///
/// Without a choice of the user no more threads run than there are cores.
pub fn share(seconds: &[f64], cores: usize, jobs: Option<usize>, threads: Option<u32>) -> Share {
    let cores = cores.max(1);
    let threads_of = |jobs: usize| threads.unwrap_or((cores / jobs).max(1) as u32);
    if let Some(jobs) = jobs {
        return Share {
            jobs,
            threads: threads_of(jobs),
        };
    }
    let most = threads
        .map_or(cores, |threads| (cores / threads.max(1) as usize).max(1))
        .min(seconds.len().max(1));
    let candidates = (1..=most).map(|jobs| Share {
        jobs,
        threads: threads_of(jobs),
    });
    let end = |share: &Share| makespan(seconds, share.jobs) / f64::from(share.threads).powf(THREAD_EFFICIENCY);
    candidates.min_by(|a, b| end(a).total_cmp(&end(b))).unwrap_or(Share {
        jobs: 1,
        threads: threads_of(1),
    })
}

/// When the last case ends if the longest is always started first on the job that is free first.
fn makespan(seconds: &[f64], jobs: usize) -> f64 {
    let mut longest_first = seconds.to_vec();
    longest_first.sort_by(|a, b| b.total_cmp(a));
    let mut busy_until = vec![0.0_f64; jobs.max(1)];
    for duration in longest_first {
        if let Some(first_free) = busy_until.iter_mut().min_by(|a, b| a.total_cmp(b)) {
            *first_free += duration;
        }
    }
    busy_until.into_iter().fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_cases_run_side_by_side_and_one_long_case_gets_all_threads() {
        assert_eq!(share(&[10.0; 8], 4, None, None), Share { jobs: 4, threads: 1 });
        assert_eq!(share(&[100.0, 1.0, 1.0], 2, None, None), Share { jobs: 1, threads: 2 });
        assert_eq!(share(&[10.0], 8, None, None), Share { jobs: 1, threads: 8 });
    }

    #[test]
    fn a_share_without_the_users_choice_never_exceeds_the_cores() {
        for cores in 1..=16 {
            for cases in 0..=6 {
                let seconds: Vec<f64> = (0..cases).map(|case| 1.0 + f64::from(case * case)).collect();
                let chosen = share(&seconds, cores, None, None);
                assert!(chosen.jobs >= 1 && chosen.threads >= 1);
                assert!(
                    chosen.jobs * chosen.threads as usize <= cores,
                    "{chosen:?} on {cores} cores"
                );
            }
        }
    }

    #[test]
    fn what_the_user_gives_is_kept() {
        assert_eq!(share(&[1.0; 4], 8, Some(2), None), Share { jobs: 2, threads: 4 });
        assert_eq!(share(&[1.0; 4], 8, None, Some(4)), Share { jobs: 2, threads: 4 });
        assert_eq!(share(&[1.0; 4], 1, Some(3), Some(2)), Share { jobs: 3, threads: 2 });
    }
}
