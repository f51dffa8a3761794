//! Scenario files: the input of a simulation, in TOML. Every key except the map has a default.

mod basis;
mod conditions;
mod demand;
mod external;
mod headways;
mod line;
mod made_signals;
mod map;
mod mixture;
mod obstacle;
mod origin;
mod prepare;
mod replay;
mod saved;
mod scheduled;
mod settling;
mod signals;
mod template;
mod turns;
mod written;
mod written_id;

use std::collections::{BTreeMap, BTreeSet};
use std::num::NonZero;
use std::path::PathBuf;

use laneweave_study::Format;
use schemars::{JsonSchema, Schema, schema_for};
use serde::{Deserialize, Serialize};

use crate::style::{DEFAULT_MIXTURE, Model};
use crate::sumo::Sumo;
use written_id::WrittenId;

pub use basis::Basis;
pub use conditions::Conditions;
pub use external::External;
pub use headways::Headways;
pub(crate) use line::inner_place;
pub use line::{Line, Stop};
pub use map::{open_map, read_map};
pub use mixture::mixture;
pub use obstacle::Obstacle;
pub use origin::Origin;
pub(crate) use prepare::LONGEST;
pub use prepare::{Prepared, driven, driving, prepare, prepare_on, prepare_playing, prepare_recorded};
pub use replay::Replay;
pub use signals::{MadeSignals, Signal, SignalPhase};
pub use template::Template;
pub use turns::Turns;
pub use written::write;

/// A scenario of laneweave: a map, the traffic on it, and the output.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// The map file (Lanelet2: .osm, CommonRoad: .xml), relative to the scenario file.
    pub map: PathBuf,
    /// How the map is read.
    #[serde(default)]
    pub map_options: MapOptions,
    /// The demand: how many vehicles arrive, of which classes, and where they go.
    #[serde(default)]
    pub demand: Demand,
    /// Turning shares at junctions, in place of the weights of the exits.
    #[serde(default)]
    pub turns: Vec<Turns>,
    /// Signal programs of traffic lights; all other traffic lights get a generated program.
    #[serde(default)]
    pub signals: Vec<Signal>,
    /// Kind of the generated signal programs.
    #[serde(default)]
    pub made_signals: MadeSignals,
    /// A table of commands that are given again (.parquet, .csv): the table `commands` of a run, or one written by
    /// hand; relative to the scenario file.
    #[serde(default)]
    pub commands: Option<PathBuf>,
    /// External vehicles: the scenario puts them on the road, and a program may drive them.
    #[serde(default)]
    pub external: Vec<External>,
    /// Obstacles that stand on the road for some time.
    #[serde(default)]
    pub obstacle: Vec<Obstacle>,
    /// A recording whose vehicles drive as they were recorded, or react.
    #[serde(default)]
    pub replay: Replay,
    /// Vehicles of SUMO, on a net of SUMO: all traffic of the demand.
    #[serde(default)]
    pub sumo: Sumo,
    /// Guidance: the information on travel times that drivers get.
    #[serde(default)]
    pub guidance: Guidance,
    /// Duration, step and seed of the simulation.
    #[serde(default)]
    pub run: Run,
    /// The styles of the drivers with their weights: names of built-in styles, or paths of style files (FILE.toml)
    /// relative to the scenario file. None of them: the drivers of SUMO's vehicles have those of their types.
    #[serde(default = "default_styles")]
    pub styles: BTreeMap<String, f64>,
    /// One lane-change model for all drivers, in place of those of their styles.
    #[serde(default)]
    pub model: Option<Model>,
    /// Output: which files are written, and where.
    #[serde(default)]
    pub output: Output,
}

/// How the map is read.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct MapOptions {
    /// Latitude and longitude [°] of the origin (0, 0); default: those of the map's first node, rounded to 0.1°.
    pub origin: Option<[f64; 2]>,
    /// The traffic law: its speed limits apply where the map gives none, trucks and buses have limits of their own, and
    /// some drivers keep to the slow side.
    pub law: Law,
    /// The side of the road on which traffic drives; default: the side that the map gives, otherwise right.
    pub driving_side: Option<DrivingSide>,
    /// Whether lanelets that meet at their ends, but share no points, continue one another: for maps that were drawn
    /// carelessly.
    pub joins_ends: bool,
    /// Largest size of the map, unpacked if it is compressed [MB]; default 1 GiB, at most 2 GiB.
    pub max_size_mb: Option<f64>,
}

