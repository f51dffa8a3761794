//! What a step is worked out with.

use crate::driver::plan::{Outbox, Plan};
use crate::step::pool::Pool;

/// Room for the work of a step, kept from one to the next.
pub(crate) struct Work {
    /// By chain.
    pub(crate) plans: Vec<Plan>,
    /// One for each thread.
    pub(crate) outboxes: Vec<Outbox>,
    /// All threads, and one alone for steps too short to share.
    pub(crate) pools: [Pool; 2],
}

impl Work {
    /// Room for the work of so many threads on so many chains.
    pub(crate) fn new(chains: usize, threads: usize) -> Work {
        Work {
            plans: (0..chains).map(|_| Plan::default()).collect(),
            outboxes: (0..threads.max(1)).map(|_| Outbox::default()).collect(),
            pools: [Pool::new(threads), Pool::new(1)],
        }
    }
}

/// Which pool moves so many vehicles: a step of fewer is over before another thread has begun.
pub(crate) fn pool_for(crowd: usize) -> usize {
    const WORTH_SHARING: usize = 300;
    usize::from(crowd < WORTH_SHARING)
}
