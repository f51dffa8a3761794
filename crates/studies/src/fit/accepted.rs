//! The gaps that recorded drivers accepted, and the limits of a gap test that accepts most of them.

use laneweave_calibration::observe::Observations;
use laneweave_models::Style;
use laneweave_models::change::deceleration_to_avoid;
use laneweave_models::follow::{Ahead, CarFollowing, Pace};
use laneweave_study::quantile;

use super::report::{ENOUGH, GapLimits};

/// Share of the recorded gaps that each limit may refuse (ours).
const REFUSED: f64 = 0.05;
/// The limits lie within these, whatever a recording shows: its positions have errors (ours).
const GAPS: [f64; 2] = [0.5, 2.0];
const TIMES: [f64; 2] = [1.0, 3.0];
const DECELERATIONS: [f64; 2] = [4.0, 6.0];
/// Vehicles that come nearer slower than this do not collide soon [m/s].
const SLOW: f64 = 0.5;

/// Gaps to new leaders and to new followers, each with the speed at which it closes and that of the driver.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Accepted {
    /// To the new leader: gap [m], closing speed [m/s], speed of the driver [m/s].
    pub(super) lead: Vec<[f64; 3]>,
    /// To the new follower.
    pub(super) lag: Vec<[f64; 3]>,
}

impl Accepted {
    /// Those of all changes that are used, when they begin.
    pub(super) fn of(observations: &Observations) -> Accepted {
        let mut accepted = Accepted::default();
        for spell in observations.drivers.iter().flat_map(|it| &it.spells) {
            let Some(side) = spell.change else { continue };
            let last = spell.sightings.last().and_then(|it| it.sides[side.at()].as_ref());
            let Some(seen) = last else { continue };
            let of = |[gap, closing]: [f32; 2]| [gap, closing, seen.speed].map(f64::from);
            accepted.lead.push(of(seen.lead));
            accepted.lag.push(of(seen.lag));
        }
        accepted
    }

    /// The limits of a gap test that accepts nearly all of them, for drivers who follow as `style` says; `None` if too
    /// few were seen.
    pub(super) fn limits(&self, style: &Style) -> Option<GapLimits> {
        if self.lead.len() < ENOUGH {
            return None;
        }
        // Each pair as its follower, who closes in on its leader.
        let lead = self.lead.iter().map(|[gap, closing, speed]| (*gap, *speed, speed - closing));
        let lag = self.lag.iter().map(|[gap, closing, speed]| (*gap, speed + closing, *speed));
        let pairs: Vec<(f64, f64, f64)> = lead.chain(lag).collect();
        let gaps: Vec<f64> = pairs.iter().map(|it| it.0).collect();
        let closing = pairs.iter().filter(|(_, follower, leader)| follower - leader > SLOW);
        let times: Vec<f64> = closing.map(|(gap, follower, leader)| gap / (follower - leader)).collect();
        let demanded = |(gap, follower, leader): &(f64, f64, f64)| {
            let ahead = Ahead::steady(gap.max(GAPS[0]), *leader);
            let pace = Pace::new(*follower, follower.max(*leader));
            let demanded = -style.follow.acceleration(pace, Some(ahead));
            demanded.max(deceleration_to_avoid(ahead.gap, *follower, *leader))
        };
        let decelerations: Vec<f64> = pairs.iter().map(demanded).collect();
        let within = |value: Option<f64>, [low, high]: [f64; 2], usual: f64| {
            (value.unwrap_or(usual).clamp(low, high) * 100.0).round() / 100.0
        };
        Some(GapLimits {
            min_gap_m: within(quantile(&gaps, REFUSED), GAPS, GAPS[1]),
            min_time_to_collision_s: within(quantile(&times, REFUSED), TIMES, TIMES[1]),
            max_deceleration_mps2: within(
                quantile(&decelerations, 1.0 - REFUSED),
                DECELERATIONS,
                DECELERATIONS[0],
            ),
        })
    }
}

/// `style` with the limits of a gap test that accepts nearly all recorded gaps, if there are any. Its critical gaps
/// stay.
pub(super) fn with_limits(style: &Style, limits: Option<&GapLimits>) -> Style {
    let mut style = style.clone();
    if let Some(limits) = limits {
        style.safety.min_time_to_collision = limits.min_time_to_collision_s;
        style.safety.max_deceleration = limits.max_deceleration_mps2;
    }
    style
}
