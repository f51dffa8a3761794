//! Drives traffic over several seeds, side by side.

use laneweave::scenario::Prepared;
use laneweave::sim::World;
use laneweave::study::{Estimate, mean};
use laneweave::{Fault, in_parallel};

use crate::effort::Effort;
use crate::seen::Seen;
use crate::traffic::Traffic;

/// Drives each kind of traffic with each seed. Returns what was seen: by traffic, and by seed.
///
/// # Errors
/// None, as long as the built-in maps and styles are valid.
pub(crate) fn drive(effort: &Effort, traffic: &[Traffic]) -> Result<Vec<Vec<Seen>>, Fault> {
    each(effort, traffic, |prepared| {
        let (mut begin, mut seen) = (None, Seen::default());
        steps(prepared, |world| {
            let begin = *begin.get_or_insert(world.clock().time() - world.clock().dt);
            seen.observe(world, world.clock().time() - begin);
        });
        seen.end(&prepared.world);
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
    watch: impl Fn(&mut Prepared) -> T + Sync,
) -> Result<Vec<Vec<T>>, Fault> {
    let jobs: Vec<(&Traffic, u64)> =
        traffic.iter().flat_map(|it| (1..=effort.seeds).map(move |seed| (it, seed))).collect();
    let once = |(traffic, seed): &(&Traffic, u64)| {
        let mut prepared = traffic.prepared(*seed, effort.length)?;
        Ok(watch(&mut prepared))
    };
    let mut seen = in_parallel(&jobs, effort.threads, once)?.into_iter();
    Ok(traffic.iter().map(|_| seen.by_ref().take(effort.seeds as usize).collect()).collect())
}

/// Simulates the warm-up and then the measured steps, after each of which `observe` sees the world.
pub(crate) fn steps(prepared: &mut Prepared, mut observe: impl FnMut(&World)) {
    let world = &mut prepared.world;
    (0..prepared.warmup_steps).for_each(|_| world.step());
    for _ in 0..prepared.steps {
        world.step();
        observe(world);
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
