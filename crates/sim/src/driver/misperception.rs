//! A driver's errors in what it sees, over time: stationary Ornstein–Uhlenbeck processes, with the correlation time of
//! [`Misperception`]. They are functions of seed, driver and time alone, so no state is kept.
//!
//! Time is a grid, and its blocks are long against the correlation time: values at their ends are drawn independently,
//! which drops a correlation of 10⁻⁹. Between two ends the process is a bridge. Its value halfway, given both ends, is
//! normal (Lévy's construction, for this process): with ρ = e^(−h/τ) over the half h, the mean is
//! (x₁ + x₂) ρ/(1 + ρ²) and the variance (1 − ρ²)/(1 + ρ²). So a value takes one draw for each halving. Between
//! neighbouring points of the grid it is linear.

use laneweave_models::Misperception;

use crate::state::lane::VehicleId;
use crate::state::normal::quantile;
use crate::state::random::{Purpose, Random};
use crate::view::scene::{Scene, Spot};

/// Distance of the points of the grid [s] (ours): a driver's error hardly changes in less.
const STEP: f64 = 0.8;
/// Halvings of a block. It has 512 steps: 410 s.
const HALVINGS: u32 = 9;

/// The errors of the driver at `spot` in what it sees at `time` [s] of a vehicle ahead, or behind; `None` if it sees
/// everything as it is.
#[inline]
pub(super) fn misperception(scene: &Scene, spot: Spot, of: Purpose, time: f64) -> Option<Misperception> {
    let random = scene.errors?;
    let size = scene.style(spot).manner.misperception;
    (size > 0.0).then(|| Misperception::new(size, processes(random, scene.motion(spot).id, of, time)))
}

/// The values of two independent processes of the driver of `id` at `time` [s], each standard normal. Different
/// purposes have different processes.
#[cold]
fn processes(random: Random, id: VehicleId, purpose: Purpose, time: f64) -> [f64; 2] {
    let place = time / STEP;
    let at = place as u32;
    let draw = |point: u32| random.uniform_pair(id, purpose, point).map(quantile);
    let mut from = at >> HALVINGS << HALVINGS;
    let mut to = from + (1 << HALVINGS);
    let (mut first, mut last) = (draw(from), draw(to));
    let mut correlation = libm::exp(-f64::from(1 << HALVINGS) * STEP / Misperception::CORRELATION_TIME);
    for halving in (0..HALVINGS).rev() {
        correlation = correlation.sqrt();
        let square = correlation * correlation;
        let share = correlation / (1.0 + square);
        let deviation = ((1.0 - square) / (1.0 + square)).sqrt();
        let halfway = from + (1 << halving);
        let [one, other] = draw(halfway);
        let middle = [
            (first[0] + last[0]) * share + deviation * one,
            (first[1] + last[1]) * share + deviation * other,
        ];
        if at < halfway { (to, last) = (halfway, middle) } else { (from, first) = (halfway, middle) }
    }
    debug_assert_eq!((from, to), (at, at + 1));
    let share = place - f64::from(at);
    [0, 1].map(|it| first[it] + share * (last[it] - first[it]))
}

#[cfg(test)]
mod tests {
    use super::*;

    const AHEAD: Purpose = Purpose::MisperceptionAhead;
    const DRIVERS: u32 = 20_000;

    /// Mean over drivers of the product of a process's values at two times [s].
    fn product(at: f64, later: f64) -> f64 {
        let random = Random::new(11);
        let of = |id| {
            let [one, other] = [at, later].map(|it| processes(random, id, AHEAD, it));
            0.5 * (one[0] * other[0] + one[1] * other[1])
        };
        (0..DRIVERS).map(of).sum::<f64>() / f64::from(DRIVERS)
    }

    /// Three standard errors of such a mean, at most.
    const NEAR: f64 = 3.0 / 141.0;

    #[test]
    fn at_any_time_its_variance_is_one() {
        // Ends, middle, first and last step of a block, and another block; between two points little is lost.
        for time in [0.0, 0.8, 204.8, 100.3, 408.8, 409.6, 1000.0, 3600.0] {
            let variance = product(time, time);
            assert!((variance - 1.0).abs() < NEAR + 0.02, "{variance} at {time} s");
        }
    }

    #[test]
    fn its_autocorrelation_falls_by_e_in_the_correlation_time_also_across_blocks() {
        for at in [0.0, 100.0, 190.4, 204.8, 408.0, 630.4] {
            for (after, expected) in
                [(8.0, 0.670_320), (20.0, 0.367_879), (40.0, 0.135_335), (100.0, 0.006_738)]
            {
                let found = product(at, at + after);
                assert!(
                    (found - expected).abs() < NEAR,
                    "{found}, not {expected}, from {at} s over {after} s"
                );
            }
        }
    }

    #[test]
    fn it_is_continuous_and_does_not_depend_on_what_was_asked_before() {
        let at = |time: f64| processes(Random::new(3), 7, AHEAD, time);
        for tenths in 0..10_000_u32 {
            let (before, after) = (at(f64::from(tenths) / 10.0), at(f64::from(tenths + 1) / 10.0));
            // A step of the grid has the deviation √(1 − e^(−2 · .8/20)) = .28.
            assert!((before[0] - after[0]).abs() < 5.0 * 0.28 / 8.0 + 1e-9, "{before:?} {after:?}");
        }
        assert_eq!(at(123.4), at(123.4));
    }

    #[test]
    fn processes_of_other_drivers_purposes_and_numbers_are_others() {
        let random = Random::new(3);
        let mean = |of: &dyn Fn(u32) -> f64| (0..DRIVERS).map(of).sum::<f64>() / f64::from(DRIVERS);
        let ahead = |id| processes(random, id, AHEAD, 50.0);
        let behind = |id| processes(random, id, Purpose::MisperceptionBehind, 50.0);
        let bound = 3.0 / 141.0 * 1.5;
        for product in [
            mean(&|id| ahead(id)[0] * ahead(id)[1]),
            mean(&|id| ahead(id)[0] * behind(id)[0]),
            mean(&|id| ahead(id)[0] * ahead(id + 1)[0]),
        ] {
            assert!(product.abs() < bound, "{product}");
        }
    }
}
