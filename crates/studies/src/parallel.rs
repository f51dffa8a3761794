//! Independent runs side by side.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use laneweave_scenario::Fault;

/// Does the `work` of every job, as many at a time as `threads`. Returns the results in the order of the jobs.
///
/// # Errors
/// The fault of the first job that has one; no other job begins then.
pub fn in_parallel<Job: Sync, Done: Send>(
    jobs: &[Job],
    threads: usize,
    work: impl Fn(&Job) -> Result<Done, Fault> + Sync,
) -> Result<Vec<Done>, Fault> {
    let all = in_parallel_while(jobs, threads, |_| true, || (), |(), job| work(job))?;
    Ok(all.unwrap_or_default())
}

/// The same as [`in_parallel`], as long as `goes_on` says so, which is told how many jobs have ended. Each thread has a
/// state of its own, which `begin` makes. Returns `None` if not all jobs were done.
///
/// # Errors
/// The fault of the first job that has one; no other job begins then.
pub fn in_parallel_while<Job: Sync, Done: Send, State>(
    jobs: &[Job],
    threads: usize,
    goes_on: impl Fn(usize) -> bool + Sync,
    begin: impl Fn() -> State + Sync,
    work: impl Fn(&mut State, &Job) -> Result<Done, Fault> + Sync,
) -> Result<Option<Vec<Done>>, Fault> {
    let (next, ended, is_over) = (AtomicUsize::new(0), AtomicUsize::new(0), AtomicBool::new(false));
    let done = Mutex::new(Vec::with_capacity(jobs.len()));
    let take = || {
        let mut state = begin();
        loop {
            if is_over.load(Ordering::Relaxed) || !goes_on(ended.load(Ordering::Relaxed)) {
                return;
            }
            // Jobs begin in their order: those before one that fails have begun, and come to their ends.
            let at = next.fetch_add(1, Ordering::Relaxed);
            let Some(job) = jobs.get(at) else { return };
            let result = work(&mut state, job);
            is_over.fetch_or(result.is_err(), Ordering::Relaxed);
            ended.fetch_add(1, Ordering::Relaxed);
            done.lock().unwrap_or_else(PoisonError::into_inner).push((at, result));
        }
    };
    thread::scope(|scope| {
        for _ in 1..threads {
            // What does not start is done by the others.
            let _ = thread::Builder::new().spawn_scoped(scope, take);
        }
        take();
    });
    let mut done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    done.sort_by_key(|(at, _)| *at);
    let done: Vec<Done> = done.into_iter().map(|(_, result)| result).collect::<Result<_, Fault>>()?;
    Ok(Some(done).filter(|it| it.len() == jobs.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fault_of_the_first_job_counts_and_others_do_not_begin() {
        let jobs: Vec<u32> = (0..1000).collect();
        let begun = AtomicUsize::new(0);
        let work = |job: &u32| {
            begun.fetch_add(1, Ordering::Relaxed);
            if *job < 10 { Ok(*job) } else { Err(Fault::new(job, "it is too large", "choose a smaller one")) }
        };
        for threads in [1, 4] {
            let fault = in_parallel(&jobs, threads, work).expect_err("one is too large");
            assert_eq!(fault.place, "10");
        }
        assert!(begun.load(Ordering::Relaxed) < 100);
    }

    #[test]
    fn what_is_stopped_has_no_results() {
        let jobs: Vec<u32> = (0..100).collect();
        let all = in_parallel_while(&jobs, 2, |_| true, || 1, |one, it| Ok(it + *one));
        assert_eq!(all, Ok(Some((1..=100).collect())));
        let some = in_parallel_while(&jobs, 2, |ended| ended < 50, || (), |(), it| Ok(*it));
        assert_eq!(some, Ok(None));
    }
}
