//! Suggestions for a user who gave a file or a style in place of a command.

use std::path::Path;

use clap::Error;
use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue};
use laneweave::maps::FileKind;
use laneweave::style::built_in;

/// Adds the suggestion to an error about an unknown command.
pub(crate) fn with_tip(mut error: Error) -> Error {
    let Some(ContextValue::String(word)) = error.get(ContextKind::InvalidSubcommand) else { return error };
    if let Some(line) = meant(word) {
        let tip = StyledStr::from(format!("did you mean: laneweave {line}"));
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip]));
    }
    error
}

/// The suggested command line for `word`.
fn meant(word: &str) -> Option<String> {
    let typed: Vec<String> = std::env::args().skip(1).collect();
    let before = typed.iter().take_while(|it| *it != word).map(String::as_str).collect::<Vec<_>>();
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
