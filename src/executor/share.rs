//! How the cores of a machine are shared between cases.

/// What computes one case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Crew {
    /// Processes.
    pub ranks: u32,
    /// Threads of each.
    pub threads: u32,
}

impl Crew {
    /// Cores that it keeps busy.
    pub fn cores(self) -> usize {
        self.ranks as usize * self.threads as usize
    }
}

/// What a case asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demand {
    /// Estimated time on one core, s.
    pub seconds: f64,
    pub ranks: u32,
    /// Of each rank; `None`: its share of the cores.
    pub threads: Option<u32>,
}

/// Cases at once, and threads of those that leave them open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Share {
    pub jobs: usize,
    pub threads: u32,
    /// Cores that the cases at work may take together; `None`: the user has said how many cases run at once.
    pub cores: Option<usize>,
}

/// Speed of a case on n cores over its speed on one is n to this power: threads and ranks wait for each other at every
/// step. Two threads take 0.68 of the time of one for model A of Deng (2011) with its crack, two ranks 0.6.
const EFFICIENCY: f64 = 0.75;

/// The share with which the last of these cases is done first; what the user gave is kept.
///
/// Without a choice of the user no more cores are taken than there are, unless a single case asks for more.
pub fn share(demands: &[Demand], cores: usize, jobs: Option<usize>) -> Share {
    let cores = cores.max(1);
    let most_ranks = demands.iter().map(|demand| demand.ranks).max().unwrap_or(1).max(1) as usize;
    let with = |jobs: usize, limit: Option<usize>| Share {
        jobs,
        threads: (cores / (jobs * most_ranks)).max(1) as u32,
        cores: limit,
    };
    if let Some(jobs) = jobs {
        return with(jobs, None);
    }
    let candidates = (1..=cores.min(demands.len().max(1))).map(|jobs| with(jobs, Some(cores)));
    candidates
        .min_by(|a, b| makespan(demands, a).total_cmp(&makespan(demands, b)))
        .unwrap_or_else(|| with(1, Some(cores)))
}

impl Share {
    pub fn crew(&self, demand: &Demand) -> Crew {
        Crew {
            ranks: demand.ranks.max(1),
            threads: demand.threads.unwrap_or(self.threads),
        }
    }

    /// Estimated time of a case on what it gets, s.
    pub fn duration(&self, demand: &Demand) -> f64 {
        let crew = self.crew(demand).cores();
        let cores = self.cores.map_or(crew, |cores| cores.min(crew));
        demand.seconds / (cores as f64).powf(EFFICIENCY)
    }

    /// A crew at work with the cores that all those at work leave idle, if its case leaves the threads open.
    pub fn widened(&self, crew: Crew, demand: &Demand, at_work: &[Crew]) -> Crew {
        let taken: usize = at_work.iter().map(|crew| crew.cores()).sum();
        let cores = self.cores.filter(|_| demand.threads.is_none());
        let idle = cores.map_or(0, |cores| cores.saturating_sub(taken));
        Crew {
            threads: crew.threads + idle as u32 / crew.ranks,
            ..crew
        }
    }

    /// Whether a case may start beside those at work. What is larger than the machine runs alone.
    pub fn has_room(&self, at_work: &[Crew], next: Crew) -> bool {
        let taken: usize = at_work.iter().map(|crew| crew.cores()).sum();
        let fits = self.cores.is_none_or(|cores| taken + next.cores() <= cores);
        at_work.len() < self.jobs && (at_work.is_empty() || fits)
    }
}

