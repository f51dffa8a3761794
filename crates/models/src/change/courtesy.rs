//! Courtesy incentive: how much closer the vehicles concerned come to their desired speeds.
//!
//! A = Σ_r (|v_r − v_r,des| − |ṽ_r − v_r,des|) / |v_r − v_r,des|
//!
//! over the old follower, the new follower, and vehicles that signal a change into the own lane. Both speeds are
//! expected one second ahead by r's own car-following model.
//!
//! * literal: the denominator, which vanishes for a follower at its desired speed, is floored at 1 m/s.
//! * repaired: divided by v_r,des.
//!
//! Giving way to the vehicle behind counts only while the driver is slower than its lane's mean (the paper's first
//! case); a merging vehicle counts with 1 + d, d its urgency ("closer to the merging intersection, the greater the
//! probability"). A driver whose own route needs its lane gives way to nobody.

use serde::{Deserialize, Serialize};

use super::situation::{Behind, Driver, LaneView, Situation};
use super::{Chances, GainBound, Incentive, Outcomes};
use crate::Reading;
use crate::follow::{Ahead, CarFollowing, speed_after};

/// Courtesy incentive.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Courtesy {
    /// μ₄.
    pub weight: f64,
    /// Which reading.
    pub reading: Reading,
}

impl Default for Courtesy {
    fn default() -> Courtesy {
        Courtesy { weight: 0.0, reading: Reading::Repaired }
    }
}

/// Floor of the literal denominator [m/s].
const LITERAL_FLOOR: f64 = 1.0;

impl Courtesy {
    /// The share of one vehicle: its expected speed changes from `now` to `then`; it desires `desired` [m/s].
    pub fn share(&self, now: f64, then: f64, desired: f64) -> f64 {
        let short_of = (now - desired).abs();
        let scale = match self.reading {
            Reading::Literal => short_of.max(LITERAL_FLOOR),
            Reading::Repaired => desired,
        };
        (short_of - (then - desired).abs()) / scale
    }

    #[inline]
    fn driver_share(&self, driver: &Driver, now: Option<Ahead>, then: Option<Ahead>) -> f64 {
        let expected = |ahead| speed_after(driver.follow.acceleration(driver.pace, ahead), driver.pace);
        self.share(expected(now), expected(then), driver.pace.desired)
    }

    /// The share of A of the old follower: it would follow the driver's leader instead of the driver, if the driver
    /// leaves the lane `here`.
    #[inline]
    pub fn relief(&self, me: &Driver, here: &LaneView) -> f64 {
        let in_the_way = me.pace.speed < here.flow.speed;
        here.behind.as_ref().filter(|_| in_the_way).map_or(0.0, |behind| {
            let [with, without] = behind.leaders(me, here.ahead);
            self.driver_share(&behind.driver, with, without)
        })
    }

    /// The share of A of the new follower: it would follow the driver instead of the leader `ahead` of it.
    #[inline]
    pub fn harm(&self, me: &Driver, ahead: Option<Ahead>, behind: &Behind) -> f64 {
        let [with, without] = behind.leaders(me, ahead);
        self.driver_share(&behind.driver, without, with)
    }

    /// A: the sum over the vehicles concerned.
    fn gain(&self, situation: &Situation) -> f64 {
        let Situation { me, here, there, merging, .. } = situation;
        let harm = there.behind.as_ref().map_or(0.0, |behind| self.harm(me, there.ahead, behind));
        if situation.is_bound() {
            return harm;
        }
        let relief = self.relief(me, here);
        let room = merging
            .iter()
            .flatten()
            .map(|it| (1.0 + it.urgency) * self.driver_share(&it.driver, it.blocked, it.freed));
        harm + relief + room.sum::<f64>()
    }
}

impl Incentive for Courtesy {
    fn outcomes(&self, situation: &Situation, _chances: Chances) -> Outcomes {
        let gain = self.gain(situation);
        Outcomes { keep: 0.0, back: gain, away: gain }
    }

    /// A is already a yield.
    fn scale(&self, _situation: &Situation, _outcomes: &Outcomes) -> f64 {
        1.0
    }

    #[inline]
    fn most(&self, bound: &GainBound) -> Option<f64> {
        Some(bound.courtesy)
    }
}
