//! Batches of observations in plain numbers: outputs send them through a sender, and writers make files of them.

use std::path::PathBuf;
use std::sync::mpsc::{Sender, SyncSender, sync_channel};
use std::sync::{Arc, OnceLock};

use laneweave_scenario::Fault;
use laneweave_sim::{Commanded, Incident, LaneChange};
use serde::{Deserialize, Serialize};

use super::frame::Frame;
use super::names::Names;
use super::traffic::Traffic;
use super::trip::Trip;

/// A batch of observations in plain numbers.
#[derive(Serialize, Deserialize)]
pub(super) enum Batch {
    /// All vehicles at some instants.
    Frame(Frame),
    /// Completed and aborted lane changes.
    LaneChanges(Vec<LaneChange>),
    /// Vehicles that touched each other.
    Incidents(Vec<Incident>),
    /// Trips that ended, or that continue when the run ends.
    Trips(Vec<Trip>),
    /// Commands of users.
    Commands(Vec<Commanded>),
    /// The traffic on all lanelets in an interval.
    Flows(Traffic),
    /// The traffic on all lanelets in the whole run.
    Lanelets(Traffic),
    /// A mark: the log must be complete up to here; the answer is its length, or an error.
    #[serde(skip)]
    Mark(Sender<Result<u64, Fault>>),
    /// The run is over, and the files are completed.
    #[serde(skip)]
    End,
}

/// Makes one file from the batches that it needs.
pub(super) trait Writer: Send {
    /// Writes the data of a batch, if it needs it.
    fn write(&mut self, batch: &Batch, names: &Names) -> Result<(), Fault>;

    /// Completes its file, and returns its name.
    fn finish(self: Box<Self>) -> Result<PathBuf, Fault>;
}

/// Sends batches to a writer thread.
#[derive(Clone)]
pub(super) struct BatchSender {
    batches: SyncSender<Arc<Batch>>,
    fault: Arc<OnceLock<Fault>>,
}

impl BatchSender {
    /// A sender for `pages`; if this channel is closed, `fault` has the reason.
    pub(super) fn new(batches: SyncSender<Arc<Batch>>, fault: Arc<OnceLock<Fault>>) -> BatchSender {
        BatchSender { batches, fault }
    }

    /// Sends `page`, as soon as the channel has space for it.
    pub(super) fn hand_over(&self, batch: impl Into<Arc<Batch>>) -> Result<(), Fault> {
        self.batches.send(batch.into()).map_err(|_| self.fault())
    }

    /// Why no thread receives batches any more.
    pub(super) fn fault(&self) -> Fault {
        self.fault.get().cloned().unwrap_or_else(broke_off)
    }

    /// Ends sending.
    pub(super) fn close(&mut self) {
        self.batches = sync_channel(0).0;
    }
}

/// The fault of a writer thread that ended without a reason.
pub(super) fn broke_off() -> Fault {
    Fault::bug("a writer thread", "stopped early")
}
