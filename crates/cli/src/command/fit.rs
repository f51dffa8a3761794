//! `laneweave fit`.

use std::num::NonZero;
use std::path::PathBuf;
use std::thread::available_parallelism;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueHint};
use laneweave::Fault;
use laneweave::folder::FIT_REPORT;
use laneweave::models::Reading as Formulas;
use laneweave::output::json;
use laneweave_calibration::Classes;
use laneweave_studies::fit::{Judged, MOST_CLASSES, Observed, Request, Rollouts};

use super::Call;
use super::check::Reading;
use super::complain;
use super::numbers::{number, seed, within};
use super::progress::ShareDone;
use super::say;

#[derive(Debug, Args)]
pub(crate) struct FitArguments {
    /// The recordings (.csv of INTERACTION, highD, inD, rounD, exiD or NGSIM, any other with --columns; CommonRoad:
    /// .xml, with their own maps). Those that continue one another are joined.
    #[arg(value_name = "RECORDING", value_hint = ValueHint::FilePath, required = true)]
    recordings: Vec<PathBuf>,
    /// The map of the recordings [default: each recording, if they are CommonRoad files].
    #[arg(long, value_name = "MAP", value_hint = ValueHint::FilePath)]
    map: Option<PathBuf>,
    /// A TOML file that says what the columns of the recordings hold.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    columns: Option<PathBuf>,
    /// Fit nothing: say what the recordings can tell.
    #[arg(long)]
    plan: bool,
    /// Number of classes of drivers, or auto: two where the recordings tell them, else one.
    #[arg(long, value_name = "K", value_parser = classes, default_value = "auto")]
    classes: Classes,
    /// The formulas of all incentives [default: those of the prior style].
    #[arg(long, value_parser = formulas())]
    reading: Option<Formulas>,
    /// Follow the paper's procedure, too, to compare: one observation of each vehicle, no intercept, aggressive
    /// vehicles picked first.
    #[arg(long, value_parser = ["paper"])]
    procedure: Option<String>,
    /// The style whose weights are the prior: a built-in one, or the path of a style file (.toml).
    #[arg(long, value_name = "STYLE", default_value = "conservative")]
    prior: String,
    /// Draws of the bootstrap over drivers; 0: errors by the information matrix alone.
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = within::<u32>(0..=10_000))]
    draws: u32,
    /// How often a third of the drivers is held out in turn.
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = within::<u32>(1..=100))]
    repetitions: u32,
    /// Seconds before its centre crosses the line at which a vehicle begins a change [default: where its path shows it,
    /// or 1.5 if many changes had begun before their vehicles were first seen].
    #[arg(long, value_name = "S", value_parser = number)]
    lead: Option<f64>,
    /// Correct the weights for errors of the recorded positions, normal with a standard deviation of M metres along
    /// each axis: by simulation-extrapolation [default: no correction].
    #[arg(long, value_name = "M", value_parser = number)]
    position_error: Option<f64>,
    /// Judge the fit in the world: fit a style to the first two thirds of the recorded time, too, and simulate the last
    /// third with it N times, as a whole and from snapshots, beside a constant chance, MOBIL, LMRS and the built-in
    /// style [default for N: 40].
    #[arg(long, value_name = "N", num_args = 0..=1, default_missing_value = "40", value_parser = within::<u32>(2..=10_000))]
    judge: Option<u32>,
    /// Seed of all random numbers.
    #[arg(long, value_name = "N", value_parser = seed, default_value = "1")]
    seed: u64,
    /// Folder of all results: the fitted styles, and the report.
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath, default_value = "fit")]
    out: PathBuf,
    #[command(flatten)]
    options: Reading,
    /// Print the report as one JSON object.
    #[arg(long)]
    json: bool,
}

fn classes(text: &str) -> Result<Classes, String> {
    match text.parse() {
        _ if text == "auto" => Ok(Classes::Auto),
        Ok(count) if (1..=MOST_CLASSES).contains(&count) => Ok(Classes::Exactly(count)),
        _ => Err(format!("choose auto, or 1 to {MOST_CLASSES}")),
    }
}

fn formulas() -> impl TypedValueParser<Value = Formulas> {
    PossibleValuesParser::new(["literal", "repaired"])
        .map(|it| if it == "literal" { Formulas::Literal } else { Formulas::Repaired })
}

/// A fit to the first two thirds, judged by so many rollouts; `None`, with a warning, if the recordings are too short.
fn judged(observed: &Observed, count: u32) -> Result<Option<Judged>, Fault> {
    let threads = available_parallelism().map_or(1, NonZero::get);
    let shown = ShareDone::of("simulations");
    let judged = observed.judge(&Rollouts { count, threads }, &|share| shown.show(share))?;
    shown.clear();
    if judged.is_none() {
        complain(format_args!(
            "warning: the recordings are too short to be simulated: at least 60 s are needed before and after two thirds of \
             their time"
        ));
    }
    Ok(judged)
}

impl FitArguments {
    pub(crate) fn execute(self, call: &Call) -> Result<(), Fault> {
        let observed = self.request().observe()?;
        observed.problems().iter().for_each(|it| complain(format_args!("warning: {it}")));
        if self.plan {
            let plan = observed.plan();
            return say(&if self.json { json(&plan)? } else { plan.to_text() });
        }
        let judged = self.judge.map(|count| judged(&observed, count)).transpose()?.flatten();
        let report = observed.fit_beside(judged)?;
        let styles = report.write(&self.out, &self.recordings, &call.line)?;
        if self.json {
            return say(&json(&report)?);
        }
        let styles: Vec<String> = styles.iter().map(|it| it.display().to_string()).collect();
        let page = self.out.join(FIT_REPORT);
        say(&format!("{}\nstyles: {}\nreport: {}\n", report.to_text(), styles.join(", "), page.display()))
    }

    fn request(&self) -> Request {
        Request {
            map: self.map.clone(),
            columns: self.columns.clone(),
            map_options: self.options.options(),
            prior: self.prior.clone(),
            reading: self.reading,
            classes: self.classes,
            by_paper: self.procedure.is_some(),
            draws: self.draws,
            repetitions: self.repetitions,
            lead_s: self.lead,
            position_error_m: self.position_error,
            judge: self.judge,
            seed: self.seed,
            ..Request::new(self.recordings.clone())
        }
    }
}
