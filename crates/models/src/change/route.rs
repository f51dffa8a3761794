//! Route incentive: a lane that leads elsewhere costs the time of the detour, and the chance of missing the turn
//! counts.
//!
//! E_i[T] = P_{n_i} T(S, V_i) + (1 − P_{n_i}) T_alt(i),  T(S, V) = S/max(V, 1 m/s) + time downstream
//!
//! * literal: Y = (E_here − E_there)/E_here: divided by the whole remaining trip; 0 between symmetric lanes.
//! * repaired: Y = (E_here − E_there)/T_ref, T_ref = 60 s, within ±10: a lost minute counts the same wherever it is
//!   lost. A driver who finds the other route faster does not come back: E_there = P_n min(T, T_alt) + (1 − P_n)
//!   T_alt. The minimum applies where T_alt is less by more than the driver's indifference band. Between symmetric
//!   lanes the speeds count, and whether a better route forks off from either (ours): E = min(T, T_alt) in both.
//! * separate: as repaired, but between symmetric lanes the speeds do not count (ours): there they are a second term of
//!   [`super::Speed`]. Only the times beyond the section remain: where the lanes' routes or their alternatives differ.
//!
//! The speeds of the lanes count over the section, at most as far as a driver sees (ours).
//!
//! In these two readings a driver leaves a route in the same way as a lane (ours): Y = (T − T_alt − band)/T_ref,
//! alone and weighed with μ₂, is compared with the threshold of the driver's rule.

use serde::{Deserialize, Serialize};

use super::situation::{LaneView, RouteView, Situation};
use super::{Chances, GainBound, Incentive, Outcomes};
use crate::Reading;
use crate::follow::CarFollowing;

/// Which of three readings of the route incentive a style uses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RouteReading {
    /// As printed.
    Literal,
    /// Against a fixed reference time.
    #[default]
    Repaired,
    /// As repaired, but without speeds between lanes that lead to the same place. Ours.
    Separate,
}

impl From<Reading> for RouteReading {
    fn from(reading: Reading) -> RouteReading {
        match reading {
            Reading::Literal => RouteReading::Literal,
            Reading::Repaired => RouteReading::Repaired,
        }
    }
}

/// Route incentive.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Route {
    /// μ₂.
    pub weight: f64,
    /// Which reading.
    pub reading: RouteReading,
    /// Added to the travel time where there is no alternative route [s].
    pub penalty: f64,
    /// T_ref of the repaired reading [s].
    pub reference: f64,
}

impl Default for Route {
    fn default() -> Route {
        Route { weight: 0.0, reading: RouteReading::Repaired, penalty: 600.0, reference: 60.0 }
    }
}

/// Largest yield, either way, of the repaired reading.
const LARGEST_YIELD: f64 = 10.0;
/// Floor of the time by which a literal gain is divided [s].
const LITERAL_FLOOR: f64 = 1.0;
/// Slowest speed of a lane in a travel time [m/s].
const SLOWEST: f64 = 1.0;

/// T(S, V) [s] over `distance` [m] at `speed` [m/s].
pub(crate) fn travel_time(distance: f64, speed: f64) -> f64 {
    distance / speed.max(SLOWEST)
}

/// E[T] [s]: `on_route` with `chance`, else `alternative`.
pub fn expected_time(chance: f64, on_route: f64, alternative: f64) -> f64 {
    chance * on_route + (1.0 - chance) * alternative
}

impl Route {
    /// Times [s] on the route and on the alternative in a lane, driven at `speed` [m/s] over `section` [m].
    #[inline]
    fn times(&self, route: &RouteView, section: f64, speed: f64) -> (f64, f64) {
        let on_section = travel_time(section, speed);
        let on_route = on_section + route.onward;
        let alternative = route.alternative.map_or(on_route + self.penalty, |time| on_section + time);
        (on_route, alternative)
    }

    /// Length [m] of `section` over which the speeds of lanes that lead to the same place count.
    #[inline]
    fn between_over(&self, section: f64) -> f64 {
        if self.reading == RouteReading::Separate { 0.0 } else { section }
    }

