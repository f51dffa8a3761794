//! A scenario with many draws of the parameters of its fitted styles: how much of the spread of what a run shows comes
//! from uncertain parameters, and how much is chance.

use std::fmt::Write;
use std::num::NonZero;

use laneweave::Simulation;
use laneweave_scenario::Fault;
use laneweave_scenario::scenario::{Origin, Scenario};
use laneweave_study::{mean, middle_95, share_between};
use serde::Serialize;

use crate::compare::{MEASURES, Outcome};
use crate::parallel::in_parallel;

/// Replications with each draw, each with its own seed.
pub const PER_DRAW: u32 = 2;

/// Replications of a scenario with draws of parameters. Fields are added, never renamed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Draws {
    /// Number of draws.
    pub draws: u32,
    /// Replications with each draw.
    pub per_draw: u32,
    /// What was measured.
    pub measures: Vec<DrawnMeasure>,
}

/// A measure over all replications.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DrawnMeasure {
    /// Its column in tables.
    pub measure: &'static str,
    /// Its name, with the unit.
    pub title: &'static str,
    /// Significant digits.
    #[serde(skip)]
    digits: usize,
    /// Its value in each replication, draw by draw; none where there was nothing to measure.
    pub values: Vec<Option<f64>>,
    /// The mean.
    pub mean: Option<f64>,
    /// The interval of the middle 95 % of the replications.
    pub interval: Option<[f64; 2]>,
    /// Share of the variance that comes from the parameters; the rest is chance.
    pub from_parameters: Option<f64>,
}

/// Runs `scenario` with the first `draws` draws of the parameters of its fitted styles, without any other output, with
/// as many parallel runs as `threads`.
///
/// # Errors
/// If the scenario cannot run, or none of its styles has so many draws.
pub fn draws(scenario: &Scenario, origin: &Origin, draws: u32, threads: usize) -> Result<Draws, Fault> {
    let jobs: Vec<u32> = (0..draws * PER_DRAW).collect();
    let outcomes = in_parallel(&jobs, threads, |number| {
        let mut scenario = scenario.clone();
        scenario.run.parameter_draw = Some(number / PER_DRAW);
        scenario.run.seed = scenario.run.seed.wrapping_add(u64::from(*number));
        scenario.run.threads = NonZero::new(1);
        Ok(Outcome::of(&mut Simulation::from_scenario(&scenario, origin)?).0)
    })?;
    let measure = |it: &crate::compare::Measure| {
        let values: Vec<Option<f64>> = outcomes.iter().map(it.of).collect();
        let known: Vec<f64> = values.iter().flatten().copied().collect();
        let groups: Vec<Vec<f64>> =
            values.chunks(PER_DRAW as usize).filter_map(|it| it.iter().copied().collect()).collect();
        DrawnMeasure {
            measure: it.column,
            title: it.title,
            digits: it.digits,
            mean: mean(&known).map(|it| it.mean),
            interval: middle_95(&known),
            from_parameters: share_between(&groups),
            values,
        }
    };
    Ok(Draws { draws, per_draw: PER_DRAW, measures: MEASURES.iter().map(measure).collect() })
}

impl Draws {
    /// A table of all measures.
    pub fn to_text(&self) -> String {
        const NAME: usize = 50;
        let mut out = String::new();
        // Writing to a string never fails.
        let _ = writeln!(
            out,
            "{} draws of the parameters, {} replications with each: mean, the middle 95 %,\n\
             and the share of the variance that comes from the parameters; the rest is chance",
            self.draws, self.per_draw
        );
        for it in &self.measures {
            let (Some(mean), Some([low, high])) = (it.mean, it.interval) else { continue };
            let digits = it.digits;
            let interval = format!("({low:.digits$} to {high:.digits$})");
            let share = it.from_parameters.map_or("–".to_owned(), |it| format!("{:.0} %", 100.0 * it));
            let _ = writeln!(out, "{:NAME$}{mean:>10.digits$} {interval:<24}{share:>6}", it.title);
        }
        out
    }
}
