//! Gap acceptance on a minor road: how long one waits for a gap in a random stream with priority, and how many enter.
//!
//! The formulas know a critical gap and a follow-up time. Drivers here follow another rule, which has both. A driver
//! sets off if the next vehicle with priority is at least c = max(t_c, time to be out of its way + margin) away, and if
//! the one before will be out of the way when the driver comes there, or [`APPROACHES`] later. So a vehicle that
//! arrives at the time a blocks it from a − c to a + e, and the critical gap between two vehicles is c + e. The ways of
//! both give e; at this junction it is −3.9 s. The rule has no follow-up time, and two go into a gap at once: the
//! headways in which one, two, … of a queue enter are measured, and Harders' sum over them is taken as it is.
//!
//! Two things are not those of the catalogue. On one lane headways cannot be quite exponential: they are so beyond
//! [`SHORTEST`], as in the formulas of Tanner (1962) for the capacity and Troutbeck (1986) for the delay (from memory).
//! And drivers with priority brake for whoever is still in their way when they see the junction, 5 s before; so the
//! critical gap is one after which nobody is. With its 5 s drivers would disturb the stream, which no formula knows.
//!
//! The critical gap is exact to a step. The mean delay of 250 drivers is that of the formula within 5 %, which is less
//! than its sampling error; 95 % of them wait as the rule says, and the others miss a gap that is just long enough, or
//! take one that is just too short. The capacity is within 10 % of the sum, and below it: a queue that still moves up
//! when the next gap begins seems to miss a few.

use std::collections::VecDeque;

use laneweave_models::Style;
use laneweave_models::follow::{FollowingModel, Idm};
use laneweave_models::yielding::{MARGIN, Yielding, time_to_cover};
use laneweave_network::{ChainIndex, Network};
use laneweave_sim::{Class, Placement, Purpose, Random, STANDS_BEFORE_A_LINE, Vehicle, VehicleId, World};

use crate::junctions::giving_way::{reaches, way_across};
use crate::junctions::town::{Arm, assert_sound, empty, exit_to, lane_from};
use crate::roads::{drivers, network};

/// Length of a car [m].
const LENGTH: f64 = 4.5;
/// Flow of the stream with priority [1/s], and the shortest time between two of its vehicles [s].
const FLOW: f64 = 0.125;
const SHORTEST: f64 = 2.0;
/// The critical gap between two of them [s].
const CRITICAL_GAP: f64 = 10.0;
/// The stream drives at this share of the limit.
const PACE: f64 = 0.5;
/// A crossing may clear this long after a driver could reach it [s], as in `right_of_way/turns.rs`.
const APPROACHES: f64 = 1.5;
/// Most vehicles in the queue on the minor road, and the distance between them [m].
const QUEUE: usize = 12;
const QUEUE_GAP: f64 = 2.0;

/// A junction where the way from the south to the north gives way to the one from the east to the west.
struct Junction {
    world: World,
    /// The lanes to the junction, from the south and from the east.
    lanes: [ChainIndex; 2],
    /// Where the first driver of a queue stands on the minor road [m].
    line: f64,
    /// The conflict begins here on the way across [m].
    conflict: f64,
    /// Where the stream arrives, measured along its lane [m], and its speed [m/s].
    arrives_at: f64,
    speed: f64,
    /// When the vehicles of the stream arrive at the conflict [s].
    arrivals: VecDeque<f64>,
    /// c and e: so long before and after its arrival such a vehicle keeps drivers from setting off [s].
    blocks: [f64; 2],
}

impl Junction {
    fn new(network: &Network, arrivals: &[f64]) -> Junction {
        let ways = [Arm::South, Arm::East].map(|it| way_across(network, it));
        let [minor, major] = reaches(network, ways);
        let lanes = [Arm::South, Arm::East].map(|it| lane_from(network, it));
        let [length, arrives_at] = lanes.map(|it| network.chain(it).length);
        let speed = f64::from((PACE * network.chain(lanes[1]).limit(0.0)) as f32);
        let time_to = |x| time_to_cover(STANDS_BEFORE_A_LINE + x, 0.0, network.chain(lanes[0]).limit(0.0));
        let after = (major.end + LENGTH - major.start) / speed - time_to(minor.start) - APPROACHES;
        let before = CRITICAL_GAP - after;
        assert!(before > time_to(minor.end + LENGTH) + MARGIN, "it is out of the way before");
        let yielding = Yielding { critical_gap: before, patience: f64::INFINITY };
        // The stream keeps its speed, but for vehicles right ahead.
        let follow = Idm { time_gap: 0.1, jam_gap: 0.5, exponent: 40.0, ..Idm::default() };
        let follow = FollowingModel::Idm(follow);
        let styles = vec![
            Style { yielding, ..drivers::conservative() },
            Style { follow, speed_factor: PACE, ..drivers::conservative() },
        ];
        Junction {
            world: empty(network.clone(), styles),
            lanes,
            line: length - STANDS_BEFORE_A_LINE,
            conflict: minor.start,
            arrives_at: arrives_at + major.start,
            speed,
            arrivals: arrivals.to_vec().into(),
            blocks: [before, after],
        }
    }

