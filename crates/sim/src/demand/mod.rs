//! Demand: how many vehicles arrive, of which kind, from where and to where, and at which headways.
//!
//! * `departure.rs` vehicles that depart at known times
//! * `arrivals.rs` the part `Arrivals`; `source.rs` origins and their queues, `destinations.rs` where their trips lead;
//!   `rate.rs`, `headways.rs` and `places.rs` when and where vehicles arrive
//! * `perimeter_control.rs` when trips may begin through a full town
//! * `assignment.rs` where a demand leads; `capacity` of `laneweave_scenario` estimates capacity from it

pub(crate) mod arrivals;
pub(crate) mod assignment;
pub(crate) mod departure;
pub(crate) mod destinations;
pub(crate) mod error;
pub(crate) mod headways;
pub(crate) mod line;
pub(crate) mod perimeter_control;
pub(crate) mod places;
pub(crate) mod rate;
pub(crate) mod source;

use laneweave_network::Network;

use crate::demand::departure::Departure;
use crate::demand::error::WorldError;
use crate::demand::headways::Headways;
use crate::demand::line::{Departures, Line};
use crate::demand::places::Places;
use crate::demand::rate::Rate;
use crate::route::place::Place;
use crate::state::lane::VehicleId;
use crate::state::random::{Purpose, Random};
use crate::state::vehicle::{Classes, Fleet};

/// Which vehicles drive, from where and to where, and how many.
#[derive(Clone, Debug, PartialEq)]
pub struct Demand {
    /// Where trips start.
    pub origins: Vec<Origin>,
    /// Where they end.
    pub destinations: Vec<Place>,
    /// Headway distribution in each lane.
    pub headways: Headways,
    /// Shares of the classes of vehicles.
    pub fleet: Fleet,
    /// The styles and their weights.
    pub population: Vec<Share>,
    /// Lines of buses.
    pub lines: Vec<Line>,
    /// Single vehicles, in the order of their times.
    pub departures: Vec<Departure>,
    /// How many of the last destinations are stops of lines: no other trip ends there.
    pub stops: usize,
}

/// A place at which trips start.
#[derive(Clone, Debug, PartialEq)]
pub struct Origin {
    /// Where it is.
    pub place: Place,
    /// Number of vehicles that arrive per hour.
    pub rate: Rate,
    /// Weight of each destination. A destination that cannot be reached from here does not count.
    pub weights: Vec<f64>,
    /// Whether destinations count for which the road is too short.
    pub trips: Trips,
}

/// Which trips from an origin count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trips {
    /// Those with road enough for the lane changes of their route; all, if none has it.
    InTime,
    /// All that have a weight: somebody has asked for them.
    All,
    /// All that have a weight. Their vehicles come by [`Demand::departures`] alone: the rate and the weights say what
    /// these are in the mean.
    Scheduled,
}

/// A style's share of the drivers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// Its weight.
    pub weight: f64,
    /// Index of its first set in the table of driver parameters.
    pub first: u32,
    /// Number of its sets.
    pub count: u32,
}

impl Share {
    /// The index of one of its sets of driver parameters for the vehicle `id`, drawn at random.
    pub(crate) fn draw(&self, random: &Random, id: VehicleId) -> u32 {
        let character = random.uniform(id, Purpose::Character, 0);
        self.first + ((character * f64::from(self.count)) as u32).min(self.count - 1)
    }
}

impl Demand {
    /// A demand of `total` vehicles per hour over all entrances, by their numbers of lanes; all destinations have equal
    /// weights.
    pub fn even(network: &Network, total: f64, trucks: f64, population: Vec<Share>) -> Demand {
        Demand::over(network, Places::at_gates(network), total, Fleet::with_trucks(trucks), population)
    }

    /// A demand of `total` vehicles per hour over all origins of `network`, by the numbers of their lanes for cars; all
    /// destinations have equal weights.
    pub fn over(
        network: &Network,
        places: Places,
        total: f64,
        fleet: Fleet,
        population: Vec<Share>,
    ) -> Demand {
        let Places { origins, destinations } = places;
        let lanes: usize = origins.iter().map(|it| it.lanes(network)).sum();
        let weights = vec![1.0; destinations.len()];
        let origin = |place: Place| {
            let rate = total * place.lanes(network) as f64 / lanes.max(1) as f64;
            Origin { place, rate: Rate::constant(rate), weights: weights.clone(), trips: Trips::InTime }
        };
        Demand {
            origins: origins.into_iter().map(origin).collect(),
            destinations,
            headways: Headways::default(),
            fleet,
            population,
            lines: Vec::new(),
            departures: Vec::new(),
            stops: 0,
        }
    }
}

impl Demand {
    /// The index of a set of driver parameters for the vehicle `id`, drawn at random from the population, whose styles
    /// have these `weights`.
    pub(crate) fn draw_driver(&self, weights: &[f64], random: &Random, id: VehicleId) -> u32 {
        let mut at = random.uniform(id, Purpose::Style, 0) * weights.iter().sum::<f64>();
        let drawn = self.population.iter().zip(weights).find(|(_, weight)| {
            at -= *weight;
            at < 0.0
        });
        // By rounding, nobody may be drawn: then it is the last style that anybody has.
        let last = || self.population.iter().zip(weights).rfind(|(_, weight)| **weight > 0.0);
        drawn.or_else(last).map_or(0, |(it, _)| it.draw(random, id))
    }

