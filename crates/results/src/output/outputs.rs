//! All outputs of a run.

use std::num::NonZero;
use std::thread::available_parallelism;

use laneweave_scenario::Fault;
use laneweave_scenario::scenario::{Prepared, Scenario, SumoFile};

use super::Output;
use super::batch::Writer;
use super::commands::{CommandTable, Commands};
use super::folder::Folder;
use super::incidents::{IncidentTable, Incidents};
use super::lane_changes::{LaneChangeTable, LaneChanges};
use super::lanelets::{FlowTable, LaneletTable, Lanelets};
use super::names::Names;
#[cfg(feature = "reports")]
use super::report::Report;
use super::samples::Samples;
use super::sumo::{Fcd, LaneChangeOutput, TripInfo};
use super::trajectories::Trajectories;
use super::trips::{TripTable, Trips};
use super::writer_threads::WriterThreads;
use crate::checkpoint;
use crate::outcome::Provenance;

/// The outputs of `scenario`; creates the folder of its results. The last of them completes the files of the
/// others, and finishes after them.
///
/// # Errors
/// If the folder or a file in it cannot be created.
pub fn outputs(
    scenario: &Scenario,
    prepared: &Prepared,
    provenance: &Provenance,
) -> Result<Vec<Box<dyn Output>>, Fault> {
    let folder = Folder { dir: &scenario.output.dir, format: scenario.output.format.into(), provenance };
    folder.make()?;
    let world = &prepared.world;
    let begin = f64::from(prepared.conditions.warmup_steps) * scenario.run.step_s;
    let measured =
        [prepared.conditions.warmup_steps, prepared.conditions.warmup_steps + prepared.conditions.steps];
    let log = prepared.conditions.checkpoint_steps.map(|_| folder.file(checkpoint::LOG));
    let (tables, xml) = (tables(prepared, &folder)?, xml(scenario, prepared, &folder)?);
    let cores = available_parallelism().map_or(1, NonZero::get);
    let free = cores.saturating_sub(prepared.threads);
    let (writers, written) = WriterThreads::begin(xml, tables, Names::of(world, scenario), log, free)?;
    let sender = writers.sender();
    let mut outputs: Vec<Box<dyn Output>> = Vec::new();
    if let Some(steps) = prepared.conditions.record_steps {
        let is_machine_full = writers.threads() > free;
        outputs.push(Box::new(Samples::new(steps, is_machine_full, sender.clone(), written)));
    }
    outputs.push(Box::new(Lanelets::new(world, prepared.conditions.flows_steps, measured, sender.clone())));
    outputs.push(Box::new(LaneChanges::new(begin, sender.clone())));
    outputs.push(Box::new(Incidents::new(begin, sender.clone())));
    outputs.push(Box::new(Commands::new(sender.clone())));
    outputs.push(Box::new(Trips::new(sender)));
    #[cfg(feature = "reports")]
    outputs.push(Box::new(Report::new(&folder, scenario, prepared)));
    outputs.push(Box::new(writers));
    Ok(outputs)
}

/// The writers of the tables.
fn tables(prepared: &Prepared, folder: &Folder) -> Result<Vec<Box<dyn Writer>>, Fault> {
    let mut writers: Vec<Box<dyn Writer>> = Vec::new();
    if prepared.conditions.record_steps.is_some() {
        writers.push(Box::new(Trajectories::create(folder)?));
    }
    if prepared.conditions.flows_steps.is_some() {
        writers.push(Box::new(FlowTable::create(folder)?));
    }
    writers.push(Box::new(LaneChangeTable::create(folder)?));
    writers.push(Box::new(IncidentTable::create(folder)?));
    writers.push(Box::new(CommandTable::create(folder)?));
    writers.push(Box::new(TripTable::create(folder)?));
    writers.push(Box::new(LaneletTable::create(folder)?));
    Ok(writers)
}

/// The writers of SUMO's files that `scenario` asks for.
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
