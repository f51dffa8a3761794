//! Suggestions for a user who gave a file or a style in place of a command.

use std::path::Path;

use clap::Error;
use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue};
use laneweave::maps::FORMATS;
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
    let extension = Path::new(word).extension().unwrap_or_default().to_string_lossy();
    let is_map = extension == "gz" || FORMATS.iter().any(|it| it.extensions.contains(&extension.as_ref()));
    match before[..] {
        ["styles"] if built_in(word).is_some() || extension == "toml" => Some(format!("styles show {word}")),
        ["scenario"] if is_map => Some(format!("scenario new {word}")),
        [] if is_map || extension == "toml" => Some(format!("run {word}")),
        [] if word == "demo" => Some("(without a command, it runs the demo)".into()),
        _ => None,
    }
}
