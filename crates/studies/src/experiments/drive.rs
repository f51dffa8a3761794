//! Runs simulations of several seeds in parallel.

use laneweave::study::{Estimate, mean};
use laneweave::{Event, Fault, Simulation};

use crate::in_parallel;

use crate::experiments::effort::Effort;
use crate::experiments::seen::Seen;
use crate::experiments::traffic::Traffic;

/// Drives each kind of traffic with each seed. Returns what was seen: by traffic, and by seed.
///
/// # Errors
/// None, as long as the built-in maps and styles are valid.
pub(crate) fn drive(effort: &Effort, traffic: &[Traffic]) -> Result<Vec<Vec<Seen>>, Fault> {
    each(effort, traffic, |simulation| {
        let (mut begin, mut seen) = (None, Seen::default());
        steps(simulation, |simulation, events| {
            let begin = *begin.get_or_insert(simulation.time_s() - simulation.step_s());
            seen.observe(simulation, events, simulation.time_s() - begin);
        });
        seen.end(simulation);
        seen
    })
}

/// The same for a known number of kinds of traffic.
///
/// # Errors
/// None, as long as the built-in maps and styles are valid.
pub(crate) fn drive_all<const N: usize>(
    effort: &Effort,
    traffic: [Traffic; N],
) -> Result<[Vec<Seen>; N], Fault> {
    let mut seen = drive(effort, &traffic)?.into_iter();
    Ok(traffic.map(|_| seen.next().unwrap_or_default()))
}

/// Does `watch` with each kind of traffic and each seed, from its beginning on. Returns what it returns: by traffic,
/// and by seed.
///
/// # Errors
/// None, as long as the built-in maps and styles are valid.
pub(crate) fn each<T: Send>(
    effort: &Effort,
    traffic: &[Traffic],
    watch: impl Fn(&mut Simulation) -> T + Sync,
) -> Result<Vec<Vec<T>>, Fault> {
    let jobs: Vec<(&Traffic, u64)> =
        traffic.iter().flat_map(|it| (1..=effort.seeds).map(move |seed| (it, seed))).collect();
    let once = |(traffic, seed): &(&Traffic, u64)| {
        let mut simulation = traffic.simulation(*seed, effort.length)?;
        Ok(watch(&mut simulation))
    };
    let mut seen = in_parallel(&jobs, effort.threads, once)?.into_iter();
    Ok(traffic.iter().map(|_| seen.by_ref().take(effort.seeds as usize).collect()).collect())
}

/// Simulates the warm-up and then the measured steps, after each of which `observe` sees the traffic and what happened.
pub(crate) fn steps(simulation: &mut Simulation, mut observe: impl FnMut(&Simulation, &[Event])) {
    let [warmup_steps, steps] = simulation.run_steps();
    (0..warmup_steps).for_each(|_| simulation.advance());
    for _ in 0..steps {
        let events = simulation.step();
        observe(simulation, &events);
    }
}

/// The mean of a measure over the runs that have it.
pub(crate) fn over<T>(runs: &[T], of: impl Fn(&T) -> Option<f64>) -> Option<Estimate> {
    mean(&runs.iter().filter_map(of).collect::<Vec<f64>>())
}

/// The mean of a difference, or of a quotient, between runs of two kinds of traffic with the same seeds.
pub(crate) fn between<T>(one: &[T], other: &[T], of: impl Fn(&T, &T) -> Option<f64>) -> Option<Estimate> {
    mean(&one.iter().zip(other).filter_map(|(one, other)| of(one, other)).collect::<Vec<f64>>())
}
