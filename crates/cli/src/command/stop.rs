//! Signals that end a run; it keeps its results so far.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use laneweave::Fault;
#[cfg(unix)]
use signal_hook::consts::{SIGHUP, SIGXFSZ};
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// Base of the exit code of a program that a signal ended, to which the signal's number is added: a convention of
/// shells.
const SIGNALLED: i32 = 128;
/// The exit code after SIGHUP, which has the same number wherever there is one.
const HUNG_UP: usize = 129;

/// The flag that the first Ctrl-C, SIGTERM or SIGHUP sets. A second Ctrl-C or SIGTERM ends the program at once, with
/// its exit code; a second SIGHUP does not, because a terminal that closes sends more than one.
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
        stop.listen_to_all().map_err(|error| Fault::bug("signals", error))?;
        Ok(stop)
    }

    fn listen_to_all(&self) -> std::io::Result<()> {
        for signal in [SIGINT, SIGTERM] {
            // The handler registered first runs first: it finds the flag as a former signal left it.
            flag::register_conditional_shutdown(signal, SIGNALLED + signal, Arc::clone(&self.is_raised))?;
            self.listen_to(signal)?;
        }
        #[cfg(unix)]
        if !is_ignored(SIGHUP) {
            self.listen_to(SIGHUP)?;
        }
        Ok(())
    }

    fn listen_to(&self, signal: i32) -> std::io::Result<()> {
        let code = SIGNALLED + signal;
        flag::register_usize(signal, Arc::clone(&self.code), code as usize)?;
        flag::register(signal, Arc::clone(&self.is_raised))?;
        Ok(())
    }

    /// Whether the run is to end.
    pub(super) fn is_raised(&self) -> bool {
        self.is_raised.load(Ordering::Acquire)
    }

    /// The exit code of a run that the signal ended.
    pub(super) fn code(&self) -> u8 {
        self.code.load(Ordering::Acquire) as u8
    }

    /// Whether the terminal has closed, so that nobody may read any more.
    pub(super) fn has_hung_up(&self) -> bool {
        self.code.load(Ordering::Acquire) == HUNG_UP
    }
}

/// Whether the program was begun with a signal ignored, as `nohup` does. Only Linux tells.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|it| it.strip_prefix("SigIgn:"));
    let ignored = ignored.and_then(|it| u64::from_str_radix(it.trim(), 16).ok()).unwrap_or(0);
    (ignored >> (signal - 1)) & 1 == 1
}

/// Has a file that grows beyond a limit of the system refused, as one on a full disk is: otherwise a signal ends the
/// program.
pub(crate) fn refuse_large_files() {
    // Where this is not possible, the signal comes.
    #[cfg(unix)]
    let _ = flag::register(SIGXFSZ, Arc::default());
}
