//! Drivers choose accelerations: behind leaders, at lane ends, and in lane changes. Emergency braking overrides them.

use laneweave_models::braking::{HARD_BRAKING, HARDEST_BRAKING, secure_speed, stays_secure};
use laneweave_models::comfortable::{comfortably, is_calm};
use laneweave_models::follow::{Ahead, CarFollowing, FollowingModel};
use laneweave_network::ChainIndex;

use crate::driver::fall_in::{falling_in, staying_behind};
use crate::driver::lane_end::{ends_for_some, is_leaving, lane_end};
use crate::driver::last_place::{before_the_last_place, kept_room, within_window};
use crate::driver::me::pace;
use crate::driver::merge;
use crate::driver::misperception::misperception;
use crate::driver::steering;
use crate::driver::stopping::{stopping_way, to_stop_at};
use crate::record::events::BrakingCause;
use crate::right_of_way::approach as junction;
use crate::right_of_way::approach::{FirstIntoMerge, Junction};
use crate::route::closures::ClosureAhead;
use crate::state::clock::Clock;
use crate::state::lane::{DriverState, Kinematics, Phase};
use crate::state::random::Purpose;
use crate::state::standstill::{ROOM_AT_A_STOP, STANDSTILL};
use crate::view::scene::{Scene, Spot};

/// The acceleration that a driver chose.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chosen {
    /// Acceleration [m/s²].
    pub(crate) acceleration: f64,
    /// What it is for, if it brakes.
    pub(crate) cause: BrakingCause,
    /// Kinematics, not the model, decided the braking.
    pub(crate) by_kinematics: bool,
    /// The vehicle overlaps its leader.
    pub(crate) touches: bool,
    /// What the driver reacts to at a junction.
    pub(crate) junction: Junction,
    /// The share of its lane change that it has to do on each metre, since little road is left; 0 if there is enough.
    pub(crate) per_metre: f64,
}

/// Where a driver with a leader on its chain reacts only to it: beyond the fork, and before the next place to stop.
#[derive(Clone, Copy)]
pub(crate) struct OpenRoad {
    /// From here on it reacts only to its leader, wherever that is [m].
    from: f64,
    fork_clearance: f64,
    first_place: f64,
}

impl OpenRoad {
    /// The open road of `chain`. A lane that ends, or that is closed ahead, has none. Nor has any lane
    /// where some drivers have errors in what they see: they need a closer look.
    #[inline]
    pub(crate) fn on(scene: &Scene, chain: ChainIndex) -> OpenRoad {
        let [first_place, last_place] = scene.network.junctions.places(chain);
        let ends = ends_for_some(scene, chain)
            || scene.navigator.closures().are_near(chain)
            || scene.errors.is_some();
        let fork_clearance = if ends { f64::INFINITY } else { scene.network.chain(chain).fork_clearance };
        OpenRoad { from: last_place.max(fork_clearance), fork_clearance, first_place }
    }

    /// Whether the driver and its leader at `leader` [m] are both on it.
    #[inline]
    pub(crate) fn reaches(&self, motion: &Kinematics, leader: f64) -> bool {
        // A driver who may have to stop behind its leader, or where the leader has gone on, needs a closer look.
        let stays_before = || self.first_place - motion.x >= stopping_way(motion.speed);
        motion.x >= self.from
            || (motion.x >= self.fork_clearance && leader <= self.first_place && stays_before())
    }
}

/// The usual case: the driver reacts only to its leader on the same chain, and its gap is large enough to be secure.
/// `None` if not.
// This is the most frequent call on a motorway.
#[inline(always)]
pub(crate) fn behind(
    scene: &Scene,
    motion: &Kinematics,
    driver: &DriverState,
    leader: &Kinematics,
    dt: f64,
) -> Option<f64> {
    let gap = leader.rear() - motion.x;
    let wish = scene.style_of(driver).follow.acceleration(pace(motion, driver), Some(leader.ahead(gap)));
    if !is_calm(motion.speed, gap, leader.speed, wish) {
        return closing_in(scene, motion, driver, leader.ahead(gap), wish, dt);
    }
    let strength = driver.class.strength();
    let acceleration = if wish < strength { wish } else { strength };
    let next = motion.speed + acceleration * dt;
    let next = if next > 0.0 { next } else { 0.0 };
    let clear = Ahead::steady(gap - FollowingModel::LARGEST_CLEARANCE, leader.speed);
    (gap >= 0.0 && stays_secure(motion.speed, next, clear, dt)).then_some(acceleration)
}

