//! Traffic as one driver sees it. The only bridge from traffic to models, for simulated and for recorded drivers.

use laneweave_models::change::{Behind, Driver, LaneView, Merging, RouteView, SIGHT, Situation};
use laneweave_models::follow::{Ahead, Pace};
use laneweave_network::{Beside, Side};

use crate::navigate::Waypoint;
use crate::scene::{LaneSight, Scene, Spot, Viewpoint, nearer};
use crate::traffic::{Car, Phase};

/// Who stands at the end of its lane has this much road left to drive on [m].
const LEAST_ROOM: f64 = 0.1;

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
        let waypoint = scene.navigator.waypoint_from(scene.network, from.destination, from.chain, from.x);
        let here = lane_view(scene, &me, from, &sight, waypoint);
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
        let mut there = lane_view(self.scene, &self.me, from, &sight, self.waypoint_beside(from));
        let mut here = self.here;
        let section = here.route.remaining.min(there.route.remaining).min(self.reach);
        let on_section = section / self.scene.network.chain(self.from.chain).limit(self.from.x);
        here.route.onward = (here.route.onward - on_section).max(0.0);
        there.route.onward = if there.route.changes == Waypoint::NO_WAY {
            here.route.onward
        } else {
            (there.route.onward - on_section).max(0.0)
        };
        Situation { me: self.me, here, there, section, merging: self.merging(side, x, &sight) }
    }

    /// The way on from beside. Only a driver who goes round already would go round from there.
    fn waypoint_beside(&self, there: Viewpoint) -> Waypoint {
        let Scene { network, navigator, .. } = self.scene;
        let Viewpoint { destination, chain, x, .. } = there;
        if navigator.waypoint(destination, self.from.chain).leads_on(self.from.x) {
            *navigator.waypoint(destination, chain)
        } else {
            navigator.waypoint_from(network, destination, chain, x)
        }
    }

    /// Who signals a change into the lane that the driver would leave to `side`, where it would be at `x` [m] and see
    /// `there`: on the other side the next one behind, or else ahead; on this side the new leader. The new follower counts
    /// as such.
    fn merging(&self, side: Side, x: f64, there: &LaneSight) -> [Option<Merging<'a>>; 2] {
        let across = self.beside(side.opposite()).and_then(|beside| {
            let (chain, x) = (beside.chain, beside.across(self.from.x));
            let lane = &self.scene.lanes[chain.at()];
            let ahead = lane.ahead_of(x);
            let next = [ahead.checked_sub(1), (ahead < lane.cars().len()).then_some(ahead)];
            let mut spots = next.into_iter().flatten().map(|index| Spot { chain, index });
            spots.find_map(|it| self.signalling(it, side.opposite(), x))
        });
        let chain = self.beside(side).map(|it| it.chain);
        let leader = there.leader.filter(|it| Some(it.chain) == chain);
        [across, leader.and_then(|it| self.signalling(it, side, x))]
    }

    /// The vehicle at `spot` on `side`, beside whose lane the driver is at `x` [m], if it signals a change and nobody is
    /// between it and the driver in the driver's lane.
    fn signalling(&self, spot: Spot, side: Side, x: f64) -> Option<Merging<'a>> {
        let mind = self.scene.mind(spot);
        if self.scene.car(spot).phase != Phase::Wants || mind.side != side.opposite() {
            return None;
        }
        let forward = self.scene.motion(spot).x - x;
        let is_next = if forward > 0.0 {
            self.sight.ahead.is_none_or(|it| it.gap > forward)
        } else {
            self.sight.follower.is_none_or(|it| it.distance > -forward)
        };
        if !is_next {
            return None;
        }
        let me_ahead = Ahead { gap: -forward - self.me.length, speed: self.me.pace.speed };
        let blocked = if me_ahead.gap > 0.0 { Some(me_ahead) } else { self.held_in_its_lane(spot) };
        let freed = self.sight.ahead.map(|it| Ahead { gap: it.gap - forward, ..it });
        Some(Merging { driver: driver(self.scene, spot), blocked, freed, urgency: f64::from(mind.urgency) })
    }

    /// What the vehicle at `spot` has ahead as long as it cannot change: its leader, or where it has to have left its lane.
    fn held_in_its_lane(&self, spot: Spot) -> Option<Ahead> {
        let room = self.scene.mind(spot).last_place - self.scene.motion(spot).x;
        let end = room.is_finite().then(|| Ahead::standing(room.max(LEAST_ROOM)));
        nearer(self.scene.ahead(self.scene.viewpoint(spot)), end)
    }
}

fn lane_view<'a>(
    scene: &Scene<'a>,
    me: &Driver,
    from: Viewpoint,
    sight: &LaneSight,
    waypoint: Waypoint,
) -> LaneView<'a> {
    let behind =
        sight.follower.map(|it| Behind { gap: it.distance - me.length, driver: driver(scene, it.spot) });
    LaneView {
        ahead: sight.ahead,
        behind,
        flow: sight.flow,
        prospect: sight.prospect,
        route: route_view(scene, from, waypoint),
    }
}

/// What a lane means for the driver's route, whose waypoint there is `waypoint`; `onward` counts from the driver's place on.
fn route_view(scene: &Scene, from: Viewpoint, waypoint: Waypoint) -> RouteView {
    let onward = (waypoint.time - from.x / scene.network.chain(from.chain).limit(from.x)).max(0.0);
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
