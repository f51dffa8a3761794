//! `laneweave compare`.

use std::path::PathBuf;
use std::thread::available_parallelism;

use clap::{Args, ValueHint};
use laneweave::folder::{Claim, REPORT};
use laneweave::output::write_whole;
use laneweave::record::SCENARIO;
use laneweave::scenario::Origin;
use laneweave::study::{Cell, Column, Format, TableWriter};
use laneweave::style::Model;
use laneweave::{Fault, Simulation};
use laneweave_studies::compare::{Comparison, MEASURES, compare, page};

use super::check::Limit;
use super::complain;
use super::numbers::within;
use super::run::model;
use super::say;

/// The default models: the paper's, two others, and the two null-model controls.
const USUAL: [Model; 5] = [Model::Mcdm, Model::Mobil, Model::Lmrs, Model::Null, Model::ConstantHazard];

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
    pub(crate) fn execute(self) -> Result<(), Fault> {
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
        if out.join(SCENARIO).exists() {
            let what = "this folder contains a scenario; the results of a run of it would be mixed with the comparison";
            return Err(Fault::new(out.display(), what, "choose another folder with --out"));
        }
        let claim = Claim::on(&out)?;
        let path = claim.dir().join("runs.csv");
        let mut table = TableWriter::create(&path, Format::Csv, &columns())?;
        let mut done = Vec::new();
        // The files are completed even if standard output fails.
        let mut said = Ok(());
        for (input, scenario, origin, seeds) in asked {
            let comparison = compare(&scenario, &origin, &models, &seeds, threads)?;
            let text = format!(
                "{input}, {} s, {}: means with 95 % intervals\n{}\n",
                scenario.run.duration_s,
                match seeds.len() {
                    1 => "1 seed (at least 2 are needed for an interval)".into(),
                    count => format!("{count} seeds"),
                },
                comparison.to_text()
            );
            said = said.and_then(|()| say(&text));
            append(&mut table, &input, &comparison)?;
            done.push((input, comparison));
        }
        table.finish()?;
        let report = out.join(REPORT);
        write_whole(&report, &page(&done, &super::given()).to_html())?;
        said.and_then(|()| say(&format!("report: {}\nall runs: {}\n", report.display(), path.display())))
    }
}

/// So many seeds from the `first` on.
fn seeds_from(first: u64, count: u64) -> Result<Vec<u64>, Fault> {
    // Tables hold them as signed numbers.
    let end = first.checked_add(count).filter(|it| i64::try_from(*it).is_ok());
    let end = end.ok_or_else(|| {
        let what = format!("{count} seeds from {first} on go beyond {}", i64::MAX);
        Fault::new("--seeds", what, "choose a smaller run.seed in the scenario")
    })?;
    Ok((first..end).collect())
}

/// The columns of the table of all runs.
fn columns() -> Vec<Column> {
    let named = [Column::text("input"), Column::text("model"), Column::integer("seed")];
    let measured = MEASURES.iter().map(|it| Column::real(it.column));
    named.into_iter().chain(measured).collect()
}

/// Appends a row for each run.
fn append(table: &mut TableWriter, input: &str, comparison: &Comparison) -> Result<(), Fault> {
    for trial in &comparison.trials {
        let named = [input.into(), trial.model.name().into(), (trial.seed as i64).into()];
        let measured = MEASURES.iter().map(|it| (it.of)(&trial.outcome).into());
        table.row(&named.into_iter().chain(measured).collect::<Vec<Cell>>())?;
    }
    Ok(())
}
