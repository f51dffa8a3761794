//! A small pool of threads that spin before they park. A motorway's step takes about ten microseconds; there,
//! work-stealing pools lose more time than they gain.
#![expect(unsafe_code, reason = "workers that outlive a step borrow that step's data; measured in bench/")]

mod handover;
mod sync;

use std::io;
use std::panic::resume_unwind;
use std::sync::Arc;
use std::thread::{self, JoinHandle};

use handover::{Handover, Job, Phase};

/// Number of portions per thread into which the items are divided, so that an uneven load evens out.
const PORTIONS: usize = 16;

/// A pool of threads, including the caller's.
pub struct Pool {
    handover: Arc<Handover<Work>>,
    workers: Vec<JoinHandle<()>>,
}

/// What is done to an item, which lives only while [`Pool::look_then_act`] waits for it. It takes the phase, the
/// thread and the item.
#[derive(Clone, Copy)]
struct Work(*const (dyn Fn(Phase, usize, usize) + Sync));

// SAFETY: the pointer is used only while `Pool::look_then_act` keeps its target alive, and the target is `Sync`.
unsafe impl Send for Work {}

impl Work {
    fn call(&self, phase: Phase, thread: usize, place: usize) {
        // SAFETY: `Pool::look_then_act` keeps the target alive until no thread is busy.
        unsafe { (*self.0)(phase, thread, place) }
    }
}

/// An array of items; in each phase one thread alone accesses an item.
struct Items<T>(*mut T);

// SAFETY: every index is claimed by exactly one thread in each phase, see `Handover::work_in`.
unsafe impl<T: Send> Sync for Items<T> {}

impl<T> Items<T> {
    fn at(&self, index: usize) -> *mut T {
        self.0.wrapping_add(index)
    }
}

impl Pool {
    /// A pool of `threads` threads, at least one, including the caller's.
    ///
    /// # Errors
    /// If the system does not start so many.
    pub fn new(threads: usize) -> io::Result<Pool> {
        Pool::with(threads, |work| thread::Builder::new().spawn(work))
    }

    /// The same with workers that `start` starts.
    fn with(
        threads: usize,
        mut start: impl FnMut(Box<dyn FnOnce() + Send>) -> io::Result<JoinHandle<()>>,
    ) -> io::Result<Pool> {
        let helpers = threads.max(1) - 1;
        let mut pool = Pool { handover: Arc::new(Handover::new(helpers)), workers: Vec::new() };
        for worker in 1..=helpers {
            let handover = Arc::clone(&pool.handover);
            // Those that have started end with the pool.
            pool.workers.push(start(Box::new(move || handover.serve(worker, Work::call)))?);
        }
        Ok(pool)
    }

    /// Number of threads, including the caller's.
    pub fn threads(&self) -> usize {
        self.workers.len() + 1
    }

    /// Calls `look` once for the plan of every `chosen` item, with all items to look at. When all calls have
    /// finished, it calls `act` once for every chosen item with its plan. It returns when everything has finished.
    /// Both functions get the item's index and the data of the thread, one of `own`. The distribution of items over
    /// threads is not determined, so no result may depend on it.
    ///
    /// # Panics
    /// If `look` or `act` panics, with what it said, if items and plans differ in number, if `own` has fewer items than
    /// the pool has threads, or if `chosen` is not in order or beyond the items.
    pub fn look_then_act<O: Send, T: Send + Sync, P: Send>(
        &mut self,
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
        assert!(is_in_order && (chosen[chosen.len() - 1] as usize) < count, "every item is chosen once");
        let (own, items, plans) =
            (Items(own.as_mut_ptr()), Items(items.as_mut_ptr()), Items(plans.as_mut_ptr()));
        self.do_all(chosen.len(), &|phase: Phase, thread: usize, place: usize| {
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
        });
    }

    /// Has `work` done in both phases at all places, and goes on with a panic.
    fn do_all(&mut self, places: usize, work: &(dyn Fn(Phase, usize, usize) + Sync)) {
        let portion = (places / (self.threads() * PORTIONS)).max(1);
        let work: *const (dyn Fn(Phase, usize, usize) + Sync + '_) = work;
        // SAFETY: only the lifetime changes. The target outlives every use, because this function returns only when
        // all workers have finished.
        let work = unsafe {
            std::mem::transmute::<
                *const (dyn Fn(Phase, usize, usize) + Sync + '_),
                *const (dyn Fn(Phase, usize, usize) + Sync),
            >(work)
        };
        let job = Job { work: Work(work), items: places, portion };
        let wake = || self.workers.iter().for_each(|it| it.thread().unpark());
        if let Err(panic) = self.handover.do_all(job, wake, Work::call) {
            resume_unwind(panic);
        }
    }
}

impl Drop for Pool {
    fn drop(&mut self) {
        self.handover.end(|| self.workers.iter().for_each(|it| it.thread().unpark()));
        for worker in self.workers.drain(..) {
            // A panic of a worker was handed over when it happened.
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
            let mut pool = Pool::new(threads).expect("threads");
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
        let mut pool = Pool::new(2).expect("threads");
        let mut items = vec![0; 10];
        for _ in 0..3 {
            thread::sleep(std::time::Duration::from_millis(50));
            let act = |item: &mut i32, (): &mut (), _, (): &mut ()| *item += 1;
            pool.look_then_act(&mut [(); 2], &mut items, &mut [(); 10], &ALL, |_, (), _, ()| (), act);
        }
        assert_eq!(items, [3; 10]);
    }

    /// What a panic with this text said, if it was one.
    fn said(call: impl FnOnce()) -> Option<String> {
        catch_unwind(AssertUnwindSafe(call)).err()?.downcast_ref().cloned()
    }

    #[test]
    fn a_panic_of_any_thread_reaches_the_caller_and_the_pool_goes_on() {
        for threads in [1, 2, 4] {
            let mut pool = Pool::new(threads).expect("threads");
            let mut own = vec![(); threads];
            for place in 0..10 {
                let (mut items, mut plans) = ([0; 10], [(); 10]);
                let fails = |at: usize, what: &str| assert!(at != place, "{what} at {place}");
                let look = |_: &[i32], (): &mut (), at, (): &mut ()| fails(at, "looking");
                let act = |_: &mut i32, (): &mut (), at, (): &mut ()| fails(at, "acting");
                let none = |_: &[i32], (): &mut (), _, (): &mut ()| ();
                let add = |item: &mut i32, (): &mut (), _, (): &mut ()| *item += 1;
                let looking = said(|| pool.look_then_act(&mut own, &mut items, &mut plans, &ALL, look, add));
                assert_eq!(looking, Some(format!("looking at {place}")));
                assert_eq!(items, [0; 10], "nobody acts");
                let acting = said(|| pool.look_then_act(&mut own, &mut items, &mut plans, &ALL, none, act));
                assert_eq!(acting, Some(format!("acting at {place}")));
                pool.look_then_act(&mut own, &mut items, &mut plans, &ALL, none, add);
                assert_eq!(items, [1; 10]);
            }
        }
    }

    #[test]
    fn threads_that_do_not_start_are_an_error_and_the_others_end() {
        let started = Arc::new(());
        let mut left = 2;
        let start = |work: Box<dyn FnOnce() + Send>| {
            left -= 1;
            let running = Arc::clone(&started);
            match left {
                0 => Err(io::ErrorKind::WouldBlock.into()),
                _ => thread::Builder::new().spawn(move || {
                    let _running = running;
                    work();
                }),
            }
        };
        assert!(Pool::with(4, start).is_err());
        assert_eq!(Arc::strong_count(&started), 1);
    }
}
