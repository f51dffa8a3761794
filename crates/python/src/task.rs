//! Long work that an interpreter waits for: it shows its progress, and Ctrl-C ends it.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use laneweave::Fault;
use pyo3::prelude::*;

use crate::errors::{Failure, caught};

/// Time between two looks at work.
const EVERY: Duration = Duration::from_millis(100);
/// Work that does not end so soon after Ctrl-C goes on until the interpreter ends; nobody takes its results.
const PATIENCE: Duration = Duration::from_secs(1);

/// What work tells, and is told.
#[derive(Default)]
pub(crate) struct Task {
    /// The share that is done, as the bits of a number from 0 to 1.
    share: AtomicU64,
    is_stopped: AtomicBool,
}

impl Task {
    /// Tells the share that is done, from 0 to 1.
    pub(crate) fn has_done(&self, share: f64) {
        self.share.store(share.to_bits(), Ordering::Relaxed);
    }

    /// Whether the work is to end.
    pub(crate) fn is_stopped(&self) -> bool {
        self.is_stopped.load(Ordering::Relaxed)
    }
}

/// Waits for what a thread sends, at most so long, without the lock of the interpreter.
fn wait<T: Send>(py: Python<'_>, receiver: &mut Receiver<T>, most: Duration) -> Result<T, RecvTimeoutError> {
    py.detach(move || receiver.recv_timeout(most))
}

/// Does `work` in a thread of its own. `progress` is called with the share that is done, several times a second.
///
/// # Errors
/// If the work fails or panics, if the user interrupts it, or if `progress` raises something.
pub(crate) fn watched<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Py<PyAny>>,
    work: impl FnOnce(&Task) -> Result<T, Failure> + Send + 'static,
) -> PyResult<T> {
    let task = Arc::new(Task::default());
    let (sender, mut receiver) = channel();
    let of_thread = Arc::clone(&task);
    let thread = thread::Builder::new().name("laneweave".into()).spawn(move || {
        // Nobody may wait any more.
        let _ = sender.send(caught(|| work(&of_thread)));
    });
    thread.map_err(|error| Failure::from(Fault::bug("a thread", error)).raise(py))?;
    let look = || -> PyResult<()> {
        py.check_signals()?;
        let share = f64::from_bits(task.share.load(Ordering::Relaxed));
        progress.map_or(Ok(()), |it| it.call1(py, (share,)).map(drop))
    };
    loop {
        match wait(py, &mut receiver, EVERY) {
            Ok(done) => return done.map_err(|it| it.raise(py)),
            Err(RecvTimeoutError::Disconnected) => {
                return Err(Failure::from(Fault::bug("a thread", "it is gone")).raise(py));
            }
            Err(RecvTimeoutError::Timeout) => {}
        }
        if let Err(raised) = look() {
            task.is_stopped.store(true, Ordering::Relaxed);
            let _ = wait(py, &mut receiver, PATIENCE);
            return Err(raised);
        }
    }
}
