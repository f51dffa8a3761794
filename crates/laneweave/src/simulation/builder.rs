//! A simulation, set up value by value.

use std::num::NonZero;
use std::path::{Path, PathBuf};

use laneweave_maps::Map;
use laneweave_scenario::Fault;
use laneweave_scenario::scenario::{Demand, Origin, Scenario, prepare, prepare_on};

use super::Simulation;

/// Where a map comes from.
#[derive(Clone, Debug)]
pub enum MapSource {
    /// A map file.
    File(PathBuf),
    /// A map that was read or generated before.
    Map(Box<Map>),
}

impl From<&str> for MapSource {
    fn from(path: &str) -> MapSource {
        MapSource::File(path.into())
    }
}

impl From<&Path> for MapSource {
    fn from(path: &Path) -> MapSource {
        MapSource::File(path.into())
    }
}

impl From<PathBuf> for MapSource {
    fn from(path: PathBuf) -> MapSource {
        MapSource::File(path)
    }
}

impl From<Map> for MapSource {
    fn from(map: Map) -> MapSource {
        MapSource::Map(Box::new(map))
    }
}

/// A simulation that is being set up. Values that are not given have the defaults of scenario files.
#[derive(Clone, Debug)]
pub struct Builder {
    map: MapSource,
    scenario: Scenario,
    styles: Vec<(String, f64)>,
    threads: Option<usize>,
}

impl Builder {
    pub(super) fn new(map: MapSource) -> Builder {
        // Errors name the map by its path.
        let path = match &map {
            MapSource::File(path) => path.clone(),
            MapSource::Map(_) => PathBuf::from("map"),
        };
        Builder { map, scenario: Scenario::of_map(path), styles: Vec::new(), threads: None }
    }

    /// The demand: how many vehicles arrive, of which classes, and where they go.
    #[must_use]
    pub fn demand(mut self, demand: Demand) -> Builder {
        self.scenario.demand = demand;
        self
    }

    /// Vehicles per hour in total, split over the entrances by their number of lanes for cars.
    #[must_use]
    pub fn vehicles_per_hour(mut self, vehicles_per_hour: f64) -> Builder {
        self.scenario.demand.vehicles_per_hour = Some(vehicles_per_hour);
        self
    }

    /// A style of drivers with its weight: the name of a built-in style, or the path of a style file (.toml) from the
    /// current folder. The first call replaces the default styles, the next ones add to it.
    #[must_use]
    pub fn style(mut self, name_or_file: impl Into<String>, weight: f64) -> Builder {
        self.styles.push((name_or_file.into(), weight));
        self
    }

    /// Seed of all random numbers [default: 1].
    #[must_use]
    pub fn seed(mut self, seed: u64) -> Builder {
        self.scenario.run.seed = seed;
        self
    }

    /// Length of a step [s], 0.01 to 1 [default: 0.1].
    #[must_use]
    pub fn step_s(mut self, step_s: f64) -> Builder {
        self.scenario.run.step_s = step_s;
        self
    }

    /// Simulated time before anything is counted or recorded [s] [default: 0].
    #[must_use]
    pub fn warmup_s(mut self, warmup_s: f64) -> Builder {
        self.scenario.run.warmup_s = warmup_s;
        self
    }

    /// Simulated and measured time after the warm-up [s] [default: 600].
    #[must_use]
    pub fn duration_s(mut self, duration_s: f64) -> Builder {
        self.scenario.run.duration_s = duration_s;
        self
    }

    /// Number of threads, 1 to 256; results do not depend on it [default: the cores of the machine, at most 2].
    #[must_use]
    pub fn threads(mut self, threads: usize) -> Builder {
        self.threads = Some(threads);
        self
    }

    /// Changes any other value of the scenario, such as its lights, its guidance or its output.
    #[must_use]
    pub fn scenario(mut self, change: impl FnOnce(&mut Scenario)) -> Builder {
        change(&mut self.scenario);
        self
    }

    /// The simulation.
    ///
    /// # Errors
    /// If the map or a style is missing, not readable, or invalid, or if a value is not in its range.
    pub fn build(self) -> Result<Simulation, Fault> {
        let Builder { map, mut scenario, styles, threads } = self;
        if !styles.is_empty() {
            scenario.styles = styles.into_iter().collect();
        }
        if let Some(threads) = threads {
            let none = || Fault::new("run.threads", "0 threads", "choose 1 or more");
            scenario.run.threads = Some(NonZero::new(threads).ok_or_else(none)?);
        }
        let origin = Origin::default();
        let has_map_file = matches!(map, MapSource::File(_));
        let prepared = match map {
            MapSource::File(_) => prepare(&scenario, &origin)?,
            MapSource::Map(map) => prepare_on(*map, &scenario, &origin)?,
        };
        Ok(Simulation::new(scenario, origin, prepared, has_map_file))
    }
}
