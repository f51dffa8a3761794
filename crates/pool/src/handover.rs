//! How a job gets from the caller's thread to the workers, and their news back. It is checked in all orders in which
//! threads can run, by the model in `tests/model.rs`.
#![expect(
    unsafe_code,
    reason = "workers that outlive a job read it where the caller wrote it; measured in bench/"
)]

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::PoisonError;

use crate::sync::{AtomicBool, AtomicUsize, Mutex, Ordering, SPINS, UnsafeCell, park, pause};

/// What somebody who panicked has said.
pub(crate) type Panic = Box<dyn Any + Send>;

/// The two phases of a job.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Phase {
    Look,
    Act,
}

/// Something to be done in both phases to so many items, of which threads claim portions.
#[derive(Clone, Copy)]
pub(crate) struct Job<W> {
    pub(crate) work: W,
    pub(crate) items: usize,
    pub(crate) portion: usize,
}

/// What the threads share.
pub(crate) struct Handover<W> {
    posted: Posted<W>,
    /// For each thread, how much of its own range of items has been claimed.
    claimed: Vec<Claimed>,
    progress: Progress,
    /// What the first one who panicked has said.
    panic: Mutex<Option<Panic>>,
}

/// What the caller's thread writes, on a cache line of its own.
#[repr(align(128))]
struct Posted<W> {
    /// Number of the current job.
    number: AtomicUsize,
    job: UnsafeCell<Option<Job<W>>>,
    has_ended: AtomicBool,
}

// SAFETY: the caller's thread writes the job only while no worker is busy, before it raises the job's number. Workers
// read it only after they see that number, and while they are busy.
unsafe impl<W: Send> Sync for Posted<W> {}

/// What the workers write, on a cache line of its own.
#[repr(align(128))]
struct Progress {
    /// Workers that have not finished.
    busy: AtomicUsize,
    /// Threads that have finished looking.
    looked: AtomicUsize,
    panicked: AtomicBool,
}

/// Counters of claimed items, for looking and for acting, on a cache line of their own.
#[repr(align(128))]
struct Claimed([AtomicUsize; 2]);

impl<W: Copy> Handover<W> {
    /// That of the caller's thread and so many workers.
    pub(crate) fn new(workers: usize) -> Handover<W> {
        let zero = || AtomicUsize::new(0);
        Handover {
            posted: Posted { number: zero(), job: UnsafeCell::new(None), has_ended: AtomicBool::new(false) },
            claimed: (0..=workers).map(|_| Claimed([zero(), zero()])).collect(),
            progress: Progress { busy: zero(), looked: zero(), panicked: AtomicBool::new(false) },
            panic: Mutex::new(None),
        }
    }

    /// Has a job done by all threads, of which `wake` wakes the workers, and waits for them. Only the caller's thread
    /// may call this.
    pub(crate) fn do_all(
        &self,
        job: Job<W>,
        wake: impl Fn(),
        call: impl Fn(&W, Phase, usize, usize),
    ) -> Result<(), Panic> {
        let Progress { busy, looked, panicked } = &self.progress;
        // SAFETY: no worker is busy.
        self.posted.job.with_mut(|it| unsafe { *it = Some(job) });
        self.claimed.iter().flat_map(|it| &it.0).for_each(|it| it.store(0, Ordering::Relaxed));
        busy.store(self.claimed.len() - 1, Ordering::Relaxed);
        looked.store(0, Ordering::Relaxed);
        panicked.store(false, Ordering::Relaxed);
        self.posted.number.fetch_add(1, Ordering::Release);
        wake();
        self.take_part(&job, 0, &call);
        spin_until(|| busy.load(Ordering::Acquire) == 0);
        self.panic.lock().unwrap_or_else(PoisonError::into_inner).take().map_or(Ok(()), Err)
    }

    /// No more jobs come.
    pub(crate) fn end(&self, wake: impl Fn()) {
        self.posted.has_ended.store(true, Ordering::Relaxed);
        self.posted.number.fetch_add(1, Ordering::Release);
        wake();
    }

    /// The loop of a worker, until no more jobs come. Workers are counted from 1 on.
    pub(crate) fn serve(&self, worker: usize, call: impl Fn(&W, Phase, usize, usize)) {
        let mut seen = 0;
        loop {
            seen = self.await_job(seen);
            if self.posted.has_ended.load(Ordering::Relaxed) {
                return;
            }
            // SAFETY: this worker has seen the job's number and is busy.
            if let Some(job) = self.posted.job.with(|it| unsafe { *it }) {
                self.take_part(&job, worker, &call);
            }
            self.progress.busy.fetch_sub(1, Ordering::Release);
        }
    }

    fn await_job(&self, seen: usize) -> usize {
        let mut spins = 0;
        loop {
            let number = self.posted.number.load(Ordering::Acquire);
            if number != seen {
                return number;
            }
            spins += 1;
            // Who is woken before it parks does not.
            if spins > SPINS { park() } else { pause(0) }
        }
    }

    /// Does a thread's part of a job. A panic is kept for the caller, so that nobody waits in vain.
    fn take_part(&self, job: &Job<W>, thread: usize, call: &impl Fn(&W, Phase, usize, usize)) {
        let part = AssertUnwindSafe(|| {
            self.work_in(Phase::Look, job, thread, call);
            if self.all_looked() {
                self.work_in(Phase::Act, job, thread, call);
            }
        });
        if let Err(panic) = catch_unwind(part) {
            self.panic.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(panic);
            self.progress.panicked.store(true, Ordering::Release);
        }
    }

    /// Waits until all threads have finished looking. Returns false if one panicked.
    fn all_looked(&self) -> bool {
        let Progress { looked, panicked, .. } = &self.progress;
        looked.fetch_add(1, Ordering::AcqRel);
        let is_over = || panicked.load(Ordering::Acquire);
        spin_until(|| looked.load(Ordering::Acquire) == self.claimed.len() || is_over());
        !is_over()
    }

    /// Works on the range of items that this thread has in every job, because they are still in its cache. Then it
    /// works on what is left of the other ranges, except for the last portion of each. To fetch that from another
    /// cache takes as long as to wait for it.
    fn work_in(&self, phase: Phase, job: &Job<W>, thread: usize, call: &impl Fn(&W, Phase, usize, usize)) {
        let threads = self.claimed.len();
        for owner in (thread..threads).chain(0..thread) {
            let range = |owner: usize| owner * job.items / threads;
            let (begin, end) = (range(owner), range(owner + 1));
            let claimed = &self.claimed[owner].0[phase as usize];
            let left_to_it = if owner == thread { 0 } else { job.portion };
            while begin + claimed.load(Ordering::Relaxed) + left_to_it < end {
                let first = begin + claimed.fetch_add(job.portion, Ordering::Relaxed);
                (first..(first + job.portion).min(end))
                    .for_each(|index| call(&job.work, phase, thread, index));
            }
        }
    }
}

fn spin_until(is_so: impl Fn() -> bool) {
    let mut spins = 0;
    while !is_so() {
        spins += 1;
        pause(spins);
    }
}