/// The same for a driver whose model wants `wish` [m/s²], and to whom the bound of comfortable braking may apply.
#[cold]
fn closing_in(
    scene: &Scene,
    motion: &Kinematics,
    driver: &DriverState,
    ahead: Ahead,
    wish: f64,
    dt: f64,
) -> Option<f64> {
    let style = scene.style_of(driver);
    let wish =
        comfortably(&style.follow, style.manner.comfortable_deceleration, pace(motion, driver), ahead, wish);
    let acceleration = within(wish, -HARDEST_BRAKING, driver.class.strength());
    let next = (motion.speed + acceleration * dt).max(0.0);
    let clear = ahead.nearer(FollowingModel::LARGEST_CLEARANCE);
    let is_usual = ahead.gap >= 0.0 && acceleration >= -HARD_BRAKING;
    (is_usual && stays_secure(motion.speed, next, clear, dt)).then_some(acceleration)
}

/// The acceleration behind one leader [m/s²]: by the driver's model, within its comfortable braking.
#[inline]
fn behind_one(scene: &Scene, motion: &Kinematics, driver: &DriverState, leader: Ahead) -> f64 {
    let (style, pace) = (scene.style_of(driver), pace(motion, driver));
    let wish = style.follow.acceleration(pace, Some(leader));
    comfortably(&style.follow, style.manner.comfortable_deceleration, pace, leader, wish)
}

/// The lowest acceleration of several [m/s²], and what it is for.
#[derive(Clone, Copy)]
struct Wish {
    acceleration: f64,
    cause: BrakingCause,
}

impl Wish {
    /// This, or a lower `acceleration` for another `cause`.
    #[inline]
    fn or(self, acceleration: f64, cause: BrakingCause) -> Wish {
        if acceleration < self.acceleration { Wish { acceleration, cause } } else { self }
    }
}

/// Every case. A vehicle in a lane change follows both leaders: both entries take the lower acceleration.
pub(crate) fn with_care(scene: &Scene, clock: Clock, spot: Spot) -> Chosen {
    let chosen = beside_others(scene, spot, in_lane(scene, clock, spot));
    if !scene.driver(spot).phase.is_between_lanes() {
        return chosen;
    }
    let id = scene.motion(spot).id;
    let other = scene.lane_change(spot).counterpart.and_then(|it| {
        let index = scene.lanes[it.chain.at()].find(id, it.x)?;
        let there = Spot { chain: it.chain, index };
        Some(beside_others(scene, there, in_lane(scene, clock, there)))
    });
    let other = other.unwrap_or(chosen);
    let lower = if other.acceleration < chosen.acceleration { other } else { chosen };
    let per_metre = chosen.per_metre.max(other.per_metre);
    let acceleration = lower.acceleration.min(steering::slowly_enough(scene, clock, spot, per_metre));
    Chosen { acceleration, cause: lower.cause, per_metre, ..chosen }
}

/// The acceleration for one entry. Its leader may be on another chain, and kinematics may have to decide.
#[inline(never)]
fn in_lane(scene: &Scene, clock: Clock, spot: Spot) -> Chosen {
    let (motion, driver) = (scene.motion(spot), scene.driver(spot));
    let slows = driver.desired > driver.limit_desired && scene.style_of(driver).manner.looks_ahead();
    let true_leader = scene.ahead(scene.viewpoint(spot));
    let leader = match misperception(scene, spot, Purpose::MisperceptionAhead, clock.time()) {
        Some(errors) => true_leader.map(|it| errors.of_leader(it)),
        None => true_leader,
    };
    let on_a_free_road = || scene.style_of(driver).follow.acceleration(pace(motion, driver), None);
    let acceleration = match leader {
        Some(leader) if steering::creeps_up_to(motion, driver, leader) => {
            on_a_free_road().min(to_stop_at(motion.speed, leader.gap - steering::NEAR_A_VEHICLE, clock.dt))
        }
        Some(leader) => behind_one(scene, motion, driver, leader),
        None => on_a_free_road(),
    };
    let wish = Wish { acceleration, cause: BrakingCause::Leader };
    let wish = if slows { slowing(scene, clock, motion, driver, wish) } else { wish };
    let (wish, end) = reacting_to_more(scene, clock, spot, wish);
    let junction = junction::look(scene, spot);
    let (wish, stop) = at_junction(scene, motion, driver, &junction, wish, clock.dt);
    let Wish { acceleration: wish, cause } = wish;
    let wish = within(wish, -HARDEST_BRAKING, driver.class.strength());
    let clearance = clearance(scene, spot, leader);
    let clear = |it: Ahead| it.nearer(clearance);
    let behind_leader = bound(motion.speed, wish, leader.map(clear), clock.dt);
    let before_the_end = bound(motion.speed, behind_leader, end, clock.dt);
    let before_the_stop = bound(motion.speed, before_the_end, stop, clock.dt);
    let acceleration = match junction.leader {
        Some(it) => {
            let first = FirstIntoMerge { ahead: clear(it.ahead), ..it };
            merge::bound(motion.speed, before_the_stop, &first, clock.dt)
        }
        None => before_the_stop,
    };
    let per_metre = if driver.phase.is_between_lanes() {
        steering::per_metre(scene, spot, [true_leader, end, stop])
    } else {
        0.0
    };
    // A lower positive acceleration is no braking.
    let by_kinematics = acceleration < wish && acceleration < 0.0;
    Chosen {
        acceleration,
        cause: if by_kinematics { BrakingCause::Kinematics } else { cause },
        by_kinematics,
        touches: true_leader.is_some_and(|it| it.gap < 0.0),
        junction,
        per_metre,
    }
}

