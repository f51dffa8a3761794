//! What a driver sees of one side at one time, as the numbers that models of lane changes use.

use laneweave_models::change::{
    Driver, INCENTIVES, Incentive, IncentiveName, Lmrs, Mcdm, Mobil, Safety, Situation, Traffic,
    deceleration_to_avoid, time_to_collision,
};

use laneweave_models::Style;
use laneweave_models::follow::{Ahead, Pace};
use laneweave_sim::Pairing;

use super::desired::NODES;
use super::place::Place;
use crate::waiting::GAP_TERMS;

/// One side at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SideSeen {
    /// Where.
    pub place: Place,
    /// Yield of courtesy.
    pub courtesy: f32,
    /// T_h of the lane there [s], for comfort.
    pub headway: f32,
    /// Net gap to the leader in the own lane [m], and how fast it closes [m/s].
    pub own: [f32; 2],
    /// The same to the leader there.
    pub lead: [f32; 2],
    /// The same of the follower there to the driver.
    pub lag: [f32; 2],
    /// Speed [m/s].
    pub speed: f32,
    /// Whether the gap test of the style accepts the gaps to both.
    pub has_safe_gap: bool,
    /// What a change into these gaps would ask of their followers.
    pub demands: GapDemands,
    /// What depends on the desired speed, for each of the driver's possible ones.
    pub by_desired: [ByDesired; NODES],
}

/// What a change into a gap would ask of those who follow there: the driver itself, and the new follower.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GapDemands {
    /// The shorter time to collision [s]; infinite where no gap closes.
    pub time_to_collision: f32,
    /// The harder braking [m/s²], by kinematics or by their models; negative where both may accelerate.
    pub deceleration: f32,
    /// Whether both could stop behind leaders who brake as hard as they can.
    pub is_secure: bool,
}

/// What depends on the desired speed of a driver.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ByDesired {
    /// Yield of speed and, as much as the style has it, of the route: between lanes that lead to the same place the two
    /// are one.
    pub speed: f32,
    /// Yields of the [`PLAIN`] incentives.
    pub plain: [f32; PLAIN.len()],
    /// MOBIL: the gain above its threshold [m/s²].
    pub mobil: f32,
    /// LMRS: the desire above its threshold.
    pub lmrs: f32,
}

/// The incentives whose yields are terms of a fit as they are. Of the others the route is one with speed, comfort has a
/// β, the yield of courtesy hardly depends on the desired speed, and urgency is not fitted.
pub const PLAIN: [IncentiveName; INCENTIVES - 5] = {
    use IncentiveName::{Comfort, Courtesy, Route, Speed, Urgency};
    IncentiveName::all_but(&[Speed, Route, Comfort, Courtesy, Urgency])
};

/// Without a vehicle ahead or behind a gap counts as this long [m].
const LONGEST_GAP: f64 = 150.0;
/// Largest gain of MOBIL that counts [m/s²]: nobody brakes or accelerates more.
const LARGEST_GAIN: f64 = 8.0;

/// `model` with all weights 1 but that of urgency, so that the yields that a fit needs are computed.
pub(super) fn unit_weights(model: &Mcdm) -> Mcdm {
    model.clone().with_weights(|it| if it == IncentiveName::Urgency { 0.0 } else { 1.0 })
}

impl SideSeen {
    /// By a driver of `style`, and by `model`, whose weights are 1.
    pub(super) fn of(situation: &Situation, (style, model): (&Style, &Mcdm), place: Place) -> SideSeen {
        let Situation { me, here, there, .. } = situation;
        let chances = model.returning.chances(situation);
        let ahead = |ahead: Option<Ahead>| {
            ahead.map_or([LONGEST_GAP as f32, 0.0], |it| {
                [it.gap.min(LONGEST_GAP) as f32, (me.pace.speed - it.speed) as f32]
            })
        };
        let lag = there.behind.map_or([LONGEST_GAP as f32, 0.0], |it| {
            [it.gap.min(LONGEST_GAP) as f32, (it.driver.pace.speed - me.pace.speed) as f32]
        });
        SideSeen {
            place,
            courtesy: model.courtesy.earning(situation, chances) as f32,
            headway: there.flow.headway(model.comfort.reading) as f32,
            own: ahead(here.ahead),
            lead: ahead(there.ahead),
            lag,
            speed: me.pace.speed as f32,
            has_safe_gap: has_safe_gap(situation, style),
            demands: GapDemands::of(situation, style),
            by_desired: [ByDesired::default(); NODES],
        }
    }
}

/// Step of the simulation [s].
const STEP: f64 = 0.1;

