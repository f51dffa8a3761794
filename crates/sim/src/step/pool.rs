//! A small pool of workers that spin before they park. A motorway's step takes about ten microseconds; there,
//! work-stealing pools lose more time than they gain.
#![expect(unsafe_code, reason = "workers that outlive a step borrow that step's data; measured in bench/")]

use std::cell::UnsafeCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread::{self, JoinHandle, Thread};

/// Number of times an idle worker looks for work before it parks.
const SPINS: u32 = 20_000;
/// Number of portions per thread into which the items are divided, so that an uneven load evens out.
const PORTIONS: usize = 16;

/// A pool of threads, including the caller's.
pub(crate) struct Pool {
    shared: Arc<Shared>,
    workers: Vec<JoinHandle<()>>,
}

struct Shared {
    posted: Posted,
    /// For each thread, how much of its own range of items has been claimed.
    noted_on: Vec<Claimed>,
    progress: Progress,
    parked: Vec<AtomicBool>,
}

/// What the caller's thread writes, on a cache line of its own.
#[repr(align(128))]
struct Posted {
    /// Number of the current job.
    job: AtomicUsize,
    task: UnsafeCell<Option<Task>>,
    stop: AtomicBool,
}

// SAFETY: the caller's thread writes the task only while no worker is busy, before it raises the job's number.
// Workers read it only after they see that number, and while they are busy.
unsafe impl Sync for Posted {}

/// What the workers write, on a cache line of its own.
#[derive(Default)]
#[repr(align(128))]
struct Progress {
    /// Workers that have not finished.
    busy: AtomicUsize,
    /// Threads that have finished looking.
    looked: AtomicUsize,
    panicked: AtomicBool,
}

/// Counters of claimed items, for looking and for acting, on a cache line of their own.
#[derive(Default)]
#[repr(align(128))]
struct Claimed([AtomicUsize; 2]);

/// A job that lives only while [`Pool::look_then_act`] waits for it. Its function takes the phase, the thread and the
/// item.
#[derive(Clone, Copy)]
struct Task {
    work: *const (dyn Fn(Phase, usize, usize) + Sync),
    items: usize,
    portion: usize,
}

// SAFETY: the pointer is used only while `Pool::look_then_act` keeps its target alive, and the target is `Sync`.
unsafe impl Send for Task {}

/// The two phases of a job.
#[derive(Clone, Copy, PartialEq)]
enum Phase {
    Look,
    Act,
}

/// An array of items; in each phase one thread alone accesses an item.
struct Items<T>(*mut T);

// SAFETY: every index is claimed by exactly one thread in each phase, see `Shared::work_on`.
unsafe impl<T: Send> Sync for Items<T> {}

impl<T> Items<T> {
    fn at(&self, index: usize) -> *mut T {
        self.0.wrapping_add(index)
    }
}

