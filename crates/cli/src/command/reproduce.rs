//! `laneweave reproduce`.

use std::path::PathBuf;
use std::thread::available_parallelism;

use clap::Args;
use clap::builder::PossibleValuesParser;
use laneweave::Fault;
use laneweave::folder::Claim;
use laneweave::output::write_whole;
use laneweave::record::SCENARIO;
use laneweave_studies::experiments::{EXPERIMENTS, Effort, Experiment};

use super::say;

/// The name of all experiments together.
const ALL: &str = "all";

#[derive(Debug, Args)]
pub(crate) struct ReproduceArguments {
    /// An experiment, or all of them; may be repeated.
    #[arg(value_name = "EXPERIMENT", value_parser = names(), default_value = ALL)]
    experiments: Vec<String>,
    /// Number of seeds of each kind of traffic [default: 5].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1000))]
    seeds: Option<u64>,
    /// A try of a minute: 2 seeds, and a tenth of the simulated times.
    #[arg(long)]
    quick: bool,
    /// Folder for the words, tables and figures.
    #[arg(long, value_name = "DIR", default_value = "reproduction")]
    out: PathBuf,
}

fn names() -> PossibleValuesParser {
    PossibleValuesParser::new(EXPERIMENTS.iter().map(|it| it.name).chain([ALL]))
}

impl ReproduceArguments {
    pub(crate) fn execute(self) -> Result<(), Fault> {
        let ReproduceArguments { experiments, seeds, quick, out } = self;
        let threads = available_parallelism().map_or(1, |it| it.get());
        let usual = if quick { Effort::quick(threads) } else { Effort::usual(threads) };
        let effort = Effort { seeds: seeds.unwrap_or(usual.seeds), ..usual };
        let is_asked = |it: &&Experiment| experiments.iter().any(|name| name == it.name || name == ALL);
        if out.join(SCENARIO).exists() {
            let what = "this folder contains a scenario; the results of a run of it would be mixed with the experiments";
            return Err(Fault::new(out.display(), what, "choose another folder with --out"));
        }
        let claim = Claim::on(&out)?;
        for experiment in EXPERIMENTS.iter().filter(is_asked) {
            let finding = experiment.run(&effort)?;
            let write = |name: String, text: &str| write_whole(&claim.dir().join(name), text);
            write(format!("{}.md", experiment.name), &finding.text)?;
            for (name, table) in &finding.tables {
                write(format!("{name}.csv"), table)?;
            }
            for (name, figure) in &finding.figures {
                write(format!("{name}.svg"), figure)?;
            }
            say(&format!("{}\n", finding.text))?;
        }
        say(&format!("results: {}\n", out.display()))
    }
}
