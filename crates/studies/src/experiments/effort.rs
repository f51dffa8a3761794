//! How much an experiment drives.

/// The effort of an experiment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Number of seeds of each kind of traffic, from 1 on; intervals need at least 2.
    pub seeds: u64,
    /// Share of the usual simulated times, 0 to 1: 1 for results, less for a try.
    pub length: f64,
    /// Number of runs side by side. Results do not depend on it.
    pub threads: usize,
}

impl Effort {
    /// So much for results.
    pub fn usual(threads: usize) -> Effort {
        Effort { seeds: 5, length: 1.0, threads }
    }

    /// A try: it shows that everything runs, and no more.
    pub fn quick(threads: usize) -> Effort {
        Effort { seeds: 2, length: 0.1, threads }
    }
}
