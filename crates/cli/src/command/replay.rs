//! `laneweave replay`.

use std::num::NonZero;
use std::path::PathBuf;
use std::thread::available_parallelism;

use clap::{Args, ValueHint};
use laneweave::maps::FileKind;
use laneweave::output::json;
use laneweave::scenario::{MapOptions, Origin, Replay, Scenario};
use laneweave::style::Model;
use laneweave::{Fault, Simulation};
use laneweave_studies::replay::{Asked, USUAL, replay, scenario};

use super::check::Reading;
use super::complain;
use super::numbers::{number, seed, within};
use super::progress::Progress;
use super::run::{model, weighted};
use super::say;
use super::stop::Stop;
use super::{Call, SUCCESS};

#[derive(Debug, Args)]
pub(crate) struct ReplayArguments {
    /// The recording (.csv of INTERACTION, highD, inD, rounD, exiD or NGSIM, any other with --columns; CommonRoad:
    /// .xml). Several that continue one another are joined.
    #[arg(value_name = "RECORDING", value_hint = ValueHint::FilePath, required = true)]
    recording: Vec<PathBuf>,
    /// The map of the recording [default: the recording, if it is a CommonRoad file].
    #[arg(long, value_name = "MAP", value_hint = ValueHint::FilePath)]
    map: Option<PathBuf>,
    /// A TOML file that says what the columns of the recording hold.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    columns: Option<PathBuf>,
    /// Share of the vehicles that become drivers who react, 0 to 1.
    #[arg(long, value_name = "SHARE", value_parser = number, default_value = "0")]
    reactive: f64,
    /// The ids of the vehicles that become drivers, separated by commas, in place of a share.
    #[arg(
        long,
        value_name = "ID,...",
        value_delimiter = ',',
        conflicts_with = "reactive",
        allow_hyphen_values = true
    )]
    reactive_ids: Vec<i64>,
    /// Time from which on they are drivers, in seconds after the first frame; those who come later are drivers at once.
    #[arg(long, value_name = "S", value_parser = number, default_value = "0")]
    from: f64,
    /// A style of the drivers, or the path of a style file (.toml), and its weight; may be repeated [default:
    /// aggressive=1 conservative=7.4].
    #[arg(long, value_name = "NAME=WEIGHT", value_parser = weighted)]
    style: Vec<(String, f64)>,
    /// Rollouts of each model, each with other random numbers: the drivers are compared with what was recorded of them.
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = within::<u64>(1..=1000))]
    rollouts: u64,
    /// A lane-change model that is compared, too; may be repeated [default: null, mobil].
    #[arg(long = "against", value_name = "MODEL", value_parser = model())]
    against: Vec<Model>,
    /// Simulated seconds [default: the whole recording].
    #[arg(long, value_name = "S", value_parser = number)]
    duration: Option<f64>,
    /// Seed of all random numbers.
    #[arg(long, value_name = "N", value_parser = seed, default_value = "1")]
    seed: u64,
    /// Folder of all results.
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath, default_value = "replay")]
    out: PathBuf,
    /// Seconds between two samples of a trajectory, a multiple of the step [default: about 1].
    #[arg(long, value_name = "S", value_parser = number)]
    record: Option<f64>,
    #[command(flatten)]
    options: Reading,
    /// Print errors only.
    #[arg(long)]
    quiet: bool,
    /// Print the report as one JSON object.
    #[arg(long)]
    json: bool,
}

impl ReplayArguments {
    pub(crate) fn execute(self, call: &Call) -> Result<u8, Fault> {
        let (scenario, origin) = self.scenario()?;
        let stop = Stop::listen()?;
        let mut progress = None;
        let models = if self.against.is_empty() { USUAL.to_vec() } else { self.against };
        let asked = Asked {
            rollouts: self.rollouts,
            models,
            threads: available_parallelism().map_or(1, NonZero::get),
        };
        let show = |simulation: &Simulation| {
            let begun = || Progress::new(simulation, self.quiet);
            progress.get_or_insert_with(begun).show(simulation);
        };
        let done = replay(&scenario, &origin, &asked, &call.line, show, || stop.is_raised());
        progress.iter_mut().for_each(Progress::clear);
        let done = done?;
        let written = done.write(&scenario.output.dir, &self.recording, &call.line)?;
        let Some((report, path)) = written else { return Ok(stop.code()) };
        match (self.json, self.quiet) {
            (true, _) => say(&json(report)?)?,
            (false, true) => {}
            (false, false) => say(&format!(
                "{}\nreport: {}\n{} files of results beside it\n",
                report.to_text(),
                path.display(),
                done.results.files.len()
            ))?,
        }
        Ok(SUCCESS)
    }

    fn scenario(&self) -> Result<(Scenario, Origin), Fault> {
        let replay = Replay {
            recording: self.recording.clone(),
            columns: self.columns.clone(),
            reactive_share: self.reactive,
            reactive_ids: self.reactive_ids.clone(),
            reactive_from_s: self.from,
        };
        let has_map = |it: &&PathBuf| FileKind::of(it).has_tracks();
        let map = self.map.clone().or_else(|| self.recording.first().filter(has_map).cloned());
        let map = map.ok_or_else(|| {
            let place = self.recording.first().map_or(String::new(), |it| it.display().to_string());
            Fault::new(place, "a recording needs the map of its location", "add --map MAP")
        })?;
        let mut origin = Origin::default();
        let options = [
            ("replay.reactive_share", "--reactive"),
            ("replay.reactive_ids", "--reactive-ids"),
            ("replay.reactive_from_s", "--from"),
            ("run.duration_s", "--duration"),
            ("run.seed", "--seed"),
            ("output.dir", "--out"),
            ("output.record_s", "--record"),
            ("styles", "--style"),
            ("map_options.origin", "--origin"),
            ("map_options.max_size_mb", "--max-map-size"),
        ];
        options.iter().for_each(|(key, option)| origin.replaced(*key, *option));
        let (mut scenario, notes) = scenario(map, replay)?;
        notes.iter().for_each(|it| complain(format_args!("note: {it}")));
        scenario.map_options = MapOptions { joins_ends: true, ..self.options.options() };
        scenario.run.seed = self.seed;
        scenario.output.dir.clone_from(&self.out);
        scenario.run.duration_s = self.duration.unwrap_or(scenario.run.duration_s);
        scenario.output.record_s = self.record.unwrap_or(scenario.output.record_s);
        if !self.style.is_empty() {
            scenario.styles = self.style.iter().cloned().collect();
        }
        Ok((scenario, origin))
    }
}
