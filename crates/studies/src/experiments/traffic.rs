//! Traffic to drive: a road, who drives there, and how many arrive.

use std::collections::BTreeMap;
use std::num::NonZero;
use std::path::PathBuf;

use laneweave::generate::{
    Arterial, Grid, Motorway, Roundabout, arterial, grid, large_town, motorway, own_maps, roundabout,
};
use laneweave::maps::{Law, Map, MapError};
use laneweave::network::DrivingSide;
use laneweave::scenario::{OdRow, Origin, Scenario, Signal, SignalPhase, VehiclesPerHour, mixture};
use laneweave::style::{Model, StyleTemplate};
use laneweave::{Fault, Simulation};
use toml::{Table, Value};

#[derive(Clone, Debug)]
pub(crate) enum Road {
    Motorway(Motorway),
    /// The map of ours with this file name.
    Own(&'static str),
    /// The larger town with so many streets in each direction.
    Town(usize),
    /// A main street with one junction at lights, which are green for the approach from the west for most of the time.
    Lights,
    /// Two streets of one lane in each direction that cross at lights. In each cycle [s] the first street, which runs
    /// east and west, has this green [s].
    Crossing {
        cycle: f64,
        green: f64,
    },
    /// A roundabout with so many lanes.
    Roundabout(usize),
}

/// A change of the styles, in those that have its key.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Change {
    /// The number at this key is multiplied.
    Times(&'static str, f64),
    /// The name at this key is replaced.
    Named(&'static str, &'static str),
}

/// Traffic on a road.
#[derive(Clone, Debug)]
pub(crate) struct Traffic {
    pub(crate) road: Road,
    /// The law of the road.
    pub(crate) law: Law,
    /// The styles with their weights; none: the usual mixture.
    pub(crate) styles: Vec<(&'static str, f64)>,
    /// Changes of the styles.
    pub(crate) changes: Vec<Change>,
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
    /// From entrances to exits with these smallest lanelet ids.
    Between(Vec<([&'static str; 2], f64)>),
}

impl Traffic {
    /// The usual drivers on `lanes` of a motorway without ramps and without a law to keep to the slow side, with
    /// `flow` [veh/h] in each lane and 10 % trucks.
    pub(crate) fn on_motorway(lanes: usize, flow: f64) -> Traffic {
        Traffic {
            road: Road::Motorway(Motorway { lanes, ..Motorway::default() }),
            law: Law::UnitedStates,
            styles: Vec::new(),
            changes: Vec::new(),
            model: None,
            demand: Arriving::Total(flow * lanes as f64),
            trucks: 0.1,
            times: [300.0, 900.0],
        }
    }

    /// A simulation of this traffic with `seed`, its times multiplied by `length`.
    ///
    /// # Errors
    /// None, as long as the built-in maps and styles are valid.
    pub(crate) fn simulation(&self, seed: u64, length: f64) -> Result<Simulation, Fault> {
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
            Arriving::Between(pairs) => {
                let row = |(ends, flow): &([&str; 2], f64)| {
                    let [from, to] = ends.map(str::to_owned);
                    OdRow { from, to, vehicles_per_hour: *flow }
                };
                scenario.demand.vehicles_per_hour = Some(0.0);
                scenario.demand.od = pairs.iter().map(row).collect();
            }
        }
        scenario.signals = self.road.signals();
        let whole = |seconds: f64| (seconds * length).round().max(1.0);
        [scenario.run.warmup_s, scenario.run.duration_s] = self.times.map(whole);
        scenario.run.seed = seed;
        scenario.run.threads = NonZero::new(1);
        let mut map = self.road.map().map_err(|error| Fault::bug("built-in map", error))?;
        map.network.law = self.law.rules();
        let mut simulation = Simulation::from_scenario_on(map, &scenario, &Origin::default())?;
        if !self.changes.is_empty() {
            simulation.change_styles(&self.changed_styles(&scenario)?)?;
        }
        Ok(simulation)
    }

    /// The styles of `scenario` with the changes.
    fn changed_styles(&self, scenario: &Scenario) -> Result<Vec<(StyleTemplate, f64)>, Fault> {
        let mut changed = mixture(scenario, &Origin::default())?;
        for change in &self.changes {
            for (template, _) in &mut changed {
                *template = change.of(template)?;
            }
        }
        Ok(changed)
    }
}

impl Change {
    /// The style `template` with the change.
    fn of(&self, template: &StyleTemplate) -> Result<StyleTemplate, Fault> {
        let (Change::Times(key, _) | Change::Named(key, _)) = self;
        let path: Vec<String> = key.split('.').map(str::to_owned).collect();
        let Some(value) = Table::try_from(template.typical())
            .ok()
            .and_then(|table| path.iter().try_fold(Value::Table(table), |it, key| it.get(key).cloned()))
        else {
            return Ok(template.clone());
        };
        let value = match (self, value) {
            (Change::Times(_, factor), Value::Float(number)) => Value::Float(number * factor),
            (Change::Named(_, name), Value::String(_)) => Value::String((*name).to_owned()),
            _ => return Ok(template.clone()),
        };
        template.with_value(&path, value, key)
    }
}

impl Road {
    /// Signal programs other than the generated ones.
    fn signals(&self) -> Vec<Signal> {
        /// Of the main street, the lights of the approach from the west, and of the others.
        const WEST: [i64; 2] = [162, 163];
        const OTHERS: [&[i64]; 3] = [&[159, 160], &[161], &[164]];
        /// Of the crossing, the lights of each street.
        const FIRST: [i64; 2] = [173, 175];
        const SECOND: [i64; 2] = [174, 176];
        /// Yellow and all-red of the crossing after each green [s].
        const PAUSE: f64 = 6.0;
        match *self {
            Road::Lights => {
                let others = OTHERS.map(|it| phase(it, 5.0, 2.0));
                vec![program([phase(&WEST, 50.0, 2.0)].into_iter().chain(others).collect())]
            }
            Road::Crossing { cycle, green } => {
                let second = cycle - green - 2.0 * PAUSE;
                vec![program(vec![phase(&FIRST, green, PAUSE - 3.0), phase(&SECOND, second, PAUSE - 3.0)])]
            }
            Road::Motorway(_) | Road::Own(_) | Road::Town(_) | Road::Roundabout(_) => Vec::new(),
        }
    }

    fn map(&self) -> Result<Map, MapError> {
        match self {
            Road::Motorway(road) => motorway(road).map_err(|_| MapError::Missing)?.build(),
            Road::Town(size) => large_town(*size, DrivingSide::Right).map_err(|_| MapError::Missing)?.build(),
            Road::Lights => {
                let street = Arterial { junctions: 1, block_length_m: 600.0, ..Arterial::default() };
                arterial(&street).map_err(|_| MapError::Missing)?.build()
            }
            Road::Crossing { .. } => {
                let streets =
                    Grid { rows: 1, columns: 1, lanes: 1, block_length_m: 1000.0, ..Grid::default() };
                grid(&streets).map_err(|_| MapError::Missing)?.build()
            }
            Road::Roundabout(lanes) => {
                let wanted = Roundabout { lanes: *lanes, ..Roundabout::default() };
                roundabout(&wanted).map_err(|_| MapError::Missing)?.build()
            }
            Road::Own(name) => {
                let maps = own_maps().map_err(|_| MapError::Missing)?;
                let drawing = maps.into_iter().find(|it| it.0 == *name).ok_or(MapError::Missing)?.1;
                drawing.build()
            }
        }
    }
}

fn program(phases: Vec<SignalPhase>) -> Signal {
    Signal { offset_s: 0.0, cycle_s: None, phases }
}

/// A phase with the lights `green` for so many `seconds`.
fn phase(green: &[i64], seconds: f64, all_red_s: f64) -> SignalPhase {
    SignalPhase {
        green: green.iter().map(|it| (*it).into()).collect(),
        green_s: Some(seconds),
        max_green_s: None,
        min_green_s: None,
        gap_s: None,
        yellow_s: 3.0,
        all_red_s,
    }
}
