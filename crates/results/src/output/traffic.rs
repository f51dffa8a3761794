//! Aggregates of every lanelet between two instants: plain counts.
//!
//! Density, flow and speed by Edie's generalised definitions (as in `laneweave_study::edie`), from the time and the
//! distance of every vehicle that the simulator records.

use laneweave_network::{Network, Side};
use laneweave_sim::{Event, LaneChange, LaneletAggregate, World};
use laneweave_study::units::{METRES_PER_KM, SECONDS_PER_HOUR};
use serde::{Deserialize, Serialize};

/// The traffic on all lanelets between two instants.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Traffic {
    /// Begin and end [s].
    pub(super) during: [f64; 2],
    /// By lanelet.
    pub(super) counts: Vec<Counts>,
}

/// The traffic on one lanelet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Counts {
    /// The aggregates of the vehicles on it.
    pub(super) stay: LaneletAggregate,
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

    /// Adds the traffic of the interval that follows.
    pub(super) fn add(&mut self, next: &Traffic) {
        self.during[1] = next.during[1];
        for (sum, it) in self.counts.iter_mut().zip(&next.counts) {
            sum.stay = sum.stay.plus(it.stay);
            sum.begun += it.begun;
            sum.ended += it.ended;
            for side in 0..2 {
                sum.away[side] += it.away[side];
                sum.onto[side] += it.onto[side];
            }
        }
    }

    /// Counts the last step.
    pub(super) fn observe(&mut self, world: &World, is_measured: impl Fn(&LaneChange) -> bool) {
        let network = world.network();
        for event in world.events() {
            match event {
                Event::Entered(id) => {
                    if let Some(trip) = world.trip(*id) {
                        self.counts[network.chain(trip.from.chain).lanelet(trip.from.x).0.at()].begun += 1;
                    }
                }
                Event::Left { chain, motion, .. } => {
                    self.counts[network.chain(*chain).lanelet(motion.x).0.at()].ended += 1;
                }
                Event::Removed { at, .. } => {
                    self.counts[network.chain(at.chain).lanelet(at.x).0.at()].ended += 1;
                }
                Event::LaneChange(change) if change.is_completed && is_measured(change) => {
                    self.change(network, change);
                }
                Event::LaneChange(_) | Event::Incident(_) | Event::Driving(_) => {}
            }
        }
    }

    /// Ends now; its traffic is the difference to `before`, which is set to the present totals.
    pub(super) fn close(&mut self, world: &World, before: &mut Vec<LaneletAggregate>) {
        self.during[1] = world.clock().time();
        let now = world.lanelet_aggregates();
        for ((counts, now), before) in self.counts.iter_mut().zip(&now).zip(&*before) {
            counts.stay = now.since(*before);
        }
        *before = now;
    }

    /// Counts a lane change.
    fn change(&mut self, network: &Network, change: &LaneChange) {
        let [from, to] = [change.from, change.to].map(|it| network.chain(it.chain).lanelet(it.x).0.at());
        let side = |it: Side| usize::from(it == Side::Right);
        self.counts[from].away[side(change.side)] += 1;
        self.counts[to].onto[side(change.side)] += 1;
    }

    /// The index of each lanelet with density [veh/km], flow [veh/h], and speed [m/s] if there were vehicles.
    pub(super) fn measures<'a>(
        &'a self,
        network: &'a Network,
    ) -> impl Iterator<Item = (usize, [f64; 2], Option<f64>)> {
        let duration = self.during[1] - self.during[0];
        let all = self.counts.iter().zip(&network.lanelets).enumerate();
        all.map(move |(place, (it, lanelet))| {
            let density = it.stay.density(lanelet.length(), duration) * METRES_PER_KM;
            let flow = it.stay.flow(lanelet.length(), duration) * SECONDS_PER_HOUR;
            (place, [density, flow], it.stay.speed())
        })
    }
}
