//! Comparison of lane-change models: the same traffic for each of them, over several seeds.

mod files;
mod outcome;
mod page;

use laneweave::Simulation;
use laneweave_results::About;
use laneweave_scenario::scenario::{Origin, Scenario};
use laneweave_scenario::style::Model;
use laneweave_scenario::{Fault, FaultKind};
use laneweave_study::{EdieRow, Estimate, mean};

use crate::parallel::in_parallel_while;

pub use files::ComparisonFiles;
pub(crate) use outcome::measure;
pub use outcome::{MEASURES, Measure, Outcome};
pub use page::page;

/// The explanation of the number after a mean.
const OF_FEW: &str = "(n): mean of n seeds only; the other seeds had nothing to measure";

/// The models that are usually compared: the paper's, two others, and the two null-model controls.
pub const USUAL: [Model; 5] = [Model::Mcdm, Model::Mobil, Model::Lmrs, Model::Null, Model::ConstantHazard];

/// So many seeds from the `first` on.
///
/// # Errors
/// If a table cannot hold the last of them.
pub fn seeds_from(first: u64, count: u64) -> Result<Vec<u64>, Fault> {
    // Tables hold them as signed numbers.
    let end = first.checked_add(count).filter(|it| i64::try_from(*it).is_ok());
    let end = end.ok_or_else(|| {
        let what = format!("{count} seeds from {first} on go beyond {}", i64::MAX);
        Fault::new("--seeds", what, "choose a smaller run.seed in the scenario")
    })?;
    Ok((first..end).collect())
}

/// One run of a comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// Its lane-change model.
    pub model: Model,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Its outcome.
    pub outcome: Outcome,
    /// The traffic in boxes, with the discretionary lane changes in them.
    pub boxes: Vec<EdieRow>,
}

/// All runs of one scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The description of the run, without the model and the seed.
    pub about: About,
    /// The models in the given order.
    pub models: Vec<Model>,
    /// By model, and by seed.
    pub trials: Vec<Trial>,
}

/// Runs `scenario` with each of the `models`, repeated names only once, and each of the `seeds`, with as many
/// parallel runs as `threads`. `goes_on` is told the share of the runs that has ended, and whether others begin is what
/// it says.
///
/// # Errors
/// If the scenario cannot run, or `goes_on` says no.
pub fn compare(
    scenario: &Scenario,
    origin: &Origin,
    models: &[Model],
    seeds: &[u64],
    threads: usize,
    goes_on: impl Fn(f64) -> bool + Sync,
) -> Result<Comparison, Fault> {
    let about = Simulation::from_scenario(scenario, origin)?.about();
    let is_first = |(place, model): &(usize, &Model)| !models[..*place].contains(model);
    let models: Vec<Model> = models.iter().enumerate().filter(is_first).map(|(_, model)| *model).collect();
    let jobs: Vec<(Model, u64)> =
        models.iter().flat_map(|model| seeds.iter().map(|seed| (*model, *seed))).collect();
    let goes_on = |ended: usize| goes_on(ended as f64 / jobs.len() as f64);
    let once = |_: &mut (), (model, seed): &(Model, u64)| trial(scenario, origin, *model, *seed);
    let trials = in_parallel_while(&jobs, threads, goes_on, || (), once)?.ok_or_else(|| {
        Fault::new("compare", "it was interrupted", "compare again").of_kind(FaultKind::State)
    })?;
    Ok(Comparison { about, models, trials })
}

/// One run without any output.
fn trial(scenario: &Scenario, origin: &Origin, model: Model, seed: u64) -> Result<Trial, Fault> {
    let mut scenario = Scenario { model: Some(model), ..scenario.clone() };
    scenario.run.seed = seed;
    scenario.run.threads = std::num::NonZero::new(1);
    let mut simulation = Simulation::from_scenario(&scenario, origin)?;
    let (outcome, boxes) = Outcome::of(&mut simulation);
    Ok(Trial { model, seed, outcome, boxes })
}

impl Comparison {
    /// A measure over the seeds of `model` that have a value.
    pub fn estimate(&self, model: Model, measure: &Measure) -> Option<Estimate> {
        let of = self.trials.iter().filter(|it| it.model == model);
        let values: Vec<f64> = of.filter_map(|it| (measure.of)(&it.outcome)).collect();
        mean(&values)
    }

    /// The difference of a measure between `model` and `other`, over the seeds in which both have a value. The
    /// arriving traffic is the same for both.
    pub fn difference(&self, model: Model, other: Model, measure: &Measure) -> Option<Estimate> {
        let of = |model: Model| self.trials.iter().filter(move |it| it.model == model);
        let pairs = of(model).zip(of(other)).filter(|(a, b)| a.seed == b.seed);
        let values: Vec<f64> =
            pairs.filter_map(|(a, b)| Some((measure.of)(&a.outcome)? - (measure.of)(&b.outcome)?)).collect();
        mean(&values)
    }

    /// A measure of a model, for a table.
    fn cell(&self, model: Model, measure: &Measure) -> Option<String> {
        self.estimate(model, measure).map(|it| cell(&it, measure.digits, self.seeds().len()))
    }

    /// The seeds of each model.
    fn seeds(&self) -> Vec<u64> {
        let first = self.models.first();
        self.trials.iter().filter(|it| Some(&it.model) == first).map(|it| it.seed).collect()
    }

    /// The table of [`to_text`](Comparison::to_text), below a line about the `input` that was measured for so long [s].
    pub fn to_titled_text(&self, input: &str, duration_s: f64) -> String {
        let seeds = match self.seeds().len() {
            1 => "1 seed (at least 2 are needed for an interval)".to_owned(),
            count => format!("{count} seeds"),
        };
        format!("{input}, {duration_s} s, {seeds}: means with 95 % intervals\n{}\n", self.to_text())
    }

    /// A table of all measures by model, each a mean with its 95 % interval over the seeds.
    pub fn to_text(&self) -> String {
        const NAME: usize = 46;
        const CELL: usize = 18;
        let mut text = format!("{:NAME$}", "");
        self.models.iter().for_each(|it| text += &format!("{:>CELL$}", it.name()));
        for measure in &MEASURES {
            text += &format!("\n{:NAME$}", measure.title);
            for model in &self.models {
                let cell = self.cell(*model, measure).unwrap_or("-".into());
                text += &format!("{cell:>CELL$}");
            }
        }
        text += "\n";
        let seeds = self.seeds().len();
        let cells = self.models.iter().flat_map(|model| MEASURES.iter().map(|it| self.estimate(*model, it)));
        if cells.flatten().any(|it| it.replications != seeds) {
            text += &format!("{OF_FEW}\n");
        }
        text
    }
}

/// A mean with half its interval, and with its number of seeds if that is not all `seeds`.
fn cell(estimate: &Estimate, digits: usize, seeds: usize) -> String {
    let Estimate { mean, half_width, replications, .. } = estimate;
    let mut text = format!("{mean:.digits$}");
    if half_width.is_finite() {
        text += &format!(" ± {half_width:.digits$}");
    }
    if *replications != seeds {
        text += &format!(" ({replications})");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mean_of_some_seeds_only_says_of_how_many() {
        let of = |values: &[f64]| mean(values).map(|it| cell(&it, 1, 3)).unwrap();
        assert_eq!(of(&[1.0, 1.0, 1.0]), "1.0 ± 0.0");
        assert_eq!(of(&[2.0, 2.0]), "2.0 ± 0.0 (2)");
        assert_eq!(of(&[2.5]), "2.5 (1)");
    }
}
