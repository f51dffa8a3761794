//! Perception: traffic as one driver sees it. This is the only bridge from traffic to models, for simulated and for
//! recorded drivers.

mod gain_bound;

use std::borrow::Cow;

use laneweave_models::change::{
    Behind, Driver, LaneRule, LaneView, Merging, RouteView, SIGHT, Situation, Toward,
};
use laneweave_models::follow::{Ahead, Pace};
use laneweave_network::{Beside, LaneUse, Side};

use crate::driver::beliefs::Beliefs;
use crate::driver::window;
use crate::route::waypoint::Waypoint;
use crate::state::lane::{DriverState, Phase};
use crate::state::vehicle::desired_speed;
use crate::view::scene::{Scene, Spot, Viewpoint, nearer};
use crate::view::sight::LaneSight;

pub(crate) use gain_bound::Dismissed;

/// A vehicle at the end of its lane counts as having this much road left [m].
const LEAST_ROOM: f64 = 0.1;

/// What a concentrated driver knows when it considers the lane on `side`; `None` where it may not change to that
/// side.
pub fn perceive<'a>(scene: &Scene<'a>, me: Spot, side: Side) -> Option<Situation<'a>> {
    let Viewpoint { chain, x, destination, .. } = scene.viewpoint(me);
    let here = scene.network.chain(chain);
    let ahead = |it: &Beside| scene.lanes[it.chain.at()].ahead_of(it.across(x));
    let mut hints = Side::BOTH.map(|side| here.beside(side, x).map_or(0, ahead));
    let waypoint = scene.navigator.waypoint_from(scene.network, destination, chain, x);
    let style = scene.style(me);
    let beliefs = Beliefs::settled(&style.guidance);
    let perception = Perception::new(scene, me, &waypoint, SIGHT, beliefs, &mut hints);
    Some(perception.situation(side, perception.beside(side)?))
}

/// A driver with its vehicle.
#[inline]
pub fn driver_of<'a>(scene: &Scene<'a>, spot: Spot) -> Driver<'a> {
    let (motion, driver) = (scene.motion(spot), scene.driver(spot));
    let style = scene.style_of(driver);
    Driver {
        pace: Pace {
            speed: motion.speed,
            desired: f64::from(driver.desired),
            headway_relaxation: f64::from(motion.headway_relaxation),
        },
        acceleration: f64::from(motion.acceleration),
        follow: &style.follow,
        comfortable: style.manner.comfortable_deceleration,
        length: f64::from(motion.length),
    }
}

/// A driver's perception of its own lane and of both sides.
pub(crate) struct Perception<'s, 'a> {
    scene: &'s Scene<'a>,
    driver: &'a DriverState,
    me: Driver<'a>,
    from: Viewpoint,
    /// How far ahead it sees [m].
    reach: f64,
    beliefs: Beliefs<'a>,
    lane_rule: LaneRule,
    sight: LaneSight,
    here: LaneView<'a>,
    /// It can no longer follow its usual route, and takes another one.
    takes_another_route: bool,
    /// Its positions in the lanes on the left and on the right, where it may change to them.
    beside: [Option<Viewpoint>; 2],
}

impl<'s, 'a> Perception<'s, 'a> {
    /// Looks along the own lane of a driver with this `waypoint` who sees `reach` [m] ahead. The first entries ahead
    /// on the left and on the right are searched from `hints` on, and written back to them.
    pub(crate) fn new(
        scene: &'s Scene<'a>,
        spot: Spot,
        waypoint: &Waypoint,
        reach: f64,
        beliefs: Beliefs<'a>,
        hints: &mut [usize; 2],
    ) -> Perception<'s, 'a> {
        let me = driver_of(scene, spot);
        let from = scene.viewpoint(spot);
        let sight = scene.look(from, me.pace.desired, me.length, reach);
        let here = lane_view(scene, &me, &sight, route_view(scene, from, waypoint, beliefs));
        let beside = Side::BOTH.map(|side| {
            let beside = window::beside(scene, spot, side)?;
            let there = scene.network.chain(beside.chain);
            // A long vehicle changes into a lane that is tight for it only if its route requires it.
            let is_tight = from.class.is_long() && there.is_tight_for_long && waypoint.changes == 0;
            if is_tight || !there.takes(beside.across(from.x), from.class) {
                return None;
            }
            if scene.is_closed(beside.chain, beside.across(from.x)) {
                return None;
            }
            let (x, hint) = (beside.across(from.x), &mut hints[side.at()]);
            *hint = scene.lanes[beside.chain.at()].ahead_of_near(x, *hint);
            Some(Viewpoint { chain: beside.chain, x, ahead: *hint, ..from })
        });
        let takes_another_route = !scene.navigator.waypoint(from.destination, from.chain).leads_on(from.x);
        Perception {
            scene,
            driver: scene.driver(spot),
            me,
            from,
            reach,
            beliefs,
            lane_rule: lane_rule(scene, spot),
            sight,
            here,
            takes_another_route,
            beside,
        }
    }

