//! `laneweave completions` and `laneweave man`.

use std::fs;
use std::path::{Path, PathBuf};

use clap::builder::PossibleValuesParser;
use clap::{Args, Command, ValueHint};
use clap_complete::Shell;
use clap_mangen::Man;
use laneweave::Fault;
use laneweave::output::write_whole;
use laneweave::style::BUILT_IN;

use super::say;

#[derive(Debug, Args)]
pub(crate) struct Completions {
    /// The shell.
    shell: Shell,
}

#[derive(Debug, Args)]
pub(crate) struct Pages {
    /// The folder for the pages, such as ~/.local/share/man/man1; it is created if it does not exist.
    #[arg(value_name = "DIR", value_hint = ValueHint::DirPath)]
    folder: PathBuf,
}

impl Completions {
    pub(crate) fn execute(&self, command: Command) -> Result<(), Fault> {
        let mut text = Vec::new();
        clap_complete::generate(self.shell, &mut naming_styles(command), "laneweave", &mut text);
        say(&String::from_utf8_lossy(&text))
    }
}

/// The command for completions: style arguments may also be files, so the parsed argument cannot be a list of names.
fn naming_styles(command: Command) -> Command {
    let names = || PossibleValuesParser::new(BUILT_IN.iter().map(|it| it.name));
    let weighted = PossibleValuesParser::new(BUILT_IN.iter().map(|it| format!("{}=1", it.name)));
    command.mut_subcommand("run", |run| run.mut_arg("style", |it| it.value_parser(weighted))).mut_subcommand(
        "styles",
        |styles| {
            let styles =
                styles.mut_subcommand("show", |it| it.mut_arg("name", |it| it.value_parser(names())));
            styles.mut_subcommand("new", |it| it.mut_arg("from", |it| it.value_parser(names())))
        },
    )
}

impl Pages {
    pub(crate) fn execute(&self, mut command: Command) -> Result<(), Fault> {
        let refused = |error| Fault::refused(&self.folder, "created as the folder for the pages", &error);
        fs::create_dir_all(&self.folder).map_err(refused)?;
        command.build();
        let mut pages = Vec::new();
        collect(&command, &self.folder, &mut pages)?;
        for (path, text) in &pages {
            write_whole(path, text)?;
        }
        say(&format!("{} pages are written into {}\n", pages.len(), self.folder.display()))
    }
}

/// The page of `command` and those of its subcommands, with their file names.
fn collect(command: &Command, folder: &Path, pages: &mut Vec<(PathBuf, String)>) -> Result<(), Fault> {
    let page = Man::new(command.clone());
    let path = folder.join(page.get_filename());
    let mut text = Vec::new();
    page.render(&mut text).map_err(|error| Fault::refused(&path, "written", &error))?;
    pages.push((path, String::from_utf8_lossy(&text).into_owned()));
    let mut subcommands = command.get_subcommands().filter(|it| it.get_name() != "help");
    subcommands.try_for_each(|it| collect(it, folder, pages))
}
