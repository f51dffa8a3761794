//! A program learns to drive in many worlds.

mod episodes;
mod observations;

use laneweave::{Fault, Simulation, Template};
use laneweave_learning::{Autoreset, Batch, Results, TERMS, Task};
use laneweave_test_data::map;

/// Dense traffic on one of the maps.
fn template(name: &str) -> Template {
    let builder = Simulation::builder(map(name)).vehicles_per_hour(2500.0).seed(1).threads(1);
    builder.template().expect("the map is sound")
}

fn populations(name: &str) -> Vec<(String, Template)> {
    vec![("usual".into(), template(name))]
}

/// A task whose episodes begin soon.
fn short(task: Task) -> Task {
    Task { warmup_s: 20.0, starts: 3, ..task }
}

/// A batch, and where its results go.
struct Driven {
    batch: Batch,
    observations: Vec<f32>,
    last_observations: Vec<f32>,
    rewards: Vec<f64>,
    terms: Vec<f64>,
    terminated: Vec<bool>,
    truncated: Vec<bool>,
}

impl Driven {
    fn new(name: &str, task: Task, seeds: &[u64], threads: usize, autoreset: Autoreset) -> Driven {
        let batch = Batch::new(populations(name), task, seeds, threads).expect("a sound task");
        let (count, numbers) = (seeds.len(), batch.task().observation.numbers());
        let mut driven = Driven {
            batch: batch.with_autoreset(autoreset),
            observations: vec![f32::NAN; count * numbers],
            last_observations: vec![0.0; count * numbers],
            rewards: vec![0.0; count],
            terms: vec![0.0; count * TERMS.len()],
            terminated: vec![false; count],
            truncated: vec![false; count],
        };
        let seeds: Vec<_> = seeds.iter().map(|it| Some(Some(*it))).collect();
        driven.reset(&seeds);
        driven
    }

    fn reset(&mut self, seeds: &[Option<Option<u64>>]) {
        self.batch.reset(seeds, &mut self.observations).expect("a seed for each world");
    }

    fn act(&mut self, actions: &[f64]) {
        self.try_to_act(actions).expect("actions for all worlds");
    }

    /// Why the actions are refused.
    fn refused(&mut self, actions: &[f64]) -> Fault {
        self.try_to_act(actions).expect_err("they are refused")
    }

    fn try_to_act(&mut self, actions: &[f64]) -> Result<(), Fault> {
        let results = Results {
            observations: &mut self.observations,
            last_observations: &mut self.last_observations,
            rewards: &mut self.rewards,
            terms: &mut self.terms,
            terminated: &mut self.terminated,
            truncated: &mut self.truncated,
        };
        self.batch.act(actions, results)
    }

    /// What a world sees.
    fn seen(&self, world: usize) -> &[f32] {
        let numbers = self.batch.task().observation.numbers();
        &self.observations[world * numbers..][..numbers]
    }

    /// A term of the reward of a world.
    fn term(&self, world: usize, name: &str) -> f64 {
        let place = TERMS.iter().position(|it| *it == name).expect("a known term");
        self.terms[world * TERMS.len() + place]
    }
}
