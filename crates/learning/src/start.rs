//! The beginnings of episodes: traffic at the moment when the ego has come.

use std::sync::OnceLock;

use laneweave::sim::{Purpose, Random};
use laneweave::{Class, Event, Fault, Id, Simulation, Template, VehicleId};

use crate::task::{Task, wrong};

/// Traffic in which an ego has just come.
pub(crate) struct Start {
    pub(crate) template: Template,
    pub(crate) ego: VehicleId,
}

/// The beginnings of all populations. Each is simulated when it is first asked for.
pub(crate) struct Starts {
    populations: Vec<Population>,
    task: Task,
    warmup: u32,
}

/// Traffic with drivers of certain styles.
struct Population {
    name: String,
    template: Template,
    starts: Vec<OnceLock<Result<Start, Fault>>>,
}

/// Number of a beginning.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct StartNumber {
    pub(crate) population: usize,
    start: usize,
}

impl Starts {
    /// The beginnings of these populations, each with its name.
    pub(crate) fn new(populations: Vec<(String, Template)>, task: &Task, warmup: u32) -> Starts {
        let starts = || (0..task.starts).map(|_| OnceLock::new()).collect();
        let population = |(name, template)| Population { name, template, starts: starts() };
        Starts { populations: populations.into_iter().map(population).collect(), task: task.clone(), warmup }
    }

    /// The names of the populations.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.populations.iter().map(|it| it.name.as_str())
    }

    /// The beginning of an episode, and the seed with which it goes on.
    pub(crate) fn drawn(&self, seed: u64, episode: u32) -> (StartNumber, u64) {
        let random = Random::new(seed);
        let below = |count: u32, most: usize| {
            let share = random.uniform(episode, Purpose::Episode, count);
            ((share * most as f64) as usize).min(most - 1)
        };
        let population = below(0, self.populations.len());
        let start = below(1, self.populations[population].starts.len());
        let goes_on = random.uniform(episode, Purpose::Episode, 2).to_bits();
        (StartNumber { population, start }, goes_on)
    }

    /// The beginning with this number.
    ///
    /// # Errors
    /// If no ego comes.
    pub(crate) fn at(&self, number: StartNumber) -> Result<&Start, Fault> {
        let population = &self.populations[number.population];
        let start = population.starts[number.start].get_or_init(|| self.simulate(population, number));
        start.as_ref().map_err(Clone::clone)
    }

    fn simulate(&self, population: &Population, number: StartNumber) -> Result<Start, Fault> {
        /// Longest time for which an ego is waited for [s].
        const LONGEST: f64 = 1800.0;
        let random = Random::new(self.task.starts_seed);
        let seed = random.uniform(number.start as u32, Purpose::Episode, number.population as u32).to_bits();
        let mut simulation = population.template.spawn(seed)?;
        (0..self.warmup).for_each(|_| simulation.advance());
        let latest = simulation.time_s() + LONGEST;
        while simulation.time_s() < latest {
            let ego = simulation.step().iter().find_map(|it| self.ego(&simulation, it));
            if let Some(ego) = ego {
                return Ok(Start { template: simulation.into_template(), ego });
            }
        }
        let remedy = "name entrances and destinations between which cars drive, or give a larger demand";
        Err(wrong("task", &format!("no ego came within {LONGEST} s"), remedy))
    }

    /// The vehicle that has just entered, if it may be an ego.
    fn ego(&self, simulation: &Simulation, event: &Event) -> Option<VehicleId> {
        let Event::Entered(entered) = event else { return None };
        let vehicle = simulation.view(entered.vehicle)?;
        let is_among = |wanted: &[Id], found: Option<Id>| {
            wanted.is_empty() || found.is_some_and(|it| wanted.contains(&it))
        };
        let is_ego = vehicle.driver.class == Class::Car
            && is_among(&self.task.destinations, vehicle.destination())
            && is_among(&self.task.entrances, entrance(simulation, vehicle.id()));
        is_ego.then_some(entered.vehicle)
    }
}

/// The entrance where a vehicle came from: its smallest lanelet id.
fn entrance(simulation: &Simulation, vehicle: VehicleId) -> Option<Id> {
    let number = simulation.trip(vehicle)?.origin?;
    simulation.origins().get(number).map(|it| it.0)
}
