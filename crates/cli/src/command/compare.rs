//! `laneweave compare`.

use std::path::PathBuf;
use std::thread::available_parallelism;

use clap::{Args, ValueHint};
use laneweave::scenario::Origin;
use laneweave::style::Model;
use laneweave::{Fault, Simulation};
use laneweave_studies::compare::{ComparisonFiles, USUAL, compare, seeds_from};

use super::Call;
use super::check::Limit;
use super::complain;
use super::numbers::within;
use super::run::model;
use super::say;

#[derive(Debug, Args)]
pub(crate) struct CompareArguments {
    /// Scenario files (.toml), or maps.
    #[arg(value_name = "SCENARIO.toml|MAP", value_hint = ValueHint::FilePath, required = true)]
    inputs: Vec<PathBuf>,
    /// A lane-change model for all drivers; may be repeated [default: mcdm, mobil, lmrs, null, constant-hazard].
    #[arg(long = "model", value_name = "MODEL", value_parser = model())]
    models: Vec<Model>,
    /// Number of seeds for each model; the first is the seed of the scenario.
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = within::<u64>(1..=10_000))]
    seeds: u64,
    /// Vehicles per hour in total; replaces all demands of the scenarios.
    #[arg(long, value_name = "VEH_PER_H")]
    demand: Option<f64>,
    /// Simulated and measured seconds, after the warm-up [default: 600].
    #[arg(long, value_name = "S")]
    duration: Option<f64>,
    /// Simulated seconds before anything is measured [default: 0].
    #[arg(long, value_name = "S")]
    warmup: Option<f64>,
    /// Folder for the report and the table of all runs.
    #[arg(long, value_name = "DIR", default_value = "comparison")]
    out: PathBuf,
    #[command(flatten)]
    size: Limit,
}

impl CompareArguments {
    pub(crate) fn execute(self, call: &Call) -> Result<(), Fault> {
        let CompareArguments { inputs, models, seeds, demand, duration, warmup, out, size } = self;
        let models = if models.is_empty() { USUAL.to_vec() } else { models };
        let threads = available_parallelism().map_or(1, |it| it.get());
        let mut asked = Vec::new();
        for input in inputs {
            let (mut scenario, mut origin) = Origin::open(&input)?;
            if let Some(demand) = demand {
                scenario.demand.entrances.clear();
                scenario.demand.od.clear();
                scenario.demand.vehicles_per_hour = Some(demand);
                origin.replaced("demand.vehicles_per_hour", "--demand");
            }
            if let Some(duration) = duration {
                scenario.run.duration_s = duration;
                origin.replaced("run.duration_s", "--duration");
            }
            if let Some(warmup) = warmup {
                scenario.run.warmup_s = warmup;
                origin.replaced("run.warmup_s", "--warmup");
            }
            if let Some(size) = size.mb() {
                scenario.map_options.max_size_mb = Some(size);
                origin.replaced("map_options.max_size_mb", "--max-map-size");
            }
            // Nothing runs before everything has been checked.
            let simulation = Simulation::from_scenario(&scenario, &origin)?;
            simulation
                .demand_note()
                .iter()
                .for_each(|it| complain(format_args!("{}: {it}", input.display())));
            let seeds = seeds_from(scenario.run.seed, seeds)?;
            asked.push((input.display().to_string(), scenario, origin, seeds));
        }
        let mut files = ComparisonFiles::begin(&out)?;
        // The files are completed even if standard output fails.
        let mut said = Ok(());
        for (input, scenario, origin, seeds) in asked {
            let comparison = compare(&scenario, &origin, &models, &seeds, threads, |_| true)?;
            let text = comparison.to_titled_text(&input, scenario.run.duration_s);
            said = said.and_then(|()| say(&text));
            files.add(input, comparison)?;
        }
        let [report, runs] = files.finish(&call.line)?;
        said.and_then(|()| say(&format!("report: {}\nall runs: {}\n", report.display(), runs.display())))
    }
}
