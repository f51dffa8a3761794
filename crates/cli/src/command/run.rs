//! `laneweave run`.

use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::thread::available_parallelism;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueHint};
use laneweave::folder::DRAWS;
use laneweave::maps::Problem;
use laneweave::output::{json, write_whole};
use laneweave::run::{self, Resumed, Run};
use laneweave::scenario::{DrivingSide, Origin, Scenario, SumoFile, TableFormat, mixture};
use laneweave::style::Model;
use laneweave::{Fault, Simulation};

use super::check::{Limit, driving_side};
use super::complain;
use super::numbers::{number, seed, threads, within};
use super::progress::Progress;
use super::resume::same_run;
use super::say;
use super::stop::Stop;
use super::{Call, SUCCESS};

/// Maximum of kinds of problems of a map that are listed.
const LISTED_KINDS: usize = 20;

#[derive(Debug, Args)]
pub(crate) struct RunArguments {
    /// A scenario file (.toml), or a map (Lanelet2: .osm, CommonRoad: .xml; compressed: .osm.gz); with --resume the
    /// folder of results of an incomplete run.
    #[arg(value_name = "SCENARIO.toml|MAP", value_hint = ValueHint::AnyPath)]
    input: PathBuf,
    /// Vehicles per hour in total, split over the entrances by their number of lanes for cars (on a map without
    /// entrance or exit evenly over its lanelets); replaces all demands of the scenario [default for a map: at most
    /// 63 % of its estimated capacity].
    #[arg(long, value_name = "VEH_PER_H", value_parser = number)]
    demand: Option<f64>,
    /// Simulated and measured seconds, after the warm-up [default: 600].
    #[arg(long, value_name = "S", value_parser = number)]
    duration: Option<f64>,
    /// Length of a step in seconds, 0.01 to 1 [default: 0.1].
    #[arg(long, value_name = "S", value_parser = number)]
    step: Option<f64>,
    /// A style of drivers, or the path of a style file (.toml), and its weight; may be repeated; replaces all styles
    /// of the scenario [default: aggressive=1 conservative=7.4].
    #[arg(long, value_name = "NAME=WEIGHT", value_parser = weighted)]
    style: Vec<(String, f64)>,
    /// One lane-change model for all drivers, in place of those of their styles; with mobil-lanes and lmrs-lanes no
    /// driver leaves the lanes of its route; null (mcdm without incentives) and constant-hazard (random changes) are
    /// null-model controls.
    #[arg(long, value_parser = model())]
    model: Option<Model>,
    /// Seed of all random numbers [default: 1].
    #[arg(long, value_name = "N", value_parser = seed)]
    seed: Option<u64>,
    /// Number of threads, 1 to 256; results do not depend on it [default: the cores of the machine, less one core for
    /// writing if trajectories are recorded; at most 2].
    #[arg(long, value_name = "N", value_parser = threads)]
    threads: Option<NonZero<usize>>,
    /// Simulated seconds before anything is measured or recorded [default: 0].
    #[arg(long, value_name = "S", value_parser = number)]
    warmup: Option<f64>,
    /// Share of trucks, 0 to 1 [default: 0.1].
    #[arg(long, value_name = "SHARE", value_parser = number)]
    trucks: Option<f64>,
    /// Folder of all results [default: out].
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    out: Option<PathBuf>,
    /// Seconds between two samples of a trajectory, a multiple of the step; 0: no trajectories [default: 1].
    #[arg(long, value_name = "S", value_parser = number)]
    record: Option<f64>,
    /// Seconds over which flow, density and speed of every lanelet are measured, a multiple of the step; 0: not
    /// measured [default: 0].
    #[arg(long, value_name = "S", value_parser = number)]
    flows: Option<f64>,
    /// Format of the tables [default: parquet].
    #[arg(long, value_parser = format())]
    format: Option<TableFormat>,
    /// Output files in SUMO's format, separated by commas: fcd, tripinfo, lanechange [default: none].
    #[arg(long, value_name = "FILE,...", value_delimiter = ',', value_parser = sumo_file)]
    sumo: Vec<SumoFile>,
    /// Simulated seconds between two checkpoints, from which an incomplete run can be resumed; 0: no checkpoints
    /// [default: 0].
    #[arg(long, value_name = "S", value_parser = number)]
    checkpoint: Option<f64>,
    /// Resume an incomplete run from its last checkpoint, or from its beginning if it has none; other options must be
    /// the same as in the run, except --threads, --quiet and --json.
    #[arg(long)]
    resume: bool,
    /// Then run the scenario with N draws of the parameters of fitted styles, twice each, and say how much of the
    /// spread of what runs show comes from the parameters, and how much is chance.
    #[arg(long, value_name = "N", value_parser = within::<u32>(2..=10_000), conflicts_with = "resume")]
    draw_parameters: Option<u32>,
    /// On which side traffic drives [default: the side that the map gives, otherwise right].
    #[arg(long, value_name = "SIDE", value_parser = driving_side())]
    driving_side: Option<DrivingSide>,
    /// Search for overlapping vehicles at every step, not only once a second.
    #[arg(long)]
    audit: bool,
    #[command(flatten)]
    size: Limit,
    #[command(flatten)]
    screen: Screen,
}

