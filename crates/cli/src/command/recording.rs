//! `laneweave recording`.

use std::io::BufWriter;
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand, ValueHint};
use laneweave::Fault;
use laneweave::open_recordings;
use laneweave::recordings::{Recording, interaction};
use laneweave::study::PartialFile;

use super::{examples, say};

#[derive(Debug, Subcommand)]
pub(crate) enum RecordingCommand {
    /// Join recordings that continue one another.
    #[command(after_help = examples::RECORDING_JOIN)]
    Join(Join),
}

#[derive(Debug, Args)]
pub(crate) struct Join {
    /// The recordings, in any order. Frames are counted from the first one.
    #[arg(value_name = "RECORDING", value_hint = ValueHint::FilePath, num_args = 2.., required = true)]
    recordings: Vec<PathBuf>,
    /// The recording to write, in the layout of INTERACTION.
    #[arg(long, value_name = "FILE", default_value = "joined.csv", value_hint = ValueHint::FilePath)]
    to: PathBuf,
    /// A TOML file that says what their columns hold.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    columns: Option<PathBuf>,
}

impl RecordingCommand {
    pub(crate) fn execute(self) -> Result<(), Fault> {
        let RecordingCommand::Join(Join { recordings, to, columns }) = self;
        let (recording, problems) = open_recordings(&recordings, columns.as_deref())?;
        write(&to, &recording)?;
        let problems: String = problems.iter().map(|it| format!("  {it}\n")).collect();
        say(&format!("{} {}\n{problems}", told(&recording), to.display()))
    }
}

/// Tracks, states and time between frames of a recording, before the name of its file.
pub(super) fn told(recording: &Recording) -> String {
    let states: usize = recording.tracks.iter().map(|it| it.states.len()).sum();
    format!("{} tracks with {states} states, a frame every {} s, in", recording.tracks.len(), recording.step)
}

/// Writes a recording in the layout of INTERACTION, whole or not at all.
pub(super) fn write(path: &Path, recording: &Recording) -> Result<(), Fault> {
    let write = || {
        let (partial, file) = PartialFile::create(path)?;
        let mut file = BufWriter::new(file);
        interaction::write(recording, &mut file)?;
        file.into_inner().map_err(|it| it.into_error())?;
        partial.complete()
    };
    write().map_err(|error| Fault::refused(path, "written", &error))
}
