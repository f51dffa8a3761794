//! A simulation in the words of the road: lanelet ids, and metres along them. Everything that it gives is plain, owned
//! data.

mod builder;
mod commands;
mod evaluation;
mod event;
mod facts;
mod light;
mod observer;
mod queries;
mod restart;
mod results;
mod settings;
mod template;
mod twins;
mod vehicle_state;
mod watch;

use std::sync::Arc;

use laneweave_maps::Map;
use laneweave_network::Network;
use laneweave_scenario::scenario::{
    Conditions, Demand, Origin, Prepared, Scenario, prepare, prepare_on, prepare_playing, prepare_recorded,
};
use laneweave_scenario::{Fault, FaultKind, Player, Recorded};
use laneweave_sim::{Clock, World};
use laneweave_study::seconds;

pub use builder::{Builder, MapSource};
pub use evaluation::{Decision, Evaluation, Leader, Reason, SideEvaluation};
pub use event::{Event, Incident, LaneChange, Occurrence};
pub use light::Light;
pub use observer::Observer;
pub use settings::StyleState;
pub use template::Template;
pub use vehicle_state::VehicleState;
pub use watch::Watcher;

/// A simulation: traffic on a map, which a program steps through, asks, and changes.
///
/// The first step begins at time 0. Simulated time before the end of the warm-up is part of it; at that time all
/// counts begin anew.
pub struct Simulation {
    scenario: Scenario,
    origin: Arc<Origin>,
    pub(crate) prepared: Prepared,
    /// The template that has spawned it, if one has.
    template: Option<Template>,
    /// Whether its map is a file, so that its results can name it.
    has_map_file: bool,
    /// Whether a program has given commands to it.
    is_commanded: bool,
    /// Whether a program has had the world behind it to change.
    is_changed: bool,
}

impl Simulation {
    /// The scenario in the file at `path` (.toml), or a bare map with the default demand.
    ///
    /// # Errors
    /// If the file, its map or a style is missing, not readable, or invalid.
    ///
    /// ```no_run
    /// # fn main() -> Result<(), laneweave::Fault> {
    /// let mut simulation = laneweave::Simulation::from_file("scenarios/demo.toml")?;
    /// simulation.run(60.0)?;
    /// for vehicle in simulation.vehicles() {
    ///     println!("{} on lanelet {} at {} m/s", vehicle.id, vehicle.lanelet, vehicle.speed_mps);
    /// }
    /// # Ok(())
    /// # }
    /// ```
    pub fn from_file(path: impl AsRef<std::path::Path>) -> Result<Simulation, Fault> {
        let (scenario, origin) = Origin::open(path.as_ref())?;
        Simulation::from_scenario(&scenario, &origin)
    }

    /// A map with a demand: a file, or a map that was read or generated before.
    ///
    /// # Errors
    /// If the map is missing, not readable, or invalid, or if the demand does not fit it.
    pub fn from_map(map: impl Into<MapSource>, demand: Demand) -> Result<Simulation, Fault> {
        Simulation::builder(map).demand(demand).build()
    }

    /// The scenario in a text, whose relative paths start in `folder`.
    ///
    /// # Errors
    /// If the text is no scenario, or if its map or a style is missing, not readable, or invalid.
    pub fn from_text(text: &str, folder: impl AsRef<std::path::Path>) -> Result<Simulation, Fault> {
        let (scenario, origin) = Origin::from_text(text, folder.as_ref())?;
        Simulation::from_scenario(&scenario, &origin)
    }

    /// A scenario, with the source of its values.
    ///
    /// # Errors
    /// If its map or a style is missing, not readable, or invalid.
    pub fn from_scenario(scenario: &Scenario, origin: &Origin) -> Result<Simulation, Fault> {
        Ok(Simulation::new(scenario.clone(), origin.clone(), prepare(scenario, origin)?, true))
    }

    /// The same on a map that was read or generated before. The path and the options of the map in the scenario have no
    /// effect.
    ///
    /// # Errors
    /// If a style is missing, not readable, or invalid, or if the demand does not fit the map.
    pub fn from_scenario_on(map: Map, scenario: &Scenario, origin: &Origin) -> Result<Simulation, Fault> {
        Ok(Simulation::new(scenario.clone(), origin.clone(), prepare_on(map, scenario, origin)?, true))
    }

    /// The same as [`from_scenario`](Self::from_scenario), with the recording that `player` plays in place of the one
    /// that the scenario names. The recording is not read again.
    ///
    /// # Errors
    /// If its map or a style is missing, not readable, or invalid.
    pub fn playing(scenario: &Scenario, origin: &Origin, player: Player) -> Result<Simulation, Fault> {
        let prepared = prepare_playing(scenario, origin, player)?;
        Ok(Simulation::new(scenario.clone(), origin.clone(), prepared, true))
    }

    /// The same with a recording in memory.
    ///
    /// # Errors
    /// If its map or a style is missing, not readable, or invalid.
    pub fn replaying(scenario: &Scenario, origin: &Origin, recorded: Recorded) -> Result<Simulation, Fault> {
        let prepared = prepare_recorded(scenario, origin, recorded)?;
        Ok(Simulation::new(scenario.clone(), origin.clone(), prepared, true))
    }

