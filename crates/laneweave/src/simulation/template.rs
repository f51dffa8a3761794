//! Many simulations of one scenario, which share all that does not change.

use std::num::NonZero;
use std::sync::Arc;

use laneweave_scenario::scenario::{self, Origin, Prepared, Scenario};
use laneweave_scenario::{Fault, FaultKind};

use super::{Builder, Simulation};

/// A scenario of which many simulations are made, each with a seed of its own. They share the map, the routes, the
/// drivers and the demand, so that each takes little time and memory. Copies are the same template.
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
}

impl Template {
    /// A template of the scenario in the file at `path` (.toml), or of a bare map with the default demand.
    ///
    /// # Errors
    /// If the file, its map or a style is missing, not readable, or invalid.
    pub fn from_file(path: impl AsRef<std::path::Path>) -> Result<Template, Fault> {
        Simulation::from_file(path)?.into_template()
    }

    /// The scenario, with the seed of the drivers.
    pub fn scenario(&self) -> &Scenario {
        &self.0.scenario
    }

    /// A simulation at its start, with this seed of all random numbers. It has as many threads as `run.threads` says,
    /// and one if that is not set.
    ///
    /// # Errors
    /// If the system does not start so many threads.
    pub fn spawn(&self, seed: u64) -> Result<Simulation, Fault> {
        self.spawn_on(seed, self.0.scenario.run.threads.map_or(1, NonZero::get))
    }

    /// A simulation at its start on so many threads.
    pub(crate) fn spawn_on(&self, seed: u64, threads: usize) -> Result<Simulation, Fault> {
        let Shared { scenario, origin, prepared, has_map_file } = &*self.0;
        let mut scenario = scenario.clone();
        scenario.run.seed = seed;
        let prepared = prepared.spawn(seed, threads).map_err(|error| {
            Fault::new(origin.place(&["run", "threads"]), error, "choose fewer, or close other programs")
        })?;
        let (origin, template, has_map_file) = (Arc::clone(origin), Some(self.clone()), *has_map_file);
        let [is_commanded, is_changed] = [false; 2];
        Ok(Simulation { scenario, origin, prepared, template, has_map_file, is_commanded, is_changed })
    }

    /// Makes what a simulation of this template simulates begin anew with this seed.
    pub(super) fn reset(&self, prepared: &mut Prepared, seed: u64) {
        self.0.prepared.reset(prepared, seed);
    }
}

impl Builder {
    /// A template of the simulation.
    ///
    /// # Errors
    /// If the map or a style is missing, not readable, or invalid, or if a value is not in its range.
    pub fn template(self) -> Result<Template, Fault> {
        self.build()?.into_template()
    }
}

impl Simulation {
    /// A template of simulations like this one, which is at its start.
    ///
    /// # Errors
    /// If it has made a step, or was changed.
    pub fn into_template(self) -> Result<Template, Fault> {
        if !self.is_as_it_began() {
            let what = "this simulation has begun";
            let remedy = "make the template of one that is at its start";
            return Err(Fault::new("template", what, remedy).of_kind(FaultKind::State));
        }
        let Simulation { mut scenario, origin, prepared, has_map_file, .. } = self;
        scenario.run.drivers_seed = Some(scenario.run.seed_of_drivers());
        Ok(Template(Arc::new(Shared { scenario, origin, prepared: prepared.into(), has_map_file })))
    }
}