impl Pool {
    /// A pool of `threads` threads, at least one, including the caller's.
    pub(crate) fn new(threads: usize) -> Pool {
        let helpers = threads.max(1) - 1;
        let shared = Arc::new(Shared {
            posted: Posted {
                job: AtomicUsize::new(0),
                task: UnsafeCell::new(None),
                stop: AtomicBool::new(false),
            },
            noted_on: (0..=helpers).map(|_| Claimed::default()).collect(),
            progress: Progress::default(),
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

    /// Number of threads, including the caller's.
    pub(crate) fn threads(&self) -> usize {
        self.workers.len() + 1
    }

    /// Calls `look` once for the plan of every `chosen` item, with all items to look at. When all calls have
    /// finished, it calls `act` once for every chosen item with its plan. It returns when everything has finished.
    /// Both functions get the item's index and the data of the thread, one of `own`. The distribution of items over
    /// threads is not determined, so no result may depend on it.
    ///
    /// # Panics
    /// If `look` or `act` panics, if items and plans differ in number, if `own` has fewer items than the pool has
    /// threads, or if `chosen` is not in order or beyond the items.
    pub(crate) fn look_then_act<O: Send, T: Send + Sync, P: Send>(
        &self,
        own: &mut [O],
        items: &mut [T],
        plans: &mut [P],
        chosen: &[u32],
        look: impl Fn(&[T], &mut O, usize, &mut P) + Sync,
        act: impl Fn(&mut T, &mut O, usize, &mut P) + Sync,
    ) {
        assert_eq!(items.len(), plans.len(), "items that do not pair");
        assert!(own.len() >= self.threads(), "each thread has something of its own");
        if self.workers.is_empty() || chosen.len() < 2 {
            let (own, indices) = (&mut own[0], || chosen.iter().map(|it| *it as usize));
            indices().for_each(|index| look(items, own, index, &mut plans[index]));
            indices().for_each(|index| act(&mut items[index], own, index, &mut plans[index]));
            return;
        }
        let count = items.len();
        let is_in_order = chosen.windows(2).all(|it| it[0] < it[1]);
        assert!(is_in_order && chosen[chosen.len() - 1] < count as u32, "every item is chosen once");
        let (own, items, plans) =
            (Items(own.as_mut_ptr()), Items(items.as_mut_ptr()), Items(plans.as_mut_ptr()));
        let work = |phase: Phase, thread: usize, place: usize| {
            let index = chosen[place] as usize;
            // SAFETY: no other thread has this number. `index` is below the length, is at this place of `chosen`
            // only, and is claimed by this thread alone in this phase. All are borrowed mutably until all threads
            // have finished.
            let (own, plan) = unsafe { (&mut *own.at(thread), &mut *plans.at(index)) };
            match phase {
                // SAFETY: no thread writes to the items before all threads have finished looking.
                Phase::Look => {
                    look(unsafe { std::slice::from_raw_parts(items.at(0), count) }, own, index, plan)
                }
                // SAFETY: all threads have finished looking, and this thread has claimed the item.
                Phase::Act => act(unsafe { &mut *items.at(index) }, own, index, plan),
            }
        };
        let portion = (chosen.len() / (self.threads() * PORTIONS)).max(1);
        let work: *const (dyn Fn(Phase, usize, usize) + Sync + '_) = &raw const work;
        // SAFETY: only the lifetime changes. The target outlives every use, because this function returns only when
        // all workers have finished.
        let work = unsafe {
            std::mem::transmute::<
                *const (dyn Fn(Phase, usize, usize) + Sync + '_),
                *const (dyn Fn(Phase, usize, usize) + Sync),
            >(work)
        };
        let task = Task { work, items: chosen.len(), portion };
        self.start(task);
        let finish = Finish(&self.shared.progress);
        self.shared.work_on(task, 0);
        drop(finish);
        assert!(!self.shared.progress.panicked.load(Ordering::Acquire), "a worker of the pool panicked");
    }

    fn start(&self, task: Task) {
        let Shared { posted, noted_on, progress, parked } = &*self.shared;
        // SAFETY: no worker is busy.
        unsafe { *posted.task.get() = Some(task) };
        noted_on.iter().flat_map(|it| &it.0).for_each(|it| it.store(0, Ordering::Relaxed));
        progress.busy.store(self.workers.len(), Ordering::Relaxed);
        progress.looked.store(0, Ordering::Relaxed);
        posted.job.fetch_add(1, Ordering::SeqCst);
        for (worker, parked) in self.workers.iter().zip(parked) {
            if parked.load(Ordering::SeqCst) {
                Thread::unpark(worker.thread());
            }
        }
    }
}

/// Waits for the workers, also when the caller's own share panics.
struct Finish<'a>(&'a Progress);

impl Drop for Finish<'_> {
    fn drop(&mut self) {
        self.0.note_panic();
        spin_until(|| self.0.busy.load(Ordering::Acquire) == 0);
    }
}

/// Reports that a worker has finished, also when it panics.
struct Done<'a>(&'a Progress);

impl Drop for Done<'_> {
    fn drop(&mut self) {
        self.0.note_panic();
        self.0.busy.fetch_sub(1, Ordering::Release);
    }
}

impl Progress {
    fn note_panic(&self) {
        if thread::panicking() {
            self.panicked.store(true, Ordering::Release);
        }
    }

    /// Waits until all `threads` have finished looking. Returns false if one panicked.
    fn all_looked(&self, threads: usize) -> bool {
        self.looked.fetch_add(1, Ordering::AcqRel);
        let is_over = || self.panicked.load(Ordering::Acquire);
        spin_until(|| self.looked.load(Ordering::Acquire) == threads || is_over());
        !is_over()
    }
}

fn spin_until(is_so: impl Fn() -> bool) {
    let mut spins = 0;
    while !is_so() {
        spins += 1;
        // A thread that has lost its core needs it again.
        if spins > SPINS { thread::yield_now() } else { std::hint::spin_loop() }
    }
}

impl Shared {
    /// The loop of a worker, until the pool is dropped.
    fn serve(&self, number: usize) {
        let mut seen = 0;
        loop {
            seen = self.await_job(seen, number);
            if self.posted.stop.load(Ordering::Acquire) {
                return;
            }
            let _done = Done(&self.progress);
            // SAFETY: this worker has seen the job's number and is busy.
            if let Some(task) = unsafe { *self.posted.task.get() } {
                self.work_on(task, number + 1);
            }
        }
    }

