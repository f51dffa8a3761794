//! What is shown: by `laneweave view` in the browser, by `laneweave render` as pictures.

use std::path::PathBuf;

use clap::{Args, ValueHint};
use laneweave_viewer::Shown;

use super::check::Reading;

/// Traffic that is shown.
#[derive(Debug, Args)]
pub(super) struct ShownArguments {
    /// A scenario (.toml) or a map to simulate, the folder with the results of a run, or with --map a recording
    /// (several that continue one another are joined) [default: the demo].
    #[arg(value_name = "SCENARIO|MAP|OUT|RECORDING", value_hint = ValueHint::AnyPath)]
    input: Vec<PathBuf>,
    /// The map of the recording.
    #[arg(long, value_name = "MAP", value_hint = ValueHint::FilePath, requires = "input")]
    map: Option<PathBuf>,
    /// A TOML file that says what the columns of the recording hold.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, requires = "map")]
    columns: Option<PathBuf>,
    #[command(flatten)]
    options: Reading,
}

impl ShownArguments {
    pub(super) fn shown(&self) -> Shown {
        let ShownArguments { input, map, columns, options } = self;
        Shown { input: input.clone(), map: map.clone(), columns: columns.clone(), options: options.options() }
    }
}
