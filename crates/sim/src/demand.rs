//! Demand: who arrives where and when, and waits at the entrances.
//!
//! Headways are negative exponential (May 1990). An arrival that finds no room waits in the queue of its lane, and
//! never delays the draw of the next.

use std::collections::VecDeque;

use laneweave_models::Style;
use laneweave_models::braking::is_secure;
use laneweave_models::follow::{Ahead, CarFollowing, Pace};
use laneweave_network::{ChainIndex, Gate, Network};

use crate::navigate::{Destination, Navigator, Waypoint};
use crate::random::{Purpose, Random};
use crate::scene::Scene;
use crate::traffic::{Motion, VehicleId};
use crate::vehicle::Class;
use crate::world::WorldError;

/// Who drives, and how many come.
#[derive(Clone, Debug, PartialEq)]
pub struct Demand {
    /// Vehicles per hour at each of the network's entrances.
    pub rates: Vec<f64>,
    /// Weight of each of the network's exits as a destination.
    pub destinations: Vec<f64>,
    /// Share of trucks.
    pub trucks: f64,
    /// The styles and their weights.
    pub population: Vec<Share>,
}

/// A style's share of the drivers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// Its weight.
    pub weight: f64,
    /// Place of its first character in the table of characters.
    pub first: u32,
    /// Number of its characters.
    pub count: u32,
}

impl Demand {
    /// `total` vehicles per hour over all entrances, by their number of lanes; destinations with equal weights.
    pub fn even(network: &Network, total: f64, trucks: f64, population: Vec<Share>) -> Demand {
        let lanes: usize = network.entrances.iter().map(|gate| gate.chains.len()).sum();
        let rate = |gate: &Gate| total * gate.chains.len() as f64 / lanes as f64;
        Demand {
            rates: network.entrances.iter().map(rate).collect(),
            destinations: vec![1.0; network.exits.len()],
            trucks,
            population,
        }
    }
}

impl Demand {
    /// Whether all its numbers make sense.
    ///
    /// # Errors
    /// The first that does not.
    pub(crate) fn check(&self) -> Result<(), WorldError> {
        let rates = self.rates.iter().map(|it| ("a demand in veh/h", *it, Demand::LARGEST_RATE));
        let exits = self.destinations.iter().map(|it| ("the weight of an exit", *it, f64::MAX));
        let styles = self.population.iter().map(|it| ("the weight of a style", it.weight, f64::MAX));
        let trucks = std::iter::once(("the share of trucks", self.trucks, 1.0));
        for (what, value, largest) in rates.chain(exits).chain(styles).chain(trucks) {
            if !(0.0..=largest).contains(&value) {
                let limit =
                    if largest == f64::MAX { String::new() } else { format!(" and not above {largest}") };
                return Err(WorldError::Demand { what, value, limit });
            }
        }
        if self.population.iter().map(|it| it.weight).sum::<f64>() <= 0.0 {
            return Err(WorldError::NoCharacters);
        }
        Ok(())
    }

    /// More vehicles per hour than this at one entrance are a mistake.
    const LARGEST_RATE: f64 = 100_000.0;
}

/// A vehicle at the moment of its arrival.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Arrival {
    pub(crate) id: VehicleId,
    pub(crate) class: Class,
    pub(crate) character: u32,
    pub(crate) destination: Destination,
}

/// An entrance with its queues.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    number: u32,
    /// Arrivals per second.
    rate: f64,
    arrived: u32,
    next_time: f64,
    /// Its lanes from the slow side to the fast one.
    lanes: Vec<Queue>,
    /// Destinations with their cumulated weights.
    destinations: Vec<(Destination, f64)>,
}

/// The vehicles that wait for one lane.
#[derive(Clone, Debug)]
pub(crate) struct Queue {
    pub(crate) chain: ChainIndex,
    pub(crate) waiting: VecDeque<Arrival>,
}

impl Source {
    /// The sources of all entrances.
    pub(crate) fn all(
        network: &Network,
        navigator: &Navigator,
        demand: &Demand,
        random: &Random,
    ) -> Vec<Source> {
        network
            .entrances
            .iter()
            .zip(&demand.rates)
            .zip(0..)
            .map(|((gate, rate), number)| {
                let mut source = Source {
                    number,
                    rate: rate / 3600.0,
                    arrived: 0,
                    next_time: 0.0,
                    lanes: from_the_slow_side(network, gate),
                    destinations: destinations(navigator, gate, &demand.destinations),
                };
                source.next_time = source.headway(random);
                source
            })
            .collect()
    }

    /// The next headway [s], −ln(u)/rate.
    fn headway(&self, random: &Random) -> f64 {
        -libm::log(random.uniform(self.number, Purpose::Arrival, self.arrived)) / self.rate
    }

    /// Lets those arrive who are due by `time` [s] and queue up; `next_id` names them.
    pub(crate) fn arrive(
        &mut self,
        scene: &Scene,
        demand: &Demand,
        random: &Random,
        time: f64,
        next_id: &mut VehicleId,
    ) {
        while self.next_time <= time {
            let arrival = self.draw(demand, random, *next_id);
            *next_id += 1;
            self.arrived += 1;
            self.next_time += self.headway(random);
            let lane = self.lane_for(scene, &arrival);
            self.lanes[lane].waiting.push_back(arrival);
        }
    }

