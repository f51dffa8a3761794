//! `laneweave reproduce`.

use std::path::PathBuf;
use std::thread::available_parallelism;

use clap::builder::PossibleValuesParser;
use clap::{Args, ValueHint};
use laneweave::Fault;
use laneweave::folder::Claim;
use laneweave::output::write_whole;
use laneweave::record::SCENARIO;
use laneweave::scenario::MapOptions;
use laneweave_studies::experiments::{EXPERIMENTS, Effort, Experiment, Finding, site_rates};
use laneweave_studies::fit::Request;

use super::check::Reading;
use super::complain;
use super::numbers::within;
use super::progress::ShareDone;
use super::say;

/// The name of all experiments together.
const ALL: &str = "all";
/// The experiment that can be made at a recorded site.
const OF_A_SITE: &str = "C2";

#[derive(Debug, Args)]
pub(crate) struct ReproduceArguments {
    /// An experiment, or all of them; may be repeated.
    #[arg(value_name = "EXPERIMENT", value_parser = names(), default_value = ALL)]
    experiments: Vec<String>,
    /// Number of seeds of each kind of traffic [default: 5].
    #[arg(long, value_name = "N", value_parser = within::<u64>(1..=1000))]
    seeds: Option<u64>,
    /// A try of a minute: 2 seeds, and a tenth of the simulated times.
    #[arg(long)]
    quick: bool,
    /// Measure C2 at a recorded site instead: a recording of it (as of `fit`). May be repeated: those that continue one
    /// another are joined.
    #[arg(long, value_name = "RECORDING", value_hint = ValueHint::FilePath)]
    site: Vec<PathBuf>,
    /// The map of the recorded site [default: each recording, if they are CommonRoad files].
    #[arg(long, value_name = "MAP", value_hint = ValueHint::FilePath, requires = "site")]
    map: Option<PathBuf>,
    /// A TOML file that says what the columns of the recordings hold.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, requires = "site")]
    columns: Option<PathBuf>,
    #[command(flatten)]
    options: Reading,
    /// Folder for the words, tables and figures.
    #[arg(long, value_name = "DIR", default_value = "reproduction")]
    out: PathBuf,
}

fn names() -> PossibleValuesParser {
    PossibleValuesParser::new(EXPERIMENTS.iter().map(|it| it.name).chain([ALL]))
}

impl ReproduceArguments {
    pub(crate) fn execute(self) -> Result<(), Fault> {
        let threads = available_parallelism().map_or(1, |it| it.get());
        let usual = if self.quick { Effort::quick(threads) } else { Effort::usual(threads) };
        let effort = Effort { seeds: self.seeds.unwrap_or(usual.seeds), ..usual };
        if !self.site.is_empty() {
            return self.at_site(&effort);
        }
        if self.options.options() != MapOptions::default() {
            let what = "--origin, --law, --driving-side and --max-map-size say how the map of a recorded site is read";
            return Err(Fault::new("reproduce", what, "leave them out, or name the site with --site"));
        }
        let is_asked = |it: &&Experiment| self.experiments.iter().any(|name| name == it.name || name == ALL);
        let folder = self.folder()?;
        for experiment in EXPERIMENTS.iter().filter(is_asked) {
            write(&folder, experiment.name, &experiment.run(&effort)?)?;
        }
        say(&format!("results: {}\n", self.out.display()))
    }

    /// C2 at a recorded site.
    fn at_site(&self, effort: &Effort) -> Result<(), Fault> {
        if self.experiments != [OF_A_SITE] {
            let what = format!("only {OF_A_SITE} is measured at a recorded site");
            return Err(Fault::new(
                "--site",
                what,
                format!("write: laneweave reproduce {OF_A_SITE} --site …"),
            ));
        }
        let request = Request {
            map: self.map.clone(),
            columns: self.columns.clone(),
            map_options: self.options.options(),
            ..Request::new(self.site.clone())
        };
        let observed = request.observe()?;
        observed.problems().iter().for_each(|it| complain(format_args!("warning: {it}")));
        let folder = self.folder()?;
        let shown = ShareDone::of("simulations");
        let finding = site_rates(&observed, effort, &|share| shown.show(share))?;
        shown.clear();
        write(&folder, &format!("{OF_A_SITE}_site"), &finding)?;
        say(&format!("results: {}\n", self.out.display()))
    }

    /// The folder of the results, which is not that of a run.
    fn folder(&self) -> Result<Claim, Fault> {
        if self.out.join(SCENARIO).exists() {
            let what = "this folder contains a scenario; the results of a run of it would be mixed with the experiments";
            return Err(Fault::new(self.out.display(), what, "choose another folder with --out"));
        }
        Claim::on(&self.out)
    }
}

/// Writes and prints what an experiment of this name found.
fn write(folder: &Claim, name: &str, finding: &Finding) -> Result<(), Fault> {
    let write = |name: String, text: &str| write_whole(&folder.dir().join(name), text);
    write(format!("{name}.md"), &finding.text)?;
    for (name, table) in &finding.tables {
        write(format!("{name}.csv"), table)?;
    }
    for (name, figure) in &finding.figures {
        write(format!("{name}.svg"), figure)?;
    }
    say(&format!("{}\n", finding.text))
}
