//! `laneweave styles`.

use std::fs::OpenOptions;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Subcommand;
use laneweave::maps::FileKind;
use laneweave::style::{BUILT_IN, StyleTemplate, copy, find};
use laneweave::{Fault, Source};

use super::{examples, say};

#[derive(Debug, Subcommand)]
pub(crate) enum StylesCommand {
    /// List the built-in styles, each with a short description.
    #[command(after_help = examples::STYLES_LIST)]
    List,
    /// Print a style file.
    #[command(after_help = examples::STYLES_SHOW)]
    Show {
        /// Name of a built-in style, or path of a style file (.toml).
        name: String,
    },
    /// Write a style file to edit.
    #[command(after_help = examples::STYLES_NEW)]
    New {
        /// Name of the new style.
        name: String,
        /// The style to start from: a built-in one, or a style file (.toml).
        #[arg(long, value_name = "STYLE", default_value = "conservative")]
        from: String,
        /// The file to write; an existing file is never replaced [default: NAME.toml].
        #[arg(long, value_name = "FILE")]
        file: Option<PathBuf>,
    },
}

impl StylesCommand {
    pub(crate) fn execute(self) -> Result<(), Fault> {
        match self {
            StylesCommand::List => {
                let widest = BUILT_IN.iter().map(|it| it.name.len()).max().unwrap_or(0);
                let mut text = String::new();
                for style in BUILT_IN {
                    let template = StyleTemplate::parse(&named(style.name)?)?;
                    text += &format!("{:widest$}  {}\n", style.name, template.typical().description);
                }
                say(&text)
            }
            StylesCommand::Show { name } => say(&named(&name)?.text),
            StylesCommand::New { name, from, file } => {
                let text = copy(&named(&from)?, &name)?;
                let file = file.unwrap_or_else(|| PathBuf::from(format!("{name}.toml")));
                if !matches!(FileKind::by_name(&file), FileKind::Toml) {
                    let what = "this is not a valid name for a style file";
                    return Err(Fault::new(file.display(), what, "use a name that ends in .toml"));
                }
                write_new(&file, &text)?;
                say(&format!(
                    "{} is written; edit it, then run: laneweave run MAP --style {0}=1\n",
                    file.display()
                ))
            }
        }
    }
}

fn named(name: &str) -> Result<Source, Fault> {
    find(name, Path::new(""), || "styles".into())
}

/// Writes a file that does not exist yet.
fn write_new(path: &Path, text: &str) -> Result<(), Fault> {
    let file = OpenOptions::new().write(true).create_new(true).open(path);
    file.and_then(|mut file| file.write_all(text.as_bytes()))
        .map_err(|error| Fault::refused(path, "written", &error))
}
