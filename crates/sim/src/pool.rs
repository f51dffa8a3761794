//! A small pool of workers that spin before they park. A motorway's step takes some ten microseconds, where
//! work-stealing pools lose more than they gain.
#![expect(unsafe_code, reason = "workers that outlive a step borrow that step's data; measured in bench/")]

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle, Thread};

/// How often an idle worker looks for work before it parks.
const SPINS: u32 = 20_000;
/// Into how many portions per thread the items are cut, so that an uneven load evens out.
const PORTIONS: usize = 16;

/// A pool of threads, of which the caller's is one.
pub(crate) struct Pool {
    shared: Arc<Shared>,
    workers: Vec<JoinHandle<()>>,
}

struct Shared {
    /// Number of the current job; odd numbers never occur, so that a stop can be told.
    job: AtomicUsize,
    task: Mutex<Option<Task>>,
    /// For each thread how much of its own range of items has been claimed.
    claimed: Vec<Claimed>,
    busy: AtomicUsize,
    stop: AtomicBool,
    panicked: AtomicBool,
    parked: Vec<AtomicBool>,
}

/// A counter on a cache line of its own.
#[derive(Default)]
#[repr(align(128))]
struct Claimed(AtomicUsize);

/// A job that lives only while [`Pool::each_pair`] waits for it.
#[derive(Clone, Copy)]
struct Task {
    work: *const (dyn Fn(usize) + Sync),
    items: usize,
    portion: usize,
}

// SAFETY: the pointer is used only while `Pool::each_pair` keeps what it points to alive, and it points to something
// `Sync`.
unsafe impl Send for Task {}

/// An array whose items are handed to one thread each.
struct Items<T>(*mut T);

// SAFETY: every index is claimed by exactly one thread, see `Shared::work_on`.
unsafe impl<T: Send> Sync for Items<T> {}

impl<T> Items<T> {
    fn at(&self, index: usize) -> *mut T {
        self.0.wrapping_add(index)
    }
}

impl Pool {
    /// A pool of `threads` threads in all, at least one.
    pub(crate) fn new(threads: usize) -> Pool {
        let helpers = threads.max(1) - 1;
        let shared = Arc::new(Shared {
            job: AtomicUsize::new(0),
            task: Mutex::new(None),
            claimed: (0..=helpers).map(|_| Claimed::default()).collect(),
            busy: AtomicUsize::new(0),
            stop: AtomicBool::new(false),
            panicked: AtomicBool::new(false),
            parked: (0..helpers).map(|_| AtomicBool::new(false)).collect(),
        });
        let workers = (0..helpers)
            .map(|number| {
                let shared = Arc::clone(&shared);
                thread::spawn(move || shared.serve(number))
            })
            .collect();
        Pool { shared, workers }
    }

    /// Number of threads, the caller's included.
    pub(crate) fn threads(&self) -> usize {
        self.workers.len() + 1
    }

    /// Calls `work` once for every item with its index; returns when all are done. Which thread takes which item is
    /// not determined, so `work` must not let it matter.
    pub(crate) fn each<T: Send>(&self, items: &mut [T], work: impl Fn(usize, &mut T) + Sync) {
        // Items without a size need no memory.
        let mut nothing = vec![(); items.len()];
        self.each_pair(items, &mut nothing, |index, item, ()| work(index, item));
    }

