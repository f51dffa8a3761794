//! What a step is worked out with.

use crate::driver::plan::{Outbox, Plan};
use crate::record::counters::Counters;
use crate::step::pool::Pool;

/// Room for the work of a step, kept from one to the next.
pub(crate) struct Work {
    /// By chain.
    pub(super) plans: Vec<Plan>,
    /// One for each thread.
    pub(super) outboxes: Vec<Outbox>,
    /// All threads, and one alone for steps too short to share.
    pub(super) pools: [Pool; 2],
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

    /// What all threads wrote down, once it is gathered.
    pub(super) fn outbox(&mut self) -> &mut Outbox {
        &mut self.outboxes[0]
    }

    /// What the drivers did so far, added up over threads, without distances.
    pub(super) fn counted(&self) -> Counters {
        let mut sum = Counters::default();
        self.outboxes.iter().for_each(|it| sum.add(&it.counters));
        sum
    }

    /// Forgets what the drivers did so far, but for this, and for distances.
    pub(super) fn reset_counters(&mut self, counters: Counters) {
        self.outboxes.iter_mut().for_each(|it| it.counters = Counters::default());
        self.outbox().counters = counters;
    }
}

/// Which pool moves so many vehicles: a step of fewer is over before another thread has begun.
pub(crate) fn pool_for(crowd: usize) -> usize {
    const WORTH_SHARING: usize = 300;
    usize::from(crowd < WORTH_SHARING)
}
