//! The vehicles that arrive, and those that wait to enter.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::demand::Demand;
use crate::demand::destinations::late_trips;
use crate::demand::perimeter_control::PerimeterControl;
use crate::demand::source::{Arrival, Coming, Queue, Source};
use crate::route::in_time::{LateTrip, LateTrips};
use crate::route::roads::Roads;
use crate::state::clock::Clock;
use crate::state::externals::FIRST_INSERTED;
use crate::state::goal::Destination;
use crate::state::lane::{Lane, VehicleId};
use crate::state::random::Random;
use crate::state::vehicle::Class;
use crate::view::scene::Scene;

/// The demand, and the queues of the vehicles that have arrived. Copies share the demand.
#[derive(Clone)]
pub(crate) struct Arrivals {
    demand: Arc<Demand>,
    late: Arc<LateTrips>,
    backlog: Backlog,
}

/// What the vehicles of a line did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct LineCount {
    /// Vehicles that have departed, or wait to enter the map.
    pub departed: u32,
    /// Stops that they served.
    pub served: u64,
    /// Stops that they could not get to in time.
    pub missed: u64,
}

/// The insertion backlog, and what decides whether it may enter: all of [`Arrivals`] that changes.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Backlog {
    /// By origin of the demand.
    sources: Vec<Source>,
    /// `None` where the map has no town core.
    perimeter: Option<PerimeterControl>,
    /// The weight of each style of the population.
    weights: Vec<f64>,
    /// By line of the demand.
    lines: Vec<LineCount>,
    /// How many of the demand's departures have come.
    departed: u32,
    next_id: VehicleId,
    /// That of the next vehicle that a user puts on the road.
    next_inserted: VehicleId,
}

impl Arrivals {
    /// No vehicle has arrived yet.
    pub(crate) fn new(roads: &Roads, mut demand: Demand) -> Arrivals {
        let (network, navigator) = (roads.network(), roads.navigator());
        let late = late_trips(network, navigator, &demand);
        let sources = Source::all(network, navigator, &demand, &late.late, &roads.random());
        for &LateTrip { origin, destination, .. } in &late.late {
            let weight = demand.origins[origin].weights.get_mut(destination);
            if let Some(weight) =
                weight.filter(|_| !sources[origin].leads_to(destination, Class::Car, navigator))
            {
                *weight = 0.0;
            }
        }
        let perimeter = PerimeterControl::new(roads.network());
        let weights = demand.population.iter().map(|it| it.weight).collect();
        let lines = vec![LineCount::default(); demand.lines.len()];
        let (next_id, next_inserted) = (0, FIRST_INSERTED);
        let backlog = Backlog { sources, perimeter, weights, lines, departed: 0, next_id, next_inserted };
        Arrivals { demand: Arc::new(demand), late: Arc::new(late), backlog }
    }

    /// The same arrivals, of which none has come yet, with other random numbers.
    pub(crate) fn drawn_with(&self, random: &Random) -> Arrivals {
        let mut arrivals = self.clone();
        arrivals.backlog.sources.iter_mut().for_each(|it| it.draw_first(random));
        arrivals
    }

    /// The demand: which vehicles arrive, from where and to where.
    pub(crate) fn demand(&self) -> &Demand {
        &self.demand
    }

    /// The trips with too little road for their lane changes.
    pub(crate) fn late(&self) -> &LateTrips {
        &self.late
    }

    /// The origins of the demand.
    pub(crate) fn sources(&self) -> &[Source] {
        &self.backlog.sources
    }

    /// The queues of an origin, mutable.
    pub(crate) fn queues_mut(&mut self, origin: usize) -> &mut [Queue] {
        self.backlog.sources[origin].queues()
    }

    /// The id that the next vehicle gets that a user puts on the road.
    pub(crate) fn next_inserted(&self) -> VehicleId {
        self.backlog.next_inserted
    }

    /// Sets the rate at which vehicles arrive at an origin after `time` [s] to `rate` [veh/h].
    pub(crate) fn set_rate(&mut self, origin: usize, rate: f64, random: &Random, time: f64) {
        self.backlog.sources[origin].set_rate(rate, random, time);
    }

    /// The weight of each style of the population.
    pub(crate) fn weights(&self) -> &[f64] {
        &self.backlog.weights
    }

    /// Sets the weight of a style of the population for the vehicles that arrive from now on.
    pub(crate) fn set_weight(&mut self, style: usize, weight: f64) {
        self.backlog.weights[style] = weight;
    }

    /// The index of a set of driver parameters for the vehicle `id`, drawn at random.
    pub(crate) fn draw_driver(&self, random: &Random, id: VehicleId) -> u32 {
        self.demand.draw_driver(&self.backlog.weights, random, id)
    }

    /// The id of a new vehicle.
    pub(crate) fn new_id(&mut self) -> VehicleId {
        let id = self.backlog.next_id;
        self.backlog.next_id += 1;
        id
    }

    /// The id of a new vehicle that a user puts on the road.
    pub(crate) fn new_inserted(&mut self) -> VehicleId {
        let id = self.backlog.next_inserted;
        self.backlog.next_inserted += 1;
        id
    }

    /// Whether the town core is full. Then no trip through it may begin.
    pub(crate) fn is_full(&self) -> bool {
        self.backlog.perimeter.as_ref().is_some_and(PerimeterControl::is_full)
    }

    /// Measures how full the town core is.
    pub(crate) fn measure(&mut self, lanes: &[Lane]) {
        self.backlog.perimeter.iter_mut().for_each(|it| it.measure(lanes));
    }