    /// Calls `work` once for every item of `items` and the one at the same place of `others`.
    pub(crate) fn each_pair<T: Send, U: Send>(
        &self,
        items: &mut [T],
        others: &mut [U],
        work: impl Fn(usize, &mut T, &mut U) + Sync,
    ) {
        assert_eq!(items.len(), others.len(), "items that do not pair");
        if self.workers.is_empty() || items.len() < 2 {
            let pairs = items.iter_mut().zip(others).enumerate();
            pairs.for_each(|(index, (item, other))| work(index, item, other));
            return;
        }
        let (array, other_array) = (Items(items.as_mut_ptr()), Items(others.as_mut_ptr()));
        let call = |index: usize| {
            // SAFETY: `index` is below the length of both and claimed by this thread alone; both are borrowed mutably
            // until all threads are done.
            let (item, other) = unsafe { (&mut *array.at(index), &mut *other_array.at(index)) };
            work(index, item, other);
        };
        let portion = (items.len() / (self.threads() * PORTIONS)).max(1);
        let work: *const (dyn Fn(usize) + Sync + '_) = &raw const call;
        // SAFETY: only the lifetime changes; `call` outlives every use, since this function returns only when all
        // workers are done with it.
        let work = unsafe {
            std::mem::transmute::<*const (dyn Fn(usize) + Sync + '_), *const (dyn Fn(usize) + Sync)>(work)
        };
        let task = Task { work, items: items.len(), portion };
        self.start(task);
        let finish = Finish(&self.shared);
        self.shared.work_on(task, 0);
        drop(finish);
        assert!(!self.shared.panicked.load(Ordering::Acquire), "a worker of the pool panicked");
    }

    fn start(&self, task: Task) {
        let shared = &self.shared;
        *shared.task.lock().unwrap_or_else(PoisonError::into_inner) = Some(task);
        shared.claimed.iter().for_each(|it| it.0.store(0, Ordering::Relaxed));
        shared.busy.store(self.workers.len(), Ordering::Relaxed);
        shared.job.fetch_add(1, Ordering::SeqCst);
        for (worker, parked) in self.workers.iter().zip(&shared.parked) {
            if parked.load(Ordering::SeqCst) {
                Thread::unpark(worker.thread());
            }
        }
    }
}

/// Waits for the workers, also when the caller's own share panics.
struct Finish<'a>(&'a Shared);

impl Drop for Finish<'_> {
    fn drop(&mut self) {
        let mut spins = 0;
        while self.0.busy.load(Ordering::Acquire) > 0 {
            spins += 1;
            // A worker that has lost its core needs it back.
            if spins > SPINS { thread::yield_now() } else { std::hint::spin_loop() }
        }
    }
}

/// Says that a worker is done, also when it panics.
struct Done<'a>(&'a Shared);

impl Drop for Done<'_> {
    fn drop(&mut self) {
        if thread::panicking() {
            self.0.panicked.store(true, Ordering::Release);
        }
        self.0.busy.fetch_sub(1, Ordering::Release);
    }
}

impl Shared {
    /// What a worker does all its life.
    fn serve(&self, number: usize) {
        let mut seen = 0;
        loop {
            seen = self.await_job(seen, number);
            if self.stop.load(Ordering::Acquire) {
                return;
            }
            let task = *self.task.lock().unwrap_or_else(PoisonError::into_inner);
            let _done = Done(self);
            if let Some(task) = task {
                self.work_on(task, number + 1);
            }
        }
    }

    fn await_job(&self, seen: usize, number: usize) -> usize {
        for _ in 0..SPINS {
            let job = self.job.load(Ordering::Acquire);
            if job != seen {
                return job;
            }
            std::hint::spin_loop();
        }
        self.parked[number].store(true, Ordering::SeqCst);
        loop {
            let job = self.job.load(Ordering::SeqCst);
            if job != seen {
                self.parked[number].store(false, Ordering::SeqCst);
                return job;
            }
            thread::park();
        }
    }

    /// Works on the range of items that is this thread's in every job, so that what it left in its cache is there; then
    /// on what is left of the others' ranges.
    fn work_on(&self, task: Task, thread: usize) {
        // SAFETY: `Pool::each_pair` keeps the job alive until no thread is busy any more.
        let work = unsafe { &*task.work };
        let threads = self.claimed.len();
        for owner in (thread..threads).chain(0..thread) {
            let range = |owner: usize| owner * task.items / threads;
            let (begin, end) = (range(owner), range(owner + 1));
            loop {
                let first = begin + self.claimed[owner].0.fetch_add(task.portion, Ordering::Relaxed);
                if first >= end {
                    break;
                }
                (first..(first + task.portion).min(end)).for_each(work);
            }
        }
    }
}

impl Drop for Pool {
    fn drop(&mut self) {
        self.shared.stop.store(true, Ordering::Release);
        self.shared.job.fetch_add(1, Ordering::SeqCst);
        for worker in self.workers.drain(..) {
            worker.thread().unpark();
            // A worker that panicked was reported when it did.
            let _ = worker.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_item_is_worked_on_once_by_any_number_of_threads() {
        for threads in [1, 2, 4] {
            let pool = Pool::new(threads);
            let mut items = vec![0usize; 1000];
            for round in 1..200 {
                pool.each(&mut items, |index, item| *item += index);
                assert!(items.iter().enumerate().all(|(index, item)| *item == round * index));
            }
        }
    }

    #[test]
    fn a_parked_pool_wakes_up() {
        let pool = Pool::new(2);
        let mut items = vec![0; 10];
        for _ in 0..3 {
            thread::sleep(std::time::Duration::from_millis(50));
            pool.each(&mut items, |_, item| *item += 1);
        }
        assert_eq!(items, [3; 10]);
    }
}