    /// Y of the repaired and the separate reading between lanes that lead to the same place, with the anticipated
    /// speeds `anticipated_speeds` [m/s].
    #[inline]
    pub(crate) fn between(
        &self,
        routes: &[RouteView; 2],
        anticipated_speeds: [f64; 2],
        section: f64,
        band: f64,
    ) -> f64 {
        let section = self.between_over(section);
        let [here, there] = [0, 1].map(|lane| {
            let (on_route, alternative) = self.times(&routes[lane], section, anticipated_speeds[lane]);
            better(on_route, alternative, band)
        });
        ((here - there) / self.reference).clamp(-LARGEST_YIELD, LARGEST_YIELD)
    }

    /// Y of leaving a route of `on_route` [s] for one of `alternative` [s] with the indifference `band` [s]; `None`
    /// where it is not worthwhile, or where the reading has no such term.
    pub fn leaving(&self, on_route: f64, alternative: f64, band: f64) -> Option<f64> {
        let gain = on_route - alternative - band;
        (self.reading != RouteReading::Literal && gain > 0.0)
            .then(|| (gain / self.reference).min(LARGEST_YIELD))
    }
}

/// The time that counts for a driver who leaves `on_route` for an `alternative` that is better by more than `band` [s].
fn better(on_route: f64, alternative: f64, band: f64) -> f64 {
    if alternative + band < on_route { alternative } else { on_route }
}

impl Incentive for Route {
    fn outcomes(&self, situation: &Situation, chances: Chances) -> Outcomes {
        let Situation { me, here, there, section, band, .. } = situation;
        let is_symmetric = situation.is_symmetric();
        let speed = |lane: &LaneView| match self.reading {
            RouteReading::Literal => me.follow.anticipated_speed(me.pace, lane.ahead),
            RouteReading::Repaired | RouteReading::Separate => lane.anticipated_speed,
        };
        let section = if is_symmetric { self.between_over(*section) } else { *section };
        let (route_here, alternative_here) = self.times(&here.route, section, speed(here));
        let (route_there, alternative_there) = self.times(&there.route, section, speed(there));
        let keep = -expected_time(chances.here, route_here, alternative_here);
        match self.reading {
            RouteReading::Literal if is_symmetric => Outcomes { keep, back: keep, away: keep },
            RouteReading::Literal => Outcomes { keep, back: -route_there, away: -alternative_there },
            RouteReading::Repaired | RouteReading::Separate if is_symmetric => {
                let there = -better(route_there, alternative_there, *band);
                Outcomes { keep: -better(route_here, alternative_here, *band), back: there, away: there }
            }
            RouteReading::Repaired | RouteReading::Separate => {
                let back = -better(route_there, alternative_there, *band);
                Outcomes { keep, back, away: -alternative_there }
            }
        }
    }

    fn scale(&self, _situation: &Situation, outcomes: &Outcomes) -> f64 {
        match self.reading {
            RouteReading::Literal => outcomes.keep.abs().max(LITERAL_FLOOR),
            RouteReading::Repaired | RouteReading::Separate => self.reference,
        }
    }

    fn earning(&self, situation: &Situation, chances: Chances) -> f64 {
        let outcomes = self.outcomes(situation, chances);
        let gain = expected_time(chances.there, outcomes.back, outcomes.away) - outcomes.keep;
        let earning = gain / self.scale(situation, &outcomes);
        match self.reading {
            RouteReading::Literal => earning,
            RouteReading::Repaired | RouteReading::Separate => earning.clamp(-LARGEST_YIELD, LARGEST_YIELD),
        }
    }

    /// A longer look finds no higher speed there.
    #[inline]
    fn most(&self, bound: &GainBound) -> Option<f64> {
        let GainBound { routes, anticipated_speeds, section, band, .. } = bound;
        (self.reading != RouteReading::Literal && self.weight > 0.0)
            .then(|| self.between(routes, *anticipated_speeds, *section, *band))
    }
}