    /// The vehicles whose departures are due by `time` [s] join the queues of their origins.
    pub(crate) fn depart(&mut self, scene: &Scene, random: &Random, time: f64) {
        let Arrivals { demand, backlog: Backlog { sources, departed, weights, lines, next_id, .. }, .. } =
            self;
        while let Some(due) = demand.departures.get(*departed as usize).filter(|it| it.time_s <= time) {
            let id = *next_id;
            let style = due.style.map(|it| &demand.population[it]);
            let parameters =
                style.map_or_else(|| demand.draw_driver(weights, random, id), |it| it.draw(random, id));
            let goal = due.line.map_or(due.destination as u16, |it| demand.lines[it].goal(0));
            let arrival = Arrival {
                id,
                time: due.time_s,
                class: due.class,
                length: due.length_m.unwrap_or(due.class.body().length),
                parameters,
                destination: scene.navigator.seen_by(due.class, Some(goal)),
                is_through_town: false,
                line: due.line.map(|it| it as u16),
            };
            sources[due.origin].join(scene, arrival);
            due.line.into_iter().for_each(|it| lines[it].departed += 1);
            *departed += 1;
            *next_id += 1;
        }
    }

    /// The vehicles that arrive at an origin by `time` [s] join its queues.
    pub(crate) fn arrive(&mut self, origin: usize, scene: &Scene, random: &Random, time: f64) {
        let Arrivals { demand, backlog: Backlog { sources, perimeter, weights, lines, next_id, .. }, .. } =
            self;
        let coming = Coming { demand, weights, perimeter: perimeter.as_ref() };
        sources[origin].arrive(scene, coming, random, time, next_id);
        for ((line, count), number) in demand.lines.iter().zip(lines).zip(0..) {
            while line.origin == origin && line.departures.time(count.departed) <= time {
                let (id, came) = (*next_id, line.departures.time(count.departed));
                let parameters = demand.draw_driver(weights, random, id);
                let destination = scene.navigator.seen_by(line.class, Some(line.goal(0)));
                let (class, is_through_town) = (line.class, false);
                let line = Some(number);
                let (time, length) = (came, class.body().length);
                let arrival =
                    Arrival { id, time, class, length, parameters, destination, is_through_town, line };
                sources[origin].join(scene, arrival);
                (*next_id, count.departed) = (id + 1, count.departed + 1);
            }
        }
    }

    /// What the vehicles of each line did.
    pub(crate) fn lines(&self) -> &[LineCount] {
        &self.backlog.lines
    }

    /// Counts a stop that a vehicle of a line served, or missed.
    pub(crate) fn count_stop(&mut self, line: usize, is_served: bool) {
        let LineCount { served, missed, .. } = &mut self.backlog.lines[line];
        *(if is_served { served } else { missed }) += 1;
    }

    /// Counts the stops of lines anew.
    pub(crate) fn reset_stops(&mut self) {
        self.backlog.lines.iter_mut().for_each(|it| (it.served, it.missed) = (0, 0));
    }

    /// Vehicles that wait to enter.
    pub(crate) fn count_waiting(&self) -> usize {
        self.backlog.sources.iter().map(Source::waiting).sum()
    }

    /// Vehicles that have arrived, whether they entered or wait.
    pub(crate) fn count_arrived(&self) -> u64 {
        let of_lines = self.backlog.lines.iter().map(|it| u64::from(it.departed));
        let departed = self.demand.departures.iter().take(self.backlog.departed as usize);
        let single = departed.filter(|it| it.line.is_none()).count() as u64;
        self.backlog.sources.iter().map(Source::arrived).chain(of_lines).chain([single]).sum()
    }

    /// All of it that changes.
    pub(crate) fn backlog(&self) -> &Backlog {
        &self.backlog
    }

    /// Continues from a saved backlog. The caller has checked that it fits.
    pub(crate) fn restore(&mut self, backlog: Backlog) {
        self.backlog = backlog;
    }
}

impl Backlog {
    /// Whether it belongs to the same demand and roads as `other` at `clock`, with this many sets of driver parameters,
    /// and names known destinations only.
    pub(crate) fn fits(
        &self,
        other: &Backlog,
        clock: Clock,
        driver_parameters: usize,
        is_known: impl Fn(Destination) -> bool,
    ) -> bool {
        let Backlog { sources, perimeter, weights, lines, departed: _, next_id: _, next_inserted } = self;
        let perimeter_fits = match (perimeter, &other.perimeter) {
            (Some(one), Some(other)) => one.fits(other),
            (one, other) => one.is_none() && other.is_none(),
        };
        let source_fits = |(one, other): (&Source, &Source)| {
            one.fits(other, clock, driver_parameters, lines.len(), &is_known)
        };
        sources.len() == other.sources.len()
            && sources.iter().zip(&other.sources).all(source_fits)
            && perimeter_fits
            && weights.len() == other.weights.len()
            && lines.len() == other.lines.len()
            && weights.iter().all(|it| *it >= 0.0)
            && weights.iter().sum::<f64>() > 0.0
            && *next_inserted >= FIRST_INSERTED
    }

    /// The ids of the vehicles that wait to enter.
    pub(crate) fn ids(&self) -> Vec<VehicleId> {
        self.sources.iter().flat_map(Source::lanes).flat_map(|it| &it.waiting).map(|it| it.id).collect()
    }

    /// The ids of the next vehicle of the demand, and of the next one that a user puts on the road.
    pub(crate) fn next_ids(&self) -> [VehicleId; 2] {
        [self.next_id, self.next_inserted]
    }
}
