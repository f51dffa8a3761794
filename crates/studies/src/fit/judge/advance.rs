//! How far a judgement is.

use std::sync::atomic::{AtomicUsize, Ordering};

/// How many of all simulations are done.
pub(super) struct Advance<'a> {
    done: AtomicUsize,
    all: usize,
    show: &'a (dyn Fn(f64) + Sync),
}

impl<'a> Advance<'a> {
    /// None of them is. `show` is told the share that is done, from 0 to 1.
    pub(super) fn of(all: usize, show: &'a (dyn Fn(f64) + Sync)) -> Advance<'a> {
        Advance { done: AtomicUsize::new(0), all: all.max(1), show }
    }

    /// One more is done.
    pub(super) fn by_one(&self) {
        let done = 1 + self.done.fetch_add(1, Ordering::Relaxed);
        (self.show)(done as f64 / self.all as f64);
    }
}
