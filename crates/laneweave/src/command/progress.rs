//! How far a long run is, in one line on the terminal.

use std::io::{IsTerminal, Write, stderr};
use std::time::{Duration, Instant};

use laneweave::scenario::Prepared;
use laneweave::sim::World;

/// Runs shorter than this show nothing.
const PATIENCE: Duration = Duration::from_secs(2);
/// Time between two looks.
const PERIOD: Duration = Duration::from_millis(200);

/// The line.
pub(super) struct Progress {
    is_shown: bool,
    began: Instant,
    next: Instant,
    /// Simulated time at the end [s].
    end: f64,
    is_on_screen: bool,
}

impl Progress {
    pub(super) fn new(prepared: &Prepared, step: f64, quiet: bool) -> Progress {
        let began = Instant::now();
        Progress {
            is_shown: !quiet && stderr().is_terminal(),
            began,
            next: began + PATIENCE,
            end: f64::from(prepared.warmup_steps + prepared.steps) * step,
            is_on_screen: false,
        }
    }

    /// Brings the line up to date, now and then.
    pub(super) fn show(&mut self, world: &World) {
        if !self.is_shown {
            return;
        }
        let now = Instant::now();
        if now < self.next {
            return;
        }
        self.next = now + PERIOD;
        self.is_on_screen = true;
        let time = world.clock().time();
        let wall = self.began.elapsed().as_secs_f64();
        let left = wall * (self.end - time) / time.max(f64::MIN_POSITIVE);
        let line = format!(
            "\r\x1b[K{time:.0} of {:.0} s, {} vehicles, {:.0} times real time, {left:.0} s to go",
            self.end,
            world.on_road(),
            time / wall,
        );
        // A terminal that is gone needs no progress.
        let _ = stderr().write_all(line.as_bytes());
    }

    /// Takes the line away.
    pub(super) fn clear(&mut self) {
        if self.is_on_screen {
            let _ = stderr().write_all(b"\r\x1b[K");
        }
    }
}