/// A traffic law.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Law {
    /// Germany.
    #[default]
    Germany,
    /// Most of the United States.
    Usa,
}

impl From<Law> for laneweave_maps::Law {
    fn from(law: Law) -> laneweave_maps::Law {
        match law {
            Law::Germany => laneweave_maps::Law::Germany,
            Law::Usa => laneweave_maps::Law::UnitedStates,
        }
    }
}

/// A side of the road.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum DrivingSide {
    /// Traffic drives on the left.
    Left,
    /// Traffic drives on the right.
    Right,
}

/// The demand: how many vehicles arrive, of which classes, and where they go.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Demand {
    /// Vehicles per hour in total, split over the entrances by their number of lanes for cars; default: at most
    /// 63 % of the estimated capacity, of each entrance what it bears.
    pub vehicles_per_hour: Option<f64>,
    /// Share of trucks, 0 to 1.
    pub trucks: f64,
    /// Share of buses, 0 to 1.
    pub buses: f64,
    /// Share of motorcycles, 0 to 1.
    pub motorcycles: f64,
    /// Share of taxis, 0 to 1: they may use lanes for buses.
    pub taxis: f64,
    /// Share of vehicles of police, fire brigade and ambulance, on usual trips, 0 to 1; all other vehicles are cars.
    pub emergency: f64,
    /// Vehicles per hour at single entrances (keys: the smallest lanelet id of the entrance), in place of their share
    /// of the total.
    pub entrances: BTreeMap<String, VehiclesPerHour>,
    /// Weights of the exits as destinations (keys: the smallest lanelet id of the exit); default 1.
    pub exits: BTreeMap<String, f64>,
    /// Vehicles per hour from single entrances to single exits, in place of the entrance's share of the total and the
    /// weights of the exits.
    pub od: Vec<OdRow>,
    /// Lines of buses, beside all other demand.
    pub line: Vec<Line>,
    /// Factors on all demands: [[time_s, factor], …]. Each factor holds from its time on, counted from the start of
    /// the simulation (with the warm-up).
    pub profile: Vec<[f64; 2]>,
    /// Distribution of the headways, the times between arrivals in a lane; its mean follows from the demand.
    pub headways: Headways,
}

impl Default for Demand {
    fn default() -> Demand {
        Demand {
            vehicles_per_hour: None,
            trucks: 0.1,
            buses: 0.0,
            motorcycles: 0.0,
            taxis: 0.0,
            emergency: 0.0,
            entrances: BTreeMap::new(),
            exits: BTreeMap::new(),
            od: Vec::new(),
            line: Vec::new(),
            profile: Vec::new(),
            headways: Headways::default(),
        }
    }
}

/// Vehicles per hour at an entrance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "invalid value: expected a number or a list [[time_s, vehicles_per_hour], …]")]
pub enum VehiclesPerHour {
    /// A constant rate.
    Constant(f64),
    /// [[time_s, vehicles_per_hour], …]. Each rate holds from its time on, counted from the start of the simulation
    /// (with the warm-up).
    OverTime(Vec<[f64; 2]>),
}

/// A row of the origin–destination matrix.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OdRow {
    /// The smallest lanelet id of the entrance.
    pub from: String,
    /// The smallest lanelet id of the exit.
    pub to: String,
    /// Vehicles per hour.
    pub vehicles_per_hour: f64,
}

/// Guidance: the information on travel times that drivers get.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Guidance {
    /// Time between two measurements of all travel times [s], 1 or more; after each, drivers may choose a better
    /// route. 0: drivers know free-flow travel times only.
    pub interval_s: f64,
}

impl Default for Guidance {
    fn default() -> Guidance {
        Guidance { interval_s: 60.0 }
    }
}

