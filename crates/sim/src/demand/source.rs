//! Sources: vehicles arrive at the origins of the demand, and wait there.
//!
//! A vehicle that finds no space waits in the queue of its lane. It never delays the next arrival.

use std::collections::VecDeque;

use laneweave_network::{ChainIndex, Gate, Network};
use serde::{Deserialize, Serialize};

use crate::demand::destinations::destinations;
use crate::demand::headways::Headways;
use crate::demand::perimeter_control::PerimeterControl;
use crate::demand::rate::Rate;
use crate::demand::{Demand, SECONDS_PER_HOUR, Trips};
use crate::junction::storage_section::StorageSection;
use crate::route::in_time::LateTrip;
use crate::route::navigate::Navigator;
use crate::route::place::Place;
use crate::state::clock::Clock;
use crate::state::goal::Destination;
use crate::state::lane::{Kinematics, VehicleId};
use crate::state::random::{Purpose, Random};
use crate::state::vehicle::{Class, Classes};
use crate::view::scene::Scene;

/// A driver enters the map in a lane of its route if the last place for its lane changes is within this distance per
/// change [m] (ours).
pub const TAKES_LANE_WITHIN: f64 = 800.0;

/// A vehicle at the moment of its arrival.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Arrival {
    pub(crate) id: VehicleId,
    /// Time of arrival [s].
    pub(crate) time: f64,
    pub(crate) class: Class,
    /// [m].
    pub(crate) length: f64,
    pub(crate) parameters: u32,
    pub(crate) destination: Destination,
    /// Its route leads through the town core, which may be full.
    pub(crate) is_through_town: bool,
    /// The line that it serves.
    pub(crate) line: Option<u16>,
}

/// An origin with its queues.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Source {
    headways: Headways,
    /// Arrival rate of each stream.
    rate: Rate,
    /// The rate that a user has set, if one has [veh/h].
    user_rate: Option<f64>,
    /// Streams of arrivals. Memoryless arrivals form one stream; others form one for each lane.
    streams: Vec<Stream>,
    /// The queues of its lanes, from the slow side to the fast side.
    lanes: Vec<Queue>,
    /// For each class restriction the destinations that can be reached from here, with their cumulated weights.
    destinations: Vec<Vec<(Destination, f64)>>,
    /// The classes of the demand that start here.
    possible: Classes,
}

/// Vehicles that arrive one after the other.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Stream {
    /// Subject of its random numbers.
    number: u32,
    arrived: u32,
    /// Time of the next arrival [s].
    next: f64,
}

/// The vehicles that wait for one lane.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Queue {
    pub(crate) chain: ChainIndex,
    pub(crate) start: Start,
    pub(crate) waiting: VecDeque<Arrival>,
    /// Step since which the first vehicle has waited for others that use the same conflict area.
    pub(crate) asks_since: Option<u32>,
}

/// How vehicles enter a lane.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum Start {
    /// They are driving when they enter, with the rear bumper at this station [m].
    Driving(f64),
    /// They start from rest, with the rear bumper at this station [m].
    FromRest(f64),
}

impl Queue {
    /// The storage section on which its vehicles start.
    pub(crate) fn section(&self, network: &Network) -> StorageSection {
        StorageSection::at(&network.junctions, self.chain, self.start.station())
    }

    /// The position in the queue of the first vehicle that may enter, with a town core that `is_full` or not.
    pub(crate) fn first(&self, is_full: bool) -> Option<usize> {
        self.waiting.iter().position(|it| !(is_full && it.is_through_town))
    }
}

impl Start {
    /// Where the rear bumper of a vehicle is when it enters [m].
    pub(crate) fn station(self) -> f64 {
        match self {
            Start::Driving(station) | Start::FromRest(station) => station,
        }
    }
}

/// Who comes, and whether the town has room.
#[derive(Clone, Copy)]
pub(crate) struct Coming<'a> {
    pub(crate) demand: &'a Demand,
    /// The weight of each style of the population.
    pub(crate) weights: &'a [f64],
    /// `None` where the map has no town core.
    pub(crate) perimeter: Option<&'a PerimeterControl>,
}