/// The driver behind the new leader, and the new follower behind the driver, for a change without urgency.
fn pairings<'a>(situation: &Situation<'a>, style: &Style) -> [Option<Pairing<'a>>; 2] {
    /// Desire that counts for the accepted time gap, as in the simulation.
    const DESIRE: f64 = 0.3;
    let Situation { me, there, .. } = situation;
    let pace = Pace { headway_relaxation: style.manner.headway_relaxation(DESIRE), ..me.pace };
    let ahead = there.ahead.map(|leader| Pairing { follower: Driver { pace, ..*me }, leader });
    let behind = there.behind.map(|it| {
        let leader = Ahead { gap: it.gap, speed: me.pace.speed, acceleration: me.acceleration };
        Pairing { follower: it.driver, leader }
    });
    [ahead, behind]
}

/// Whether the gap test of `style` accepts the gaps to the new leader and to the new follower, for a change without
/// urgency.
fn has_safe_gap(situation: &Situation, style: &Style) -> bool {
    let [ahead, behind] = pairings(situation, style);
    let suits = |it: Option<Pairing>, safety: &Safety| it.is_none_or(|it| it.accepted(safety, STEP).is_ok());
    suits(ahead, &style.safety) && suits(behind, &style.safety.of_follower())
}

impl GapDemands {
    /// Of a driver of `style`.
    fn of(situation: &Situation, style: &Style) -> GapDemands {
        const NOTHING: Safety = Safety {
            min_gap: 0.0,
            min_lag_gap: 0.0,
            closing_growth: 0.0,
            min_time_to_collision: 0.0,
            max_deceleration: f64::INFINITY,
        };
        /// Vehicles that touch have this gap [m].
        const SHORTEST: f64 = 0.1;
        let mut demands =
            GapDemands { time_to_collision: f32::INFINITY, deceleration: f32::NEG_INFINITY, is_secure: true };
        for pair in pairings(situation, style).into_iter().flatten() {
            let (gap, leader) = (pair.leader.gap.max(SHORTEST), pair.leader.speed);
            let (follower, demanded) = (pair.follower.pace.speed, -pair.follower.demanded(pair.leader));
            let deceleration = deceleration_to_avoid(gap, follower, leader).max(demanded);
            let time = time_to_collision(gap, follower, leader) as f32;
            demands.time_to_collision = demands.time_to_collision.min(time);
            demands.deceleration = demands.deceleration.max(deceleration as f32);
            demands.is_secure &= pair.accepted(&NOTHING, STEP).is_ok();
        }
        demands
    }

    /// Whether a gap test with the limits of `safety` accepts this, whatever the critical gaps are.
    pub fn suit(&self, safety: &Safety) -> bool {
        f64::from(self.time_to_collision) >= safety.min_time_to_collision
            && f64::from(self.deceleration) <= safety.max_deceleration
            && self.is_secure
    }
}

impl ByDesired {
    /// By `model`, whose weights are 1; the route counts `route` times as much as speed.
    pub(super) fn of(situation: &Situation, model: &Mcdm, route: f64) -> ByDesired {
        let appraisal = model.appraise(situation);
        let earning = |it: IncentiveName| appraisal.row(it).earning;
        let mobil = Mobil { traffic: Traffic::Law, ..Mobil::default() };
        let by_mobil = mobil.appraise(situation);
        let [own, others] = [IncentiveName::Speed, IncentiveName::Courtesy].map(|it| by_mobil.row(it));
        let gain = own.earning + mobil.politeness * others.earning - by_mobil.theta;
        let lmrs = Lmrs::default().appraise(situation);
        ByDesired {
            speed: (earning(IncentiveName::Speed) + route * earning(IncentiveName::Route)) as f32,
            plain: PLAIN.map(|it| earning(it) as f32),
            mobil: gain.clamp(-LARGEST_GAIN, LARGEST_GAIN) as f32,
            lmrs: (lmrs.gain - lmrs.theta) as f32,
        }
    }
}

/// The covariates of gap acceptance (the form of Toledo 2003): logarithms of the gaps to the new leader and to the new
/// follower, over 10 m, and how fast they close, over 5 m/s.
pub fn gap_terms(seen: &SideSeen) -> [f64; GAP_TERMS] {
    /// Shorter gaps count as this long [m].
    const SHORTEST: f64 = 0.5;
    let length = |[gap, _]: [f32; 2]| libm::log(f64::from(gap).max(SHORTEST) / 10.0);
    let closing = |[_, closing]: [f32; 2]| f64::from(closing).max(0.0) / 5.0;
    [length(seen.lead), length(seen.lag), closing(seen.lead), closing(seen.lag)]
}
