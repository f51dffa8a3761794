//! The gap in the lane beside: whether a driver accepts it, and which driver could make it larger.

use laneweave_models::Misperception;
use laneweave_models::change::{Driver, GapPair, Refusal, Safety, deceleration_to_avoid, time_to_collision};
use laneweave_models::follow::{Ahead, Pace};
use laneweave_network::{ChainIndex, Side};

use crate::driver::lane_end::lane_end;
use crate::driver::misperception::misperception;
use crate::driver::perceive::driver_of;
use crate::driver::steering;
use crate::driver::stopping::stopping_way;
use crate::driver::window;
use crate::junction::storage_section::StorageSection;
use crate::right_of_way::applicant::Applicant;
use crate::right_of_way::may_pass::Asking;
use crate::right_of_way::survey::is_place_ahead;
use crate::state::clock::Clock;
use crate::state::lane::{LaneChangeKind, LaneChangeState, Phase};
use crate::state::random::Purpose;
use crate::state::standstill::STANDSTILL;
use crate::view::scene::{Found, Scene, Spot, Viewpoint};

/// Time in which a driver who brakes comfortably stays secure at its speed (ours) [s].
const TO_BRAKE: f64 = 0.5;
/// Desire that counts for the accepted time gap in a discretionary change (ours).
const VOLUNTARY_DESIRE: f64 = 0.3;
/// A driver who lets another in leaves this much beyond the critical lag gap of that one [m].
const ROOM_TO_YIELD: f64 = 1.0;

/// Why a driver who wants to change does not go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hindrance {
    /// A change to that side is not allowed here.
    NotAllowed,
    /// The change is not allowed for as long as it takes to cross the line.
    TooLittleRoad,
    /// The change would not be over before a place where drivers may have to stop, or it would take storage space
    /// that is kept for others.
    Junction,
    /// The driver has a reservation for a junction, and keeps its lane.
    InReservation,
    /// Another driver has waited longer for the space in that lane.
    RequestedBefore,
    /// The gap to the new leader is not accepted.
    Ahead(Refusal, GapPair),
    /// The gap to the new follower is not accepted.
    Behind(Refusal, GapPair),
}

/// A gap in the lane beside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gap {
    /// The chain of that lane.
    pub(crate) chain: ChainIndex,
    /// Position of the own front bumper on it [m].
    pub(crate) x: f64,
    /// The driver looks at it before the place where the change becomes allowed.
    pub(crate) is_coming: bool,
    /// Metres on that chain for a metre on the own one.
    pub(crate) scale: f64,
    /// Length of road on which the centre can still cross the line [m].
    pub(crate) room: f64,
    /// The new leader.
    pub(crate) ahead: Option<Ahead>,
    /// The new follower.
    pub(crate) follower: Option<Found>,
}

/// The gap in the lane on `side`; `None` where a change to that side is not allowed.
pub(crate) fn gap(scene: &Scene, spot: Spot, side: Side) -> Option<Gap> {
    let motion = scene.motion(spot);
    let beside = window::beside(scene, spot, side)?;
    let x = beside.across(motion.x);
    let from = scene.viewpoint_at(scene.viewpoint(spot), beside.chain, x);
    scene.takes(beside.chain, x, from.class).then(|| Gap {
        chain: beside.chain,
        x,
        is_coming: motion.x < beside.start,
        scale: beside.scale,
        room: permitted_ahead(scene, spot, side),
        ahead: scene.ahead(from),
        follower: scene.follower(from),
    })
}

/// How far ahead a change to `side` stays allowed [m]. No more road is counted than a change needs.
fn permitted_ahead(scene: &Scene, spot: Spot, side: Side) -> f64 {
    const ENOUGH: f64 = 300.0;
    const ROUNDING: f64 = 1e-6;
    let (motion, driver) = (scene.motion(spot), scene.driver(spot));
    let start = window::beside(scene, spot, side).map_or(motion.x, |it| it.start.max(motion.x));
    let (mut x, mut permitted) = (start, 0.0);
    for leg in scene.navigator.walk(scene.network, driver.goal.destination(), spot.chain, 0.0) {
        let chain = scene.network.chain(leg.chain);
        loop {
            let Some(stretch) = chain.beside(side, x) else { return permitted };
            permitted += stretch.end - x;
            if permitted > ENOUGH {
                return permitted;
            }
            if stretch.end >= chain.length - ROUNDING {
                break;
            }
            // Joined stretches of one chain follow each other without a break.
            let next = chain.beside(side, stretch.end + ROUNDING).filter(|it| it.start > stretch.start);
            let Some(next) = next else { return permitted };
            x = next.start;
        }
        x = 0.0;
    }
    permitted
}