    /// The state of the driver.
    pub(crate) fn driver(&self) -> &'a DriverState {
        self.driver
    }

    /// Its beliefs about travel times.
    pub(crate) fn beliefs(&self) -> Beliefs<'a> {
        self.beliefs
    }

    /// The own lane.
    pub(crate) fn here(&self) -> &LaneView<'a> {
        &self.here
    }

    /// The driver's position in the lane on `side`; `None` where it may not change to that side.
    pub(crate) fn beside(&self, side: Side) -> Option<Viewpoint> {
        self.beside[side.at()]
    }

    /// What the driver knows about the lane on `side`, seen from its position there, `from`.
    pub(crate) fn situation(&self, side: Side, from: Viewpoint) -> Situation<'a> {
        let sight = self.scene.look(from, self.me.pace.desired, self.me.length, self.reach);
        let (section, [route_here, route_there]) = self.routes(from);
        let here = LaneView { route: route_here, ..self.here };
        let there = lane_view(self.scene, &self.me, &sight, route_there);
        let (me, band, merging) = (self.me, self.beliefs.band, self.merging(side, from, &sight));
        let (toward, lane_rule) = (self.toward(side), self.lane_rule);
        Situation { toward, me, here, there, section, band, lane_rule, merging }
    }

    /// Where the lane on `side` lies.
    fn toward(&self, side: Side) -> Toward {
        let offside = self.scene.network.driving_side.overtaking();
        if side == offside { Toward::Offside } else { Toward::Nearside }
    }

    /// The length of road on which the speeds of the own lane and of the lane at `from` are compared [m], and what
    /// the two lanes mean for the route beyond it.
    #[inline]
    fn routes(&self, from: Viewpoint) -> (f64, [RouteView; 2]) {
        let there = route_view(self.scene, from, &self.waypoint_beside(from), self.beliefs);
        let section = self.here.route.remaining.min(there.remaining).min(self.reach);
        let [on_section_here, on_section_there] = self.times_on(section, from);
        let here = self.beyond(on_section_here, self.here.route);
        let mut there = self.beyond(on_section_there, there);
        if there.changes == Waypoint::NO_WAY {
            there.onward = here.onward;
        }
        (section, [here, there])
    }

    /// Times [s] on the next `section` [m], as waypoints count them, in the own lane and in the lane at `there`.
    /// Where the times are those of the free road, both are the same.
    #[inline]
    fn times_on(&self, section: f64, there: Viewpoint) -> [f64; 2] {
        let Scene { network, navigator, .. } = self.scene;
        if navigator.links().are_free() {
            return [section / network.chain(self.from.chain).limit(self.from.x); 2];
        }
        [self.from, there].map(|it| navigator.time_ahead(network, it.destination, it.chain, it.x, section))
    }

    /// What a lane means for the route beyond a section that takes `on_section` [s].
    #[inline]
    fn beyond(&self, on_section: f64, route: RouteView) -> RouteView {
        let Beliefs { own, other, .. } = self.beliefs;
        RouteView {
            onward: (route.onward - own * on_section).max(0.0),
            alternative: route.alternative.map(|time| (time - other * on_section).max(0.0)),
            ..route
        }
    }

    /// The waypoint at a position beside. Only a driver who already takes another route may take one from there.
    fn waypoint_beside(&self, there: Viewpoint) -> Cow<'a, Waypoint> {
        let Scene { network, navigator, .. } = self.scene;
        let Viewpoint { destination, chain, x, .. } = there;
        if self.takes_another_route || !navigator.closures().is_empty() {
            navigator.unusual_waypoint(network, destination, chain, x, self.takes_another_route)
        } else {
            Cow::Borrowed(navigator.waypoint(destination, chain))
        }
    }

    /// The vehicles that signal a change into the lane that the driver would leave to `side`. `from` is the driver's
    /// position there, and `there` what it sees. On the other side this is the next vehicle behind, or else the next
    /// one ahead. On this side it is the new leader; the new follower counts as a follower only.
    fn merging(&self, side: Side, from: Viewpoint, there: &LaneSight) -> [Option<Merging<'a>>; 2] {
        let across = self.beside(side.opposite()).and_then(|Viewpoint { chain, x, ahead, .. }| {
            let drivers = self.scene.drivers(chain);
            let at = |index: usize| {
                let signals = drivers.get(index)?.phase == Phase::Wants;
                signals.then(|| self.merging_from(Spot { chain, index }, side.opposite(), x)).flatten()
            };
            ahead.checked_sub(1).and_then(at).or_else(|| at(ahead))
        });
        let signals = |it: &Spot| it.chain == from.chain && self.scene.driver(*it).phase == Phase::Wants;
        let leader = there.leader.filter(signals);
        [across, leader.and_then(|it| self.merging_from(it, side, from.x))]
    }

    /// The vehicle at `spot` on `side`, if it wants to change into the driver's lane, and no vehicle is between it
    /// and the driver there. The driver is at `x` [m] beside the vehicle's lane.
    #[inline(never)]
    fn merging_from(&self, spot: Spot, side: Side, x: f64) -> Option<Merging<'a>> {
        let lane_change = self.scene.lane_change(spot);
        if lane_change.side != side.opposite() {
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
        let Driver { pace, acceleration, length, .. } = self.me;
        let me_ahead = Ahead { gap: -forward - length, speed: pace.speed, acceleration };
        let blocked = if me_ahead.gap > 0.0 { Some(me_ahead) } else { self.held_in_its_lane(spot) };
        let freed = self.sight.ahead.map(|it| Ahead { gap: it.gap - forward, ..it });
        Some(Merging {
            driver: driver_of(self.scene, spot),
            blocked,
            freed,
            urgency: f64::from(lane_change.urgency),
        })
    }

    /// What the vehicle at `spot` has ahead while it cannot change: its leader, or the place where it has to have
    /// left its lane.
    fn held_in_its_lane(&self, spot: Spot) -> Option<Ahead> {
        let room = self.scene.lane_change(spot).last_place - self.scene.motion(spot).x;
        let end = room.is_finite().then(|| Ahead::standing(room.max(LEAST_ROOM)));
        nearer(self.scene.ahead(self.scene.viewpoint(spot)), end)
    }
}

