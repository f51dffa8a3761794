//! What is seen of every driver about once a second: how it moves, behind whom, and whether it only follows.

use laneweave_models::bends::speed_squared;
use laneweave_models::change::LaneRule;
use laneweave_models::follow::Ahead;
use laneweave_network::{ChainIndex, LaneUse, Side};
use laneweave_recorded::{Frame, Replay};
use laneweave_recordings::Matched;
use laneweave_sim::{Phase, Scene, Spot, VehicleId};
use rayon::prelude::*;

use crate::observe::{FREE, InView};

/// Drivers are looked at so often [s].
pub(super) const EVERY: f64 = 1.0;
/// The road is plain where nothing else than a leader is to be seen so far ahead [s]; ours.
const AHEAD: f64 = 8.0;
/// A bend counts for who drives faster than this share of the speed with which the style would drive through it (ours).
const UNHURRIED: f64 = 0.67;
/// Drivers in a lane that ends within this distance may look for a gap in the next one, and those there let them in
/// [m]; ours.
const BEFORE_A_LANE_END: f64 = 300.0;

/// What is seen of a driver at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Look {
    /// The number of the look, the same for all drivers.
    pub(super) number: i64,
    pub(super) chain: ChainIndex,
    /// Front bumper along the chain [m].
    pub(super) x: f64,
    pub(super) speed: f64,
    /// What limit and class allow [m/s].
    pub(super) allowed: f64,
    /// What its vehicle can accelerate [m/s²].
    pub(super) strength: f64,
    pub(super) leader: Option<(VehicleId, Ahead)>,
    /// Nothing but a leader is to be reacted to.
    pub(super) is_plain: bool,
}

/// What is seen of the drivers of all tracks, and the time between two looks [s].
pub(super) fn looks(matched: &Matched, replay: &Replay) -> (Vec<Vec<Look>>, f64) {
    let mut tracks = vec![Vec::new(); matched.recording.tracks.len()];
    let every = (EVERY / matched.recording.step).round().max(1.0) as i64;
    let period = every as f64 * matched.recording.step;
    let Some((first, _)) = matched.recording.frames() else { return (tracks, period) };
    let in_view = InView::of(matched);
    let watch = Watch { matched, in_view };
    let frames = matched.recording.frames_by(every);
    let of = |frame: &i64| watch.at(&replay.frame(*frame), (frame - first) / every);
    let seen: Vec<Vec<(VehicleId, Look)>> = frames.par_iter().map(of).collect();
    seen.into_iter().flatten().for_each(|(track, look)| tracks[track as usize].push(look));
    (tracks, period)
}

struct Watch<'a> {
    matched: &'a Matched<'a>,
    in_view: InView<'a>,
}

impl Watch<'_> {
    fn at(&self, frame: &Frame, number: i64) -> Vec<(VehicleId, Look)> {
        let scene = frame.scene();
        let spots = frame.vehicles().filter_map(|it| frame.spot(it));
        spots.map(|spot| (scene.motion(spot).id, self.look(&scene, spot, number))).collect()
    }

    fn look(&self, scene: &Scene, spot: Spot, number: i64) -> Look {
        let (motion, driver) = (scene.motion(spot), scene.driver(spot));
        let network = self.matched.network;
        let view = scene.viewpoint(spot);
        let leader = scene
            .ahead(view)
            .zip(scene.leader_spot(view))
            .map(|(ahead, leader)| (scene.motion(leader).id, ahead));
        // Who has nobody ahead may follow somebody whom the recording does not show.
        let sees = || self.in_view.shows(spot.chain, motion.x, FREE * motion.speed);
        let is_alone = driver.phase == Phase::Cruises && (leader.is_some() || sees());
        Look {
            number,
            chain: spot.chain,
            x: motion.x,
            speed: motion.speed,
            allowed: driver.class.allowed(network.chain(spot.chain).limit(motion.x), &network.law),
            strength: driver.class.strength(),
            leader,
            is_plain: is_alone && self.is_plain(scene, spot) && !self.stays_behind(scene, spot),
        }
    }

    /// Whether the road ahead has no bend that counts, no lower limit, no end of the lane, no fork, and no place where
    /// drivers may have to stop.
    fn is_plain(&self, scene: &Scene, spot: Spot) -> bool {
        let (motion, driver) = (scene.motion(spot), scene.driver(spot));
        let network = self.matched.network;
        let (chain, x) = (network.chain(spot.chain), motion.x);
        let reach = AHEAD * motion.speed;
        let left = chain.length - x;
        let largest = scene.driver_parameters[driver.parameters as usize].manner.lateral_acceleration;
        let fits = |curvature: f64| {
            motion.speed * motion.speed
                <= UNHURRIED * UNHURRIED * speed_squared(largest, driver.class.is_long(), curvature)
        };
        let counts = |it: &laneweave_network::Bend| it.end > x && it.start < x + reach && !fits(it.curvature);
        let bends = largest > 0.0 && chain.bends.iter().any(counts);
        let is_slower = chain.limit(x + reach) < chain.limit(x) || (reach > left + chain.slow_beyond);
        let beside =
            Side::BOTH.iter().filter_map(|it| chain.beside(*it, x)).map(|it| (it.chain, it.across(x)));
        let mut lanes = beside.chain([(spot.chain, x)]);
        x >= chain.fork_clearance
            && !bends
            && !is_slower
            && !lanes.any(|(lane, x)| self.ends_within(lane, x, BEFORE_A_LANE_END.max(reach)))
            && network.junctions.free_way(spot.chain, x, chain.length) > reach
    }

    /// Whether a lane ends beside one that goes on, within `reach` [m] from `x` [m] on.
    fn ends_within(&self, lane: ChainIndex, x: f64, reach: f64) -> bool {
        let network = self.matched.network;
        let chain = network.chain(lane);
        let left = chain.length - x;
        match chain.following[..] {
            _ if chain.is_lane_drop() => left < reach,
            [only] if network.chain(only).is_lane_drop() => left + network.chain(only).length < reach,
            _ => false,
        }
    }

    /// Whether the driver may have to stay behind its leader in the overtaking lane, since the law forbids to pass it
    /// on the slow side.
    fn stays_behind(&self, scene: &Scene, spot: Spot) -> bool {
        let network = self.matched.network;
        let (motion, driver) = (scene.motion(spot), scene.driver(spot));
        let chain = network.chain(spot.chain);
        if network.lane_use(chain, motion.x, driver.class.is_long()) != LaneUse::SlowSide {
            return false;
        }
        let change = &scene.driver_parameters[driver.parameters as usize].change;
        let Some(beside) = chain.beside(network.driving_side.overtaking(), motion.x) else { return false };
        let there = scene.viewpoint_at(scene.viewpoint(spot), beside.chain, beside.across(motion.x));
        change.minds_offside(LaneRule::NoPassingThere)
            && scene.ahead(there).is_some_and(|it| change.stays_behind(motion.speed, it))
    }
}
