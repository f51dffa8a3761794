//! Whether a driver is concentrated or inattentive. This is a function of seed, driver and time alone, so no state is
//! kept.
//!
//! The state is a Markov process of two states with the mean dwell times τ_c and τ_i. Such a process redraws its
//! state at the points of a Poisson process with the rate 1/τ_c + 1/τ_i. Each state drawn is inattentive with the
//! probability τ_i/(τ_c + τ_i). Here time is divided into slots, sixteen to the mean time between two points, and
//! each slot has at most one point. Dwell times are then geometric in slots, with exactly the mean that the style
//! gives. The state is the one drawn at the last point, which is searched backwards from the present.

use laneweave_models::{Attention, Concentration};

use crate::state::lane::VehicleId;
use crate::state::random::{Purpose, Random};

/// Slots in the mean time between two points (ours).
const SLOTS: f64 = 16.0;

/// The state of the driver of `id` at `time` [s].
#[inline]
pub(crate) fn concentration(
    attention: &Attention,
    random: Random,
    id: VehicleId,
    time: f64,
) -> Concentration {
    if attention.inattentive_share() == 0.0 {
        return Concentration::Concentrated;
    }
    drawn(attention, random, id, time)
}

/// The state of a driver who is inattentive at times.
#[inline(never)]
fn drawn(attention: &Attention, random: Random, id: VehicleId, time: f64) -> Concentration {
    let is_inattentive = match attention.memory() {
        0.0 => true,
        memory => last_draw(random, id, (time * SLOTS / memory) as u32) < attention.inattentive_share(),
    };
    if is_inattentive { Concentration::Inattentive } else { Concentration::Concentrated }
}

/// The random number of the state, uniform in (0, 1), at the last point up to `slot`. The first slot always has a
/// point.
fn last_draw(random: Random, id: VehicleId, slot: u32) -> f64 {
    let draw = |slot| random.uniform(id, Purpose::Attention, slot);
    let at_a_point = (1..=slot).rev().map(|slot| draw(slot) * SLOTS).find(|it| *it < 1.0);
    at_a_point.unwrap_or_else(|| draw(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    const DRIFTING: Attention = Attention {
        epoch: 1.0,
        concentrated_for: 60.0,
        inattentive_for: 20.0,
        inattentive: laneweave_models::Alertness { epoch: 2.0, sight: 150.0, comfort: 2.0 },
    };

    /// Durations of the complete dwells [s] of one driver in each state, within `hours`.
    fn dwells(hours: f64) -> [Vec<f64>; 2] {
        let mut dwells = [Vec::new(), Vec::new()];
        let (mut state, mut since) = (None, 0.0);
        for tenths in 0..(hours * 36_000.0) as u32 {
            let time = f64::from(tenths) / 10.0;
            let now = concentration(&DRIFTING, Random::new(1), 7, time);
            if let Some(was) = state.filter(|was| *was != now) {
                dwells[usize::from(was == Concentration::Inattentive)].push(time - since);
                since = time;
            }
            state = Some(now);
        }
        dwells
    }

    #[test]
    fn drivers_stay_in_either_state_for_exponential_times_with_the_means_of_their_style() {
        let found = dwells(50.0);
        for (times, expected) in found.iter().zip([60.0, 20.0]) {
            let n = times.len() as f64;
            let mean = times.iter().sum::<f64>() / n;
            let sd = (times.iter().map(|it| (it - mean) * (it - mean)).sum::<f64>() / (n - 1.0)).sqrt();
            // Three standard errors. The deviation of an exponential time is its mean; a share of 1/e is longer than
            // the mean.
            assert!((mean / expected - 1.0).abs() < 3.0 / n.sqrt(), "{mean} of {expected}, {n} dwells");
            assert!((sd / mean - 1.0).abs() < 0.1, "{sd} of {mean}");
            let longer = times.iter().filter(|it| **it > expected).count() as f64 / n;
            assert!((longer - (-1.0_f64).exp()).abs() < 3.0 * 0.48 / n.sqrt(), "{longer}");
        }
    }

    #[test]
    fn at_any_time_the_share_of_inattentive_drivers_is_that_of_their_style() {
        for time in [0.0, 0.5, 30.0, 3600.0] {
            let is_inattentive =
                |id: &u32| concentration(&DRIFTING, Random::new(3), *id, time) == Concentration::Inattentive;
            let share = (0..20_000).filter(is_inattentive).count() as f64 / 20_000.0;
            assert!((share - 0.25).abs() < 3.0 * (0.25 * 0.75 / 20_000.0_f64).sqrt(), "{share} at {time} s");
        }
    }

    #[test]
    fn a_style_can_be_always_in_one_state() {
        for (concentrated_for, inattentive_for, expected) in [
            (60.0, 0.0, Concentration::Concentrated),
            (0.0, 0.0, Concentration::Concentrated),
            (0.0, 20.0, Concentration::Inattentive),
        ] {
            let attention = Attention { concentrated_for, inattentive_for, ..DRIFTING };
            for id in 0..1000 {
                assert_eq!(concentration(&attention, Random::new(1), id, f64::from(id)), expected);
            }
        }
    }
}
