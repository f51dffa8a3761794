//! What was seen, in batches of plain numbers: who fills them hands them over by a sender, who makes files of them is a
//! writer.

use std::path::PathBuf;
use std::sync::mpsc::{Sender, SyncSender, sync_channel};
use std::sync::{Arc, OnceLock};

use laneweave_scenario::Fault;
use laneweave_sim::{Incident, LaneChange};
use serde::{Deserialize, Serialize};

use super::frame::Frame;
use super::names::Names;
use super::traffic::Traffic;
use super::trip::Trip;

/// What was seen, in plain numbers.
#[derive(Serialize, Deserialize)]
pub(super) enum Batch {
    /// All vehicles at some instants.
    Frame(Frame),
    /// Lane changes that ended.
    LaneChanges(Vec<LaneChange>),
    /// Vehicles that came to touch each other.
    Incidents(Vec<Incident>),
    /// Trips that ended, or that go on when the run ends.
    Trips(Vec<Trip>),
    /// What happened on all lanelets in an interval.
    Flows(Traffic),
    /// What happened on all lanelets in the whole run.
    Lanelets(Traffic),
    /// The log of batches is to be complete up to here; its length is told, or why it is not.
    #[serde(skip)]
    Mark(Sender<Result<u64, Fault>>),
    /// The run is over, and files are to be completed.
    #[serde(skip)]
    End,
}

/// Makes one file of those batches that concern it.
pub(super) trait Writer: Send {
    /// Writes what concerns it.
    fn write(&mut self, batch: &Batch, names: &Names) -> Result<(), Fault>;

    /// Completes its file, and names it.
    fn finish(self: Box<Self>) -> Result<PathBuf, Fault>;
}

/// Hands batches to a thread that writes.
#[derive(Clone)]
pub(super) struct BatchSender {
    batches: SyncSender<Arc<Batch>>,
    fault: Arc<OnceLock<Fault>>,
}

impl BatchSender {
    /// Hands them over by `batches`; when that is closed, `fault` says why.
    pub(super) fn new(batches: SyncSender<Arc<Batch>>, fault: Arc<OnceLock<Fault>>) -> BatchSender {
        BatchSender { batches, fault }
    }

    /// Hands `batch` over, as soon as there is room for it.
    pub(super) fn hand_over(&self, batch: impl Into<Arc<Batch>>) -> Result<(), Fault> {
        self.batches.send(batch.into()).map_err(|_| self.fault())
    }

    /// Why nobody takes batches any more.
    pub(super) fn fault(&self) -> Fault {
        self.fault.get().cloned().unwrap_or_else(broke_off)
    }

    /// Hands no more batches over.
    pub(super) fn close(&mut self) {
        self.batches = sync_channel(0).0;
    }
}

/// A thread that writes ended without a word.
pub(super) fn broke_off() -> Fault {
    Fault::new("a writer thread", "stopped early", "report this as a bug")
}