/// When the last case ends if the longest is started first, and each next one as soon as there is room for it.
fn makespan(demands: &[Demand], share: &Share) -> f64 {
    let mut longest_first: Vec<&Demand> = demands.iter().collect();
    longest_first.sort_by(|a, b| share.duration(b).total_cmp(&share.duration(a)));
    let mut at_work: Vec<(f64, Crew)> = Vec::new();
    let mut now = 0.0;
    for demand in longest_first {
        let crew = share.crew(demand);
        while !share.has_room(&at_work.iter().map(|(_, crew)| *crew).collect::<Vec<_>>(), crew) {
            let ends = at_work.iter().map(|(end, _)| *end);
            now = ends.fold(f64::INFINITY, f64::min);
            at_work.retain(|(end, _)| *end > now);
        }
        at_work.push((now + share.duration(demand), crew));
    }
    at_work.iter().map(|(end, _)| *end).fold(now, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn demands(seconds: &[f64], ranks: u32, threads: Option<u32>) -> Vec<Demand> {
        let demand = |&seconds: &f64| Demand {
            seconds,
            ranks,
            threads,
        };
        seconds.iter().map(demand).collect()
    }

    fn shared(seconds: &[f64], cores: usize, jobs: Option<usize>, threads: Option<u32>) -> (usize, u32) {
        let demands = demands(seconds, 1, threads);
        let share = share(&demands, cores, jobs);
        (share.jobs, share.crew(&demands[0]).threads)
    }

    #[test]
    fn equal_cases_run_side_by_side_and_one_long_case_gets_all_threads() {
        assert_eq!(shared(&[10.0; 8], 4, None, None), (4, 1));
        assert_eq!(shared(&[100.0, 1.0, 1.0], 2, None, None), (1, 2));
        assert_eq!(shared(&[10.0], 8, None, None), (1, 8));
    }

    #[test]
    fn what_the_user_gives_is_kept() {
        assert_eq!(shared(&[1.0; 4], 8, Some(2), None), (2, 4));
        assert_eq!(shared(&[1.0; 4], 8, None, Some(4)), (2, 4));
        assert_eq!(shared(&[1.0; 4], 1, Some(3), Some(2)), (3, 2));
    }

    #[test]
    fn ranks_and_threads_share_the_cores() {
        let pairs = demands(&[10.0; 4], 2, None);
        assert_eq!(
            share(&pairs, 8, None),
            Share {
                jobs: 4,
                threads: 1,
                cores: Some(8)
            }
        );
        assert_eq!(
            share(&pairs[..1], 8, None),
            Share {
                jobs: 1,
                threads: 4,
                cores: Some(8)
            }
        );
    }

    #[test]
    fn cases_at_work_never_exceed_the_cores_unless_one_alone_does() {
        for cores in 1..=9 {
            for ranks in 1..=4 {
                let demands = demands(&[9.0, 4.0, 2.0, 1.0], ranks, None);
                let share = share(&demands, cores, None);
                let crew = share.crew(&demands[0]);
                let mut at_work = Vec::new();
                while share.has_room(&at_work, crew) {
                    at_work.push(crew);
                }
                let taken: usize = at_work.iter().map(|crew| crew.cores()).sum();
                assert!(
                    taken <= cores.max(ranks as usize) && !at_work.is_empty(),
                    "{share:?} on {cores} cores with {ranks} ranks"
                );
            }
        }
    }

    #[test]
    fn a_crew_is_widened_by_the_cores_that_are_idle_unless_the_user_has_said_how_many_it_has() {
        let share = Share {
            jobs: 3,
            threads: 2,
            cores: Some(8),
        };
        let [demand, given] = [None, Some(2)].map(|threads| demands(&[1.0], 1, threads)[0]);
        let [one, two] = [1, 2].map(|ranks| Crew { ranks, threads: 2 });
        let threads = |share: &Share, crew, demand: &Demand, beside: &[Crew]| {
            share.widened(crew, demand, &[beside, &[crew]].concat()).threads
        };
        assert_eq!(threads(&share, one, &demand, &[]), 8);
        assert_eq!(threads(&share, one, &demand, &[one, one]), 4);
        assert_eq!(threads(&share, two, &demand, &[one]), 3);
        assert_eq!(threads(&share, two, &demand, &[two]), 2);
        assert_eq!(threads(&share, one, &given, &[]), 2);
        let by_the_user = Share { cores: None, ..share };
        assert_eq!(threads(&by_the_user, one, &demand, &[]), 2);
    }

    #[test]
    fn a_wide_case_waits_for_narrow_ones_and_they_for_it() {
        let share = Share {
            jobs: 4,
            threads: 1,
            cores: Some(4),
        };
        let [narrow, wide] = [1, 3].map(|ranks| Crew { ranks, threads: 1 });
        assert!(share.has_room(&[narrow], wide) && !share.has_room(&[narrow, narrow], wide));
        assert!(share.has_room(&[wide], narrow) && !share.has_room(&[wide, narrow], narrow));
    }
}