    /// Checks that all its numbers are sensible.
    ///
    /// # Errors
    /// The first number that is not.
    pub(crate) fn check(&self, network: &Network) -> Result<(), WorldError> {
        let rates = self.origins.iter().flat_map(|it| it.rate.values());
        let rates = rates.map(|it| ("a demand in veh/h", it, Demand::LARGEST_RATE));
        let weights = self.origins.iter().flat_map(|it| &it.weights);
        let exits = weights.map(|it| ("the weight of an exit", *it, f64::MAX));
        let styles = self.population.iter().map(|it| ("the weight of a style", it.weight, f64::MAX));
        let Fleet { trucks, buses, motorcycles, taxis, emergency } = self.fleet;
        let [(_, cars), ..] = self.fleet.shares();
        let classes = [
            ("the share of trucks", trucks, 1.0),
            ("the share of buses", buses, 1.0),
            ("the share of motorcycles", motorcycles, 1.0),
            ("the share of taxis", taxis, 1.0),
            ("the share of emergency vehicles", emergency, 1.0),
            ("the share of cars", cars, 1.0),
        ];
        for (what, value, largest) in rates.chain(exits).chain(styles).chain(classes) {
            if !(0.0..=largest).contains(&value) {
                let limit =
                    if largest == f64::MAX { String::new() } else { format!(" and not above {largest}") };
                return Err(WorldError::Demand { what, value, limit });
            }
        }
        if self.population.iter().map(|it| it.weight).sum::<f64>() <= 0.0 {
            return Err(WorldError::NoDriverParameters);
        }
        for origin in &self.origins {
            self.headways.check(origin.rate_of_a_lane(network))?;
        }
        if self.stops > self.destinations.len() {
            return Err(WorldError::Stops { stops: self.stops, destinations: self.destinations.len() });
        }
        if let Some(line) = self.lines.iter().find(|it| !self.knows(it)) {
            return Err(WorldError::Line(line.name.clone()));
        }
        let is_after = |pair: &[Departure]| pair[0].time_s <= pair[1].time_s;
        if !(self.departures.iter().all(|it| it.fits(self)) && self.departures.windows(2).all(is_after)) {
            return Err(WorldError::Departures);
        }
        if self.destinations.len() > Demand::MOST_DESTINATIONS {
            return Err(WorldError::Destinations(self.destinations.len(), Demand::MOST_DESTINATIONS));
        }
        Ok(())
    }

    /// Whether a line has places that the demand has, and possible times.
    fn knows(&self, line: &Line) -> bool {
        let Departures { first_s, every_s, until_s } = line.departures;
        let [exits, all] = [self.exits().len(), self.destinations.len()];
        let mut rests = line.stops.iter().map(|stop| stop.rest_s);
        line.origin < self.origins.len()
            && line.destination < exits
            && line.stops.iter().all(|it| (exits..all).contains(&it.destination))
            && rests.all(|it| it.is_finite() && it >= 0.0)
            && first_s >= 0.0
            && (Departures::SHORTEST..f64::INFINITY).contains(&every_s)
            && !until_s.is_nan()
    }

    /// The mean rate of each origin between two times [s] [veh/h]. If no vehicle arrives in that time, every lane of
    /// the origins gets the same flow.
    pub fn mean_rates(&self, network: &Network, [from, until]: [f64; 2]) -> Vec<f64> {
        let means: Vec<f64> = self.origins.iter().map(|it| it.rate.mean(from, until)).collect();
        if means.iter().any(|it| *it > 0.0) {
            return means;
        }
        self.origins.iter().map(|it| it.place.lanes(network) as f64).collect()
    }

    /// The destinations that are no stops of lines.
    pub fn exits(&self) -> &[Place] {
        &self.destinations[..self.destinations.len() - self.stops]
    }

    /// The classes that drive: those of the fleet, of lines and of departures.
    pub(crate) fn classes(&self) -> Classes {
        let single = self.departures.iter().map(|it| it.class);
        self.lines.iter().map(|it| it.class).chain(single).collect::<Classes>().and(self.fleet.classes())
    }

    /// A rate above this at one origin is an error [veh/h].
    pub(crate) const LARGEST_RATE: f64 = 100_000.0;
    /// A vehicle stores its destination, route and class restriction in two bytes.
    pub(crate) const MOST_DESTINATIONS: usize = 32_000;
}

impl Origin {
    /// The highest rate in each of its lanes [1/s].
    pub fn rate_of_a_lane(&self, network: &Network) -> f64 {
        self.rate.highest() / (SECONDS_PER_HOUR * self.lanes(network) as f64)
    }

    /// The number of its lanes: of those for cars, if there is one.
    pub(crate) fn lanes(&self, network: &Network) -> usize {
        match self.place.lanes(network) {
            0 => self.place.chains().len(),
            count => count,
        }
    }
}

/// Seconds in an hour.
pub(crate) const SECONDS_PER_HOUR: f64 = 3600.0;
