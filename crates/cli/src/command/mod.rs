//! The command line.

mod branch;
mod check;
mod compare;
mod examples;
mod explain;
mod fit;
mod generate;
mod numbers;
mod observe;
mod progress;
mod recording;
mod render;
mod replay;
mod reproduce;
mod resume;
mod routes;
mod run;
mod scenario;
mod shell;
mod shown;
mod stop;
mod styles;
mod sweep;
mod tips;
mod view;

use std::any::TypeId;
use std::ffi::OsString;
use std::fmt;
use std::io::{self, Write};
use std::path::PathBuf;
use std::time::Instant;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use laneweave::Fault;
use laneweave::output::command_line;
use laneweave::scenario::{Origin, Scenario};

pub(crate) use stop::refuse_large_files;
pub(crate) use tips::with_tip;

/// Exit code of a command that did what was asked.
pub(crate) const SUCCESS: u8 = 0;

/// The call of a command.
pub(crate) struct Call {
    /// When it began.
    started: Instant,
    /// The command line as it was given.
    line: String,
    /// How a process of the same command begins: a program, and its first arguments.
    program: Vec<OsString>,
}

impl Call {
    pub(crate) fn new(started: Instant, arguments: &[OsString], program: Vec<OsString>) -> Call {
        let given = arguments.iter().skip(1).map(|it| it.to_string_lossy().into_owned());
        Call { started, line: command_line(given), program }
    }
}

/// Microscopic traffic whose drivers change lanes for human reasons.
///
/// Without a command it runs the demo scenario, ten minutes of a town with a motorway through it, and writes into out/.
#[derive(Debug, Parser)]
#[command(name = "laneweave", version, max_term_width = 100, after_help = examples::LANEWEAVE)]
pub(crate) struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Simulate a scenario, or a bare map.
    #[command(after_help = examples::RUN)]
    Run(run::RunArguments),
    /// Show traffic on its map in the browser, in 3-D, with the reasons of its drivers, and change it while it drives.
    #[command(after_help = examples::VIEW)]
    View(view::ViewArguments),
    /// Make pictures of traffic from above, one after the other, without a display.
    #[command(after_help = examples::RENDER)]
    Render(render::RenderArguments),
    /// Explain why a driver of a run changed lanes, waited, or stayed in its lane.
    #[command(after_help = examples::EXPLAIN)]
    Explain(explain::ExplainArguments),
    /// Repeat a run with one thing changed from a time on, and report what differs (a counterfactual).
    #[command(after_help = examples::BRANCH)]
    Branch(branch::BranchArguments),
    /// Run scenarios with several lane-change models and seeds, and compare the results.
    #[command(after_help = examples::COMPARE)]
    Compare(compare::CompareArguments),
    /// Run many variants of a scenario, each with several seeds, and write a table with a row for each run.
    #[command(after_help = examples::SWEEP)]
    Sweep(sweep::SweepArguments),
    /// Run experiments: the drivers beside published values, and the claims of the paper.
    #[command(after_help = examples::REPRODUCE)]
    Reproduce(reproduce::ReproduceArguments),
    /// Report what a map or a recording contains, and the problems in it.
    #[command(after_help = examples::CHECK)]
    Check(check::CheckArguments),
    /// Record the traffic of a run as a drone would: its view, its frame rate, its errors.
    #[command(after_help = examples::OBSERVE)]
    Observe(observe::ObserveArguments),
    /// Replay a recording: its vehicles drive as they were recorded, and some of them react.
    #[command(after_help = examples::REPLAY)]
    Replay(replay::ReplayArguments),
    /// Fit driving styles to recordings, with their uncertainty.
    #[command(after_help = examples::FIT)]
    Fit(fit::FitArguments),
    /// Join recordings.
    #[command(subcommand, after_help = examples::RECORDING)]
    Recording(recording::RecordingCommand),
    /// List the sensible routes from one lanelet of a map to another.
    #[command(after_help = examples::ROUTES)]
    Routes(routes::RoutesArguments),
    /// Create a scenario file.
    #[command(subcommand, after_help = examples::SCENARIO)]
    Scenario(scenario::ScenarioCommand),
    /// Generate a map.
    #[command(subcommand, after_help = examples::GENERATE)]
    Generate(generate::Kind),
    /// List, print or create driver styles.
    #[command(subcommand, after_help = examples::STYLES)]
    Styles(styles::StylesCommand),
    /// Print the JSON schema of scenario files.
    #[command(after_help = examples::SCHEMA)]
    Schema,
    /// Print the completion script of a shell, for commands, options and names.
    #[command(after_help = examples::COMPLETIONS)]
    Completions(shell::Completions),
    /// Write manual pages, one for each command.
    #[command(after_help = examples::MAN)]
    Man(shell::Pages),
}