    fn await_job(&self, seen: usize, number: usize) -> usize {
        for _ in 0..SPINS {
            let job = self.posted.job.load(Ordering::Acquire);
            if job != seen {
                return job;
            }
            std::hint::spin_loop();
        }
        self.parked[number].store(true, Ordering::SeqCst);
        loop {
            let job = self.posted.job.load(Ordering::SeqCst);
            if job != seen {
                self.parked[number].store(false, Ordering::SeqCst);
                return job;
            }
            thread::park();
        }
    }

    fn work_on(&self, task: Task, thread: usize) {
        self.work_in(Phase::Look, task, thread);
        if self.progress.all_looked(self.noted_on.len()) {
            self.work_in(Phase::Act, task, thread);
        }
    }

    /// Works on the range of items that this thread has in every job, because they are still in its cache. Then it
    /// works on what is left of the other ranges, except for the last portion of each. To fetch that from another
    /// cache takes as long as to wait for it.
    fn work_in(&self, phase: Phase, task: Task, thread: usize) {
        // SAFETY: `Pool::look_then_act` keeps the job alive until no thread is busy.
        let work = unsafe { &*task.work };
        let threads = self.noted_on.len();
        for owner in (thread..threads).chain(0..thread) {
            let range = |owner: usize| owner * task.items / threads;
            let (begin, end) = (range(owner), range(owner + 1));
            let noted_on = &self.noted_on[owner].0[phase as usize];
            let left_to_it = if owner == thread { 0 } else { task.portion };
            while begin + noted_on.load(Ordering::Relaxed) + left_to_it < end {
                let first = begin + noted_on.fetch_add(task.portion, Ordering::Relaxed);
                (first..(first + task.portion).min(end)).for_each(|index| work(phase, thread, index));
            }
        }
    }
}

impl Drop for Pool {
    fn drop(&mut self) {
        self.shared.posted.stop.store(true, Ordering::Release);
        self.shared.posted.job.fetch_add(1, Ordering::SeqCst);
        for worker in self.workers.drain(..) {
            worker.thread().unpark();
            // A panic of a worker was reported when it happened.
            let _ = worker.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use std::panic::{AssertUnwindSafe, catch_unwind};

    use super::*;

    const ALL: [u32; 10] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9];

    #[test]
    fn every_chosen_item_is_worked_on_once_by_any_number_of_threads_after_all_have_looked() {
        for threads in [1, 2, 4] {
            let pool = Pool::new(threads);
            let (mut items, mut seen) = (vec![0_usize; 400], vec![0; 400]);
            let chosen: Vec<u32> = (100..400).collect();
            for round in 0..200 {
                let mut counts = vec![0; threads];
                pool.look_then_act(
                    &mut counts,
                    &mut items,
                    &mut seen,
                    &chosen,
                    |items, count, index, seen| {
                        *count += 1;
                        *seen = items.iter().sum::<usize>() + index;
                    },
                    |item, _, index, seen| {
                        assert_eq!(*seen, 300 * round + index, "everybody looked at the same");
                        *item += 1;
                    },
                );
                assert_eq!(counts.iter().sum::<usize>(), chosen.len());
                let expected = |index: usize| if index < 100 { 0 } else { round + 1 };
                assert!(items.iter().enumerate().all(|(index, it)| *it == expected(index)));
            }
        }
    }

    #[test]
    fn a_parked_pool_wakes_up() {
        let pool = Pool::new(2);
        let mut items = vec![0; 10];
        for _ in 0..3 {
            thread::sleep(std::time::Duration::from_millis(50));
            let act = |item: &mut i32, (): &mut (), _, (): &mut ()| *item += 1;
            pool.look_then_act(&mut [(); 2], &mut items, &mut [(); 10], &ALL, |_, (), _, ()| (), act);
        }
        assert_eq!(items, [3; 10]);
    }

    #[test]
    fn a_panic_while_looking_reaches_the_caller() {
        for place in 0..10 {
            let pool = Pool::new(2);
            let look = |_: &[i32], (): &mut (), index, (): &mut ()| assert_ne!(index, place);
            let mut items = [0; 10];
            let call =
                || pool.look_then_act(&mut [(); 2], &mut items, &mut [(); 10], &ALL, look, |_, (), _, ()| ());
            assert!(catch_unwind(AssertUnwindSafe(call)).is_err());
        }
    }
}
