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

#[cfg(test)]
mod tests {
    use laneweave_network::{DrivingSide, Lanelet, LaneletIndex, Network, Point, Polyline};
    use laneweave_recorded::Assumed;
    use laneweave_recordings::{Recording, RoadUser, State, Track};
    use laneweave_sim::Navigator;

    use super::super::tests::style;
    use super::*;

    /// A lanelet 3.5 m wide between two points of its centre line, with a limit [m/s].
    fn lanelet(id: i64, [from, to]: [[f64; 2]; 2], limit: f64) -> Lanelet {
        let line = |aside: f64| {
            Polyline::new([from, to].map(|[x, y]| Point::new(x, y + aside, 0.0))).expect("two points")
        };
        Lanelet::alone(id, [1.75, -1.75, 0.0].map(line), limit)
    }

    /// A road with 30 m/s on its first 200 m, and with 15 m/s then.
    fn road_that_gets_slower() -> Network {
        let mut lanelets = vec![
            lanelet(1, [[0.0, 0.0], [200.0, 0.0]], 30.0),
            lanelet(2, [[200.0, 0.0], [1000.0, 0.0]], 15.0),
        ];
        lanelets[0].following = vec![LaneletIndex(1)];
        Network::new(lanelets, DrivingSide::Right).expect("it is a road")
    }

    #[test]
    fn a_lower_limit_counts_as_soon_as_the_driver_comes_there_within_eight_seconds() {
        let network = road_that_gets_slower();
        // Its front is at 10 m, and a second later 10 m on.
        let state = |frame| State { frame, x: 7.75 + frame as f64, y: 0.0, speed: 10.0, heading: 0.0 };
        let states = (0..300).map(state).collect();
        let track = Track { id: 1, class: RoadUser::Car, length: 4.5, width: 1.8, states };
        let recording = Recording { step: 0.1, tracks: vec![track], ..Recording::default() };
        let matched = Matched::new(&network, &recording);
        let (navigator, styles) = (Navigator::new(&network), [style()]);
        let assume = |_| Assumed { parameters: 0, speed_factor: 1.0 };
        let replay = Replay::new(&matched, &[], &navigator, &styles, assume).expect("it is a driver");
        let watch = Watch { matched: &matched, in_view: InView::of(&matched) };
        let is_plain = |second: i64| {
            let frame = replay.frame(10 * second);
            watch.is_plain(&frame.scene(), frame.spot(1).expect("it is seen"))
        };
        // It looks 80 m ahead: from 110 m on it sees the place at 190 m, and from 130 m on that at 210 m.
        assert!(is_plain(0) && is_plain(10));
        assert!(!is_plain(12) && !is_plain(18));
        // Once it is there, the limit is no lower ahead.
        assert!(is_plain(20));
    }

    /// A lane of 400 m, the last 100 m of which two lanes share, beside a road that goes on; and its first chain.
    fn shared_lane_that_ends() -> (Network, ChainIndex) {
        let mut lanelets = vec![
            lanelet(1, [[0.0, 3.5], [300.0, 3.5]], 30.0),
            lanelet(2, [[300.0, 3.5], [400.0, 3.5]], 30.0),
            lanelet(3, [[400.0, 3.5], [900.0, 3.5]], 30.0),
            lanelet(4, [[0.0, 0.0], [300.0, 0.0]], 30.0),
            lanelet(5, [[0.0, -40.0], [300.0, 0.0]], 30.0),
            lanelet(6, [[300.0, 0.0], [400.0, 0.0]], 30.0),
        ];
        for (from, to) in [(0, 1), (1, 2), (3, 5), (4, 5)] {
            lanelets[from].following = vec![LaneletIndex(to)];
        }
        (lanelets[5].left, lanelets[1].right) = (Some(LaneletIndex(1)), Some(LaneletIndex(5)));
        let network = Network::new(lanelets, DrivingSide::Right).expect("it is a road");
        let first = network.start_of(LaneletIndex(3)).chain;
        (network, first)
    }

    #[test]
    fn a_lane_that_goes_on_only_into_one_that_ends_ends_with_it() {
        let (network, first) = shared_lane_that_ends();
        let recording = Recording { step: 0.1, ..Recording::default() };
        let matched = Matched::new(&network, &recording);
        let watch = Watch { matched: &matched, in_view: InView::of(&matched) };
        let last = network.chain(first).following[0];
        assert!(network.chain(last).is_lane_drop() && !network.chain(first).is_lane_drop());
        // 300 m are left from 100 m on, and 60 m from 40 m on in the chain that ends.
        assert!(watch.ends_within(first, 100.0, 301.0) && !watch.ends_within(first, 100.0, 299.0));
        assert!(watch.ends_within(last, 40.0, 61.0) && !watch.ends_within(last, 40.0, 59.0));
        // The road beside goes on.
        assert!(!watch.ends_within(network.start_of(LaneletIndex(0)).chain, 100.0, 1e6));
    }
}
