//! Traffic as one driver sees it. The only bridge from traffic to models, for simulated and for recorded drivers.

use laneweave_models::change::{Behind, Driver, LaneView, Merging, RouteView, SIGHT, Situation};
use laneweave_models::follow::{Ahead, Pace};
use laneweave_network::{Beside, ChainIndex, Side};

use crate::navigate::Waypoint;
use crate::scene::{LaneSight, Scene, Spot, Viewpoint};
use crate::traffic::{Car, Phase};

/// What a concentrated driver knows when it considers the lane on `side`; `None` where it may not change to one.
pub fn perceive<'a>(scene: &Scene<'a>, me: Spot, side: Side) -> Option<Situation<'a>> {
    let outlook = Outlook::new(scene, me, SIGHT);
    let beside = outlook.beside(side)?;
    let hint = scene.lanes[beside.chain.at()].ahead_of(beside.across(outlook.from.x));
    Some(outlook.situation(side, beside, &mut { hint }))
}

/// A driver with its vehicle.
#[inline]
pub fn driver<'a>(scene: &Scene<'a>, spot: Spot) -> Driver<'a> {
    let (motion, car) = (scene.motion(spot), scene.car(spot));
    Driver {
        pace: Pace {
            speed: motion.speed,
            desired: f64::from(car.desired),
            tightness: f64::from(motion.tightness),
        },
        follow: &scene.characters[car.character as usize].follow,
        length: f64::from(motion.length),
    }
}

/// A driver's view of its own lane, from which it considers both sides.
pub(crate) struct Outlook<'s, 'a> {
    scene: &'s Scene<'a>,
    car: &'a Car,
    me: Driver<'a>,
    from: Viewpoint,
    /// How far ahead it sees [m].
    reach: f64,
    sight: LaneSight,
    here: LaneView<'a>,
}

impl<'s, 'a> Outlook<'s, 'a> {
    /// Looks along the own lane of a driver who sees `reach` [m] ahead.
    pub(crate) fn new(scene: &'s Scene<'a>, spot: Spot, reach: f64) -> Outlook<'s, 'a> {
        let me = driver(scene, spot);
        let from = scene.viewpoint(spot);
        let sight = scene.look(from, me.pace.desired, me.length, reach);
        let here = lane_view(scene, &me, from, &sight);
        Outlook { scene, car: scene.car(spot), me, from, reach, sight, here }
    }

    /// The driver's own vehicle.
    pub(crate) fn car(&self) -> &'a Car {
        self.car
    }

    /// The own lane.
    pub(crate) fn here(&self) -> &LaneView<'a> {
        &self.here
    }

    /// The stretch beside on `side`.
    pub(crate) fn beside(&self, side: Side) -> Option<&'a Beside> {
        self.scene.network.chain(self.from.chain).beside(side, self.from.x)
    }

    /// What the driver knows about the lane on `side`, along the stretch `beside`. The first entry ahead there is
    /// sought from `hint` on, and kept in it.
    pub(crate) fn situation(&self, side: Side, beside: &Beside, hint: &mut usize) -> Situation<'a> {
        let x = beside.across(self.from.x);
        *hint = self.scene.lanes[beside.chain.at()].ahead_of_near(x, *hint);
        let from = Viewpoint { chain: beside.chain, x, ahead: *hint, ..self.from };
        let sight = self.scene.look(from, self.me.pace.desired, self.me.length, self.reach);
        let mut there = lane_view(self.scene, &self.me, from, &sight);
        let mut here = self.here;
        let section = here.route.remaining.min(there.route.remaining).min(self.reach);
        let on_section = section / self.scene.network.chain(self.from.chain).limit(self.from.x);
        here.route.onward = (here.route.onward - on_section).max(0.0);
        there.route.onward = if there.route.changes == Waypoint::NO_WAY {
            here.route.onward
        } else {
            (there.route.onward - on_section).max(0.0)
        };
        Situation { me: self.me, here, there, section, merging: self.merging(side, from, &sight) }
    }

    /// A neighbour on the other side than the driver would leave to cannot be seen from here; one on this side that
    /// signals into the driver's lane can.
    fn merging(&self, side: Side, from: Viewpoint, sight: &LaneSight) -> Option<Merging<'a>> {
        let wants_in = |spot: Spot| {
            let lane = &self.scene.lanes[spot.chain.at()];
            lane.cars()[spot.index].phase == Phase::Wants && lane.minds()[spot.index].side == side.opposite()
        };
        let behind = sight.follower.map(|it| it.spot).filter(|it| wants_in(*it));
        let spot = behind.or(sight.leader.filter(|it| wants_in(*it)))?;
        // Where it would be on the driver's own lane, seen from the driver.
        let forward =
            if spot.chain == from.chain { self.scene.motion(spot).x - from.x } else { return None };
        let driver = driver(self.scene, spot);
        let in_own_lane = self.scene.ahead(self.scene.viewpoint(spot));
        let me_ahead = Ahead { gap: -forward - self.me.length, speed: self.me.pace.speed };
        let my_leader =
            self.sight.ahead.map(|it| Ahead { gap: (it.gap - forward).max(0.1), speed: it.speed });
        let blocked = if behind.is_some() && me_ahead.gap > 0.0 { Some(me_ahead) } else { in_own_lane };
        let mind = &self.scene.lanes[spot.chain.at()].minds()[spot.index];
        Some(Merging { driver, blocked, freed: my_leader, urgency: f64::from(mind.urgency) })
    }
}

fn lane_view<'a>(scene: &Scene<'a>, me: &Driver, from: Viewpoint, sight: &LaneSight) -> LaneView<'a> {
    let behind =
        sight.follower.map(|it| Behind { gap: it.distance - me.length, driver: driver(scene, it.spot) });
    LaneView {
        ahead: sight.ahead,
        behind,
        flow: sight.flow,
        prospect: sight.prospect,
        route: route_view(scene, from.chain, from),
    }
}

/// What a lane means for the driver's route; `onward` counts from the driver's place on.
fn route_view(scene: &Scene, chain: ChainIndex, from: Viewpoint) -> RouteView {
    let waypoint = scene.navigator.waypoint(from.destination, chain);
    let onward = (waypoint.time - from.x / scene.network.chain(chain).limit(from.x)).max(0.0);
    if !waypoint.leads_on(from.x) {
        return RouteView { changes: Waypoint::NO_WAY, remaining: 0.0, onward: 0.0, alternative: None };
    }
    RouteView {
        changes: waypoint.changes,
        remaining: waypoint.last_place - from.x,
        onward,
        alternative: None,
    }
}
