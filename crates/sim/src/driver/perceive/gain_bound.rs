//! An upper bound of the gain in the lanes beside. For most drivers the next vehicles there show that neither lane
//! can be worth a change, so they look no further. Their decisions are the same to the last bit.

use laneweave_models::change::{Behind, GainBound, Mcdm, anticipated_speed};
use laneweave_models::follow::Ahead;
use laneweave_network::Side;

use super::{Perception, driver_of};
use crate::state::lane::Phase;
use crate::view::scene::{Found, REAR_SIGHT, Spot, Viewpoint};

/// What a driver has seen who looks no further.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Dismissed {
    /// Highest anticipated speed in a lane beside that leads to the same place [m/s]; `None` if there is no such
    /// lane.
    pub(crate) best_anticipated_speed: Option<f64>,
}

impl Perception<'_, '_> {
    /// Whether neither side can gain as much as `reach`. `None` if one can, or if the bound is not valid.
    #[inline]
    pub(crate) fn dismisses(&self, model: &Mcdm, reach: f64) -> Option<Dismissed> {
        if self.here.route.changes != 0
            || self.takes_another_route
            || Side::BOTH.into_iter().any(|it| self.signals(it))
        {
            return None;
        }
        let is_courteous = model.courtesy.weight != 0.0;
        let relief = if is_courteous { model.courtesy.relief(&self.me, &self.here) } else { 0.0 };
        let mut best_anticipated_speed = None;
        let (keeps, minds_offside) = (self.lane_rule.keeps(), model.minds_offside(self.lane_rule));
        for side in Side::BOTH {
            let Some(from) = self.beside[side.at()] else { continue };
            let (section, routes) = self.routes(from);
            if routes[1].changes != 0 {
                return None;
            }
            let (ahead, follower) = self.next_to(from)?;
            let desired = self.me.pace.desired;
            let anticipated_speed = ahead.map_or(desired, |it| anticipated_speed(it, desired));
            let harm = follower.filter(|_| is_courteous).map_or(0.0, |it| {
                let behind =
                    Behind { gap: it.distance - self.me.length, driver: driver_of(self.scene, it.spot) };
                model.courtesy.harm(&self.me, ahead, &behind)
            });
            let (toward, leaders) = (self.toward(side), [self.here.ahead, ahead]);
            let mut anticipated_speeds = [self.here.anticipated_speed, anticipated_speed];
            if minds_offside {
                let speed = self.me.pace.speed;
                anticipated_speeds = model.without_passing(toward, speed, leaders, anticipated_speeds);
            }
            let slow_side = if keeps { model.keeping.toward(toward, leaders, desired) } else { 0.0 };
            let bound = GainBound {
                desired,
                anticipated_speeds,
                routes,
                section,
                band: self.beliefs.band,
                courtesy: relief + harm,
                slow_side,
            };
            if model.gain_at_most(&bound) >= reach {
                return None;
            }
            best_anticipated_speed =
                Some(best_anticipated_speed.map_or(anticipated_speed, |it: f64| it.max(anticipated_speed)));
        }
        Some(Dismissed { best_anticipated_speed })
    }

    /// Whether one of the next vehicles on `side` signals a change, perhaps into the driver's lane.
    #[inline]
    fn signals(&self, side: Side) -> bool {
        self.beside[side.at()].is_some_and(|from| {
            let drivers = self.scene.drivers(from.chain);
            let signals = |index: usize| drivers.get(index).is_some_and(|it| it.phase == Phase::Wants);
            signals(from.ahead) || from.ahead.checked_sub(1).is_some_and(signals)
        })
    }

    /// The leader and the follower of the driver if it were at `from`; `None` if they are not both on that chain.
    #[inline]
    fn next_to(&self, from: Viewpoint) -> Option<(Option<Ahead>, Option<Found>)> {
        let motions = self.scene.motions(from.chain);
        let (index, leader) = (from.ahead.checked_sub(1)?, motions.get(from.ahead)?);
        let follower = &motions[index];
        if [leader.id, follower.id].contains(&from.id) {
            return None;
        }
        let ahead = leader.ahead(leader.rear() - from.x);
        let found = Found { spot: Spot { chain: from.chain, index }, distance: from.x - follower.x };
        let is_seen = |it: &Found| it.distance < REAR_SIGHT;
        Some((Some(ahead).filter(|it| it.gap <= self.reach), Some(found).filter(is_seen)))
    }
}
