//! Writer threads for tables and XML files. They receive the observations in batches of plain numbers, through
//! channels with a small capacity: an output that is too fast waits, so that memory is bounded.
//!
//! Each kind of batch comes from one output, in the order of observation, and each file is made from one kind: the
//! contents of a file do not depend on when it is written.

use std::path::PathBuf;
use std::sync::mpsc::{Receiver, SyncSender, channel, sync_channel};
use std::sync::{Arc, OnceLock};
use std::thread::{self, JoinHandle};

use laneweave_scenario::Fault;
use laneweave_sim::World;

use super::Output;
use super::batch::{Batch, BatchSender, Writer, broke_off};
use super::frame::Frame;
use super::log::{PageLog, batches};
use super::names::Names;
use crate::outcome::Summary;
use crate::pack::{pack, unpack};
use crate::whole_file::all_whole;

/// Batches that wait for a thread: as many as are filled while a row group of a table is encoded.
const WAITING: usize = 16;
/// Maximum of frames that wait for reuse: a log that is read again gives more.
const SPARES: usize = 24;
/// The thread for the tables, which also writes the log, and the thread for the XML files.
const TABLES: &str = "tables";
const XML: &str = "xml";

/// The writer threads, as the last of the outputs: it observes nothing, and completes all files after the others
/// have finished.
pub(super) struct WriterThreads {
    sender: BatchSender,
    threads: Vec<JoinHandle<Result<Vec<PathBuf>, Fault>>>,
    /// The log of batches, if there is one.
    log: Option<PathBuf>,
    names: Arc<Names>,
}

impl WriterThreads {
    /// Begins to write with `xml` and `tables`. If so many `cores` are free, there are two threads, and the one for
    /// the tables passes all batches on to the one for the XML files; otherwise there is one. The receiver returns
    /// written frames for reuse.
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
            // The first thread that receives the batches writes the log.
            let log = if name == TABLES { log.take() } else { None };
            let work = move || {
                let outcome = stage.write(&received, writers, log);
                if let Err(error) = &outcome {
                    // The first fault counts. It is stored before a channel closes.
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
        Ok((WriterThreads { sender, threads, log: log_path, names }, spares))
    }

    /// Number of threads that write.
    pub(super) fn threads(&self) -> usize {
        self.threads.len()
    }

    /// The sender of batches to it.
    pub(super) fn sender(&self) -> BatchSender {
        self.sender.clone()
    }

    /// Waits until all threads have ended.
    fn join(threads: Vec<JoinHandle<Result<Vec<PathBuf>, Fault>>>) -> Result<Vec<PathBuf>, Fault> {
        let ended: Vec<_> =
            threads.into_iter().map(|it| it.join().unwrap_or_else(|_| Err(broke_off()))).collect();
        // The tables come first; their thread was begun last.
        all_whole(ended.into_iter().rev())
    }
}

impl Output for WriterThreads {
    /// Writes all batches up to now into the log, and stores its length.
    fn save(&mut self, _world: &World) -> Result<Vec<u8>, Fault> {
        let (told, length) = channel();
        self.sender.hand_over(Batch::Mark(told))?;
        let length = length.recv().map_err(|_| self.sender.fault())?;
        pack(&length?)
    }

    /// Sends the batches of the log again.
    fn restore(&mut self, saved: &[u8]) -> Result<(), Fault> {
        let Some(log) = &self.log else { return Ok(()) };
        for batch in batches(log, unpack(saved)?)? {
            let batch = batch?;
            if !batch.is_sound(&self.names) {
                let what = "a batch is damaged: it names what this run has not";
                return Err(Fault::new(
                    log.display(),
                    what,
                    "run again from the beginning, without --resume",
                ));
            }
            self.sender.hand_over(batch)?;
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
    /// Without a regular end, incomplete files are removed when this returns.
    fn drop(&mut self) {
        self.sender.close();
        let _ = WriterThreads::join(std::mem::take(&mut self.threads));
    }
}

/// The data of a thread, beside its writers.
struct Stage {
    /// The thread to which it passes batches on.
    next: Option<BatchSender>,
    names: Arc<Names>,
    /// Channel that returns frames after all threads have written them.
    written: SyncSender<Frame>,
}

impl Stage {
    /// Writes batches until the end, or until there is no sender left.
    fn write(
        &self,
        batches: &Receiver<Arc<Batch>>,
        mut writers: Vec<Box<dyn Writer>>,
        mut log: Option<PageLog>,
    ) -> Result<Vec<PathBuf>, Fault> {
        for mut batch in batches {
            // Only the first thread owns the batch alone.
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
                        // If this fails, the thread that asked has ended.
                        let _ = told.send(marked.clone());
                        marked?;
                    }
                    Batch::End => {}
                    batch => log.write(batch)?,
                }
            }
            if matches!(*batch, Batch::End) {
                return all_whole(writers.into_iter().map(|it| it.finish().map(|it| vec![it])));
            }
            for writer in &mut writers {
                writer.write(&batch, &self.names)?;
            }
            if let Some(Batch::Frame(mut frame)) = Arc::into_inner(batch) {
                frame.clear();
                // When the run is over, nothing receives it.
                let _ = self.written.try_send(frame);
            }
        }
        Ok(Vec::new())
    }
}