    /// A simulation on a map, set up value by value.
    pub fn builder(map: impl Into<MapSource>) -> Builder {
        Builder::new(map.into())
    }

    fn new(scenario: Scenario, origin: Origin, prepared: Prepared, has_map_file: bool) -> Simulation {
        let (origin, template, [is_commanded, is_changed]) = (Arc::new(origin), None, [false; 2]);
        Simulation { scenario, origin, prepared, template, has_map_file, is_commanded, is_changed }
    }

    /// Simulates one step, and returns what happened in it. The commands of the scenario that are due are given before.
    pub fn step(&mut self) -> Vec<Event> {
        self.advance();
        self.events()
    }

    /// Simulates `count` steps, and returns what happened in them.
    pub fn steps(&mut self, count: u32) -> Vec<Event> {
        (0..count).flat_map(|_| self.step()).collect()
    }

    /// Simulates one step. What happened in it is told by [`events`](Self::events) to those who ask.
    pub fn advance(&mut self) {
        self.prepared.step();
    }

    /// What happened in the last step.
    pub fn events(&self) -> Vec<Event> {
        let world = self.world();
        world.events().iter().map(|it| Event::of(world, it)).collect()
    }

    /// Simulates steps until the time `until_s` [s].
    ///
    /// # Errors
    /// If `until_s` is no time from now on.
    pub fn run(&mut self, until_s: f64) -> Result<(), Fault> {
        self.observe::<Fault>(until_s, &mut [])
    }

    /// The same, while `observers` see the simulation after every step, and what happened in the step. The error of an
    /// observer may be of any type that can also hold one of laneweave.
    ///
    /// # Errors
    /// If `until_s` is no time from now on, or if an observer fails.
    pub fn observe<E: From<Fault>>(
        &mut self,
        until_s: f64,
        observers: &mut [&mut dyn Observer<E>],
    ) -> Result<(), E> {
        /// Maximum simulated time [s].
        const LONGEST: f64 = 1e7;
        let now = self.world().clock().step;
        // As many steps as the time contains; rounded, because the sum of many steps is not exact.
        let last = (until_s / self.scenario.run.step_s).round() as u32;
        if !(0.0..=LONGEST).contains(&until_s) || last < now {
            let what = format!("until the time {until_s} s");
            let from = seconds(self.time_s());
            let remedy = format!("choose a time from {from} to {LONGEST} s");
            return Err(Fault::new("run", what, remedy).of_kind(FaultKind::State).into());
        }
        while self.world().clock().step < last {
            let events = self.step();
            for observer in &mut *observers {
                observer.observe(self, &events)?;
            }
        }
        Ok(())
    }

    /// The clock: the steps that were simulated, and the length of a step.
    pub fn clock(&self) -> Clock {
        self.world().clock()
    }

    /// The length of a step [s].
    pub fn step_s(&self) -> f64 {
        self.scenario.run.step_s
    }

    /// The steps of the warm-up, and the steps that are measured after it.
    pub fn run_steps(&self) -> [u32; 2] {
        [self.prepared.conditions.warmup_steps, self.prepared.conditions.steps]
    }

    /// Whether it is at its start, as its scenario says: no step was made, and nobody has given a command.
    pub fn is_as_it_began(&self) -> bool {
        self.clock().step == 0 && !self.is_commanded && !self.is_changed
    }

    /// The present time [s].
    pub fn time_s(&self) -> f64 {
        self.world().clock().time()
    }

    /// The time at which a run with this warm-up and duration ends [s].
    pub fn end_s(&self) -> f64 {
        let Conditions { warmup_steps, steps, .. } = &*self.prepared.conditions;
        f64::from(warmup_steps + steps) * self.scenario.run.step_s
    }

    /// All state of the traffic at this time, as bytes.
    ///
    /// # Errors
    /// None, as long as there is memory.
    pub fn save(&self) -> Result<Vec<u8>, Fault> {
        self.prepared.save().map_err(|error| Fault::bug("save", error))
    }

    /// Goes on from a saved state of a simulation with the same map, drivers, demand and seed, bit for bit.
    ///
    /// # Errors
    /// If the bytes are not such a state. Nothing changes then.
    pub fn restore(&mut self, saved: &[u8]) -> Result<(), Fault> {
        let remedy = "give the bytes that a simulation of the same scenario saved";
        self.is_changed = true;
        self.prepared.restore(saved).map_err(|error| Fault::new("restore", error, remedy))
    }

    /// Hash of the id, lanelet, position, speed and state of all vehicles. Two simulations with the same hash have the
    /// same traffic.
    pub fn state_hash(&self) -> u64 {
        self.world().state_hash()
    }

    /// The scenario, with all its settings.
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// The source of the values of the scenario.
    pub fn origin(&self) -> &Origin {
        &self.origin
    }

    /// The roads.
    pub fn network(&self) -> &Network {
        self.world().network()
    }

    /// The network, for use beyond the simulation.
    pub fn shared_network(&self) -> Arc<Network> {
        self.world().shared_network()
    }

    /// The world behind the simulation.
    pub(crate) fn world(&self) -> &World {
        &self.prepared.world
    }
}
