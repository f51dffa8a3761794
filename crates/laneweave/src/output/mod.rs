//! What a run leaves behind: tables, figures, a report and a summary, each made by an observer that reads the world and
//! never writes it.

mod boxes;
mod driving;
mod frame;
mod incidents;
mod lane_changes;
mod lanelets;
mod log;
mod names;
mod provenance;
mod queues;
mod reasons;
mod report;
mod road;
mod short_trips;
mod summary;
mod sumo;
mod traces;
mod traffic;
mod trajectories;
mod trip_times;
mod trips;
mod writer_threads;

use std::fs;
use std::io::{self, Write};
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::thread::available_parallelism;

use laneweave_scenario::Fault;
use laneweave_scenario::scenario::{Prepared, Scenario, SumoFile};
use laneweave_sim::World;
use laneweave_study::{Column, Format, PartialFile, TableWriter};

use self::frame::Samples;
use self::incidents::{IncidentTable, Incidents};
use self::lane_changes::{LaneChangeTable, LaneChanges};
use self::lanelets::{FlowTable, LaneletTable, Lanelets};
use self::names::Names;
use self::report::Report;
use self::sumo::{Fcd, LaneChangeOutput, TripInfo};
use self::trajectories::Trajectories;
use self::trips::{TripTable, Trips};
use self::writer_threads::{Writer, WriterThreads};
use crate::checkpoint;

pub use boxes::Boxes;
pub use driving::{Driving, StyleDriving};
pub use incidents::FirstIncident;
pub use provenance::{Provenance, command_line};
pub use queues::{HeldFor, Queue, Queues};
pub use reasons::Reasons;
pub use report::Record;
pub use short_trips::{ShortTrips, TripMeans};
pub use summary::{Inputs, Summary};
pub use traces::Traces;
pub use trip_times::{Crowd, TripTimes};

/// Something that watches a run; most leave files. One that keeps nothing from step to step needs `observe` only.
pub trait Observer {
    /// Sees the world after a step.
    ///
    /// # Errors
    /// If what it sees cannot be written.
    fn observe(&mut self, world: &World) -> Result<(), Fault>;

    /// What it keeps in memory, as bytes; what it has collected for the files it hands over first. By default nothing.
    ///
    /// # Errors
    /// If what is handed over cannot be written.
    fn save(&mut self, _world: &World) -> Result<Vec<u8>, Fault> {
        Ok(Vec::new())
    }

    /// Goes on from what it kept.
    ///
    /// # Errors
    /// If it is not what it kept.
    fn restore(&mut self, _saved: &[u8]) -> Result<(), Fault> {
        Ok(())
    }

    /// Completes its files after a run that amounts to `summary`, and names them. By default it leaves none.
    ///
    /// # Errors
    /// If a file cannot be written.
    fn finish(self: Box<Self>, _world: &World, _summary: &Summary) -> Result<Vec<PathBuf>, Fault> {
        Ok(Vec::new())
    }
}

/// The observers of `scenario`; makes the folder of its results. The last of them completes what the others began, and
/// finishes after them.
///
/// # Errors
/// If the folder or a file in it cannot be made.
pub fn observers(
    scenario: &Scenario,
    prepared: &Prepared,
    provenance: &Provenance,
) -> Result<Vec<Box<dyn Observer>>, Fault> {
    let folder = Folder { dir: &scenario.output.dir, format: scenario.output.format.into(), provenance };
    folder.make()?;
    let world = &prepared.world;
    let begin = f64::from(prepared.warmup_steps) * scenario.run.step_s;
    let measured = [prepared.warmup_steps, prepared.warmup_steps + prepared.steps];
    let log = prepared.checkpoint_steps.map(|_| folder.file(checkpoint::LOG));
    let (tables, xml) = (tables(prepared, &folder)?, xml(scenario, prepared, &folder)?);
    let cores = available_parallelism().map_or(1, NonZero::get);
    let free = cores.saturating_sub(prepared.threads);
    let (writers, written) = WriterThreads::begin(xml, tables, Names::of(world), log, free)?;
    let pen = writers.pen();
    let mut observers: Vec<Box<dyn Observer>> = Vec::new();
    if let Some(steps) = prepared.record_steps {
        let is_machine_full = writers.threads() > free;
        observers.push(Box::new(Samples::new(steps, is_machine_full, pen.clone(), written)));
    }
    observers.push(Box::new(Lanelets::new(world, prepared.flows_steps, measured, pen.clone())));
    observers.push(Box::new(LaneChanges::new(begin, pen.clone())));
    observers.push(Box::new(Incidents::new(begin, pen.clone())));
    observers.push(Box::new(Trips::new(pen)));
    observers.push(Box::new(Report::new(&folder, scenario, prepared)));
    observers.push(Box::new(writers));
    Ok(observers)
}

/// What writes the tables.
fn tables(prepared: &Prepared, folder: &Folder) -> Result<Vec<Box<dyn Writer>>, Fault> {
    let mut writers: Vec<Box<dyn Writer>> = Vec::new();
    if prepared.record_steps.is_some() {
        writers.push(Box::new(Trajectories::create(folder)?));
    }
    if prepared.flows_steps.is_some() {
        writers.push(Box::new(FlowTable::create(folder)?));
    }
    writers.push(Box::new(LaneChangeTable::create(folder)?));
    writers.push(Box::new(IncidentTable::create(folder)?));
    writers.push(Box::new(TripTable::create(folder)?));
    writers.push(Box::new(LaneletTable::create(folder)?));
    Ok(writers)
}

/// What writes the files of SUMO that `scenario` asks for.
fn xml(scenario: &Scenario, prepared: &Prepared, folder: &Folder) -> Result<Vec<Box<dyn Writer>>, Fault> {
    let network = prepared.world.network();
    let writer = |file: &SumoFile| -> Result<Box<dyn Writer>, Fault> {
        Ok(match file {
            SumoFile::Fcd => Box::new(Fcd::create(folder, network)?),
            SumoFile::Tripinfo => Box::new(TripInfo::create(folder)?),
            SumoFile::Lanechange => {
                Box::new(LaneChangeOutput::create(folder, network.driving_side.overtaking())?)
            }
        })
    };
    scenario.output.sumo.iter().map(writer).collect()
}

/// The folder of the results, and what is the same for all files in it.
struct Folder<'a> {
    dir: &'a Path,
    format: Format,
    provenance: &'a Provenance,
}

impl Folder<'_> {
    fn make(&self) -> Result<(), Fault> {
        let Folder { dir, .. } = self;
        fs::create_dir_all(dir).map_err(|error| Fault::refused(dir, "made the folder of the results", &error))
    }

    /// The path of a file in it.
    fn file(&self, name: &str) -> PathBuf {
        self.dir.join(name)
    }

    /// Begins the table called `name`.
    fn table(&self, name: &str, columns: &[Column]) -> Result<(TableWriter, PathBuf), Fault> {
        let path = self.file(name).with_extension(self.format.extension());
        let notes = self.provenance.notes();
        let notes = notes.each_ref().map(|(key, value)| (*key, value.as_str()));
        Ok((TableWriter::create_with(&path, self.format, columns, &notes)?, path))
    }
}

/// Writes a file that is complete or not there at all.
///
/// # Errors
/// If it cannot be written.
pub fn write_whole(path: &Path, text: &str) -> Result<(), Fault> {
    let write = || -> io::Result<()> {
        let (partial, mut file) = PartialFile::create(path)?;
        file.write_all(text.as_bytes())?;
        partial.complete()
    };
    write().map_err(|error| Fault::refused(path, "written", &error))
}