    fn draw(&self, demand: &Demand, random: &Random, id: VehicleId) -> Arrival {
        let uniform = |purpose| random.uniform(id, purpose, 0);
        let class = if uniform(Purpose::Class) < demand.trucks { Class::Truck } else { Class::Car };
        let total: f64 = demand.population.iter().map(|it| it.weight).sum();
        let mut at = uniform(Purpose::Style) * total;
        let share = demand
            .population
            .iter()
            .find(|it| {
                at -= it.weight;
                at < 0.0
            })
            .or(demand.population.last());
        let character = share.map_or(0, |it| {
            it.first + ((uniform(Purpose::Character) * f64::from(it.count)) as u32).min(it.count - 1)
        });
        let last = self.destinations.last().map_or(0.0, |it| it.1);
        let wanted = uniform(Purpose::Destination) * last;
        let destination = self.destinations.iter().find(|it| wanted < it.1).and_then(|it| it.0);
        Arrival { id, class, character, destination }
    }

    /// The lane in which a driver queues: the fewest changes from its route, if they have to be made soon; then trucks
    /// on the slow side, others where fewer wait and where there is more room.
    fn lane_for(&self, scene: &Scene, arrival: &Arrival) -> usize {
        /// Road per lane change within which a driver takes its lane from the start [m].
        const SOON: f64 = 600.0;
        let key = |queue: &Queue| {
            let waypoint = scene.navigator.waypoint(arrival.destination, queue.chain);
            let room = scene.motions(queue.chain).first().map_or(f64::INFINITY, Motion::rear);
            let (queued, room) = match arrival.class {
                Class::Truck => (0, 0.0),
                Class::Car => (queue.waiting.len(), room),
            };
            let is_pressing = waypoint.last_place < SOON * f64::from(waypoint.changes);
            (if is_pressing { waypoint.changes } else { 0 }, queued, -room)
        };
        let order = |a: &(u32, usize, f64), b: &(u32, usize, f64)| {
            (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2))
        };
        let keys = self.lanes.iter().map(key).enumerate();
        keys.min_by(|a, b| order(&a.1, &b.1)).map_or(0, |(index, _)| index)
    }

    /// Its queues.
    pub(crate) fn queues(&mut self) -> &mut [Queue] {
        &mut self.lanes
    }

    /// Vehicles that wait.
    pub(crate) fn waiting(&self) -> usize {
        self.lanes.iter().map(|queue| queue.waiting.len()).sum()
    }

    /// Vehicles that have arrived.
    pub(crate) fn arrived(&self) -> u32 {
        self.arrived
    }
}

/// The gate's lanes, ordered from the slow side.
fn from_the_slow_side(network: &Network, gate: &Gate) -> Vec<Queue> {
    let slow = network.driving_side.overtaking().opposite();
    let lanes_beyond = |chain: ChainIndex| {
        let mut count = 0;
        let mut at = chain;
        while let Some(beside) = network.chain(at).beside(slow, 0.0).filter(|_| count < gate.chains.len()) {
            (at, count) = (beside.chain, count + 1);
        }
        count
    };
    let mut chains = gate.chains.clone();
    chains.sort_by_key(|chain| lanes_beyond(*chain));
    chains.into_iter().map(|chain| Queue { chain, waiting: VecDeque::new() }).collect()
}

/// The exits that can be reached from a gate, with cumulated weights.
fn destinations(navigator: &Navigator, gate: &Gate, weights: &[f64]) -> Vec<(Destination, f64)> {
    let mut sum = 0.0;
    let mut reachable = Vec::new();
    for (exit, weight) in weights.iter().enumerate() {
        let destination = Some(exit as u16);
        let leads = |chain: &ChainIndex| navigator.waypoint(destination, *chain).changes < Waypoint::NO_WAY;
        if *weight > 0.0 && gate.chains.iter().any(leads) {
            sum += weight;
            reachable.push((destination, sum));
        }
    }
    reachable
}

/// Speed [m/s] at which a driver enters behind `ahead`; `None` if it has to wait.
pub(crate) fn entry_speed(style: &Style, desired: f64, ahead: Option<Ahead>, dt: f64) -> Option<f64> {
    /// Braking that an entering driver puts up with [m/s²].
    const GENTLE: f64 = 0.5;
    /// Who would have to enter slower than this share of the leader's speed waits.
    const SHARE_OF_LEADER: f64 = 1.0;
    let Some(ahead) = ahead else { return Some(desired) };
    let fits = |speed: f64| {
        let demanded = style.follow.acceleration(Pace::new(speed, desired), Some(ahead));
        ahead.gap >= style.safety.min_gap && demanded >= -GENTLE && is_secure(speed, ahead, dt)
    };
    if fits(desired) {
        return Some(desired);
    }
    let (mut slow, mut fast) = (SHARE_OF_LEADER * ahead.speed.min(desired), desired);
    if !fits(slow) {
        return None;
    }
    for _ in 0..20 {
        let middle = 0.5 * (slow + fast);
        if fits(middle) { slow = middle } else { fast = middle }
    }
    Some(slow)
}
