//! Demand: who arrives where and when, and waits at the origins.
//!
//! Headways are negative exponential (May 1990). An arrival that finds no room waits in the queue of its lane, and
//! never delays the draw of the next.

use std::collections::VecDeque;

use laneweave_network::{ChainIndex, Gate, Network};

use crate::navigate::{Destination, Navigator, Waypoint};
use crate::place::{Place, Places};
use crate::random::{Purpose, Random};
use crate::scene::Scene;
use crate::traffic::{Motion, VehicleId};
use crate::vehicle::Class;
use crate::world::WorldError;

/// Who drives, where from and where to, and how many come.
#[derive(Clone, Debug, PartialEq)]
pub struct Demand {
    /// Where trips start.
    pub origins: Vec<Origin>,
    /// Where they end.
    pub destinations: Vec<Place>,
    /// Share of trucks.
    pub trucks: f64,
    /// The styles and their weights.
    pub population: Vec<Share>,
}

/// A place at which trips start.
#[derive(Clone, Debug, PartialEq)]
pub struct Origin {
    /// Where it is.
    pub place: Place,
    /// Vehicles per hour.
    pub rate: f64,
    /// Weight of each of the destinations; those that cannot be reached from here do not count.
    pub weights: Vec<f64>,
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
        Demand::over(Places::at_gates(network), total, trucks, population)
    }

    /// `total` vehicles per hour over all origins, by their number of lanes; destinations with equal weights.
    pub fn over(places: Places, total: f64, trucks: f64, population: Vec<Share>) -> Demand {
        let Places { origins, destinations } = places;
        let lanes: usize = origins.iter().map(|place| place.chains().len()).sum();
        let weights = vec![1.0; destinations.len()];
        let origin = |place: Place| {
            let rate = total * place.chains().len() as f64 / lanes as f64;
            Origin { place, rate, weights: weights.clone() }
        };
        Demand { origins: origins.into_iter().map(origin).collect(), destinations, trucks, population }
    }
}

impl Demand {
    /// Whether all its numbers make sense.
    ///
    /// # Errors
    /// The first that does not.
    pub(crate) fn check(&self) -> Result<(), WorldError> {
        let rates = self.origins.iter().map(|it| ("a demand in veh/h", it.rate, Demand::LARGEST_RATE));
        let weights = self.origins.iter().flat_map(|it| &it.weights);
        let exits = weights.map(|it| ("the weight of an exit", *it, f64::MAX));
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
        if self.destinations.len() > Demand::MOST_DESTINATIONS {
            return Err(WorldError::Destinations(self.destinations.len()));
        }
        Ok(())
    }

    /// More vehicles per hour than this at one origin are a mistake.
    const LARGEST_RATE: f64 = 100_000.0;
    /// A vehicle keeps its destination in two bytes.
    const MOST_DESTINATIONS: usize = u16::MAX as usize;
}

/// A vehicle at the moment of its arrival.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Arrival {
    pub(crate) id: VehicleId,
    pub(crate) class: Class,
    pub(crate) character: u32,
    pub(crate) destination: Destination,
}

/// An origin with its queues.
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
    pub(crate) start: Start,
    pub(crate) waiting: VecDeque<Arrival>,
}

/// How vehicles come onto a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Start {
    /// They come driving from before its start.
    Driving,
    /// They start from rest, with the rear bumper at this station [m].
    FromRest(f64),
}

impl Source {
    /// The sources of all origins.
    pub(crate) fn all(
        network: &Network,
        navigator: &Navigator,
        demand: &Demand,
        random: &Random,
    ) -> Vec<Source> {
        demand
            .origins
            .iter()
            .zip(0..)
            .map(|(origin, number)| {
                let mut source = Source {
                    number,
                    rate: origin.rate / 3600.0,
                    arrived: 0,
                    next_time: 0.0,
                    lanes: queues(network, &origin.place),
                    destinations: destinations(network, navigator, origin),
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

/// The queues of a place, ordered from the slow side.
fn queues(network: &Network, place: &Place) -> Vec<Queue> {
    let queue = |chain, start| Queue { chain, start, waiting: VecDeque::new() };
    match place {
        Place::Gate(gate) => {
            from_the_slow_side(network, gate).into_iter().map(|it| queue(it, Start::Driving)).collect()
        }
        Place::Kerb(kerb) => vec![queue(kerb.chain, Start::FromRest(kerb.station))],
    }
}

/// The gate's lanes, ordered from the slow side.
fn from_the_slow_side(network: &Network, gate: &Gate) -> Vec<ChainIndex> {
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
    chains
}

/// The destinations that can be reached from an origin, with cumulated weights.
fn destinations(network: &Network, navigator: &Navigator, origin: &Origin) -> Vec<(Destination, f64)> {
    let reachable: Vec<u16> = match &origin.place {
        Place::Gate(gate) => (0u16..)
            .take(origin.weights.len())
            .filter(|number| {
                let leads =
                    |chain: &ChainIndex| navigator.waypoint(Some(*number), *chain).changes < Waypoint::NO_WAY;
                gate.chains.iter().any(leads)
            })
            .collect(),
        Place::Kerb(kerb) => navigator.trips_from(network, kerb).collect(),
    };
    let mut sum = 0.0;
    let weighted = reachable.into_iter().map(|number| (number, origin.weights[usize::from(number)]));
    weighted
        .filter(|(_, weight)| *weight > 0.0)
        .map(|(number, weight)| {
            sum += weight;
            (Some(number), sum)
        })
        .collect()
}
