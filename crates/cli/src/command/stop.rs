//! Signals that end a run; it keeps its results so far.

use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use laneweave::Fault;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// Base of the exit code of a program that a signal ended, to which the signal's number is added: a convention of
/// shells.
const SIGNALLED: i32 = 128;

/// The flag that the first Ctrl-C or SIGTERM sets. A second one ends the program at once, with the same exit code.
pub(super) struct Stop {
    is_raised: Arc<AtomicBool>,
    code: Arc<AtomicUsize>,
}

impl Stop {
    /// Listens from now on.
    ///
    /// # Errors
    /// If the system does not let the program listen.
    pub(super) fn listen() -> Result<Stop, Fault> {
        let stop = Stop { is_raised: Arc::default(), code: Arc::default() };
        for signal in [SIGINT, SIGTERM] {
            stop.listen_to(signal).map_err(|error| Fault::bug("signals", error))?;
        }
        Ok(stop)
    }

    fn listen_to(&self, signal: i32) -> std::io::Result<()> {
        let code = SIGNALLED + signal;
        // The handler registered first runs first: it finds the flag as a former signal left it.
        flag::register_conditional_shutdown(signal, code, Arc::clone(&self.is_raised))?;
        flag::register_usize(signal, Arc::clone(&self.code), code as usize)?;
        flag::register(signal, Arc::clone(&self.is_raised))?;
        Ok(())
    }

    /// Whether the run is to end.
    pub(super) fn is_raised(&self) -> bool {
        self.is_raised.load(Ordering::Acquire)
    }

    /// The exit code of a run that the signal ended.
    pub(super) fn code(&self) -> ExitCode {
        ExitCode::from(self.code.load(Ordering::Acquire) as u8)
    }
}