impl Source {
    /// The sources of all origins.
    pub(crate) fn all(
        network: &Network,
        navigator: &Navigator,
        demand: &Demand,
        late: &[LateTrip],
        random: &Random,
    ) -> Vec<Source> {
        // The first stream of each source has the number of the source; further streams follow.
        let mut further = demand.origins.len() as u32..;
        let sources = demand.origins.iter().zip(0..).map(|(origin, number)| {
            let lanes = queues(network, &origin.place);
            let count = match (origin.trips, demand.headways) {
                (Trips::Scheduled, _) => 0,
                (_, Headways::Exponential) => 1,
                _ => origin.lanes(network),
            };
            let numbers = std::iter::once(number).chain(further.by_ref().take(count.saturating_sub(1)));
            let numbers = numbers.take(count);
            let destinations = destinations(network, navigator, (demand, number as usize), late);
            let leads = |class: &Class| !destinations[navigator.restriction_of(*class)].is_empty();
            let may_start =
                |class: &Class| lanes.iter().any(|it| network.chain(it.chain).classes.has(*class));
            let leads_nowhere = destinations.iter().all(Vec::is_empty);
            let starts = |it: &Class| if leads_nowhere { may_start(it) } else { leads(it) };
            let possible = demand.fleet.classes().iter().filter(starts).collect();
            let mut source = Source {
                headways: demand.headways,
                rate: origin.rate.times(&Rate::constant(1.0 / count.max(1) as f64)),
                user_rate: None,
                streams: numbers.map(|number| Stream { number, arrived: 0, next: 0.0 }).collect(),
                lanes,
                destinations,
                possible,
            };
            source.draw_first(random);
            source
        });
        sources.collect()
    }

    /// Whether it is the source of the same origin as `other` at `clock`, with this many sets of driver parameters and
    /// lines, and names known destinations only.
    pub(crate) fn fits(
        &self,
        other: &Source,
        clock: Clock,
        driver_parameters: usize,
        lines_of_demand: usize,
        is_known: impl Fn(Destination) -> bool,
    ) -> bool {
        let Source { headways, rate: _, user_rate: _, streams, lanes, destinations, possible } = self;
        let arrival_fits = |it: &Arrival| {
            (it.parameters as usize) < driver_parameters
                && is_known(it.destination)
                && it.line.is_none_or(|it| usize::from(it) < lines_of_demand)
        };
        let queue_fits = |(one, other): (&Queue, &Queue)| {
            one.chain == other.chain
                && one.start == other.start
                && one.waiting.iter().all(arrival_fits)
                && one.asks_since.is_none_or(|it| it <= clock.step)
        };
        let stream_fits =
            |(one, other): (&Stream, &Stream)| one.number == other.number && one.next >= clock.time();
        headways == &other.headways
            && destinations == &other.destinations
            && possible == &other.possible
            && streams.len() == other.streams.len()
            && streams.iter().zip(&other.streams).all(stream_fits)
            && lanes.len() == other.lanes.len()
            && lanes.iter().zip(&other.lanes).all(queue_fits)
    }

    /// Whether trips of a class lead from here to a destination.
    pub(crate) fn leads_to(&self, destination: usize, class: Class, navigator: &Navigator) -> bool {
        let of_class = &self.destinations[navigator.restriction_of(class)];
        of_class.iter().any(|it| navigator.number(it.0) == Some(destination))
    }

    /// The rate that a user has set, if one has [veh/h].
    pub(crate) fn user_rate(&self) -> Option<f64> {
        self.user_rate
    }

    /// Sets the rate at which vehicles arrive after `time` [s] to `rate` [veh/h]. The time of the next arrival is drawn
    /// anew.
    pub(crate) fn set_rate(&mut self, rate: f64, random: &Random, time: f64) {
        if self.streams.is_empty() {
            return;
        }
        self.user_rate = Some(rate);
        self.rate = Rate::constant(rate / self.streams.len() as f64);
        for stream in 0..self.streams.len() {
            self.streams[stream].next = time;
            self.draw_next(stream, random);
        }
    }

    /// Draws when the first vehicle of each stream arrives, from time 0 on.
    pub(crate) fn draw_first(&mut self, random: &Random) {
        for stream in 0..self.streams.len() {
            self.streams[stream].next = 0.0;
            self.draw_next(stream, random);
        }
    }

    /// Samples the time of the next arrival in a stream.
    fn draw_next(&mut self, stream: usize, random: &Random) {
        let Stream { number, arrived, next } = self.streams[stream];
        let chance = random.uniform(number, Purpose::Arrival, arrived);
        self.streams[stream].next = next_arrival(self.headways, &self.rate, next, chance);
    }

    /// The vehicles that are due by `time` [s] arrive and join the queues; `next_id` gives their ids.
    pub(crate) fn arrive(
        &mut self,
        scene: &Scene,
        coming: Coming,
        random: &Random,
        time: f64,
        next_id: &mut VehicleId,
    ) {
        let due = |source: &Source| {
            let streams = source.streams.iter().enumerate();
            let (index, first) = streams.min_by(|(_, a), (_, b)| a.next.total_cmp(&b.next))?;
            (first.next <= time && !source.possible.is_empty()).then_some(index)
        };
        while let Some(stream) = due(self) {
            let came = self.streams[stream].next;
            let mut arrival = self.draw(scene.navigator, coming, random, (*next_id, came));
            *next_id += 1;
            self.streams[stream].arrived += 1;
            self.draw_next(stream, random);
            let lane = self.lane_for(scene, &arrival);
            let lane = &mut self.lanes[lane];
            let is_on_way =
                |it: &PerimeterControl| it.is_on_way(scene.navigator, lane.chain, arrival.destination);
            arrival.is_through_town = coming.perimeter.is_some_and(is_on_way);
            lane.waiting.push_back(arrival);
        }
    }