    fn time(&self) -> f64 {
        self.world.clock().time()
    }

    /// Places a car that comes from `arm` at `x` on its lane.
    fn put(&mut self, arm: Arm, x: f64, speed: f64) -> VehicleId {
        let destination = Some(exit_to(self.world.network(), arm.turned(2)));
        let parameters = u32::from(arm == Arm::East);
        let chain = self.lanes[parameters as usize];
        let car = Placement { chain, x, speed, class: Class::Car, parameters, destination };
        self.world.place(car).expect("it fits on the road")
    }

    /// One step, before which the next vehicles of the stream come to its lane.
    fn step(&mut self) {
        while let Some(arrival) = self.arrivals.front() {
            let x = self.arrives_at - self.speed * (arrival - self.time());
            if x < LENGTH {
                break;
            }
            self.put(Arm::East, x, self.speed);
            self.arrivals.pop_front();
        }
        self.world.step();
    }

    fn of(&self, id: VehicleId) -> Option<Vehicle<'_>> {
        self.world.vehicles().find(|it| it.id() == id)
    }

    /// Whether a driver has set off from the line.
    fn has_set_off(&self, id: VehicleId) -> bool {
        self.of(id).is_none_or(|it| it.spot.chain != self.lanes[0] || it.x() > self.line + 0.1)
    }

    /// Whether it has come to the conflict.
    fn has_entered(&self, id: VehicleId) -> bool {
        self.of(id).is_none_or(|it| it.spot.chain != self.lanes[0] && it.x() > self.conflict)
    }

    /// The time until a driver sets off who comes to the line now [s]. It leaves the junction before this returns.
    fn first(&mut self) -> f64 {
        let (since, id) = (self.time(), self.put(Arm::South, self.line, 0.0));
        while !self.has_set_off(id) {
            self.step();
        }
        let set_off = self.time();
        while !self.has_entered(id) {
            self.step();
        }
        set_off - since
    }

    /// Places a queue behind the last of `queue`, as far as it is on the lane.
    fn queue_up(&mut self, queue: &mut VecDeque<VehicleId>) {
        while queue.len() < QUEUE {
            let last = queue.back().map(|it| self.of(*it).filter(|it| it.spot.chain == self.lanes[0]));
            let (x, speed) = match last {
                None => (self.line, 0.0),
                Some(None) => break,
                Some(Some(it)) => (it.x() - LENGTH - QUEUE_GAP, it.speed()),
            };
            if x < LENGTH {
                break;
            }
            queue.push_back(self.put(Arm::South, x, speed));
        }
    }
}

/// The first `count` arrivals of a random stream [s].
fn arrivals(seed: u64, count: u32) -> Vec<f64> {
    let random = Random::new(seed);
    let headway = |it| SHORTEST - libm::log(random.uniform(0, Purpose::Arrival, it)) / rate();
    let mut time = 20.0;
    let mut next = |it| {
        time += headway(it);
        time
    };
    (0..count).map(&mut next).collect()
}

/// The rate of the exponential part of headways [1/s].
fn rate() -> f64 {
    1.0 / (1.0 / FLOW - SHORTEST)
}

#[track_caller]
fn assert_within(value: f64, expected: f64, share: f64) {
    assert!((value / expected - 1.0).abs() <= share, "{value} is not {expected} within {share}");
}

/// The time that a driver has to wait by the rule who comes at the time `since` [s].
fn waits(since: f64, arrivals: &[f64], [before, after]: [f64; 2]) -> f64 {
    let blocked = arrivals.iter().map(|it| (it - before, it + after));
    blocked.fold(since, |goes, (from, until)| if from < goes && goes < until { until } else { goes }) - since
}