/// What appears on screen.
#[derive(Clone, Copy, Debug, Default, Args)]
pub(crate) struct Screen {
    /// Print errors only, and no warnings.
    #[arg(long)]
    quiet: bool,
    /// Print the summary as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(super) fn weighted(text: &str) -> Result<(String, f64), String> {
    let (name, weight) = text.rsplit_once('=').ok_or("write NAME=WEIGHT, such as aggressive=1")?;
    let weight = weight.parse().map_err(|_| format!("the weight {weight:?} is not a number"))?;
    Ok((name.into(), weight))
}

/// A lane-change model by its name.
pub(super) fn model() -> impl TypedValueParser<Value = Model> {
    PossibleValuesParser::new(Model::ALL.map(Model::name)).try_map(|text| {
        let found = Model::ALL.into_iter().find(|it| it.name() == text);
        found.ok_or("unknown model")
    })
}

fn format() -> impl TypedValueParser<Value = TableFormat> {
    PossibleValuesParser::new(["parquet", "csv"])
        .map(|it| if it == "csv" { TableFormat::Csv } else { TableFormat::Parquet })
}

fn sumo_file(text: &str) -> Result<SumoFile, String> {
    match text {
        "fcd" => Ok(SumoFile::Fcd),
        "tripinfo" => Ok(SumoFile::Tripinfo),
        "lanechange" => Ok(SumoFile::Lanechange),
        _ => Err("choose among fcd, tripinfo and lanechange".into()),
    }
}

impl RunArguments {
    pub(crate) fn execute(self, call: &Call) -> Result<u8, Fault> {
        let screen = self.screen;
        if self.resume {
            return self.resume(call);
        }
        let (mut scenario, mut origin) = Origin::open(&self.input)?;
        let draws = self.draw_parameters;
        self.replace(&mut scenario, &mut origin);
        if let Some(count) = draws {
            check_draws(&scenario, &origin, count)?;
        }
        let code = run(&scenario, &origin, screen, call)?;
        match draws {
            Some(count) if code == SUCCESS => draw(&scenario, &origin, screen, count)?,
            _ => {}
        }
        Ok(code)
    }

    /// Resumes the run that left its scenario in the named folder.
    fn resume(mut self, call: &Call) -> Result<u8, Fault> {
        let (dir, screen) = (&self.input.clone(), self.screen);
        let (mut scenario, origin) = run::kept(dir)?;
        let whole = |path: &Path| path.canonicalize().ok();
        // The path of the folder may be written in another way.
        self.out = self.out.filter(|it| whole(it) != whole(dir));
        let (mut asked, mut options) = (scenario.clone(), Origin::default());
        self.replace(&mut asked, &mut options);
        same_run((&scenario, &origin), (&asked, &options))?;
        scenario.run.threads = asked.run.threads;
        scenario.map_options.max_size_mb = asked.map_options.max_size_mb;
        match run::resume(&scenario, &origin)? {
            Resumed::Run(run) => drive(*run, screen, call),
            Resumed::Complete(summary) => {
                if !screen.quiet {
                    complain(format_args!("{}: the run is already complete", dir.display()));
                }
                if screen.json {
                    say(&summary)?;
                }
                Ok(SUCCESS)
            }
        }
    }

    /// Options override the scenario.
    fn replace(self, scenario: &mut Scenario, origin: &mut Origin) {
        fn replace<T>(
            origin: &mut Origin,
            (key, option): (&'static str, &'static str),
            place: &mut T,
            value: Option<T>,
        ) {
            if let Some(value) = value {
                *place = value;
                origin.replaced(key, option);
            }
        }
        let Scenario { demand, run, output, styles, model, map_options, .. } = scenario;
        if self.demand.is_some() {
            demand.entrances.clear();
            demand.od.clear();
        }
        let total = self.demand.map(Some);
        replace(origin, ("demand.vehicles_per_hour", "--demand"), &mut demand.vehicles_per_hour, total);
        replace(origin, ("demand.trucks", "--trucks"), &mut demand.trucks, self.trucks);
        replace(origin, ("run.duration_s", "--duration"), &mut run.duration_s, self.duration);
        replace(origin, ("run.step_s", "--step"), &mut run.step_s, self.step);
        replace(origin, ("run.seed", "--seed"), &mut run.seed, self.seed);
        replace(origin, ("run.warmup_s", "--warmup"), &mut run.warmup_s, self.warmup);
        replace(origin, ("run.threads", "--threads"), &mut run.threads, self.threads.map(Some));
        replace(origin, ("run.audit", "--audit"), &mut run.audit, self.audit.then_some(true));
        replace(origin, ("output.dir", "--out"), &mut output.dir, self.out);
        replace(origin, ("output.record_s", "--record"), &mut output.record_s, self.record);
        replace(origin, ("output.flows_s", "--flows"), &mut output.flows_s, self.flows);
        replace(origin, ("output.format", "--format"), &mut output.format, self.format);
        replace(origin, ("output.checkpoint_s", "--checkpoint"), &mut output.checkpoint_s, self.checkpoint);
        let sumo = (!self.sumo.is_empty()).then(|| self.sumo.into_iter().collect());
        replace(origin, ("output.sumo", "--sumo"), &mut output.sumo, sumo);
        let mixture = (!self.style.is_empty()).then(|| self.style.into_iter().collect());
        replace(origin, ("styles", "--style"), styles, mixture);
        replace(origin, ("model", "--model"), model, self.model.map(Some));
        let side = self.driving_side.map(Some);
        replace(origin, ("map_options.driving_side", "--driving-side"), &mut map_options.driving_side, side);
        let size = self.size.mb().map(Some);
        replace(origin, ("map_options.max_size_mb", "--max-map-size"), &mut map_options.max_size_mb, size);
    }
}

