//! Route guidance: link times from the traffic itself, and routes planned with them.
//!
//! At each interval the time of each link becomes max(BPR(q), L/v̄). q and v̄ follow Edie's definitions over the link
//! and the interval, from vehicle-metres and vehicle-seconds sampled once a second. Then the routes to all destinations
//! in use are planned again. A limit per step bounds the work of a step.

use std::collections::BTreeMap;

use laneweave_models::change::link_time;
use laneweave_models::follow::{FollowingModel, Idm};
use laneweave_network::{ChainIndex, Network};
use serde::{Deserialize, Serialize};

use crate::route::links::{Link, Links};
use crate::route::navigate::Navigator;
use crate::route::place::Place;
use crate::state::clock::Clock;
use crate::state::lane::Lane;
use crate::state::vehicle::Class;

/// Waypoints that are planned in a step, ours: this takes some milliseconds.
const WAYPOINTS_A_STEP: usize = 4000;
/// Time between two samples of the traffic [s].
const SAMPLED_EVERY: f64 = 1.0;

/// Route guidance of drivers.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Guidance {
    /// Steps between two measurements.
    period: u32,
    /// One for each link, in the order of the links.
    meters: Vec<Meter>,
    /// Tables of usual routes whose destinations have to be planned again, the next one last.
    due: Vec<usize>,
    /// For each table whether a driver uses it.
    in_use: Vec<bool>,
    /// Number of waypoints that may be planned now.
    credit: usize,
}

/// What is measured on a link.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Meter {
    /// Capacity [veh/s].
    capacity: f64,
    /// Vehicle-seconds since the last measurement.
    seconds: f64,
    /// Vehicle-metres since the last measurement.
    metres: f64,
}

impl Meter {
    /// Time [s] on `link` from the counts of `interval` [s]; resets the counts.
    fn read(&mut self, link: &Link, interval: f64) -> f64 {
        let Meter { capacity, seconds, metres } = *self;
        (self.seconds, self.metres) = (0.0, 0.0);
        if seconds == 0.0 {
            return link.free_time;
        }
        let flow = metres / (link.length * interval);
        link_time(link.free_time, flow / capacity, link.length, metres / seconds)
    }
}

impl Guidance {
    /// Guidance over `links` with a measurement every `period` steps.
    pub(crate) fn new(links: &Links, period: u32) -> Guidance {
        // Many links have one limit.
        let mut capacities = BTreeMap::new();
        let mut meter = |link: &Link| {
            let capacity = *capacities.entry(link.limit.to_bits()).or_insert_with(|| capacity(link.limit));
            Meter { capacity, seconds: 0.0, metres: 0.0 }
        };
        let meters = links.all().iter().map(&mut meter).collect();
        Guidance { period, meters, due: Vec::new(), in_use: Vec::new(), credit: 0 }
    }

    /// Whether it has this many links and tables.
    pub(crate) fn fits(&self, links: usize, tables: usize) -> bool {
        let Guidance { period, meters, due, in_use, credit } = self;
        let is_use = in_use.is_empty() || in_use.len() == tables;
        *period > 0
            && meters.len() == links
            && due.iter().all(|it| *it < tables)
            && is_use
            && (due.is_empty() || !in_use.is_empty())
            && *credit <= usize::MAX / 2
    }

    /// Measures, and plans the routes to `destinations` again, if this is due at `clock`.
    pub(crate) fn advance(
        &mut self,
        network: &Network,
        navigator: &mut Navigator,
        lanes: &[Lane],
        destinations: &[Place],
        clock: Clock,
    ) {
        if clock.step.is_multiple_of(clock.steps(SAMPLED_EVERY)) {
            self.sample(lanes, navigator.links());
        }
        if clock.step.is_multiple_of(self.period) {
            let times = self.measure(navigator.links(), clock.dt);
            navigator.take_link_times(times.into_iter());
            self.look_who_drives(lanes, navigator);
        }
        self.plan(network, destinations, navigator);
    }

    /// Samples where the vehicles are.
    fn sample(&mut self, lanes: &[Lane], links: &Links) {
        for (lane, chain) in lanes.iter().zip(0..) {
            let all = lane.motions().iter().zip(lane.drivers());
            for (motion, _) in all.filter(|(_, driver)| !driver.is_shadow) {
                let meter = &mut self.meters[links.at(ChainIndex(chain), motion.x)];
                meter.seconds += SAMPLED_EVERY;
                meter.metres += SAMPLED_EVERY * motion.speed;
            }
        }
    }

    /// The link times since the last measurement [s]; resets the counts.
    fn measure(&mut self, links: &Links, dt: f64) -> Vec<f64> {
        let interval = f64::from(self.period) * dt;
        let all = self.meters.iter_mut().zip(links.all());
        all.map(|(meter, link)| meter.read(link, interval)).collect()
    }

    /// Notes which tables drivers use, and which destinations have to be planned again.
    fn look_who_drives(&mut self, lanes: &[Lane], navigator: &Navigator) {
        let Guidance { due, in_use, .. } = self;
        in_use.clear();
        in_use.resize(navigator.tables(), false);
        let goals =
            lanes.iter().flat_map(|lane| lane.drivers()).filter_map(|driver| driver.goal.destination());
        goals.for_each(|table| in_use[usize::from(table)] = true);
        if due.is_empty() {
            let is_active = |table: &usize| navigator.ways(*table).iter().any(|way| in_use[*way]);
            due.extend(navigator.usual_tables().rev().filter(is_active));
        }
    }

    /// Plans as many of the due routes as a step allows.
    fn plan(&mut self, network: &Network, destinations: &[Place], navigator: &mut Navigator) {
        let cost = network.chains.len();
        self.credit = (self.credit + WAYPOINTS_A_STEP).min(cost.max(WAYPOINTS_A_STEP));
        while self.credit >= cost {
            let Some(table) = self.due.pop() else { return };
            self.credit -= cost;
            let ways = navigator.ways(table);
            if let Some(place) = navigator.number(Some(table as u16)).and_then(|it| destinations.get(it)) {
                navigator.renew(network, place, ways, ways.map(|way| self.in_use[way]));
            }
        }
    }
}

/// Capacity of a lane under `limit` [m/s], in veh/s: that of cars that follow by the IDM with its usual parameters;
/// ours.
fn capacity(limit: f64) -> f64 {
    FollowingModel::Idm(Idm::default()).capacity(limit, Class::Car.body().length)
}
