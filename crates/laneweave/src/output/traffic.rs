//! What happened on every lanelet between two instants: plain counts.
//!
//! Density, flow and speed by Edie's generalised definitions (as in `laneweave_study::edie`), with the time and the way of
//! every vehicle in every step; who passes from one lanelet to the next is shared between them as at constant speed.

use laneweave_network::{Chain, ChainIndex, LaneletIndex, Network, Side};
use laneweave_sim::{Car, Clock, Event, LaneChange, Motion, World};
use serde::{Deserialize, Serialize};

use crate::units::{METRES_PER_KM, SECONDS_PER_HOUR};

/// Who is slower stands [m/s].
const STANDS: f64 = 0.1;

/// What happened on all lanelets between two instants.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Traffic {
    /// From when to when [s].
    pub(super) during: [f64; 2],
    /// By lanelet.
    pub(super) counts: Vec<Counts>,
}

/// What happened on one lanelet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Counts {
    /// Σt: time that fronts of vehicles spent on it [s].
    time: f64,
    /// Σd: way that they drove on it [m].
    way: f64,
    /// Of the time, that at rest [s].
    pub(super) standing: f64,
    /// Vehicles whose fronts passed its end.
    pub(super) passed: u32,
    /// Trips that began and ended on it.
    pub(super) begun: u32,
    pub(super) ended: u32,
    /// Lane changes from and to it, each first those to the left and then those to the right.
    pub(super) away: [u32; 2],
    pub(super) onto: [u32; 2],
}

impl Traffic {
    pub(super) fn of(network: &Network, from: f64) -> Traffic {
        Traffic { during: [from; 2], counts: vec![Counts::default(); network.lanelets.len()] }
    }

    /// Adds what happened in the interval that follows.
    pub(super) fn add(&mut self, next: &Traffic) {
        self.during[1] = next.during[1];
        for (sum, it) in self.counts.iter_mut().zip(&next.counts) {
            sum.time += it.time;
            sum.way += it.way;
            sum.standing += it.standing;
            sum.passed += it.passed;
            sum.begun += it.begun;
            sum.ended += it.ended;
            for side in 0..2 {
                sum.away[side] += it.away[side];
                sum.onto[side] += it.onto[side];
            }
        }
    }

    /// Adds what all did in the last step.
    pub(super) fn observe(&mut self, world: &World, is_measured: impl Fn(&LaneChange) -> bool) {
        let (network, clock) = (world.network(), world.clock());
        self.during[1] = clock.time();
        let mut fresh = Vec::new();
        for event in world.events() {
            match event {
                Event::Entered(id) => {
                    if let Some(trip) = world.trip(*id) {
                        fresh.push(trip.from.0);
                        self.counts[network.chain(trip.from.0).lanelet(trip.from.1).0.at()].begun += 1;
                    }
                }
                Event::Left { chain, motion, .. } => self.leave(network, clock, *chain, motion),
                Event::LaneChange(change) if change.is_completed && is_measured(change) => {
                    self.change(network, change);
                }
                Event::LaneChange(_) => {}
            }
        }
        let scene = world.scene();
        for (index, chain) in network.chains.iter().enumerate() {
            let at = ChainIndex(index as u32);
            let (motions, cars) = (scene.motions(at), scene.cars(at));
            if fresh.contains(&at) {
                // Who has just entered has not driven yet.
                let all = motions.iter().zip(cars).zip(scene.minds(at));
                let drove = all.filter(|((_, car), mind)| !car.is_shadow && mind.entered < clock.step);
                drove.for_each(|((motion, _), mind)| {
                    self.drive(network, clock, at, mind.trail.known(), motion)
                });
            } else if !motions.is_empty() {
                self.drive_all(world, at, chain, (motions, cars));
            }
        }
    }

