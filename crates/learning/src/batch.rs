//! Many worlds, stepped together.

use laneweave::{Fault, FaultKind, Fleet, LaneChange, Simulation, Template, VehicleId};
use laneweave_pool::Pool;
use serde::{Deserialize, Serialize};

use crate::reward::TERMS;
use crate::start::Starts;
use crate::task::{Task, wrong};
use crate::world::{LearningWorld, Outcome};

/// What all worlds share.
pub(crate) struct Plan {
    pub(crate) task: Task,
    pub(crate) starts: Starts,
    /// Steps of an action, and of an episode at most.
    pub(crate) decision: u32,
    pub(crate) limit: u32,
    /// Whether worlds keep what happened in the steps of the last action.
    pub(crate) keeps_changes: bool,
    /// Numbers of an observation.
    numbers: usize,
}

/// When a world whose episode is over begins the next one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Autoreset {
    /// At the next action, which has no effect and no reward.
    NextStep,
    /// At once. The last observation of the episode goes into [`Results::last_observations`].
    SameStep,
    /// When the program says so. Until then actions have no effect.
    Disabled,
}

/// Many worlds in which a program learns, one vehicle in each. One pool of threads steps them all; what they do does
/// not depend on its number of threads.
pub struct Batch {
    plan: Plan,
    worlds: Vec<LearningWorld>,
    /// The numbers of all worlds.
    all: Vec<u32>,
    autoreset: Autoreset,
    pool: Pool,
}

/// A world's part of what is done with all of them.
struct Row<'r> {
    number: usize,
    /// What the vehicle sees now.
    observation: &'r mut [f32],
    /// What it saw last, if its episode has ended; it may be empty.
    last_observation: &'r mut [f32],
    /// What the action led to.
    outcome: Outcome,
}

/// Where the results of an action go: one place for each world, or one row.
pub struct Results<'a> {
    /// What the vehicles see now.
    pub observations: &'a mut [f32],
    /// What those saw last whose episode has ended, with [`Autoreset::SameStep`]; it may be empty otherwise.
    pub last_observations: &'a mut [f32],
    /// The rewards.
    pub rewards: &'a mut [f64],
    /// Their [`TERMS`].
    pub terms: &'a mut [f64],
    /// Whether the vehicle has collided or left the road.
    pub terminated: &'a mut [bool],
    /// Whether the time of the episode is over.
    pub truncated: &'a mut [bool],
}

impl Batch {
    /// A world for each of the `seeds`, at the beginning of its first episode, on so many threads. Each episode is one
    /// of the `populations`, which have names; all have the same map and steps. Where `run.audit` is set, an ego that
    /// touches another vehicle from the side is seen at once, not only at the end of the second.
    ///
    /// # Errors
    /// If a value of the task cannot be used, if no vehicle comes that can be an ego, if there are no seeds,
    /// populations or threads, or if the system does not start so many.
    pub fn new(
        populations: Vec<(String, Template)>,
        task: Task,
        seeds: &[u64],
        threads: usize,
    ) -> Result<Batch, Fault> {
        let Some((_, template)) = populations.first() else {
            return Err(wrong("populations", "there are none", "give one or more"));
        };
        let [decision, limit, warmup] = task.steps(template.scenario().run.step_s)?;
        if seeds.is_empty() {
            return Err(wrong("seeds", "there are none", "give one for each world"));
        }
        if !(1..=Fleet::MOST_THREADS).contains(&threads) {
            return Err(wrong("threads", &format!("{threads} threads"), "choose 1 to 256"));
        }
        let pool = Pool::new(threads)
            .map_err(|it| wrong("threads", &it.to_string(), "choose fewer, or close other programs"))?;
        let starts = Starts::new(populations, &task, warmup);
        let numbers = task.observation.numbers();
        let plan = Plan { task, starts, decision, limit, keeps_changes: false, numbers };
        let worlds: Result<Vec<LearningWorld>, Fault> =
            seeds.iter().map(|it| LearningWorld::new(&plan, *it, 0)).collect();
        let all = (0..seeds.len() as u32).collect();
        Ok(Batch { plan, worlds: worlds?, all, autoreset: Autoreset::NextStep, pool })
    }

    /// The same with another mode.
    #[must_use]
    pub fn with_autoreset(self, autoreset: Autoreset) -> Batch {
        Batch { autoreset, ..self }
    }

    /// The same, which keeps the lane changes around the egos in the steps of the last action.
    #[must_use]
    pub fn with_changes(mut self) -> Batch {
        self.plan.keeps_changes = true;
        self
    }

    /// Number of worlds.
    #[must_use]
    pub fn len(&self) -> usize {
        self.worlds.len()
    }

