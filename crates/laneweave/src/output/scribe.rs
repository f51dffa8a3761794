//! Tables and XML files are written by a thread of their own. What observers see reaches it in pages of plain numbers,
//! through a channel that holds few of them: an observer that is too fast waits, so that memory is bounded.
//!
//! Each kind of page comes from one observer, in the order in which it was seen, and each file is made from one kind: what is
//! in a file does not depend on when it is written.

use std::path::PathBuf;
use std::sync::mpsc::{Receiver, Sender, SyncSender, channel, sync_channel};
use std::sync::{Arc, OnceLock};
use std::thread::{self, JoinHandle};

use laneweave_sim::{LaneChange, World};

use super::Observer;
use super::frame::Frame;
use super::lanelets::Traffic;
use super::names::Names;
use super::trips::Trip;
use crate::fault::Fault;

/// Pages that wait for the writer.
const WAITING: usize = 4;

/// What was seen, in plain numbers.
pub(super) enum Page {
    /// All vehicles at some instants.
    Frame(Frame),
    /// Lane changes that ended.
    LaneChanges(Vec<LaneChange>),
    /// Trips that ended, or that go on when the run ends.
    Trips(Vec<Trip>),
    /// What happened on all lanelets in an interval.
    Flows(Traffic),
    /// What happened on all lanelets in the whole run.
    Lanelets(Traffic),
}

/// Makes one file of those pages that concern it.
pub(super) trait Writer: Send {
    /// Writes what concerns it.
    fn write(&mut self, page: &Page, names: &Names) -> Result<(), Fault>;

    /// Completes its file, and names it.
    fn finish(self: Box<Self>) -> Result<PathBuf, Fault>;
}

/// Hands pages to the writers.
#[derive(Clone)]
pub(super) struct Pen {
    pages: SyncSender<Page>,
    fault: Arc<OnceLock<Fault>>,
}

impl Pen {
    /// Hands `page` over, as soon as there is room for it.
    pub(super) fn hand_over(&self, page: Page) -> Result<(), Fault> {
        self.pages.send(page).map_err(|_| self.fault.get().cloned().unwrap_or_else(broke_off))
    }
}

/// The thread that writes, as the last of the observers: it sees nothing of the world, and completes all files when the others
/// have finished.
pub(super) struct Scribe {
    thread: Option<JoinHandle<Result<Vec<PathBuf>, Fault>>>,
}

impl Scribe {
    /// Begins to write with `writers`. The receiver gives frames back that are written, to be used again.
    pub(super) fn begin(
        writers: Vec<Box<dyn Writer>>,
        names: Names,
    ) -> Result<(Scribe, Pen, Receiver<Frame>), Fault> {
        let (pages, received) = sync_channel(WAITING);
        let (spare, spares) = channel();
        let fault = Arc::new(OnceLock::new());
        let pen = Pen { pages, fault: Arc::clone(&fault) };
        let work = move || {
            let outcome = write_all(&received, writers, &names, &spare);
            if let Err(error) = &outcome {
                // The first fault is the one that counts. It is known before the channel closes.
                let _ = fault.set(error.clone());
            }
            drop(received);
            outcome
        };
        let thread = thread::Builder::new().name("writer".into()).spawn(work);
        let thread = thread.map_err(|error| {
            Fault::new("the thread that writes", error, "stop other programs, and try again")
        })?;
        Ok((Scribe { thread: Some(thread) }, pen, spares))
    }

    /// Waits until all is written.
    fn end(&mut self) -> Result<Vec<PathBuf>, Fault> {
        let Some(thread) = self.thread.take() else { return Ok(Vec::new()) };
        thread.join().unwrap_or_else(|_| Err(broke_off()))
    }
}

impl Observer for Scribe {
    fn observe(&mut self, _world: &World) -> Result<(), Fault> {
        Ok(())
    }

    fn finish(mut self: Box<Self>, _world: &World) -> Result<Vec<PathBuf>, Fault> {
        self.end()
    }
}

impl Drop for Scribe {
    fn drop(&mut self) {
        // Files that are not complete are gone when this returns.
        let _ = self.end();
    }
}

fn broke_off() -> Fault {
    Fault::new("the thread that writes", "broke off", "report this as a bug")
}

/// Writes pages until nobody is left to hand one over.
fn write_all(
    pages: &Receiver<Page>,
    mut writers: Vec<Box<dyn Writer>>,
    names: &Names,
    spare: &Sender<Frame>,
) -> Result<Vec<PathBuf>, Fault> {
    for mut page in pages {
        if let Page::Frame(frame) = &mut page {
            frame.locate(names);
        }
        for writer in &mut writers {
            writer.write(&page, names)?;
        }
        if let Page::Frame(mut frame) = page {
            frame.clear();
            // Nobody takes it when the run is over.
            let _ = spare.send(frame);
        }
    }
    writers.into_iter().map(Writer::finish).collect()
}