/// Duration, step and seed of the simulation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Run {
    /// Simulated and measured time after the warm-up [s].
    pub duration_s: f64,
    /// Length of a step [s], 0.01 to 1.
    pub step_s: f64,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Seed with which the parameters of drivers are drawn from the distributions of their styles. Default: `seed`.
    pub drivers_seed: Option<u64>,
    /// Simulated time before anything is measured or recorded [s].
    pub warmup_s: f64,
    /// Number of threads; results do not depend on it. Default: the cores of the machine, less one core for writing
    /// if trajectories are recorded; at most 2.
    pub threads: Option<NonZero<usize>>,
    /// Whether to search for overlapping vehicles at every step, not only once a second.
    pub audit: bool,
    /// Number of a draw of the parameters of fitted styles, from 0 on, in place of their estimates: styles that
    /// `laneweave fit` wrote have such draws. Other styles stay as they are.
    pub parameter_draw: Option<u32>,
}

impl Default for Run {
    fn default() -> Run {
        Run {
            duration_s: 600.0,
            step_s: 0.1,
            seed: 1,
            drivers_seed: None,
            warmup_s: 0.0,
            threads: None,
            audit: false,
            parameter_draw: None,
        }
    }
}

impl Run {
    /// The seed with which the parameters of drivers are drawn.
    pub fn seed_of_drivers(&self) -> u64 {
        self.drivers_seed.unwrap_or(self.seed)
    }
}

/// Output: which files are written, and where.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Output {
    /// The folder of all results, relative to the current folder.
    pub dir: PathBuf,
    /// Time between two samples of a trajectory [s]; 0: no trajectories.
    pub record_s: f64,
    /// Length of the intervals over which flow, density and speed of every lanelet are measured [s]; 0: not measured.
    pub flows_s: f64,
    /// Format of the tables.
    pub format: TableFormat,
    /// Output files in SUMO's format.
    pub sumo: BTreeSet<SumoFile>,
    /// Time between two checkpoints, from which an incomplete run can be resumed [s]; 0: no checkpoints.
    pub checkpoint_s: f64,
}

impl Default for Output {
    fn default() -> Output {
        Output {
            dir: "out".into(),
            record_s: 1.0,
            flows_s: 0.0,
            format: TableFormat::default(),
            sumo: BTreeSet::new(),
            checkpoint_s: 0.0,
        }
    }
}

/// A format of tables.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum TableFormat {
    /// Apache Parquet.
    #[cfg(feature = "parquet")]
    #[default]
    Parquet,
    /// Comma-separated values.
    #[cfg_attr(not(feature = "parquet"), default)]
    Csv,
}

impl From<TableFormat> for Format {
    fn from(format: TableFormat) -> Format {
        match format {
            TableFormat::Csv => Format::Csv,
            #[cfg(feature = "parquet")]
            TableFormat::Parquet => Format::Parquet,
        }
    }
}

/// An output file in SUMO's format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum SumoFile {
    /// fcd.xml: every vehicle at every sample.
    Fcd,
    /// tripinfo.xml: every completed trip.
    Tripinfo,
    /// lanechanges.xml: every completed lane change.
    Lanechange,
}

fn default_styles() -> BTreeMap<String, f64> {
    DEFAULT_MIXTURE.into_iter().map(|(name, weight)| (name.into(), weight)).collect()
}

impl Scenario {
    /// The scenario of a bare map.
    pub fn of_map(map: PathBuf) -> Scenario {
        Scenario {
            map,
            map_options: MapOptions::default(),
            demand: Demand::default(),
            turns: Vec::new(),
            signals: Vec::new(),
            made_signals: MadeSignals::default(),
            commands: None,
            external: Vec::new(),
            obstacle: Vec::new(),
            replay: Replay::default(),
            sumo: Sumo::default(),
            guidance: Guidance::default(),
            run: Run::default(),
            styles: default_styles(),
            model: None,
            output: Output::default(),
        }
    }

    /// The JSON schema of scenario files.
    pub fn schema() -> Schema {
        schema_for!(Scenario)
    }
}
