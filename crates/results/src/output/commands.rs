//! Every command of a user: the table `commands`.

use std::path::PathBuf;

use laneweave_scenario::{COMMAND_COLUMNS, Fault, Written};
use laneweave_sim::{Commanded, World};
use laneweave_study::TableWriter;

use super::Output;
use super::batch::{Batch, BatchSender, Writer};
use super::folder::Folder;
use super::names::Names;
use crate::folder::COMMANDS;
use crate::outcome::Summary;

/// Commands in a batch; those of one step more at most.
const BATCH: usize = 256;

/// Collects commands, from the beginning of the run on: without those of the warm-up it could not be repeated.
pub(super) struct Commands {
    seen: Vec<Commanded>,
    sender: BatchSender,
}

impl Commands {
    pub(super) fn new(sender: BatchSender) -> Commands {
        Commands { seen: Vec::new(), sender }
    }
}

impl Output for Commands {
    fn warm_up(&mut self, world: &World) -> Result<(), Fault> {
        self.observe(world)
    }

    fn observe(&mut self, world: &World) -> Result<(), Fault> {
        self.seen.extend_from_slice(world.commands());
        if self.seen.len() < BATCH {
            return Ok(());
        }
        self.sender.hand_over(Batch::Commands(std::mem::take(&mut self.seen)))
    }

    fn save(&mut self, _world: &World) -> Result<Vec<u8>, Fault> {
        self.sender.hand_over(Batch::Commands(std::mem::take(&mut self.seen)))?;
        Ok(Vec::new())
    }

    fn finish(self: Box<Self>, _world: &World, _summary: &Summary) -> Result<Vec<PathBuf>, Fault> {
        self.sender.hand_over(Batch::Commands(self.seen))?;
        Ok(Vec::new())
    }
}

/// Writes a row for each command.
pub(super) struct CommandTable {
    table: TableWriter,
    path: PathBuf,
}

impl CommandTable {
    /// Begins the table in `folder`.
    pub(super) fn create(folder: &Folder) -> Result<CommandTable, Fault> {
        let (table, path) = folder.table(COMMANDS, &COMMAND_COLUMNS)?;
        Ok(CommandTable { table, path })
    }
}

impl Writer for CommandTable {
    fn write(&mut self, batch: &Batch, names: &Names) -> Result<(), Fault> {
        if let Batch::Commands(commands) = batch {
            for command in commands {
                self.table.row(&Written::of(command, names.step_s).cells())?;
            }
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<PathBuf, Fault> {
        self.table.finish()?;
        Ok(self.path)
    }
}
