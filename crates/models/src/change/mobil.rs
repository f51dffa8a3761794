//! MOBIL: minimizing overall braking induced by lane changes.
//!
//! Kesting, Treiber, Helbing (2007), Transp. Res. Rec. 1999, 86–94. With accelerations a of the own car-following
//! models before and ã after the change, of the driver (c), the new follower (n) and the old one (o):
//!
//! * safety: ã_n ≥ −b_safe;
//! * symmetric: ã_c − a_c + p [(ã_n − a_n) + (ã_o − a_o)] > a_thr;
//! * European: to the slow side ã_c^eur − a_c + p (ã_o − a_o) > a_thr − a_bias, to the fast side ã_c − a_c^eur + p
//!   (ã_n − a_n) > a_thr + a_bias. On the slow side of a leader slower than the driver, but faster than v_crit, a^eur
//!   is at most the acceleration behind that leader: nobody passes on that side in free traffic.
//!
//! Which of the two holds is a key of the style; it may leave the choice to the law of the map (ours).
//!
//! The model has no route. [`RouteKeeping`] gives it one (ours); with the urgency d, the accelerations count only
//! 1 − |d|: who has to change waits for a gap, however bad the present one is. The safety criterion applies to
//! discretionary changes. For route-driven changes the gap test, which all models share, replaces it.

use serde::{Deserialize, Serialize};

use super::incentives::{IncentiveName, in_rows};
use super::mcdm::{Appraisal, Row, by_threshold};
use super::route_keeping::RouteKeeping;
use super::situation::{Driver, LaneRule, LaneView, Situation, Toward, may_not_pass};
use crate::braking::HARDEST_BRAKING;
use crate::follow::{Ahead, CarFollowing};

/// Minimizing overall braking induced by lane changes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Mobil {
    /// Whether the lanes are equal, or one side is for overtaking.
    pub traffic: Traffic,
    /// p: weight of the others' gains.
    pub politeness: f64,
    /// a_thr: gain from which a change is worthwhile [m/s²].
    pub threshold: f64,
    /// a_bias: preference for the slow side, in European traffic [m/s²].
    pub bias: f64,
    /// b_safe: hardest braking that a change may cause for the new follower [m/s²].
    pub safe_deceleration: f64,
    /// v_crit: speed above which nobody passes on the slow side, in European traffic [m/s].
    pub critical_speed: f64,
    /// How the driver follows its route.
    pub route: RouteKeeping,
    /// Weight of full urgency, where the driver keeps its route by urgency [m/s²].
    pub urgency: f64,
}

/// Whether lanes are equal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Traffic {
    /// Drivers overtake on either side.
    #[default]
    Symmetric,
    /// Drivers keep to the slow side, and overtake on the other.
    European,
    /// European where the law of the map wants drivers on the slow side, elsewhere symmetric.
    Law,
}

impl Traffic {
    /// Whether it is European where the law has this rule.
    #[inline]
    pub fn is_european(self, rule: LaneRule) -> bool {
        match self {
            Traffic::Symmetric => false,
            Traffic::European => true,
            Traffic::Law => rule == LaneRule::NoPassingThere,
        }
    }
}

impl Default for Mobil {
    /// The values of Kesting et al. (from memory); the weight of urgency is ours: full urgency outweighs the hardest
    /// braking.
    fn default() -> Mobil {
        Mobil {
            traffic: Traffic::Symmetric,
            politeness: 0.2,
            threshold: 0.1,
            bias: 0.3,
            safe_deceleration: 4.0,
            critical_speed: 60.0 / 3.6,
            route: RouteKeeping::Urgency,
            urgency: 8.0,
        }
    }
}

/// Accelerations [m/s²] without the change and with it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Accelerations {
    /// a_c, ã_c: of the driver.
    pub own: [f64; 2],
    /// a_n, ã_n: of the new follower; equal where there is none.
    pub new_follower: [f64; 2],
    /// a_o, ã_o: of the old follower.
    pub old_follower: [f64; 2],
}

/// Weight [m/s²] of a lane change that the route needs, for drivers who stay in the lanes that lead on: above every
/// gain.
const DECISIVE: f64 = 1000.0;

impl Accelerations {
    /// The accelerations in `situation`, by every driver's own car-following model; nobody brakes harder than vehicles
    /// can.
    pub fn of(situation: &Situation) -> Accelerations {
        let Situation { me, here, there, .. } = situation;
        let of =
            |driver: &Driver, ahead| driver.follow.acceleration(driver.pace, ahead).max(-HARDEST_BRAKING);
        let own = |lane: &LaneView| of(me, lane.ahead);
        // Acceleration of the vehicle behind in a lane, with the driver in that lane and without.
        let behind = |lane: &LaneView| {
            lane.behind.map_or([0.0; 2], |it| it.leaders(me, lane.ahead).map(|ahead| of(&it.driver, ahead)))
        };
        let [new_with, new_without] = behind(there);
        Accelerations {
            own: [own(here), own(there)],
            new_follower: [new_without, new_with],
            old_follower: behind(here),
        }
    }
}