fn lane_view<'a>(scene: &Scene<'a>, me: &Driver, sight: &LaneSight, route: RouteView) -> LaneView<'a> {
    let behind =
        sight.follower.map(|it| Behind { gap: it.distance - me.length, driver: driver_of(scene, it.spot) });
    LaneView {
        ahead: sight.ahead,
        behind,
        flow: sight.flow,
        anticipated_speed: sight.anticipated_speed,
        route,
    }
}

/// What a lane with this `waypoint` means for the driver's route. Times count from the driver's position.
#[inline(always)]
fn route_view(scene: &Scene, from: Viewpoint, waypoint: &Waypoint, beliefs: Beliefs) -> RouteView {
    if !waypoint.leads_on(from.x) {
        return RouteView { changes: Waypoint::NO_WAY, remaining: 0.0, onward: 0.0, alternative: None };
    }
    let behind = scene.navigator.time_to(scene.network, from.chain, from.x);
    let alternative = Some(waypoint.alternative).filter(|it| it.is_finite());
    let ways = [waypoint.disutility, waypoint.alternative_disutility];
    let [added, added_beside] = beliefs.added(scene.network, from.chain, from.x, ways);
    RouteView {
        changes: waypoint.changes,
        remaining: waypoint.last_place - from.x,
        onward: beliefs.own * (waypoint.time - behind).max(0.0) + added,
        alternative: alternative.map(|it| beliefs.other * (it - behind).max(0.0) + added_beside),
    }
}

/// What the law asks of a driver about lanes.
pub(crate) fn lane_rule(scene: &Scene, spot: Spot) -> LaneRule {
    let (network, driver) = (scene.network, scene.driver(spot));
    let (chain, x) = (network.chain(spot.chain), scene.motion(spot).x);
    match network.lane_use(chain, x, driver.class.is_long()) {
        LaneUse::Free => LaneRule::Free,
        LaneUse::SlowSide => LaneRule::NoPassingThere,
        LaneUse::SlowSideIfSlower => {
            let limit = chain.limit(x);
            let is_slower = desired_speed(driver.class, scene.style(spot), limit, &network.law) < limit;
            if is_slower { LaneRule::SlowSide } else { LaneRule::Free }
        }
    }
}