    /// Adds what all on a chain did in the last step: most stayed on one lanelet.
    fn drive_all(
        &mut self,
        world: &World,
        at: ChainIndex,
        chain: &Chain,
        (motions, cars): (&[Motion], &[Car]),
    ) {
        let (network, clock) = (world.network(), world.clock());
        let mut ahead = chain.starts[1..].iter().chain([&f64::INFINITY]);
        let mut lanelets = chain.lanelets.iter();
        let (mut start, mut end, mut lanelet) = (0.0, f64::NEG_INFINITY, 0);
        let (mut steps, mut standing, mut way) = (0, 0, 0.0);
        for (index, (motion, car)) in motions.iter().zip(cars).enumerate() {
            if car.is_shadow {
                continue;
            }
            if motion.x >= end {
                self.counts[lanelet].stay(clock, [steps, standing], way);
                (steps, standing, way) = (0, 0, 0.0);
                while motion.x >= end
                    && let (Some(here), Some(next)) = (lanelets.next(), ahead.next())
                {
                    (lanelet, start, end) = (here.at(), end.max(0.0), *next);
                }
            }
            let [from, to] = last_way(motion, clock.dt);
            if from >= start {
                steps += 1;
                standing += u32::from(motion.speed < STANDS);
                way += to - from;
            } else {
                let trail = world.scene().minds(at)[index].trail;
                self.drive(network, clock, at, trail.known(), motion);
            }
        }
        self.counts[lanelet].stay(clock, [steps, standing], way);
    }

    /// Adds what one vehicle did in the last step, which came onto its chain over those `before`.
    fn drive(
        &mut self,
        network: &Network,
        clock: Clock,
        chain: ChainIndex,
        before: impl Iterator<Item = ChainIndex>,
        motion: &Motion,
    ) {
        let way = last_way(motion, clock.dt);
        let mut is_beyond = false;
        along(network, chain, before, way, |lanelet, part| {
            let counts = &mut self.counts[lanelet.at()];
            counts.pass(clock, motion, part, way[1] - way[0]);
            counts.passed += u32::from(std::mem::replace(&mut is_beyond, true));
        });
    }

    /// Adds the last step of a vehicle that left the map from `chain`, up to the end of the road.
    fn leave(&mut self, network: &Network, clock: Clock, chain: ChainIndex, motion: &Motion) {
        let length = network.chain(chain).length;
        let [from, to] = last_way(motion, clock.dt);
        let mut is_beyond = to > length;
        self.counts[network.chain(chain).lanelet(to).0.at()].ended += 1;
        along(network, chain, None, [from, to.min(length)], |lanelet, part| {
            let counts = &mut self.counts[lanelet.at()];
            counts.pass(clock, motion, part, to - from);
            counts.passed += u32::from(std::mem::replace(&mut is_beyond, true));
        });
    }

    /// Counts a lane change.
    fn change(&mut self, network: &Network, change: &LaneChange) {
        let [from, to] = [change.from, change.to].map(|(chain, x)| network.chain(chain).lanelet(x).0.at());
        let side = |it: Side| usize::from(it == Side::Right);
        self.counts[from].away[side(change.side)] += 1;
        self.counts[to].onto[side(change.side)] += 1;
    }

    /// Each lanelet's place with density [veh/km], flow [veh/h], and speed [m/s] if anybody was there.
    pub(super) fn measures<'a>(
        &'a self,
        network: &'a Network,
    ) -> impl Iterator<Item = (usize, [f64; 2], Option<f64>)> {
        let duration = self.during[1] - self.during[0];
        let all = self.counts.iter().zip(&network.lanelets).enumerate();
        all.map(move |(place, (it, lanelet))| {
            let size = lanelet.length() * duration;
            let density = it.time / size * METRES_PER_KM;
            let flow = it.way / size * SECONDS_PER_HOUR;
            (place, [density, flow], (it.time > 0.0).then(|| it.way / it.time))
        })
    }
}

impl Counts {
    /// Vehicles stayed for so many steps, of them so many at rest, and drove so far [m].
    fn stay(&mut self, clock: Clock, [steps, standing]: [u32; 2], way: f64) {
        self.time += f64::from(steps) * clock.dt;
        self.standing += f64::from(standing) * clock.dt;
        self.way += way;
    }

