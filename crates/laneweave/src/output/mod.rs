//! What a run leaves behind: tables, figures and a summary, each made by an observer that reads the world and never
//! writes it.

mod boxes;
mod driving;
mod flows;
mod lane_change_rate;
mod lane_changes;
mod queues;
mod reasons;
mod report;
mod road;
mod summary;
mod time_space;
mod traces;
mod trajectories;
mod trip_times;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use laneweave_sim::World;
use laneweave_study::{Format, TableError};

use crate::fault::Fault;
use crate::scenario::{Prepared, Scenario, TableFormat};

pub use boxes::Boxes;
pub use driving::{Driving, StyleDriving};
pub use flows::Flows;
pub use lane_change_rate::LaneChangeRate;
pub use lane_changes::LaneChanges;
pub use queues::{HeldFor, Queue, Queues};
pub use reasons::Reasons;
pub use report::{Record, Report};
pub use summary::{Inputs, Summary};
pub use time_space::TimeSpace;
pub use traces::Traces;
pub use trajectories::Trajectories;
pub use trip_times::{Crowd, TripTimes};

/// Something that watches a run and leaves a file.
pub trait Observer {
    /// Sees the world after a step.
    ///
    /// # Errors
    /// If what it sees cannot be written.
    fn observe(&mut self, world: &World) -> Result<(), Fault>;

    /// Is told what the run amounts to, before it completes its file.
    fn conclude(&mut self, _summary: &Summary) {}

    /// Completes its file, and names it.
    ///
    /// # Errors
    /// If the file cannot be written.
    fn finish(self: Box<Self>, world: &World) -> Result<PathBuf, Fault>;
}

/// The observers of `scenario`; makes the folder of its results.
///
/// # Errors
/// If the folder or a file in it cannot be made.
pub fn observers(scenario: &Scenario, prepared: &Prepared) -> Result<Vec<Box<dyn Observer>>, Fault> {
    let dir = &scenario.output.dir;
    fs::create_dir_all(dir).map_err(|error| Fault::refused(dir, "made the folder of the results", &error))?;
    let format = Format::from(scenario.output.format);
    let begin = f64::from(prepared.warmup_steps) * scenario.run.step_s;
    let mut observers: Vec<Box<dyn Observer>> = Vec::new();
    if let Some(steps) = prepared.record_steps {
        observers.push(Box::new(Trajectories::create(dir, format, steps)?));
    }
    if let Some(every) = prepared.flows_steps {
        let measured = [prepared.warmup_steps, prepared.warmup_steps + prepared.steps];
        observers.push(Box::new(Flows::create(dir, format, &prepared.world, every, measured)?));
    }
    observers.push(Box::new(LaneChanges::create(dir, format, begin)?));
    let duration = f64::from(prepared.steps) * scenario.run.step_s;
    observers.push(Box::new(LaneChangeRate::new(dir, &prepared.world, begin, duration)));
    observers.push(Box::new(TimeSpace::new(dir, &prepared.world, &prepared.origins, begin, duration)));
    observers.push(Box::new(Report::new(dir, scenario, prepared)));
    Ok(observers)
}

impl From<TableFormat> for Format {
    fn from(format: TableFormat) -> Format {
        match format {
            TableFormat::Csv => Format::Csv,
            TableFormat::Parquet => Format::Parquet,
        }
    }
}

/// The path of the table called `name`.
fn table_path(dir: &Path, name: &str, format: Format) -> PathBuf {
    dir.join(name).with_extension(match format {
        Format::Csv => "csv",
        Format::Parquet => "parquet",
    })
}

/// Writes a file that is complete or not there at all.
///
/// # Errors
/// If it cannot be written.
pub fn write_whole(path: &Path, text: &str) -> Result<(), Fault> {
    let mut partial = path.as_os_str().to_owned();
    partial.push(".partial");
    let written: io::Result<()> = fs::write(&partial, text).and_then(|()| fs::rename(&partial, path));
    written.map_err(|error| {
        // Of no interest beside the first failure.
        let _ = fs::remove_file(&partial);
        Fault::refused(path, "written", &error)
    })
}

impl From<TableError> for Fault {
    fn from(error: TableError) -> Fault {
        match &error {
            TableError::Create { path, source } => Fault::refused(path, "created", source),
            TableError::Write { path, source } => Fault::refused(path, "written", source),
            TableError::Width { path, .. } | TableError::Cell { path, .. } => {
                Fault::new(path.display(), &error, "report this as a bug")
            }
        }
    }
}
