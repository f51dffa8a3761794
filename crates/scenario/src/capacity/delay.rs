//! Delays of vehicles at a junction because of lights and of other drivers.
//!
//! Both are the control delays of the Highway Capacity Manual (2010, chapters 18 to 20, from memory) for a quarter of
//! an hour.

use laneweave_study::units::SECONDS_PER_HOUR;

/// Duration of the flows [s].
const PERIOD: f64 = 0.25 * SECONDS_PER_HOUR;

/// Mean delay before a light [s]. `mean_wait` [s] is the mean wait of a vehicle that arrives at a random time and
/// finds no queue; the vehicles are a `flow` of `capacity` [veh/s], which passes during a `green` share of the time.
pub(super) fn at_a_light(mean_wait: f64, green: f64, flow: f64, capacity: f64) -> f64 {
    /// For lights with fixed times.
    const FIXED: f64 = 4.0;
    let fullness = flow / capacity;
    mean_wait / (1.0 - green * fullness.min(1.0)).max(f64::EPSILON) + overflow(fullness, FIXED / capacity)
}

/// Mean delay of vehicles that give way [s]: `flow` of `capacity` [veh/s].
pub(super) fn giving_way(flow: f64, capacity: f64) -> f64 {
    /// Times at the head of the queue vary like those of a process without memory.
    const RANDOM: f64 = 8.0;
    /// Time for braking and starting, in addition to the time in the queue and at its head [s].
    const STOPPING: f64 = 5.0;
    1.0 / capacity + overflow(flow / capacity, RANDOM / capacity) + STOPPING
}

/// Mean time in a queue [s] that exists because the intervals between arrivals vary, and that grows if the flow is
/// above capacity.
fn overflow(fullness: f64, spread: f64) -> f64 {
    let excess = fullness - 1.0;
    0.25 * PERIOD * (excess + (excess * excess + spread * fullness / PERIOD).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn delays_are_those_of_the_formulas() {
        // c = 600 veh/h, x = 0.5: 6 s + 225 s (−0.5 + √(0.25 + 8 · 0.5 / 150)) + 5 s.
        assert!((giving_way(300.0 / 3600.0, 600.0 / 3600.0) - 16.848).abs() < 1e-3);
        // A cycle of 60 s with 30 s of green, X = 0.8, c = 900 veh/h: 7.5 s / (1 − 0.4) + 225 s (−0.2 + √(0.04 + 4 ·
        // 0.8 / 225)).
        assert!((at_a_light(7.5, 0.5, 0.2, 0.25) - 19.893).abs() < 1e-3);
        assert_eq!(at_a_light(7.5, 0.5, 0.0, 0.25), 7.5);
    }

    #[test]
    fn the_more_come_the_longer_they_wait_beyond_capacity_too() {
        let flows = || (0..40).map(|it| 0.01 * f64::from(it));
        let lists: [Vec<f64>; 2] = [
            flows().map(|it| giving_way(it, 0.2)).collect(),
            flows().map(|it| at_a_light(10.0, 0.4, it, 0.2)).collect(),
        ];
        assert!(
            lists.iter().all(|list| list.windows(2).all(|it| it[0] < it[1] && it[1].is_finite())),
            "{lists:?}"
        );
    }
}