/// Runs `scenario` and writes its results; nothing is written before everything has been checked.
pub(crate) fn run(scenario: &Scenario, origin: &Origin, screen: Screen, call: &Call) -> Result<u8, Fault> {
    drive(Run::begin(scenario, origin, &call.line)?, screen, call)
}

/// Refuses more draws of parameters than the styles have, before anything runs.
fn check_draws(scenario: &Scenario, origin: &Origin, count: u32) -> Result<(), Fault> {
    let fault = |what, remedy| Err(Fault::new("--draw-parameters", what, remedy));
    let mixture = mixture(scenario, origin)?;
    let drawn: Vec<_> = mixture.iter().filter(|it| it.0.draws() > 0).collect();
    if drawn.is_empty() {
        let what = "no style of the scenario has draws of its parameters".to_owned();
        return fault(what, "leave the option out, or name a style that `laneweave fit` wrote".to_owned());
    }
    match drawn.iter().find(|it| it.0.draws() < count as usize) {
        None => Ok(()),
        Some((style, _)) => {
            let (name, has) = (&style.typical().name, style.draws());
            let what =
                format!("the style {name} has {has} draws of its parameters, but {count} are asked for");
            fault(what, format!("choose 2 to {has}, or fit more: laneweave fit --draws {count}"))
        }
    }
}

/// Runs a scenario with draws of parameters.
fn draw(scenario: &Scenario, origin: &Origin, screen: Screen, count: u32) -> Result<(), Fault> {
    let threads = available_parallelism().map_or(1, NonZero::get);
    let draws = laneweave_studies::draws(scenario, origin, count, threads)?;
    write_whole(&scenario.output.dir.join(DRAWS), &json(&draws)?)?;
    match screen {
        Screen { json: false, quiet: false } => say(&draws.to_text()),
        _ => Ok(()),
    }
}

/// Drives a run to its end, and shows its progress and its results.
fn drive(run: Run, screen: Screen, call: &Call) -> Result<u8, Fault> {
    if !screen.quiet {
        warn(run.simulation());
    }
    let stop = Stop::listen()?;
    let mut progress = Progress::new(run.simulation(), screen.quiet);
    let results = run.started(call.started).complete(|simulation| {
        progress.show(simulation);
        !stop.is_raised()
    });
    progress.clear();
    let results = results?;
    let said = match screen {
        Screen { json: true, .. } => say(&results.summary.to_json()?),
        Screen { quiet: false, .. } => say(&results.to_text()),
        _ => Ok(()),
    };
    said.or_else(|fault| if stop.has_hung_up() { Ok(()) } else { Err(fault) })?;
    if !screen.quiet {
        results.warnings.iter().for_each(|it| complain(format_args!("warning: commands: {it}")));
    }
    Ok(if results.summary.interrupted { stop.code() } else { SUCCESS })
}

/// Lists the problems of the map, its remarks, and the demand.
fn warn(simulation: &Simulation) {
    let kinds = Problem::kinds(simulation.problems());
    for (problem, count) in kinds.iter().take(LISTED_KINDS) {
        let others = if *count > 1 { format!(" ({} more like it)", count - 1) } else { String::new() };
        complain(format_args!("warning: map: {problem}{others}"));
    }
    if kinds.len() > LISTED_KINDS {
        let more = kinds.len() - LISTED_KINDS;
        complain(format_args!("warning: map: {more} more kinds of problems; laneweave check lists them"));
    }
    for remark in simulation.remarks() {
        complain(format_args!("warning: map: {remark}"));
    }
    simulation.demand_note().iter().for_each(|it| complain(format_args!("{it}")));
    let warnings = [simulation.step_warning(), simulation.demand_warning()];
    warnings.iter().flatten().for_each(|it| complain(format_args!("warning: {it}")));
}