/// Two vehicles that would follow each other after a change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pairing<'a> {
    /// The new follower.
    pub follower: Driver<'a>,
    /// The new leader of that follower.
    pub leader: Ahead,
}

impl<'a> Pairing<'a> {
    /// The pairing as its leader, with these errors, sees it.
    fn seen_by_leader(self, errors: Misperception) -> Pairing<'a> {
        let Pairing { follower, leader } = self;
        let (gap, speed) = errors.of_follower(leader.gap, follower.pace.speed);
        let follower = Driver { pace: Pace { speed, ..follower.pace }, ..follower };
        Pairing { follower, leader: Ahead { gap, ..leader } }
    }

    /// Checks whether `safety` accepts the pairing, with time step `dt` [s].
    ///
    /// # Errors
    /// The reason why it is not accepted.
    pub fn accepted(&self, safety: &Safety, dt: f64) -> Result<(), (Refusal, GapPair)> {
        let Pairing { follower, leader } = *self;
        let demanded = follower.demanded(leader);
        let pair = GapPair { gap: leader.gap, follower: follower.pace.speed, leader: leader.speed, demanded };
        let time = if follower.comfortable > 0.0 { dt.max(TO_BRAKE) } else { dt };
        safety.accept(pair, time).map_err(|why| (why, pair))
    }
}

/// Gap that the driver at `spot` is left by one who lets it in [m].
fn room_to_let_in(scene: &Scene, spot: Spot) -> f64 {
    scene.style(spot).safety.of_follower().min_gap + ROOM_TO_YIELD
}

/// How much of that the driver at `follower` leaves beyond its own gap at standstill [m].
pub(crate) fn room_to_yield(scene: &Scene, spot: Spot, follower: Spot) -> f64 {
    (room_to_let_in(scene, spot) - scene.style(follower).follow.jam_gap()).max(0.0)
}

impl Gap {
    /// Checks whether the road is long enough, and the gaps to the new leader and to the new follower are accepted.
    ///
    /// # Errors
    /// The reason why the gap is not accepted.
    pub(crate) fn accepted(&self, scene: &Scene, spot: Spot, clock: Clock) -> Result<(), Hindrance> {
        self.urgency_on_road(scene, spot, scene.motion(spot).speed)?;
        let safety = &scene.style(spot).safety;
        let [ahead, behind] = self.seen(scene, spot, clock.time());
        ahead
            .map_or(Ok(()), |it| it.accepted(safety, clock.dt))
            .map_err(|(why, pair)| Hindrance::Ahead(why, pair))?;
        behind
            .map_or(Ok(()), |it| it.accepted(&safety.of_follower(), clock.dt))
            .map_err(|(why, pair)| Hindrance::Behind(why, pair))?;
        if steering::has_road(scene, spot) { Ok(()) } else { Err(Hindrance::TooLittleRoad) }
    }

