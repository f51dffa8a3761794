//! LMRS: lane changes with relaxation and synchronization.
//!
//! Schakel, Knoop, van Arem (2012), Transp. Res. Rec. 2316, 47–57 (from memory). The desire for a side is
//!
//! d = d_r + θ_v (d_s + d_b)
//!
//! * d_r, the route: the urgency of the own lane if the side takes a change off the route, minus that of the side if
//!   it adds one; where both lanes take as many, the difference of their urgencies (ours).
//! * d_s, the speed: a_gain (v_ant − v_ant,here)/v_gain, a_gain = (a − max(a_now, 0))/a: a driver who accelerates is
//!   content. To the slow side, only a loss counts while the own lane is faster than v_cong.
//! * d_b, the bias: d_free to the slow side where no speed is lost there.
//! * θ_v: 1 where d_r is at most d_sync or of the same sign, falling to 0 at d_coop.
//!
//! At d_free the driver takes a gap that is there. At d_sync it also adapts its speed to the target lane. At d_coop
//! others also let it in. The stronger the desire, the shorter the time gap that it accepts; the gap relaxes again
//! ([`crate::Manner`]).

use serde::{Deserialize, Serialize};

use super::incentives::{IncentiveName, in_rows};
use super::mcdm::{Appraisal, Row, by_threshold};
use super::route_keeping::RouteKeeping;
use super::situation::{Situation, Toward};
use crate::follow::CarFollowing;

/// Lane changes with relaxation and synchronization.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Lmrs {
    /// d_free: desire from which a gap that is there is taken.
    pub free: f64,
    /// d_sync: desire from which the driver adapts its speed to the target lane.
    pub synchronize: f64,
    /// d_coop: desire from which others let it in.
    pub cooperate: f64,
    /// v_gain: gain of speed that gives a full desire [m/s].
    pub speed_gain: f64,
    /// v_cong: speed below which traffic is congested [m/s].
    pub congested_speed: f64,
    /// a: acceleration of a driver that nothing holds up [m/s²].
    pub acceleration: f64,
    /// How the driver follows its route; by urgency is the model's own.
    pub route: RouteKeeping,
}

impl Default for Lmrs {
    fn default() -> Lmrs {
        Lmrs {
            free: 0.365,
            synchronize: 0.577,
            cooperate: 0.788,
            speed_gain: 69.6 / 3.6,
            congested_speed: 60.0 / 3.6,
            acceleration: 1.25,
            route: RouteKeeping::Urgency,
        }
    }
}

impl Lmrs {
    /// d_s for a lane in which `there` [m/s] is anticipated instead of `here`, while accelerating `acceleration`
    /// [m/s²].
    pub fn speed_desire(&self, toward: Toward, [here, there]: [f64; 2], acceleration: f64) -> f64 {
        let content = (self.acceleration - acceleration.max(0.0)) / self.acceleration;
        let gain = match toward {
            Toward::Nearside if here > self.congested_speed => (there - here).min(0.0),
            Toward::Offside | Toward::Nearside => there - here,
        };
        content.max(0.0) * gain / self.speed_gain
    }

    /// d_b for a side with the desire `speed` for its speed.
    fn bias_desire(&self, toward: Toward, speed: f64) -> f64 {
        match toward {
            Toward::Nearside if speed >= 0.0 => self.free,
            Toward::Offside | Toward::Nearside => 0.0,
        }
    }

    /// d_r.
    fn route_desire(&self, situation: &Situation) -> f64 {
        let (saved, urgency) = (RouteKeeping::changes_saved(situation), RouteKeeping::urgency_for(situation));
        match self.route {
            RouteKeeping::Urgency => urgency,
            // A driver who stays in the lanes that lead on looks for one from the beginning.
            RouteKeeping::Lanes if saved > 0.0 => urgency.max(self.synchronize),
            RouteKeeping::Lanes if saved < 0.0 => -1.0,
            RouteKeeping::Lanes => urgency,
        }
    }

    /// Whether only d_b, the bias to the slow side, makes the driver of this `appraisal` want the change.
    pub(super) fn is_for_the_slow_side(&self, toward: Toward, appraisal: &Appraisal) -> bool {
        let bias = appraisal.row(IncentiveName::Comfort);
        toward == Toward::Nearside && appraisal.gain - bias.weight * bias.earning < self.free
    }

    /// Chances within one epoch of the desire for either side: from d_free on, the stronger one is certain.
    pub fn choose(&self, sides: [Option<&Appraisal>; 2]) -> [f64; 2] {
        by_threshold(sides, |excess| excess >= 0.0)
    }

    /// θ_v: weight of the `voluntary` desire beside the `mandatory` one.
    pub fn voluntary_weight(&self, mandatory: f64, voluntary: f64) -> f64 {
        let size = mandatory.abs();
        if size <= self.synchronize || mandatory * voluntary >= 0.0 {
            1.0
        } else if size >= self.cooperate {
            0.0
        } else {
            (self.cooperate - size) / (self.cooperate - self.synchronize)
        }
    }

    /// The driver's appraisal of the side in `situation`: d_s stands in the row of speed, d_b in that of comfort, d_r
    /// in that of urgency.
    pub fn appraise(&self, situation: &Situation) -> Appraisal {
        let Situation { me, here, there, toward, .. } = situation;
        let acceleration = me.follow.acceleration(me.pace, here.ahead);
        let speed =
            self.speed_desire(*toward, [here.anticipated_speed, there.anticipated_speed], acceleration);
        let bias = self.bias_desire(*toward, speed);
        let route = self.route_desire(situation);
        let weight = self.voluntary_weight(route, speed + bias);
        let rows = in_rows([
            (IncentiveName::Speed, Row { earning: speed, weight }),
            (IncentiveName::Comfort, Row { earning: bias, weight }),
            (IncentiveName::Urgency, Row { earning: route, weight: 1.0 }),
        ]);
        let gain = rows.iter().map(|it| it.weight * it.earning).sum();
        Appraisal { rows, gain, theta: self.free }
    }
}
