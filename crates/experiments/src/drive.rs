//! Drives traffic over several seeds, side by side.

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
    let jobs: Vec<(&Traffic, u64)> =
        traffic.iter().flat_map(|it| (1..=effort.seeds).map(move |seed| (it, seed))).collect();
    let seen = in_parallel(&jobs, effort.threads, |(traffic, seed)| once(traffic, *seed, effort.length))?;
    let mut seen = seen.into_iter();
    Ok(traffic.iter().map(|_| seen.by_ref().take(effort.seeds as usize).collect()).collect())
}

fn once(traffic: &Traffic, seed: u64, length: f64) -> Result<Seen, Fault> {
    let mut prepared = traffic.prepared(seed, length)?;
    let world = &mut prepared.world;
    (0..prepared.warmup_steps).for_each(|_| world.step());
    world.reset_counts();
    let (begin, mut seen) = (world.clock().time(), Seen::default());
    for _ in 0..prepared.steps {
        world.step();
        seen.observe(world, world.clock().time() - begin);
    }
    seen.end(world);
    Ok(seen)
}

/// The mean of a measure over the runs that have it.
pub(crate) fn over(runs: &[Seen], of: impl Fn(&Seen) -> Option<f64>) -> Option<Estimate> {
    mean(&runs.iter().filter_map(of).collect::<Vec<f64>>())
}

/// The mean of a difference, or of a quotient, between runs of two kinds of traffic with the same seeds.
pub(crate) fn between(
    one: &[Seen],
    other: &[Seen],
    of: impl Fn(&Seen, &Seen) -> Option<f64>,
) -> Option<Estimate> {
    mean(&one.iter().zip(other).filter_map(|(one, other)| of(one, other)).collect::<Vec<f64>>())
}
