//! `laneweave run`.

use std::num::NonZero;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use clap::Args;
use laneweave::Fault;
use laneweave::output::{Inputs, Summary, observers, write_whole};
use laneweave::scenario::{Origin, Prepared, Scenario, TableFormat, prepare};
use laneweave::simulation::simulate;

use super::progress::Progress;
use super::say;

/// Exit code of a program that was stopped by the keyboard.
const STOPPED: i32 = 130;
/// Problems of a map that are listed one by one.
const LISTED_PROBLEMS: usize = 3;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// A scenario file (.toml), or a map (Lanelet2: .osm, CommonRoad: .xml; compressed: .osm.gz).
    #[arg(value_name = "SCENARIO.toml|MAP")]
    input: PathBuf,
    /// Vehicles per hour in total, split over the entrances by their number of lanes (on a map without entrance or exit
    /// evenly over its lanelets), whatever the scenario says of them [default for a map: 1000 a lane, or 200 a kilometre].
    #[arg(long, value_name = "VEH_PER_H", allow_negative_numbers = true)]
    demand: Option<f64>,
    /// Simulated and measured seconds, after the warm-up [default: 600].
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    duration: Option<f64>,
    /// Length of a step in seconds, 0.01 to 1 [default: 0.1].
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    step: Option<f64>,
    /// A style of drivers, or the path of a style file (.toml), and its weight; may be repeated, and goes in place of
    /// all styles of the scenario [default: aggressive=1 conservative=7.4].
    #[arg(long, value_name = "NAME=WEIGHT", value_parser = weighted)]
    style: Vec<(String, f64)>,
    /// Seed of all random draws [default: 1].
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Number of threads; results do not depend on it [default: the machine's, at most 2].
    #[arg(long, value_name = "N")]
    threads: Option<NonZero<usize>>,
    /// Simulated seconds before anything is measured or recorded [default: 0].
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    warmup: Option<f64>,
    /// Share of trucks, 0 to 1 [default: 0.1].
    #[arg(long, value_name = "SHARE", allow_negative_numbers = true)]
    trucks: Option<f64>,
    /// Folder of all results [default: out].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Seconds between two samples of a trajectory; 0: no trajectories [default: 1].
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    record: Option<f64>,
    /// Seconds over which flow, density and speed of every lanelet are measured; 0: they are not [default: 0].
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    flows: Option<f64>,
    /// Format of the tables [default: parquet].
    #[arg(long, value_name = "parquet|csv", value_parser = format)]
    format: Option<TableFormat>,
    #[command(flatten)]
    screen: Screen,
}

/// What appears on screen.
#[derive(Clone, Copy, Debug, Default, Args)]
pub(crate) struct Screen {
    /// Print nothing but errors.
    #[arg(long)]
    quiet: bool,
    /// Print the summary as one JSON object.
    #[arg(long)]
    json: bool,
}

fn weighted(text: &str) -> Result<(String, f64), String> {
    let (name, weight) = text.rsplit_once('=').ok_or("write NAME=WEIGHT, such as aggressive=1")?;
    let weight = weight.parse().map_err(|_| format!("the weight {weight:?} is no number"))?;
    Ok((name.into(), weight))
}

fn format(text: &str) -> Result<TableFormat, String> {
    match text {
        "parquet" => Ok(TableFormat::Parquet),
        "csv" => Ok(TableFormat::Csv),
        _ => Err("choose parquet or csv".into()),
    }
}

impl Arguments {
    pub(crate) fn execute(self, started: Instant) -> Result<(), Fault> {
        let (mut scenario, mut origin) = Origin::open(&self.input)?;
        origin.command = Some(super::given());
        let screen = self.screen;
        self.replace(&mut scenario, &mut origin);
        run(&scenario, &origin, screen, started)
    }

    /// Options go before what the scenario says.
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
        let Scenario { demand, run, output, styles, .. } = scenario;
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
        replace(origin, ("output.dir", "--out"), &mut output.dir, self.out);
        replace(origin, ("output.record_s", "--record"), &mut output.record_s, self.record);
        replace(origin, ("output.flows_s", "--flows"), &mut output.flows_s, self.flows);
        replace(origin, ("output.format", "--format"), &mut output.format, self.format);
        let mixture = (!self.style.is_empty()).then(|| self.style.into_iter().collect());
        replace(origin, ("styles", "--style"), styles, mixture);
    }
}

/// Runs `scenario` and leaves its results; nothing is written before all of it has been checked.
pub(crate) fn run(
    scenario: &Scenario,
    origin: &Origin,
    screen: Screen,
    started: Instant,
) -> Result<(), Fault> {
    let mut prepared = prepare(scenario, origin)?;
    if !screen.quiet {
        warn(&prepared);
    }
    let mut observers = observers(scenario, &prepared)?;
    let stop = stop_by_keyboard()?;
    let mut progress = Progress::new(&prepared, scenario.run.step_s, screen.quiet);
    let mut load_s = 0.0;
    let ending = simulate(
        &mut prepared,
        &mut observers,
        |world| {
            progress.show(world);
            !stop.load(Ordering::Relaxed)
        },
        || load_s = started.elapsed().as_secs_f64(),
    )?;
    progress.clear();
    let wall_s = started.elapsed().as_secs_f64();
    let summary = Summary::of(&prepared, Inputs { scenario, ending: &ending, wall_s, load_s });
    let mut files = Vec::new();
    for mut observer in observers {
        observer.conclude(&summary);
        files.push(observer.finish(&prepared.world)?);
    }
    let summary = summary.after(started.elapsed().as_secs_f64());
    let json = serde_json::to_string_pretty(&summary)
        .map_err(|error| Fault::new("summary.json", error, "report this as a bug"))?
        + "\n";
    let path = scenario.output.dir.join("summary.json");
    write_whole(&path, &json)?;
    files.push(path);
    match screen {
        Screen { json: true, .. } => say(&json),
        Screen { quiet: false, .. } => say(&summary.to_text(&prepared.styles, &files)),
        _ => {}
    }
    Ok(())
}

/// Lists what in the map could not be used as it stands.
fn warn(prepared: &Prepared) {
    let problems = &prepared.problems;
    for problem in problems.iter().take(LISTED_PROBLEMS) {
        eprintln!("warning: map: {problem}");
    }
    if problems.len() > LISTED_PROBLEMS {
        eprintln!("warning: map: {} more problems like these", problems.len() - LISTED_PROBLEMS);
    }
}

/// A flag that Ctrl-C raises, so that the run ends with what it has; a second Ctrl-C ends at once.
fn stop_by_keyboard() -> Result<Arc<AtomicBool>, Fault> {
    let stop = Arc::new(AtomicBool::new(false));
    let raised = Arc::clone(&stop);
    ctrlc::set_handler(move || {
        if raised.swap(true, Ordering::Relaxed) {
            std::process::exit(STOPPED);
        }
    })
    .map_err(|error| Fault::new("Ctrl-C", error, "report this as a bug"))?;
    Ok(stop)
}