    /// The pairings as the driver at `spot` sees them at `time` [s]. Of a pair it sees the other vehicle with errors.
    pub(crate) fn seen<'a>(&self, scene: &Scene<'a>, spot: Spot, time: f64) -> [Option<Pairing<'a>>; 2] {
        let [ahead, behind] = self.pairings(scene, spot);
        if scene.errors.is_none() {
            return [ahead, behind];
        }
        let errors = |of| misperception(scene, spot, of, time);
        let ahead = match errors(Purpose::MisperceptionAhead) {
            Some(errors) => ahead.map(|it| Pairing { leader: errors.of_leader(it.leader), ..it }),
            None => ahead,
        };
        let behind = match errors(Purpose::MisperceptionBehind) {
            Some(errors) => behind.map(|it| it.seen_by_leader(errors)),
            None => behind,
        };
        [ahead, behind]
    }

    /// The urgency with which the driver at `spot` changes lanes at that `speed` [m/s]: its own, or, if the road is too
    /// short for that and the change is for its route, the full one (ours).
    ///
    /// # Errors
    /// The reason why the road is too short.
    pub(crate) fn urgency_on_road(&self, scene: &Scene, spot: Spot, speed: f64) -> Result<f32, Hindrance> {
        const FULL: f32 = 1.0;
        let &LaneChangeState { urgency, kind, .. } = scene.lane_change(spot);
        match self.has_road(scene, spot, speed, urgency) {
            Err(_) if kind == LaneChangeKind::Route => self.has_road(scene, spot, speed, FULL).map(|()| FULL),
            found => found.map(|()| urgency),
        }
    }

    /// Checks whether the road is long enough for a change with this `urgency` at that `speed` [m/s] of the driver at
    /// `spot`.
    fn has_road(&self, scene: &Scene, spot: Spot, speed: f64, urgency: f32) -> Result<(), Hindrance> {
        let style = scene.style(spot);
        let duration = style.manner.duration(f64::from(urgency));
        let crossing = 0.5 * duration * speed;
        let closure = scene.end_of_lane_ahead(scene.viewpoint(spot)).map_or(f64::INFINITY, |it| it.way_out);
        if self.room.min(closure) < crossing {
            return Err(Hindrance::TooLittleRoad);
        }
        // A driver does not change into a lane that ends if it could not stop before the end.
        let end = lane_end(scene, self.chain, scene.driver(spot).class).map(|it| it.open - self.x);
        let needed = || 2.0 * crossing + stopping_way(speed);
        if end.is_some_and(|it| it < needed()) {
            return Err(Hindrance::TooLittleRoad);
        }
        if !scene.navigator.closures().is_empty() {
            let there = scene.viewpoint_at(scene.viewpoint(spot), self.chain, self.x);
            if scene.closure_ahead(there).is_some_and(|it| it.ahead < needed()) {
                return Err(Hindrance::TooLittleRoad);
            }
        }
        if !self.is_clear_of_junctions(scene, spot, 2.0 * crossing) {
            return Err(Hindrance::Junction);
        }
        Ok(())
    }

    /// The highest speed of the driver at `spot` at which the road is long enough, to the last bit [m/s]. It is
    /// infinite if this is higher than any driver's speed, and 0 if the road is too short at every speed.
    pub(crate) fn fastest(&self, scene: &Scene, spot: Spot) -> f64 {
        const NOBODY: f64 = 128.0;
        let does = |speed: f64| self.urgency_on_road(scene, spot, speed).is_ok();
        let (mut does_for, mut too_fast) = (0.0, NOBODY);
        if does(too_fast) {
            return f64::INFINITY;
        }
        loop {
            let middle = 0.5 * (does_for + too_fast);
            if middle <= does_for || middle >= too_fast {
                return does_for;
            }
            if does(middle) { does_for = middle } else { too_fast = middle }
        }
    }

    /// The driver with its new leader, and its new follower with the driver.
    pub(crate) fn pairings<'a>(&self, scene: &Scene<'a>, spot: Spot) -> [Option<Pairing<'a>>; 2] {
        let me = driver_of(scene, spot);
        let ahead = self.ahead.map(|leader| {
            let follower = Driver { pace: self.pace(spot, scene), ..me };
            Pairing { follower, leader }
        });
        [ahead, self.follower.map(|it| self.behind(scene, spot, it))]
    }

    /// A `follower` with the driver.
    fn behind<'a>(&self, scene: &Scene<'a>, spot: Spot, follower: Found) -> Pairing<'a> {
        let me = driver_of(scene, spot);
        let gap = follower.distance - me.length;
        let leader = Ahead { gap, speed: me.pace.speed, acceleration: me.acceleration };
        Pairing { follower: driver_of(scene, follower.spot), leader }
    }

    /// Checks whether the driver at `spot`, who waits for this gap, takes it now.
    ///
    /// # Errors
    /// The reason why it does not.
    pub(crate) fn taken(&self, scene: &Scene, spot: Spot, clock: Clock) -> Result<(), Hindrance> {
        if scene.has_reservation(spot, f64::NEG_INFINITY) {
            return Err(Hindrance::InReservation);
        }
        if self.is_requested_before(scene, spot, clock) {
            return Err(Hindrance::RequestedBefore);
        }
        self.accepted(scene, spot, clock)?;
        if self.is_coming { Err(Hindrance::NotAllowed) } else { Ok(()) }
    }

    /// Whether a driver who waits before a junction for storage space on that stretch comes first.
    fn is_requested_before(&self, scene: &Scene, spot: Spot, clock: Clock) -> bool {
        let section = StorageSection::at(&scene.network.junctions, self.chain, self.x);
        let priority = Asking::of(&Applicant::at(scene, spot), scene.lane_change(spot).since, clock).priority;
        scene.reservations.requested_before(section, priority) > 0.0
    }

    /// The first follower that can open a gap by braking no harder than it does to let others in, for the driver at
    /// `spot` whom this `hindrance` keeps from the change. Those nearer drive past.
    pub(crate) fn who_can_let_in(
        &self,
        scene: &Scene,
        spot: Spot,
        hindrance: &Hindrance,
        clock: Clock,
    ) -> Option<Found> {
        /// This many followers see the signal.
        const SEE_IT: usize = 10;
        let motion = scene.motion(spot);
        let room = room_to_let_in(scene, spot);
        let safety = scene.style(spot).safety.of_follower();
        let is_missing_a_gap = matches!(hindrance, Hindrance::Ahead(..) | Hindrance::Behind(..));
        let lane = scene.network.chain(spot.chain);
        let comes_to_its_end = is_missing_a_gap && lane.ends_for.has(scene.driver(spot).class);
        let can = |it: &Found| {
            let (behind, driver) = (scene.motion(it.spot), scene.driver(it.spot));
            let gentle = scene.style_of(driver).manner.yield_deceleration;
            let gap = it.distance - f64::from(motion.length);
            // A vehicle beside a standing one, or right behind it, cannot open a gap for it; but one that has come as
            // near as it may holds its gap open for one whose lane ends.
            let is_near = gap < room && motion.speed <= STANDSTILL;
            let holds_open =
                || comes_to_its_end && self.behind(scene, spot, *it).accepted(&safety, clock.dt).is_ok();
            let is_beside = is_near && !holds_open();
            let left = (gap - room_to_yield(scene, spot, it.spot)).max(0.1);
            let needed = deceleration_to_avoid(left, behind.speed, motion.speed);
            // A driver with a reservation lets in nobody: no vehicle may come in front of it.
            let is_free = !scene.has_reservation(it.spot, gap);
            driver.phase == Phase::Cruises && is_free && gentle > 0.0 && !is_beside && needed <= gentle
        };
        std::iter::successors(self.follower, |it| scene.next_behind(*it, motion.id)).take(SEE_IT).find(can)
    }

    /// Whether the change, which takes `way` [m], is over before the next place where drivers may have to stop, the
    /// whole vehicle has room beyond the last one on the new lane, and no follower has a reservation already.
    fn is_clear_of_junctions(&self, scene: &Scene, spot: Spot, way: f64) -> bool {
        /// Least distance to such a place at which lanes are still changed, at walking speed [m].
        const LEAST: f64 = 15.0;
        let motion = scene.motion(spot);
        let here = scene.viewpoint(spot);
        let there = Viewpoint { chain: self.chain, x: self.x, ..here };
        let way = way.max(LEAST);
        let has_reservation =
            |it: &Found| scene.has_reservation(it.spot, it.distance - f64::from(motion.length));
        let rear = self.x - f64::from(motion.length);
        let is_in_fork = rear < scene.network.chain(self.chain).fork_clearance;
        // Around a roundabout one crossing follows the other: a truck would find no such place.
        let junctions = &scene.network.junctions;
        let is_long = scene.driver(spot).class.is_long();
        let is_crossed = || {
            !junctions.is_in_roundabout(self.chain)
                && junctions.is_crossed(self.chain, [rear, self.x], is_long)
        };
        !scene.takes_kept_space(self.chain, self.x, rear)
            && !is_in_fork
            && !is_crossed()
            && ![here, there].into_iter().any(|it| is_place_ahead(scene, it, way))
            && !self.follower.as_ref().is_some_and(has_reservation)
    }

    /// The driver's pace with the time gap that it accepts for this change.
    fn pace(&self, spot: Spot, scene: &Scene) -> Pace {
        let (motion, driver) = (scene.motion(spot), scene.driver(spot));
        let style = scene.style_of(driver);
        let desire = f64::from(scene.lane_change(spot).urgency).max(VOLUNTARY_DESIRE);
        let headway_relaxation =
            style.manner.headway_relaxation(desire).min(f64::from(motion.headway_relaxation));
        Pace { speed: motion.speed, desired: f64::from(driver.desired), headway_relaxation }
    }

    /// Share of the usual time gap that the driver accepts for this change.
    pub(crate) fn headway_relaxation(&self, scene: &Scene, spot: Spot) -> f64 {
        self.pace(spot, scene).headway_relaxation
    }

    /// Gaps [m] and times to collision [s] ahead and behind; infinite if there is no vehicle.
    pub(crate) fn measures(&self, scene: &Scene, spot: Spot) -> [f64; 4] {
        let motion = scene.motion(spot);
        let (gap_ahead, ttc_ahead) = self.ahead.map_or((f64::INFINITY, f64::INFINITY), |it| {
            (it.gap, time_to_collision(it.gap, motion.speed, it.speed))
        });
        let (gap_behind, ttc_behind) = self.follower.map_or((f64::INFINITY, f64::INFINITY), |it| {
            let gap = it.distance - f64::from(motion.length);
            (gap, time_to_collision(gap, scene.motion(it.spot).speed, motion.speed))
        });
        [gap_ahead, gap_behind, ttc_ahead, ttc_behind]
    }
}