    /// A vehicle was here for a `part` of its `way` in the last step [m]. Who stands is in one place for all of the step.
    fn pass(&mut self, clock: Clock, motion: &Motion, part: f64, way: f64) {
        let time = if way > 0.0 { part / way * clock.dt } else { clock.dt };
        self.time += time;
        self.way += part;
        if motion.speed < STANDS {
            self.standing += time;
        }
    }
}

/// From where to where a vehicle drove in its last step along its chain [m]; its speed changed evenly.
fn last_way(motion: &Motion, dt: f64) -> [f64; 2] {
    let driven = (motion.speed - 0.5 * f64::from(motion.acceleration) * dt) * dt;
    [motion.x - driven, motion.x]
}

/// Visits the lanelets between two stations of `chain` with the way on each [m], the last one first. What lies before its start
/// is on the chains `before`, as far as there are any, or else on the first lanelet of the last one.
fn along(
    network: &Network,
    mut chain: ChainIndex,
    before: impl IntoIterator<Item = ChainIndex>,
    [mut from, mut to]: [f64; 2],
    mut visit: impl FnMut(LaneletIndex, f64),
) {
    let mut before = before.into_iter();
    loop {
        let Chain { lanelets, starts, .. } = network.chain(chain);
        let previous = before.next();
        let beyond = starts.partition_point(|it| *it <= to);
        for (lanelet, start) in lanelets[..beyond].iter().zip(&starts[..beyond]).rev() {
            let is_first = *start == 0.0 && previous.is_none();
            if from >= *start || is_first {
                return visit(*lanelet, to - from);
            }
            visit(*lanelet, to - start);
            to = *start;
        }
        let Some(previous) = previous else { return };
        let length = network.chain(previous).length;
        (chain, from, to) = (previous, length + from, length);
    }
}

#[cfg(test)]
mod tests {
    use laneweave_maps::generate::{Motorway, motorway};

    use super::*;

    /// The ways on lanelets, by their ids, between two stations of a chain that follows on another.
    fn ways(before: impl IntoIterator<Item = ChainIndex>, way: [f64; 2]) -> Vec<(i64, f64)> {
        // Each lane is one chain of five lanelets of 100 m, numbered row by row from the slow lane on.
        let plan = Motorway { lanes: 2, length_m: 500.0, ..Motorway::default() };
        let network = motorway(&plan).unwrap().build().unwrap().network;
        let mut ways = Vec::new();
        along(&network, ChainIndex(0), before, way, |lanelet, way| {
            ways.push((network.lanelets[lanelet.at()].id, (way * 1e6).round() / 1e6));
        });
        ways
    }

    #[test]
    fn a_way_is_shared_by_the_lanelets_that_it_leads_over() {
        assert_eq!(ways(None, [20.0, 50.0]), [(1, 30.0)]);
        assert_eq!(ways(None, [99.0, 101.5]), [(3, 1.5), (1, 1.0)]);
        assert_eq!(ways(None, [90.0, 310.0]), [(7, 10.0), (5, 100.0), (3, 100.0), (1, 10.0)]);
        // What reaches beyond the end is not lost.
        assert_eq!(ways(None, [499.0, 503.0]), [(9, 4.0)]);
    }

    #[test]
    fn a_way_that_begins_on_the_chain_before_is_shared_with_its_last_lanelet() {
        assert_eq!(ways(Some(ChainIndex(1)), [-2.0, 1.0]), [(1, 1.0), (10, 2.0)]);
        assert_eq!(ways(None, [-2.0, 1.0]), [(1, 3.0)]);
        let both = ways([ChainIndex(1), ChainIndex(0)], [-502.0, 1.0]);
        assert_eq!((both.len(), both[0], both[6]), (7, (1, 1.0), (9, 2.0)));
    }
}