/// The distance that kinematics keeps behind a leader [m]: that of the driver's model, or more if one of the two is at
/// an angle, since it is in a lane change.
#[inline]
fn clearance(scene: &Scene, spot: Spot, leader: Option<Ahead>) -> f64 {
    const NEAR: f64 = 1.5;
    // Who stands comes no nearer.
    let is_near = leader.is_some_and(|it| it.gap < NEAR) && scene.motion(spot).speed >= STANDSTILL;
    let own = scene.style(spot).follow.clearance();
    if is_near && is_angled(scene, spot) { own.max(FollowingModel::LARGEST_CLEARANCE) } else { own }
}

/// Whether the vehicle at `spot` or its leader is between lanes.
#[inline(never)]
fn is_angled(scene: &Scene, spot: Spot) -> bool {
    let is_between_lanes = |spot| scene.driver(spot).phase.is_between_lanes();
    is_between_lanes(spot) || scene.leader_spot(scene.viewpoint(spot)).is_some_and(is_between_lanes)
}

/// The acceleration of a driver whose desired speed falls, because of the road ahead: it falls with it.
#[inline(never)]
fn slowing(scene: &Scene, clock: Clock, motion: &Kinematics, driver: &DriverState, wish: Wish) -> Wish {
    /// A driver slower than it desires by more than this may still accelerate [m/s], and one who is too fast brakes
    /// harder by at most this [m/s²]; ours.
    const SLOWER: f64 = 0.5;
    const HARDER: f64 = 1.0;
    let (pace, style) = (pace(motion, driver), scene.style_of(driver));
    if pace.speed < pace.desired - SLOWER {
        return wish;
    }
    let on_a_free_road = style.follow.acceleration(pace, None).max(-HARDER);
    wish.or(on_a_free_road - driver.slowing(&style.manner, clock), BrakingCause::DesiredSpeed)
}

/// What a driver brakes hard for, who has `chosen` that: its leader may have changed lanes, and a lower desired speed
/// counts on its own.
#[cold]
pub(crate) fn cause(scene: &Scene, spot: Spot, chosen: &Chosen) -> BrakingCause {
    if chosen.cause != BrakingCause::Leader {
        return chosen.cause;
    }
    let (motion, driver) = (scene.motion(spot), scene.driver(spot));
    if scene.style_of(driver).follow.acceleration(pace(motion, driver), None) < -HARD_BRAKING {
        return BrakingCause::DesiredSpeed;
    }
    let leader = scene.leader_spot(scene.viewpoint(spot)).map(|it| scene.driver(it));
    let is_between_lanes = |it: &DriverState| it.phase.is_between_lanes();
    let is_cut_in = is_between_lanes(driver) || leader.is_some_and(is_between_lanes);
    if is_cut_in { BrakingCause::CutIn } else { BrakingCause::Leader }
}

/// What the driver at `spot` has `chosen`, or the hardest braking: a vehicle that a user drives comes into the lane
/// beside it. However fast that one is, the driver lets it go first.
#[inline]
fn beside_others(scene: &Scene, spot: Spot, chosen: Chosen) -> Chosen {
    if !chosen.touches || !is_cut_off(scene, spot) {
        return chosen;
    }
    let (acceleration, cause) = (-HARDEST_BRAKING, BrakingCause::Kinematics);
    Chosen { acceleration, cause, by_kinematics: true, ..chosen }
}

/// Whether the vehicle beside the driver at `spot`, which is its leader, is one that a user drives.
#[cold]
fn is_cut_off(scene: &Scene, spot: Spot) -> bool {
    scene.leader_spot(scene.viewpoint(spot)).is_some_and(|it| scene.driver(it).is_external)
}

/// The acceleration of a driver at a junction, and the place where it has to stop there.
fn at_junction(
    scene: &Scene,
    motion: &Kinematics,
    driver: &DriverState,
    junction: &Junction,
    wish: Wish,
    dt: f64,
) -> (Wish, Option<Ahead>) {
    let wish = match junction.leader {
        Some(first) => {
            let following = behind_one(scene, motion, driver, first.ahead);
            wish.or(merge::follow(motion.speed, following, &first, dt), BrakingCause::Leader)
        }
        None => wish,
    };
    let Some(stop) = junction.stop else { return (wish, None) };
    let stopping = to_stop_at(motion.speed, stop - ROOM_AT_A_STOP, dt);
    (wish.or(stopping, BrakingCause::Stop), Some(Ahead::standing(stop)))
}

