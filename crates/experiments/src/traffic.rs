//! Traffic to drive: a road, who drives there, and how many arrive.

use std::collections::BTreeMap;
use std::num::NonZero;
use std::path::PathBuf;

use laneweave::Fault;
use laneweave::maps::generate::{Motorway, motorway, own_maps};
use laneweave::maps::{Law, Map, MapError};
use laneweave::scenario::{Origin, Prepared, Scenario, VehiclesPerHour, prepare_on};
use laneweave::style::Model;

/// A road.
#[derive(Clone, Debug)]
pub(crate) enum Road {
    /// A motorway.
    Motorway(Motorway),
    /// The map of ours with this file name.
    Own(&'static str),
}

/// Traffic on a road.
#[derive(Clone, Debug)]
pub(crate) struct Traffic {
    /// The road.
    pub(crate) road: Road,
    /// The law of the road.
    pub(crate) law: Law,
    /// The styles with their weights; none: the usual mixture.
    pub(crate) styles: Vec<(&'static str, f64)>,
    /// One lane-change model for all drivers.
    pub(crate) model: Option<Model>,
    /// Vehicles per hour, in total or at single entrances.
    pub(crate) demand: Arriving,
    /// Share of trucks.
    pub(crate) trucks: f64,
    /// Simulated time before anything is measured, and measured time [s].
    pub(crate) times: [f64; 2],
}

/// How many vehicles arrive in an hour.
#[derive(Clone, Debug)]
pub(crate) enum Arriving {
    /// In total.
    Total(f64),
    /// At the entrances with these smallest lanelet ids.
    At(Vec<(&'static str, f64)>),
}

impl Traffic {
    /// The usual drivers on `lanes` of a motorway without ramps and without a law to keep to the slow side, with
    /// `flow` [veh/h] in each lane and 10 % trucks.
    pub(crate) fn on_motorway(lanes: usize, flow: f64) -> Traffic {
        Traffic {
            road: Road::Motorway(Motorway { lanes, ..Motorway::default() }),
            law: Law::UnitedStates,
            styles: Vec::new(),
            model: None,
            demand: Arriving::Total(flow * lanes as f64),
            trucks: 0.1,
            times: [300.0, 900.0],
        }
    }

    /// The world of this traffic with `seed`, its times multiplied by `length`.
    ///
    /// # Errors
    /// None, as long as the built-in maps and styles are valid.
    pub(crate) fn prepared(&self, seed: u64, length: f64) -> Result<Prepared, Fault> {
        let mut scenario = Scenario::of_map(PathBuf::from("built in"));
        if !self.styles.is_empty() {
            scenario.styles =
                self.styles.iter().map(|(name, weight)| ((*name).to_owned(), *weight)).collect();
        }
        scenario.model = self.model;
        scenario.demand.trucks = self.trucks;
        match &self.demand {
            Arriving::Total(flow) => scenario.demand.vehicles_per_hour = Some(*flow),
            Arriving::At(entrances) => {
                let at = |(id, flow): &(&str, f64)| ((*id).to_owned(), VehiclesPerHour::Constant(*flow));
                scenario.demand.entrances = entrances.iter().map(at).collect::<BTreeMap<_, _>>();
            }
        }
        let whole = |seconds: f64| (seconds * length).round().max(1.0);
        [scenario.run.warmup_s, scenario.run.duration_s] = self.times.map(whole);
        scenario.run.seed = seed;
        scenario.run.threads = NonZero::new(1);
        let mut map =
            self.road.map().map_err(|error| Fault::new("built-in map", error, "report this as a bug"))?;
        map.network.lane_use = self.law.lane_use();
        prepare_on(map, &scenario, &Origin::default())
    }
}

impl Road {
    fn map(&self) -> Result<Map, MapError> {
        match self {
            Road::Motorway(road) => motorway(road).map_err(|_| MapError::Missing)?.build(),
            Road::Own(name) => {
                let maps = own_maps().map_err(|_| MapError::Missing)?;
                let drawing = maps.into_iter().find(|it| it.0 == *name).ok_or(MapError::Missing)?.1;
                drawing.build()
            }
        }
    }
}
