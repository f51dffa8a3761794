//! Suggestions for a user who gave a file or a style in place of a command.

use std::ffi::OsString;
use std::path::Path;

use clap::Error;
use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue};
use laneweave::maps::FileKind;
use laneweave::style::built_in;

/// Adds the suggestion to an error about an unknown command among the `arguments`.
pub(crate) fn with_tip(mut error: Error, arguments: &[OsString]) -> Error {
    let Some(ContextValue::String(word)) = error.get(ContextKind::InvalidSubcommand) else { return error };
    if let Some(line) = meant(word, arguments) {
        let tip = StyledStr::from(format!("did you mean: laneweave {line}"));
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip]));
    }
    error
}

/// The suggested command line for `word`.
fn meant(word: &str, arguments: &[OsString]) -> Option<String> {
    let typed = arguments.iter().skip(1).filter_map(|it| it.to_str());
    let before: Vec<&str> = typed.take_while(|it| *it != word).collect();
    match (&before[..], FileKind::by_name(Path::new(word))) {
        (["styles"], FileKind::Toml) => Some(format!("styles show {word}")),
        (["styles"], _) if built_in(word).is_some() => Some(format!("styles show {word}")),
        (["scenario"], FileKind::Map(_)) => Some(format!("scenario new {word}")),
        ([], FileKind::Map(_) | FileKind::Toml) => Some(format!("run {word}")),
        ([], kind) if kind.is_table() => Some(format!("check {word} --map MAP")),
        ([], _) if word == "demo" => Some("(without a command, it runs the demo)".into()),
        _ => None,
    }
}