/// `clamp` for ordered bounds.
#[inline]
fn within(value: f64, low: f64, high: f64) -> f64 {
    let value = if value < high { value } else { high };
    if value > low { value } else { low }
}

/// The acceleration of a driver who reacts to more than its leader, and the end of its lane.
fn reacting_to_more(scene: &Scene, clock: Clock, spot: Spot, behind_leader: Wish) -> (Wish, Option<Ahead>) {
    let (motion, driver) = (scene.motion(spot), scene.driver(spot));
    let (mut wish, mut obstacle) = (behind_leader, None);
    if driver.phase == Phase::Wants || driver.needs_full_update {
        wish = beyond_the_leader(scene, clock, spot, wish);
    }
    let lane_end = lane_end(scene, spot.chain, driver.class);
    if let Some(lane_end) = lane_end.filter(|_| !is_leaving(scene, spot)) {
        let end = lane_end.of_entry(scene, spot);
        let kept = within_window(kept_room(scene, clock, spot, end - motion.x), end - lane_end.window);
        let stopping = to_stop_at(motion.speed, end - kept - motion.x, clock.dt);
        wish = wish.or(stopping, BrakingCause::LaneEnd);
        obstacle = Some(Ahead::standing(end - motion.x - steering::kept_to_begin(scene, spot)));
    }
    if scene.navigator.closures().is_empty() {
        return (wish, obstacle);
    }
    before_closure(scene, clock, spot, wish, obstacle)
}

/// The acceleration of a driver who may have to stop before a closed stretch, and the nearest end of its lane.
#[inline(never)]
fn before_closure(
    scene: &Scene,
    clock: Clock,
    spot: Spot,
    wish: Wish,
    end: Option<Ahead>,
) -> (Wish, Option<Ahead>) {
    let is_on_its_way = steering::leaves_its_lane(scene, spot);
    let place = |it: ClosureAhead| if is_on_its_way { it.way_out } else { it.ahead };
    let closed =
        scene.end_of_lane_ahead(scene.viewpoint(spot)).filter(|_| !is_leaving(scene, spot)).map(place);
    let Some(closed) = closed.filter(|closed| end.is_none_or(|it| *closed < it.gap)) else {
        return (wish, end);
    };
    let room = closed - kept_room(scene, clock, spot, closed);
    let stopping = to_stop_at(scene.motion(spot).speed, room, clock.dt);
    let wish = wish.or(stopping, BrakingCause::LaneEnd);
    (wish, Some(Ahead::standing(closed - steering::kept_to_begin(scene, spot))))
}

/// The acceleration for all that a driver reacts to besides its leader.
fn beyond_the_leader(scene: &Scene, clock: Clock, spot: Spot, wish: Wish) -> Wish {
    let (motion, driver, lane_change) = (scene.motion(spot), scene.driver(spot), scene.lane_change(spot));
    let pace = pace(motion, driver);
    let style = scene.style_of(driver);
    let mut wish = wish;
    if driver.phase == Phase::Wants {
        let falling_in = falling_in(scene, spot, pace).unwrap_or(f64::INFINITY);
        wish = wish.or(falling_in, BrakingCause::CutIn);
    }
    if let Some(acceleration) = staying_behind(scene, spot) {
        wish = wish.or(acceleration, BrakingCause::Leader);
    }
    let (gap, speed) = lane_change.lets_in;
    if gap < f32::INFINITY {
        let ahead = Ahead::steady(f64::from(gap).max(0.1), f64::from(speed));
        let giving_way = style.follow.acceleration(pace, Some(ahead));
        wish = wish.or(giving_way.max(-style.manner.yield_deceleration), BrakingCause::CutIn);
    }
    // A driver with a reservation for a junction does not wait for a gap there.
    let may_wait = matches!(driver.phase, Phase::Cruises | Phase::Wants) && scene.reservation(spot).is_none();
    if lane_change.last_place.is_finite() && may_wait {
        wish = wish.or(before_the_last_place(scene, clock, spot), BrakingCause::LaneEnd);
    }
    wish
}

/// The acceleration, limited by kinematics behind `obstacle`.
#[inline]
pub(super) fn bound(speed: f64, acceleration: f64, obstacle: Option<Ahead>, dt: f64) -> f64 {
    let next = speed + acceleration * dt;
    let next = if next > 0.0 { next } else { 0.0 };
    match obstacle {
        Some(obstacle) if !stays_secure(speed, next, obstacle, dt) => {
            let slowed = (secure_speed(speed, obstacle, dt) - speed) / dt;
            acceleration.min(slowed.max(-HARDEST_BRAKING))
        }
        _ => acceleration,
    }
}
