//! How likely recorded drivers are under many rollouts of a model.
//!
//! For each reactive driver and each full second after it became a driver, the rollouts give a distribution of its
//! speed, its acceleration and its gap: normal kernels around their values, mixed with a little of a uniform
//! distribution, so that nothing is impossible. The score is the logarithm of its density at the recorded value, in
//! nats. A higher score is better. The time of the first lane change is scored in classes of two seconds. The
//! bandwidths are ours; the idea is that of the Waymo Open Sim Agents Challenge (Montali et al., 2023).

use std::collections::BTreeMap;
use std::f64::consts::PI;

use super::trace::{FARTHEST, HORIZON, Sample, Trace};

/// The share of the uniform distribution.
const UNIFORM: f64 = 0.01;
/// Length of the classes of the time of a lane change [s].
const CLASS: f64 = 2.0;
/// What is added to the count of each class.
const PSEUDO_COUNT: f64 = 0.1;
/// Smallest gap that is told from a smaller one [m].
const NEAREST: f64 = 0.1;

/// What is scored.
pub(super) const KINDS: usize = 4;

/// A quantity that is scored every second.
struct Quantity {
    /// Standard deviation of the kernels.
    bandwidth: f64,
    /// Where it can be.
    range: [f64; 2],
    /// Its value at a sample; there are so many samples in a second.
    of: fn(samples: &[Sample], at: usize, a_second: usize) -> f64,
}

const SPEED: Quantity = Quantity { bandwidth: 1.0, range: [0.0, 60.0], of: speed };
const ACCELERATION: Quantity = Quantity { bandwidth: 0.5, range: [-10.0, 10.0], of: acceleration };
/// Of the logarithm of the gap.
const GAP: Quantity = Quantity { bandwidth: 0.2, range: [-2.303, 5.299], of: log_gap };

impl Quantity {
    /// The logarithm of the density at `value`, of which the rollouts gave `drawn`.
    fn score(&self, drawn: &[f64], value: f64) -> f64 {
        let [least, most] = self.range;
        let kernel = |it: &f64| {
            let far = (value - it) / self.bandwidth;
            (-0.5 * far * far).exp() / (self.bandwidth * (2.0 * PI).sqrt())
        };
        let count = drawn.len().max(1) as f64;
        let density = drawn.iter().map(kernel).sum::<f64>() / count;
        ((1.0 - UNIFORM) * density + UNIFORM / (most - least)).ln()
    }
}

/// The mean scores of one driver: speed, acceleration, gap and time of a lane change [nats]. `rollouts` are its traces,
/// `dt` is the step [s]. None if it was recorded for less than a second, or was not comparable so long in any rollout.
pub(super) fn scores(record: &Trace, rollouts: &[&Trace], dt: f64) -> Option<[f64; KINDS]> {
    let a_second = (1.0 / dt).round().max(1.0) as usize;
    let seconds = (record.samples.len().checked_sub(1)? / a_second).min(HORIZON as usize);
    if seconds == 0 {
        return None;
    }
    let (mut sums, mut scored) = ([0.0; KINDS - 1], 0);
    for second in 1..=seconds {
        let at = second * a_second;
        let there: Vec<&&Trace> = rollouts.iter().filter(|it| it.samples.len() > at).collect();
        if there.is_empty() {
            break;
        }
        scored += 1;
        for (sum, quantity) in sums.iter_mut().zip([SPEED, ACCELERATION, GAP]) {
            let of = |it: &Trace| (quantity.of)(&it.samples, at, a_second);
            let drawn: Vec<f64> = there.iter().map(|it| of(it)).collect();
            *sum += quantity.score(&drawn, of(record));
        }
    }
    if scored == 0 {
        return None;
    }
    let [speed, acceleration, gap] = sums.map(|it| it / f64::from(scored));
    Some([speed, acceleration, gap, change(record, rollouts, dt)])
}

fn speed(samples: &[Sample], at: usize, _: usize) -> f64 {
    samples[at].speed
}

fn acceleration(samples: &[Sample], at: usize, a_second: usize) -> f64 {
    samples[at].speed - samples[at - a_second].speed
}

fn log_gap(samples: &[Sample], at: usize, _: usize) -> f64 {
    samples[at].gap.clamp(NEAREST, FARTHEST).ln()
}

/// The score of the time of the first lane change while the driver was recorded, or of none. A rollout in which the
/// driver was not comparable long enough to tell does not count.
fn change(record: &Trace, rollouts: &[&Trace], dt: f64) -> f64 {
    let span = record.until - record.from;
    let tells = |it: &&&Trace| it.changed.is_some() || !it.is_cut || it.until - it.from >= span;
    let rollouts: Vec<&Trace> = rollouts.iter().filter(tells).copied().collect();
    let class = |it: &Trace| {
        let after = it.changed.map(|step| step - it.from).filter(|it| *it <= span);
        after.map(|it| (f64::from(it) * dt / CLASS) as usize)
    };
    let classes = (f64::from(span) * dt / CLASS) as usize + 2;
    let own = class(record);
    let same = rollouts.iter().filter(|it| class(it) == own).count() as f64;
    ((same + PSEUDO_COUNT) / (rollouts.len() as f64 + PSEUDO_COUNT * classes as f64)).ln()
}

/// The scores of all drivers that were recorded for a second or more, by their ids.
pub(super) fn all_scores(
    record: &BTreeMap<i64, Trace>,
    rollouts: &[BTreeMap<i64, Trace>],
    dt: f64,
) -> BTreeMap<i64, [f64; KINDS]> {
    let of = |id: &i64| rollouts.iter().filter_map(|it| it.get(id)).collect::<Vec<&Trace>>();
    record.iter().filter_map(|(id, trace)| Some((*id, scores(trace, &of(id), dt)?))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_density_is_that_of_a_normal_kernel_with_a_little_of_a_uniform_one() {
        let exact = 0.99 / (2.0 * PI).sqrt() + 0.01 / 60.0;
        assert!((SPEED.score(&[20.0], 20.0) - f64::ln(exact)).abs() < 1e-12);
        assert!((SPEED.score(&[20.0], 50.0) - f64::ln(0.01 / 60.0)).abs() < 1e-9, "it is not impossible");
        assert!(SPEED.score(&[19.0, 21.0], 20.0) > SPEED.score(&[17.0, 23.0], 20.0));
    }
}
