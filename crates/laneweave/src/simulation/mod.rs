//! A simulation in the words of the road: lanelet ids, and metres along them. Everything that it gives is plain, owned
//! data.

mod builder;
mod commands;
mod event;
mod light;
mod observer;
mod queries;
mod results;
mod vehicle_state;

use laneweave_network::Network;
use laneweave_scenario::Fault;
use laneweave_scenario::scenario::{Demand, Origin, Prepared, Scenario, prepare};
use laneweave_sim::World;
use laneweave_study::seconds;

pub use builder::{Builder, MapSource};
pub use event::{Event, Incident, LaneChange, Occurrence};
pub use light::Light;
pub use observer::Observer;
pub use vehicle_state::VehicleState;

/// A simulation: traffic on a map, which a program steps through, asks, and changes.
///
/// The first step begins at time 0. Simulated time before the end of the warm-up is part of it; at that time all
/// counts begin anew.
pub struct Simulation {
    scenario: Scenario,
    origin: Origin,
    pub(crate) prepared: Prepared,
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
    /// simulation.run(60.0, &mut [])?;
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

    /// A scenario, with the source of its values.
    ///
    /// # Errors
    /// If its map or a style is missing, not readable, or invalid.
    pub fn from_scenario(scenario: &Scenario, origin: &Origin) -> Result<Simulation, Fault> {
        Ok(Simulation::new(scenario.clone(), origin.clone(), prepare(scenario, origin)?, true))
    }

    /// A simulation on a map, set up value by value.
    pub fn builder(map: impl Into<MapSource>) -> Builder {
        Builder::new(map.into())
    }

    fn new(scenario: Scenario, origin: Origin, prepared: Prepared, has_map_file: bool) -> Simulation {
        let [is_commanded, is_changed] = [false; 2];
        Simulation { scenario, origin, prepared, has_map_file, is_commanded, is_changed }
    }

    /// Simulates one step, and returns what happened in it. The commands of the scenario that are due are given before.
    pub fn step(&mut self) -> Vec<Event> {
        self.prepared.step();
        self.events()
    }

    /// What happened in the last step.
    pub fn events(&self) -> Vec<Event> {
        let world = self.world();
        world.events().iter().map(|it| Event::of(world, it)).collect()
    }

    /// Simulates steps until the time `until_s` [s]. After every step the `observers` see the simulation, and what
    /// happened in the step.
    ///
    /// # Errors
    /// If `until_s` is no time from now on, or if an observer fails.
    pub fn run(&mut self, until_s: f64, observers: &mut [&mut dyn Observer]) -> Result<(), Fault> {
        /// Maximum simulated time [s].
        const LONGEST: f64 = 1e7;
        let now = self.world().clock().step;
        // As many steps as the time contains; rounded, because the sum of many steps is not exact.
        let last = (until_s / self.scenario.run.step_s).round() as u32;
        if !(0.0..=LONGEST).contains(&until_s) || last < now {
            let what = format!("until the time {until_s} s");
            let from = seconds(self.time_s());
            return Err(Fault::new("run", what, format!("choose a time from {from} to {LONGEST} s")));
        }
        while self.world().clock().step < last {
            let events = self.step();
            for observer in &mut *observers {
                observer.observe(self, &events)?;
            }
        }
        Ok(())
    }

    /// The present time [s].
    pub fn time_s(&self) -> f64 {
        self.world().clock().time()
    }

    /// The time at which a run with this warm-up and duration ends [s].
    pub fn end_s(&self) -> f64 {
        let Prepared { warmup_steps, steps, .. } = &self.prepared;
        f64::from(warmup_steps + steps) * self.scenario.run.step_s
    }

    /// All state of the traffic at this time, as bytes.
    ///
    /// # Errors
    /// None, as long as there is memory.
    pub fn save(&self) -> Result<Vec<u8>, Fault> {
        self.prepared.save().map_err(|error| Fault::new("save", error, "report this as a bug"))
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

    /// What was prepared of the scenario, with the world at the present time.
    pub fn prepared(&self) -> &Prepared {
        &self.prepared
    }

    /// The source of the values of the scenario.
    pub(crate) fn origin(&self) -> &Origin {
        &self.origin
    }

    /// The roads.
    pub fn network(&self) -> &Network {
        self.world().network()
    }

    /// The world behind the simulation, for questions that the simulation does not answer.
    pub fn world(&self) -> &World {
        &self.prepared.world
    }

    /// The world behind the simulation, mutable. Steps of the world itself return no events, and begin no counts.
    pub fn world_mut(&mut self) -> &mut World {
        self.is_changed = true;
        &mut self.prepared.world
    }
}
