//! Tables and XML files are written by threads of their own. What observers see reaches them in batches of plain
//! numbers, through channels that hold few of them: an observer that is too fast waits, so that memory is bounded.
//!
//! Each kind of batch comes from one observer, in the order in which it was seen, and each file is made from one kind:
//! what is in a file does not depend on when it is written.

use std::path::PathBuf;
use std::sync::mpsc::{Receiver, SyncSender, channel, sync_channel};
use std::sync::{Arc, OnceLock};
use std::thread::{self, JoinHandle};

use laneweave_scenario::Fault;
use laneweave_sim::World;

use super::batch::{Batch, BatchSender, Writer, broke_off};
use super::frame::Frame;
use super::log::{PageLog, batches};
use super::names::Names;
use crate::observer::Observer;
use crate::outcome::Summary;
use crate::pack::{pack, unpack};

/// Pages that wait for a thread: as many as are filled while a row group of a table is encoded.
const WAITING: usize = 16;
/// Frames that wait to be filled again, at most: of batches that come again there are more.
const SPARES: usize = 24;
/// The thread for the tables, which keeps the log too, and that for the XML files.
const TABLES: &str = "tables";
const XML: &str = "xml";

/// The threads that write, as the last of the observers: it sees nothing of the world, and has all files completed when
/// the others have finished.
pub(super) struct WriterThreads {
    sender: BatchSender,
    threads: Vec<JoinHandle<Result<Vec<PathBuf>, Fault>>>,
    /// The log of batches, if there is one.
    log: Option<PathBuf>,
}

impl WriterThreads {
    /// Begins to write with `xml` and `tables`: on two threads if so many `cores` are free, of which that for the
    /// tables passes all batches on to that for the XML files, and else on one. The receiver gives frames back that are
    /// written, to be used again.
    pub(super) fn begin(
        mut xml: Vec<Box<dyn Writer>>,
        mut tables: Vec<Box<dyn Writer>>,
        names: Names,
        log_path: Option<PathBuf>,
        cores: usize,
    ) -> Result<(WriterThreads, Receiver<Frame>), Fault> {
        if cores < 2 {
            tables.append(&mut xml);
        }
        let mut log = log_path.as_deref().map(PageLog::create).transpose()?;
        let (written, spares) = sync_channel(SPARES);
        let (names, fault) = (Arc::new(names), Arc::new(OnceLock::new()));
        let (mut threads, mut next) = (Vec::new(), None);
        let stages = [(XML, xml), (TABLES, tables)];
        for (name, writers) in stages.into_iter().filter(|(_, writers)| !writers.is_empty()) {
            let (batches, received) = sync_channel(WAITING);
            let sender = BatchSender::new(batches, Arc::clone(&fault));
            let stage =
                Stage { next: next.replace(sender), names: Arc::clone(&names), written: written.clone() };
            let fault = Arc::clone(&fault);
            // The first to get the batches logs them.
            let log = if name == TABLES { log.take() } else { None };
            let work = move || {
                let outcome = stage.write(&received, writers, log);
                if let Err(error) = &outcome {
                    // The first fault is the one that counts. It is known before a channel closes.
                    let _ = fault.set(error.clone());
                }
                drop((received, stage));
                outcome
            };
            threads.push(thread::Builder::new().name(name.into()).spawn(work).map_err(|error| {
                Fault::new("a writer thread", error, "close other programs, and try again")
            })?);
        }
        let sender = next.ok_or_else(broke_off)?;
        Ok((WriterThreads { sender, threads, log: log_path }, spares))
    }

    /// Number of threads that write.
    pub(super) fn threads(&self) -> usize {
        self.threads.len()
    }

    /// What hands batches over to it.
    pub(super) fn sender(&self) -> BatchSender {
        self.sender.clone()
    }

    /// Waits until all threads have ended.
    fn join(threads: Vec<JoinHandle<Result<Vec<PathBuf>, Fault>>>) -> Result<Vec<PathBuf>, Fault> {
        let ended: Vec<_> =
            threads.into_iter().map(|it| it.join().unwrap_or_else(|_| Err(broke_off()))).collect();
        // The tables, whose thread was begun last, stand first.
        let files: Result<Vec<Vec<PathBuf>>, Fault> = ended.into_iter().rev().collect();
        Ok(files?.concat())
    }
}

impl Observer for WriterThreads {
    /// All batches up to now are in the log, whose length is kept.
    fn save(&mut self, _world: &World) -> Result<Vec<u8>, Fault> {
        let (told, length) = channel();
        self.sender.hand_over(Batch::Mark(told))?;
        let length = length.recv().map_err(|_| self.sender.fault())?;
        pack(&length?)
    }

    /// Pages that were logged come again.
    fn restore(&mut self, saved: &[u8]) -> Result<(), Fault> {
        let Some(log) = &self.log else { return Ok(()) };
        for batch in batches(log, unpack(saved)?)? {
            self.sender.hand_over(batch?)?;
        }
        Ok(())
    }

    fn observe(&mut self, _world: &World) -> Result<(), Fault> {
        Ok(())
    }

    fn finish(mut self: Box<Self>, _world: &World, _summary: &Summary) -> Result<Vec<PathBuf>, Fault> {
        let ended = self.sender.hand_over(Batch::End);
        let files = WriterThreads::join(std::mem::take(&mut self.threads));
        ended.and(files)
    }
}

impl Drop for WriterThreads {
    /// Without an end, files that are not complete are gone when this returns.
    fn drop(&mut self) {
        self.sender.close();
        let _ = WriterThreads::join(std::mem::take(&mut self.threads));
    }
}

/// What a thread works with, beside its writers.
struct Stage {
    /// To whom it passes batches on.
    next: Option<BatchSender>,
    names: Arc<Names>,
    /// Where frames go back that all have written.
    written: SyncSender<Frame>,
}

impl Stage {
    /// Writes batches until the end, or until nobody is left to hand one over.
    fn write(
        &self,
        batches: &Receiver<Arc<Batch>>,
        mut writers: Vec<Box<dyn Writer>>,
        mut log: Option<PageLog>,
    ) -> Result<Vec<PathBuf>, Fault> {
        for mut batch in batches {
            // Only the first thread has the batch for itself.
            if let Some(Batch::Frame(frame)) = Arc::get_mut(&mut batch) {
                frame.locate(&self.names);
            }
            if let Some(next) = &self.next {
                next.hand_over(Arc::clone(&batch))?;
            }
            if let Some(log) = &mut log {
                match &*batch {
                    Batch::Mark(told) => {
                        let marked = log.mark();
                        // Who asked has gone if nobody hears it.
                        let _ = told.send(marked.clone());
                        marked?;
                    }
                    Batch::End => {}
                    batch => log.write(batch)?,
                }
            }
            if matches!(*batch, Batch::End) {
                return writers.into_iter().map(Writer::finish).collect();
            }
            for writer in &mut writers {
                writer.write(&batch, &self.names)?;
            }
            if let Some(Batch::Frame(mut frame)) = Arc::into_inner(batch) {
                frame.clear();
                // Nobody takes it when the run is over.
                let _ = self.written.try_send(frame);
            }
        }
        Ok(Vec::new())
    }
}