/// The command, whose numbers and places may begin with a minus sign, so that the message about a wrong one names its
/// option. A name or path may not: there an option would be taken for it, as it would for a value that may be left out.
fn with_negative_values(command: clap::Command) -> clap::Command {
    let named = command.mut_args(|it| {
        let parser = it.get_value_parser();
        let is_text =
            [TypeId::of::<PathBuf>(), TypeId::of::<String>()].iter().any(|text| parser.type_id() == *text);
        let takes_words = is_text || parser.possible_values().is_some();
        let has_value =
            it.get_action().takes_values() && it.get_num_args().is_none_or(|it| it.min_values() > 0);
        let may_be_negative = !it.is_positional() && has_value && !takes_words;
        if may_be_negative { it.allow_hyphen_values(true) } else { it }
    });
    named.mut_subcommands(with_negative_values)
}

impl Cli {
    /// What the user asks for.
    ///
    /// # Errors
    /// On a wrong command line, and if it asks for help or for the version.
    pub(crate) fn read(arguments: &[OsString]) -> Result<Cli, clap::Error> {
        Cli::from_arg_matches(&with_negative_values(Cli::command()).try_get_matches_from(arguments)?)
    }

    /// Does what the user asks for, and returns the exit code.
    pub(crate) fn execute(self, call: &Call) -> Result<u8, Fault> {
        let done = match self.command {
            None => {
                let (scenario, origin) = Origin::demo()?;
                return run::run(&scenario, &origin, run::Screen::default(), call);
            }
            Some(Command::Run(arguments)) => return arguments.execute(call),
            Some(Command::View(arguments)) => arguments.execute(),
            Some(Command::Render(arguments)) => arguments.execute(),
            Some(Command::Explain(arguments)) => arguments.execute(),
            Some(Command::Branch(arguments)) => arguments.execute(call),
            Some(Command::Compare(arguments)) => arguments.execute(call),
            Some(Command::Sweep(arguments)) => return arguments.execute(call),
            Some(Command::Reproduce(arguments)) => arguments.execute(),
            Some(Command::Check(arguments)) => arguments.execute(),
            Some(Command::Observe(arguments)) => arguments.execute(),
            Some(Command::Replay(arguments)) => return arguments.execute(call),
            Some(Command::Fit(arguments)) => arguments.execute(call),
            Some(Command::Recording(deed)) => deed.execute(),
            Some(Command::Routes(arguments)) => arguments.execute(),
            Some(Command::Scenario(deed)) => deed.execute(),
            Some(Command::Generate(kind)) => kind.execute(),
            Some(Command::Styles(deed)) => deed.execute(),
            Some(Command::Schema) => say(&format!("{:#}\n", Scenario::schema().to_value())),
            Some(Command::Completions(arguments)) => arguments.execute(Cli::command()),
            Some(Command::Man(arguments)) => arguments.execute(Cli::command()),
        };
        done.map(|()| SUCCESS)
    }
}

/// Prints `text` on standard output.
///
/// # Errors
/// If it cannot be written there, or nobody reads it.
pub(crate) fn say(text: &str) -> Result<(), Fault> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes()).and_then(|()| out.flush()).map_err(|error| Fault::output(&error))
}

/// Writes a line to standard error. Where that is closed, nobody wants to know.
pub(crate) fn complain(text: fmt::Arguments) {
    let _ = writeln!(io::stderr(), "{text}");
}