#[test]
fn v43_who_comes_to_a_road_with_priority_waits_as_long_as_adams_says() {
    const DRIVERS: u32 = 250;
    let network = network("priority.osm");
    let stream = arrivals(43, 10 * DRIVERS);
    let at_once = Junction::new(&network, &[]).first();
    let mut junction = Junction::new(&network, &stream);
    let (mut delay, mut others) = (0.0, 0);
    for _ in 0..DRIVERS {
        // The next one comes when the stream no longer knows of the last gap.
        (0..100).for_each(|_| junction.step());
        let expected = waits(junction.time(), &stream, junction.blocks);
        let waited = junction.first() - at_once;
        delay += waited;
        others += u32::from((waited - expected).abs() > 0.5);
    }
    assert_sound(&junction.world);
    assert!(junction.arrivals.len() > 10, "the stream went on");
    // Drivers look once a step: gaps that are just long enough, or too short, may be taken or missed.
    assert!(
        f64::from(others) < 0.05 * f64::from(DRIVERS),
        "{others} waited longer or shorter than by the rule"
    );
    // Adams: (e^(q t_c) − q t_c − 1)/q for Δ = 0.
    let (rate, beyond) = (rate(), CRITICAL_GAP - SHORTEST);
    let expected = f64::exp(rate * beyond) / FLOW - CRITICAL_GAP - 1.0 / rate
        + rate * SHORTEST * SHORTEST / (2.0 * (rate * SHORTEST + 1.0));
    assert_within(delay / f64::from(DRIVERS), expected, 0.05);
}

/// How many drivers of a queue enter between two vehicles of the stream with this `headway` [s].
fn enter_within(network: &Network, headway: f64) -> usize {
    const FIRST: f64 = 17.0;
    let mut junction = Junction::new(network, &[FIRST, FIRST + headway]);
    // The queue comes when the first vehicle of the stream already keeps it from setting off.
    while junction.time() < FIRST - CRITICAL_GAP {
        junction.step();
    }
    let mut queue = VecDeque::new();
    junction.queue_up(&mut queue);
    while junction.time() < FIRST + headway {
        junction.step();
    }
    queue.iter().filter(|it| junction.has_entered(**it)).count()
}

/// The shortest headways in which one, two, … drivers of a queue enter [s].
fn critical_headways(network: &Network) -> Vec<f64> {
    let shortest = |count: usize| {
        let (mut low, mut high) = (2.0, 60.0);
        while high - low > 0.05 {
            let middle = 0.5 * (low + high);
            if enter_within(network, middle) >= count { high = middle } else { low = middle }
        }
        0.5 * (low + high)
    };
    (1..QUEUE).map(shortest).collect()
}

#[test]
fn v43_a_minor_road_has_the_capacity_of_harders() {
    const GAPS: u32 = 800;
    let network = network("priority.osm");
    let critical = critical_headways(&network);
    let stream = arrivals(44, GAPS);
    let until = stream[stream.len() - 1];
    let mut junction = Junction::new(&network, &stream);
    let (mut queue, mut entered) = (VecDeque::new(), 0);
    while junction.time() < until {
        junction.queue_up(&mut queue);
        junction.step();
        while queue.front().is_some_and(|it| junction.has_entered(*it)) {
            queue.pop_front();
            entered += u32::from(junction.time() > stream[0]);
        }
    }
    assert_sound(&junction.world);
    let enter = |pair: &[f64]| critical.iter().filter(|it| **it <= pair[1] - pair[0]).count();
    let by_headway: usize = stream.windows(2).map(enter).sum();
    // Σ q e^(−λ(t − Δ)), which is q e^(−q t_c)/(1 − e^(−q t_f)) for Δ = 0 and headways that are t_f apart.
    let share = |it: &f64| f64::exp(-rate() * (it - SHORTEST));
    let expected = FLOW * critical.iter().map(share).sum::<f64>();
    assert!((critical[0] - CRITICAL_GAP).abs() < 0.15, "{critical:?}");
    // A queue that still moves up when the next gap begins seems to miss a few.
    let of_gaps = f64::from(entered) / by_headway as f64;
    assert!((0.92..=1.0).contains(&of_gaps), "{entered} of {by_headway}");
    assert_within(f64::from(entered) / (until - stream[0]), expected, 0.1);
}