fn gain([now, then]: [f64; 2]) -> f64 {
    then - now
}

impl Mobil {
    /// The own gain, and the gain of the other vehicles that count [m/s²], in a change `toward` a side, under this
    /// rule of the law.
    pub fn gains(&self, toward: Toward, rule: LaneRule, accelerations: &Accelerations) -> [f64; 2] {
        let Accelerations { own, new_follower, old_follower } = accelerations;
        let others = match (self.traffic.is_european(rule), toward) {
            (false, _) => gain(*new_follower) + gain(*old_follower),
            (true, Toward::Offside) => gain(*new_follower),
            (true, Toward::Nearside) => gain(*old_follower),
        };
        [gain(*own), others]
    }

    /// θ: gain [m/s²] from which a change `toward` a side is worthwhile, under this rule of the law.
    pub fn threshold(&self, toward: Toward, rule: LaneRule) -> f64 {
        match (self.traffic.is_european(rule), toward) {
            (false, _) => self.threshold,
            (true, Toward::Offside) => self.threshold + self.bias,
            (true, Toward::Nearside) => self.threshold - self.bias,
        }
    }

    /// Whether a driver in European traffic at `speed` [m/s] on the slow side of `offside`, the leader in the lane
    /// beside, may not pass it.
    #[inline]
    pub fn stays_behind(&self, speed: f64, offside: Ahead) -> bool {
        may_not_pass(speed, offside, self.critical_speed)
    }

    /// The same accelerations where the lane on the slow side counts as no faster than passing there allows: a^eur.
    fn without_passing(&self, situation: &Situation, accelerations: Accelerations) -> Accelerations {
        let Accelerations { own: [now, then], .. } = accelerations;
        let Situation { me, here, there, toward, lane_rule, .. } = situation;
        let offside = match toward {
            Toward::Offside => there.ahead,
            Toward::Nearside => here.ahead,
        };
        let is_european = self.traffic.is_european(*lane_rule);
        if !is_european || !offside.is_some_and(|it| self.stays_behind(me.pace.speed, it)) {
            return accelerations;
        }
        let own = match toward {
            Toward::Offside => [now.min(then), then],
            Toward::Nearside => [now, then.min(now)],
        };
        Accelerations { own, ..accelerations }
    }

    /// Whether only the preference for the slow side makes the driver of this `appraisal` want the change.
    pub(super) fn is_for_the_slow_side(&self, situation: &Situation, appraisal: &Appraisal) -> bool {
        let Situation { toward, lane_rule, .. } = *situation;
        let is_european = self.traffic.is_european(lane_rule);
        is_european && toward == Toward::Nearside && appraisal.gain <= self.threshold
    }

    /// Chances within one epoch of the desire for either side: the better one above its threshold is certain.
    pub fn choose(&self, sides: [Option<&Appraisal>; 2]) -> [f64; 2] {
        by_threshold(sides, |excess| excess > 0.0)
    }

    /// The driver's appraisal of the side in `situation`: its own gain stands in the row of speed, the others' in
    /// that of courtesy. Where the change is neither safe nor for the route, the gain is −∞.
    pub fn appraise(&self, situation: &Situation) -> Appraisal {
        let accelerations = self.without_passing(situation, Accelerations::of(situation));
        let Situation { toward, lane_rule, .. } = *situation;
        let [own, others] = self.gains(toward, lane_rule, &accelerations);
        let [route, urgency] = self.route.rows(situation, DECISIVE, self.urgency);
        // The stronger the urgency, the less the accelerations of the moment count: the driver waits for a gap.
        let free = 1.0 - urgency.earning.abs();
        let rows = in_rows([
            (IncentiveName::Speed, Row { earning: own, weight: free }),
            (IncentiveName::Route, route),
            (IncentiveName::Courtesy, Row { earning: others, weight: free * self.politeness }),
            (IncentiveName::Urgency, urgency),
        ]);
        let helps_the_route = RouteKeeping::is_helped(situation);
        let [_, new_follower] = accelerations.new_follower;
        let is_safe = new_follower >= -self.safe_deceleration;
        let gain = if is_safe || helps_the_route {
            rows.iter().map(|it| it.weight * it.earning).sum()
        } else {
            f64::NEG_INFINITY
        };
        Appraisal { rows, gain, theta: self.threshold(toward, lane_rule) }
    }
}
