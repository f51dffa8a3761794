//! The hand-over of the pool to one worker, in all orders in which the two can run that interrupt them twice at most.

use std::panic::resume_unwind;

use handover::{Handover, Job, Phase};
use loom::cell::UnsafeCell;
use loom::model::Builder;
use loom::sync::Arc;
use loom::thread;

#[path = "../src/handover.rs"]
mod handover;

/// What the hand-over needs, in which loom chooses who goes on.
mod sync {
    use std::cell::Cell;

    pub(crate) use loom::cell::UnsafeCell;
    pub(crate) use loom::sync::Mutex;
    pub(crate) use loom::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

    pub(crate) const SPINS: u32 = 0;

    thread_local! {
        /// Whether workers park. Loom takes all that is said before a thread is woken as known to it: what the job's
        /// number alone tells is seen only where nobody parks.
        pub(crate) static PARKS: Cell<bool> = const { Cell::new(true) };
    }

    pub(crate) fn park() {
        if PARKS.get() { loom::thread::park() } else { loom::thread::yield_now() }
    }

    pub(crate) fn pause(_: u32) {
        loom::thread::yield_now();
    }
}

/// A number that one thread writes while no other reads it, or loom finds it.
#[derive(Default)]
struct Item(UnsafeCell<u32>);

// SAFETY: this is what loom checks.
#[expect(unsafe_code, reason = "loom finds who reads while somebody writes")]
unsafe impl Sync for Item {}

#[expect(unsafe_code, reason = "loom finds who reads while somebody writes")]
impl Item {
    fn get(&self) -> u32 {
        // SAFETY: this is what loom checks.
        self.0.with(|it| unsafe { *it })
    }

    fn add(&self) {
        // SAFETY: this is what loom checks.
        self.0.with_mut(|it| unsafe { *it += 1 });
    }
}

/// What is done to the items in each phase: everybody looks at all of them, then adds to its own. In a job that fails
/// the first item panics in a phase.
fn call(all: &Arc<Vec<Item>>) -> impl Fn(&Option<Phase>, Phase, usize, usize) + use<> {
    let all = Arc::clone(all);
    move |fails, phase, _, index| {
        if index == 0 && *fails == Some(phase) {
            resume_unwind(Box::new(phase));
        }
        match phase {
            Phase::Look => all.iter().for_each(|it| _ = it.get()),
            Phase::Act => all[index].add(),
        }
    }
}

/// Lets the caller and a worker do the jobs one after the other.
fn check(parks: bool, items: usize, jobs: &'static [Option<Phase>]) {
    sync::PARKS.set(parks);
    let mut model = Builder::new();
    model.preemption_bound = Some(2);
    model.check(move || {
        let handover = Arc::new(Handover::new(1));
        let all: Arc<Vec<Item>> = Arc::new((0..items).map(|_| Item::default()).collect());
        let (served, called) = (Arc::clone(&handover), call(&all));
        let worker = thread::spawn(move || served.serve(1, called));
        let wake = || {
            if parks {
                worker.thread().unpark();
            }
        };
        for (fails, done) in jobs.iter().zip(1..) {
            let ended = handover.do_all(Job { work: *fails, items, portion: 1 }, wake, call(&all));
            let said = ended.err().and_then(|it| it.downcast_ref::<Phase>().copied());
            assert_eq!(said, *fails);
            // Who panicked may have kept others from acting.
            let is_sure = jobs.iter().all(Option::is_none);
            assert!(!is_sure || all.iter().all(|it| it.get() == done), "each item once in each job");
        }
        handover.end(wake);
        worker.join().expect("a worker that ends");
    });
}

#[test]
fn every_item_is_worked_on_once_after_all_have_looked() {
    check(true, 3, &[None, None]);
}

#[test]
fn the_number_of_a_job_tells_a_worker_all_that_it_needs() {
    check(false, 3, &[None, None]);
}

#[test]
fn who_panics_keeps_nobody_waiting_and_the_next_job_is_done() {
    check(true, 2, &[Some(Phase::Look), None]);
    check(true, 2, &[Some(Phase::Act), None]);
}
