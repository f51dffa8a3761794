//! What a program learns: which vehicle it drives, what it sees and may do, and what that is worth.

use laneweave::{Fault, FaultKind, Id};
use serde::{Deserialize, Serialize};

use crate::action::Action;
use crate::observation::Observation;
use crate::reward::Rewards;

/// What a program learns. Its vehicle, the ego, is one of those that arrive: with the class, route and driver of the
/// demand, in the place and at the speed at which it entered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Task {
    /// The entrances where an ego may come from, by their smallest lanelet ids; empty: all.
    pub entrances: Vec<Id>,
    /// The destinations that an ego may have, by their smallest lanelet ids; empty: all.
    pub destinations: Vec<Id>,
    /// What an action is.
    pub action: Action,
    /// What the ego sees.
    pub observation: Observation,
    /// What each term of the reward is worth.
    pub rewards: Rewards,
    /// Time from one action to the next [s]: a multiple of the step.
    pub decision_s: f64,
    /// Longest time of an episode [s].
    pub limit_s: f64,
    /// Simulated time before an ego may come [s]: the road fills.
    pub warmup_s: f64,
    /// How many different beginnings episodes have, for each population. Each is simulated once, when an episode first
    /// begins with it; after that, an episode begins in microseconds. What follows has random numbers of its own.
    pub starts: u32,
    /// Seed of the beginnings. With another one, no beginning is the same: so what was learned is tried in traffic that
    /// was never seen.
    pub starts_seed: u64,
}

impl Default for Task {
    fn default() -> Task {
        Task {
            entrances: Vec::new(),
            destinations: Vec::new(),
            action: Action::default(),
            observation: Observation::default(),
            rewards: Rewards::default(),
            decision_s: 1.0,
            limit_s: 60.0,
            warmup_s: 60.0,
            starts: 64,
            starts_seed: 1,
        }
    }
}

impl Task {
    /// How many steps of `step_s` [s] an action lasts, an episode at most, and the warm-up.
    ///
    /// # Errors
    /// If a number is not in its range, or a time is no multiple of a step.
    pub(crate) fn steps(&self, step_s: f64) -> Result<[u32; 3], Fault> {
        /// Longest time [s].
        const LONGEST: f64 = 1e5;
        /// Most beginnings of a population.
        const MOST_STARTS: u32 = 100_000;
        self.observation.check()?;
        if !(1..=MOST_STARTS).contains(&self.starts) {
            return Err(wrong("starts", &format!("{} beginnings", self.starts), "choose 1 to 100000"));
        }
        let steps = |key: &str, time: f64, least: u32| {
            let steps = (time / step_s).round();
            let is_multiple = (steps * step_s - time).abs() < 1e-6;
            if !(time <= LONGEST && steps >= f64::from(least) && is_multiple) {
                let remedy = format!("choose a multiple of the step of {step_s} s, up to {LONGEST} s");
                return Err(wrong(key, &format!("{time} s cannot be simulated"), &remedy));
            }
            Ok(steps as u32)
        };
        let decision = steps("decision_s", self.decision_s, 1)?;
        let limit = steps("limit_s", self.limit_s, decision)?;
        Ok([decision, limit, steps("warmup_s", self.warmup_s, 0)?])
    }
}

/// A value of a task that cannot be used.
pub(crate) fn wrong(place: &str, what: &str, remedy: &str) -> Fault {
    Fault::new(place, what, remedy).of_kind(FaultKind::Value)
}
