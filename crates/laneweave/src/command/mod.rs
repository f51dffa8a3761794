//! The command line.

mod check;
mod generate;
mod progress;
mod routes;
mod run;
mod styles;

use std::io::{self, Write};
use std::time::Instant;

use clap::{Parser, Subcommand};
use laneweave::Fault;
use laneweave::scenario::{Origin, Scenario};

/// Microscopic traffic whose drivers change lanes for human reasons.
///
/// Without a command it runs the demo scenario, ten minutes of a town with a motorway through it, and writes into out/.
#[derive(Debug, Parser)]
#[command(version, max_term_width = 100)]
pub(crate) struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Simulate a scenario, or a bare map.
    Run(run::Arguments),
    /// Say what a map or a recording holds, and what is wrong with it.
    Check(check::Arguments),
    /// Name the sensible ways from one lanelet of a map to another.
    Routes(routes::Arguments),
    /// Make a map.
    #[command(subcommand)]
    Generate(generate::Kind),
    /// See, or begin to write, styles of drivers.
    #[command(subcommand)]
    Styles(styles::Deed),
    /// Print the JSON schema of scenario files.
    Schema,
}

impl Cli {
    /// Does what the user asks for; `started` is when the process began.
    pub(crate) fn execute(self, started: Instant) -> Result<(), Fault> {
        match self.command {
            None => {
                let (scenario, mut origin) = Origin::demo()?;
                origin.command = Some(given());
                run::run(&scenario, &origin, run::Screen::default(), started)
            }
            Some(Command::Run(arguments)) => arguments.execute(started),
            Some(Command::Check(arguments)) => arguments.execute(),
            Some(Command::Routes(arguments)) => arguments.execute(),
            Some(Command::Generate(kind)) => kind.execute(),
            Some(Command::Styles(deed)) => deed.execute(),
            Some(Command::Schema) => {
                say(&format!("{:#}\n", Scenario::schema().to_value()));
                Ok(())
            }
        }
    }
}

/// Prints `text`. Whoever stops listening, as `head` does, has seen enough.
fn say(text: &str) {
    let mut out = io::stdout().lock();
    let _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
}

/// The command as it was given, in the words of a shell.
fn given() -> String {
    let quoted = |word: String| {
        let is_plain = |it: char| it.is_alphanumeric() || "-_./=:,+@%".contains(it);
        if !word.is_empty() && word.chars().all(is_plain) {
            word
        } else {
            format!("'{}'", word.replace('\'', "'\\''"))
        }
    };
    let words = std::env::args_os().skip(1).map(|it| quoted(it.to_string_lossy().into_owned()));
    ["laneweave".into()].into_iter().chain(words).collect::<Vec<String>>().join(" ")
}
