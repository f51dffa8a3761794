//! The buffers and threads of a step.

use std::io;

use laneweave_network::ChainIndex;
use laneweave_pool::Pool;

use crate::driver::plan::{Outbox, Plan};
use crate::record::counters::Counters;

/// The buffers and threads of a step, kept from one step to the next.
pub(crate) struct Work {
    /// The plans, by chain.
    pub(super) plans: Vec<Plan>,
    /// The outboxes, one for each thread.
    pub(super) outboxes: Vec<Outbox>,
    /// A pool of all threads, and one of a single thread for steps too short to share.
    pub(super) pools: [Pool; 2],
}

impl Work {
    /// The work of `threads` threads on `chains` chains.
    ///
    /// # Errors
    /// If the system does not start so many threads.
    pub(crate) fn new(chains: usize, threads: usize) -> io::Result<Work> {
        Ok(Work {
            plans: (0..chains).map(|_| Plan::default()).collect(),
            outboxes: (0..threads.max(1)).map(|_| Outbox::default()).collect(),
            pools: [Pool::new(threads)?, Pool::new(1)?],
        })
    }

    /// Goes on from the work of another world, with the memory that it has.
    pub(super) fn go_on_from(&mut self, other: &Work) {
        for (plan, other) in self.plans.iter_mut().zip(&other.plans) {
            plan.clear();
            plan.waiting.clone_from(&other.waiting);
            plan.distance = other.distance;
        }
        self.reset_counters(other.counted());
    }

    /// The outbox of all threads, after it was gathered.
    pub(super) fn outbox(&mut self) -> &mut Outbox {
        &mut self.outboxes[0]
    }

    /// Adds a distance that a vehicle drove on `chain` [m].
    pub(super) fn add_distance(&mut self, chain: ChainIndex, distance: f64) {
        self.plans[chain.at()].distance += distance;
    }

    /// The counters of drivers, added over threads, without distances.
    pub(super) fn counted(&self) -> Counters {
        let mut sum = Counters::default();
        self.outboxes.iter().for_each(|it| sum.add(&it.counters));
        sum
    }

    /// Resets the counters of drivers to `counters`, except for distances.
    pub(super) fn reset_counters(&mut self, counters: Counters) {
        self.outboxes.iter_mut().for_each(|it| it.counters = Counters::default());
        self.outbox().counters = counters;
    }
}

/// Index of the pool that moves a `crowd` of vehicles. A step of few vehicles ends before another thread begins.
pub(crate) fn pool_for(crowd: usize) -> usize {
    const WORTH_SHARING: usize = 300;
    usize::from(crowd < WORTH_SHARING)
}
