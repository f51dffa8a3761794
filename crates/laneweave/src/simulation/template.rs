//! Many simulations of one scenario, which share all that does not change.

use std::num::NonZero;
use std::sync::Arc;

use laneweave_scenario::Fault;
use laneweave_scenario::scenario::{self, Origin, Prepared, Scenario};

use super::{Builder, Simulation};

/// A scenario of which many simulations are made, each with a seed of its own. They share the map, the routes, the
/// drivers and the demand, so that each takes little time and memory. Copies are the same template.
///
/// A simulation that has begun can be a template, too. What it spawns goes on from there, each with random numbers of
/// its own.
///
/// The parameters of the drivers are drawn once. So the scenario of each simulation has the `run.drivers_seed` of the
/// template: with it, a simulation of that scenario comes to the same traffic.
///
/// ```no_run
/// # fn main() -> Result<(), laneweave::Fault> {
/// let template = laneweave::Template::from_file("scenarios/demo.toml")?;
/// let mut simulation = template.spawn(1)?;
/// for seed in 1..=1000 {
///     simulation.reset(seed)?;
///     simulation.run(60.0)?;
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Clone)]
pub struct Template(Arc<Shared>);

struct Shared {
    scenario: Scenario,
    origin: Arc<Origin>,
    prepared: scenario::Template,
    has_map_file: bool,
    /// Whether it is a simulation that has made a step, or was changed.
    has_begun: bool,
}

impl Template {
    /// A template of the scenario in the file at `path` (.toml), or of a bare map with the default demand.
    ///
    /// # Errors
    /// If the file, its map or a style is missing, not readable, or invalid.
    pub fn from_file(path: impl AsRef<std::path::Path>) -> Result<Template, Fault> {
        Ok(Simulation::from_file(path)?.into_template())
    }

    /// The scenario, with the seed of the drivers.
    pub fn scenario(&self) -> &Scenario {
        &self.0.scenario
    }

    /// A simulation with this seed of all random numbers, which begins where the template is. It has as many threads as
    /// `run.threads` says, and one if that is not set.
    ///
    /// # Errors
    /// If the system does not start so many threads.
    pub fn spawn(&self, seed: u64) -> Result<Simulation, Fault> {
        self.spawn_on(seed, self.0.scenario.run.threads.map_or(1, NonZero::get))
    }

    /// The same on so many threads.
    pub(crate) fn spawn_on(&self, seed: u64, threads: usize) -> Result<Simulation, Fault> {
        let Shared { scenario, origin, prepared, has_map_file, has_begun } = &*self.0;
        let mut scenario = scenario.clone();
        scenario.run.seed = seed;
        let prepared = prepared.spawn(seed, threads).map_err(|error| {
            Fault::new(origin.place(&["run", "threads"]), error, "choose fewer, or close other programs")
        })?;
        let (origin, template, has_map_file) = (Arc::clone(origin), Some(self.clone()), *has_map_file);
        let [is_commanded, is_changed] = [*has_begun; 2];
        Ok(Simulation { scenario, origin, prepared, template, has_map_file, is_commanded, is_changed })
    }

    /// Makes what a simulation of this template simulates begin anew with this seed. Returns whether the template has
    /// made a step, or was changed.
    pub(super) fn reset(&self, prepared: &mut Prepared, seed: u64) -> bool {
        self.0.prepared.reset(prepared, seed);
        self.0.has_begun
    }
}

impl Builder {
    /// A template of the simulation.
    ///
    /// # Errors
    /// If the map or a style is missing, not readable, or invalid, or if a value is not in its range.
    pub fn template(self) -> Result<Template, Fault> {
        Ok(self.build()?.into_template())
    }
}

impl Simulation {
    /// A template of simulations that go on from where this one is.
    #[must_use]
    pub fn into_template(self) -> Template {
        let has_begun = !self.is_as_it_began();
        let Simulation { mut scenario, origin, prepared, has_map_file, .. } = self;
        scenario.run.drivers_seed = Some(scenario.run.seed_of_drivers());
        Template(Arc::new(Shared { scenario, origin, prepared: prepared.into(), has_map_file, has_begun }))
    }
}