    /// Whether there is no world: there always is one.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.worlds.is_empty()
    }

    /// What the program learns.
    #[must_use]
    pub fn task(&self) -> &Task {
        &self.plan.task
    }

    /// The names of the populations.
    pub fn populations(&self) -> impl Iterator<Item = &str> {
        self.plan.starts.names()
    }

    /// The number of the population in a world.
    ///
    /// # Errors
    /// If there are not so many worlds.
    pub fn population(&self, number: usize) -> Result<usize, Fault> {
        Ok(self.world(number)?.start.population)
    }

    /// The simulation of a world, and its ego.
    ///
    /// # Errors
    /// If there are not so many worlds.
    pub fn simulation(&self, number: usize) -> Result<(&Simulation, VehicleId), Fault> {
        let world = self.world(number)?;
        Ok((&world.simulation, world.ego))
    }

    /// A simulation that goes on from where a world is.
    ///
    /// # Errors
    /// If there are not so many worlds.
    pub fn copy(&self, number: usize) -> Result<Simulation, Fault> {
        self.world(number)?.copy(&self.plan)
    }

    /// The lane changes of the ego of a world, and of the drivers within [`AROUND`](crate::AROUND), in the steps of the
    /// last action, if they are [kept](Batch::with_changes).
    ///
    /// # Errors
    /// If there are not so many worlds.
    pub fn changes(&self, number: usize) -> Result<&[LaneChange], Fault> {
        Ok(&self.world(number)?.changes)
    }

    fn world(&self, number: usize) -> Result<&LearningWorld, Fault> {
        self.worlds.get(number).ok_or_else(|| {
            let (what, most) = (format!("there is no world {number}"), self.len() - 1);
            Fault::new("batch", what, format!("choose 0 to {most}")).of_kind(FaultKind::State)
        })
    }

    /// Begins the next episodes of the worlds with a seed in `seeds`: the first one of the inner seed, if that is
    /// given. Writes what all vehicles see into `observations`.
    ///
    /// # Errors
    /// If a slice has not one place for each world, or row of numbers, or if no ego comes.
    pub fn reset(&mut self, seeds: &[Option<Option<u64>>], observations: &mut [f32]) -> Result<(), Fault> {
        self.check_length("seeds", seeds.len(), 1)?;
        self.check_length("observations", observations.len(), self.plan.numbers)?;
        self.each(observations, &mut [], |plan, world, row| {
            if let Some(seed) = seeds[row.number] {
                world.reset(plan, seed)?;
            }
            world.observe(plan, row.observation);
            Ok(())
        })
        .map(drop)
    }

    /// Acts in all worlds, and simulates until the next actions are due. `actions` has a row of
    /// [numbers](crate::Action::numbers) for each world.
    ///
    /// # Errors
    /// If a slice has not the right length, if a number is not finite or that of no choice, or if an action cannot be
    /// carried out.
    pub fn act(&mut self, actions: &[f64], results: Results) -> Result<(), Fault> {
        let width = self.plan.task.action.numbers();
        self.check_length("actions", actions.len(), width)?;
        self.check(&results)?;
        if let Some((place, number)) =
            actions.iter().enumerate().find(|it| !self.plan.task.action.takes(*it.1))
        {
            let what = format!("action {} has the number {number}", place / width);
            return Err(wrong("actions", &what, self.plan.task.action.remedy()));
        }
        let autoreset = self.autoreset;
        let act = |plan: &Plan, world: &mut LearningWorld, row: &mut Row| {
            match (world.outcome.is_over(), autoreset) {
                (true, Autoreset::Disabled) => {}
                (true, _) => world.reset(plan, None)?,
                (false, _) => world.act(plan, &actions[row.number * width..][..width])?,
            }
            row.outcome = world.outcome;
            if row.outcome.is_over() && autoreset == Autoreset::SameStep {
                world.observe(plan, row.last_observation);
                world.reset(plan, None)?;
            }
            world.observe(plan, row.observation);
            Ok(())
        };
        let rewards = self.plan.task.rewards;
        for (number, outcome) in
            self.each(results.observations, results.last_observations, act)?.iter().enumerate()
        {
            results.rewards[number] = rewards.of(&outcome.terms);
            results.terms[number * TERMS.len()..][..TERMS.len()].copy_from_slice(&outcome.terms.numbers());
            (results.terminated[number], results.truncated[number]) =
                (outcome.is_terminated, outcome.is_truncated);
        }
        Ok(())
    }

    /// Does `work` with each world and its row of the observations, on all threads. Returns the outcomes.
    ///
    /// # Errors
    /// The first one by number.
    fn each(
        &mut self,
        observations: &mut [f32],
        last_observations: &mut [f32],
        work: impl Fn(&Plan, &mut LearningWorld, &mut Row) -> Result<(), Fault> + Sync,
    ) -> Result<Vec<Outcome>, Fault> {
        let Batch { plan, worlds, all, pool, .. } = self;
        let mut last = last_observations.chunks_exact_mut(plan.numbers);
        let rows = observations.chunks_exact_mut(plan.numbers).enumerate().map(|(number, observation)| {
            let last_observation = last.next().unwrap_or_default();
            (Row { number, observation, last_observation, outcome: Outcome::NOTHING }, Ok(()))
        });
        let mut rows: Vec<(Row, Result<(), Fault>)> = rows.collect();
        let mut own = vec![(); pool.threads()];
        let act = |world: &mut LearningWorld, (): &mut (), _, (row, done): &mut (Row, Result<(), Fault>)| {
            *done = work(plan, world, row);
        };
        pool.look_then_act(&mut own, worlds, &mut rows, all, |_, (), _, _| (), act);
        let outcome = |(row, done): (Row, Result<(), Fault>)| match done {
            Ok(()) => Ok(row.outcome),
            Err(it) => Err(Fault { place: format!("world {}: {}", row.number, it.place), ..it }),
        };
        rows.into_iter().map(outcome).collect()
    }

    fn check(&self, results: &Results) -> Result<(), Fault> {
        self.check_length("observations", results.observations.len(), self.plan.numbers)?;
        self.check_length("rewards", results.rewards.len(), 1)?;
        self.check_length("terms", results.terms.len(), TERMS.len())?;
        self.check_length("terminated", results.terminated.len(), 1)?;
        self.check_length("truncated", results.truncated.len(), 1)?;
        if self.autoreset == Autoreset::SameStep {
            self.check_length("last_observations", results.last_observations.len(), self.plan.numbers)?;
        }
        Ok(())
    }

    /// Checks that a slice has so many places for each world.
    fn check_length(&self, name: &str, found: usize, each: usize) -> Result<(), Fault> {
        let needed = self.len() * each;
        if found == needed {
            return Ok(());
        }
        Err(wrong(name, &format!("{found} places"), &format!("give it {needed}")))
    }
}