    /// A vehicle joins a queue.
    pub(crate) fn join(&mut self, scene: &Scene, arrival: Arrival) {
        let lane = self.lane_for(scene, &arrival);
        self.lanes[lane].waiting.push_back(arrival);
    }

    /// Makes the vehicle `id` that arrives at `time` [s], from random numbers.
    fn draw(
        &self,
        navigator: &Navigator,
        Coming { demand, weights, .. }: Coming,
        random: &Random,
        (id, time): (VehicleId, f64),
    ) -> Arrival {
        let uniform = |purpose| random.uniform(id, purpose, 0);
        let class = demand.fleet.class(uniform(Purpose::Class), self.possible);
        let parameters = demand.draw_driver(weights, random, id);
        let destinations = &self.destinations[navigator.restriction_of(class)];
        let wanted = uniform(Purpose::Destination) * destinations.last().map_or(0.0, |it| it.1);
        let destination = destinations.iter().find(|it| wanted < it.1).and_then(|it| it.0);
        let (length, line) = (class.body().length, None);
        Arrival { id, time, class, length, parameters, destination, is_through_town: false, line }
    }

    /// The lane in which a driver queues, among those that its class may use. First: fewest lane changes, if they have
    /// to be made soon. Then: long vehicles on the slow side, others where fewer vehicles wait, and where there is more
    /// space.
    fn lane_for(&self, scene: &Scene, arrival: &Arrival) -> usize {
        let may_use = |it: &Queue| scene.network.chain(it.chain).classes.has(arrival.class);
        let key = |queue: &Queue| {
            let waypoint = scene.navigator.waypoint(arrival.destination, queue.chain);
            let room = scene.motions(queue.chain).first().map_or(f64::INFINITY, Kinematics::rear);
            let (queued, room) = if arrival.class.is_long() { (0, 0.0) } else { (queue.waiting.len(), room) };
            let is_pressing = waypoint.last_place < TAKES_LANE_WITHIN * f64::from(waypoint.changes);
            (if is_pressing { waypoint.changes } else { 0 }, queued, -room)
        };
        let order = |a: &(u32, usize, f64), b: &(u32, usize, f64)| {
            (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2))
        };
        let lanes = self.lanes.iter().enumerate().filter(|it| may_use(it.1));
        let keys = lanes.map(|(index, it)| (index, key(it)));
        keys.min_by(|a, b| order(&a.1, &b.1)).map_or(0, |(index, _)| index)
    }

    pub(crate) fn queues(&mut self) -> &mut [Queue] {
        &mut self.lanes
    }

    /// Its queues, read-only.
    pub(crate) fn lanes(&self) -> &[Queue] {
        &self.lanes
    }

    /// The classes of the demand that start here.
    pub(crate) fn possible(&self) -> Classes {
        self.possible
    }

    /// Vehicles that wait.
    pub(crate) fn waiting(&self) -> usize {
        self.lanes.iter().map(|queue| queue.waiting.len()).sum()
    }

    /// Vehicles that have arrived.
    pub(crate) fn arrived(&self) -> u64 {
        self.streams.iter().map(|it| u64::from(it.arrived)).sum()
    }
}

/// Time of the next arrival after the one at `last` [s]. Its headway is exceeded with probability `chance`, in a stream
/// of `rate` [veh/h].
///
/// Where the rate changes in between, the remaining share of the headway continues at the new rate. So Poisson arrivals
/// stay Poisson at any time, and the minimum headway of a distribution is kept.
fn next_arrival(headways: Headways, rate: &Rate, last: f64, chance: f64) -> f64 {
    let (mut time, mut left) = (last, 1.0);
    while time < f64::INFINITY {
        let (now, until) = (rate.at(time) / SECONDS_PER_HOUR, rate.changes_after(time));
        if now > 0.0 {
            let headway = headways.exceeded(chance, now);
            if time + left * headway <= until {
                return time + left * headway;
            }
            left -= (until - time) / headway;
        }
        time = until;
    }
    f64::INFINITY
}

/// The queues of a place, ordered from the slow side.
fn queues(network: &Network, place: &Place) -> Vec<Queue> {
    let queue = |chain, start| Queue { chain, start, waiting: VecDeque::new(), asks_since: None };
    match place {
        Place::Gate(gate) => {
            from_the_slow_side(network, gate).into_iter().map(|it| queue(it, Start::Driving(0.0))).collect()
        }
        Place::Inside(inner) => vec![queue(inner.chain, Start::FromRest(inner.station))],
        Place::Across(section) => {
            let start = if section.is_passed { Start::Driving } else { Start::FromRest };
            section.lanes().map(|it| queue(it.chain, start(it.x))).collect()
        }
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
