//! The progress of a long run: in one line on the terminal, or as a line a minute elsewhere.

use std::io::{IsTerminal, Write, stderr};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use laneweave::Simulation;

/// Where the progress is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Screen {
    /// Nowhere.
    Nothing,
    /// In one line, which changes.
    Terminal,
    /// In a file or a log, in a line each.
    Log,
}

impl Screen {
    /// That of this process.
    fn here() -> Screen {
        if stderr().is_terminal() { Screen::Terminal } else { Screen::Log }
    }

    /// Runs shorter than this show nothing.
    fn patience(self) -> Duration {
        Duration::from_secs(if self == Screen::Log { 60 } else { 2 })
    }

    /// Time between two checks.
    fn period(self) -> Duration {
        if self == Screen::Log { Duration::from_secs(60) } else { Duration::from_millis(200) }
    }
}

/// What is shown now and then.
struct Shown {
    screen: Screen,
    began: Instant,
    next: Instant,
    is_on_screen: bool,
}

impl Shown {
    /// Nothing yet of something that began.
    fn on(screen: Screen, began: Instant) -> Shown {
        Shown { screen, began, next: began + screen.patience(), is_on_screen: false }
    }

    /// The text to write at `now`, if it is due: what `text` says of the time since the beginning [s].
    fn line(&mut self, now: Instant, text: impl FnOnce(f64) -> String) -> Option<String> {
        if self.screen == Screen::Nothing || now < self.next {
            return None;
        }
        self.next = now + self.screen.period();
        let text = text((now - self.began).as_secs_f64());
        if self.screen == Screen::Log {
            return Some(text + "\n");
        }
        self.is_on_screen = true;
        Some(format!("\r\x1b[K{text}"))
    }

    /// Removes the line from the terminal.
    fn clear(&mut self) {
        if std::mem::take(&mut self.is_on_screen) {
            write("\r\x1b[K");
        }
    }
}

/// Writes to the terminal. An error is ignored: a closed one needs no progress.
fn write(text: &str) {
    let _ = stderr().write_all(text.as_bytes());
}

/// The progress of a run.
pub(super) struct Progress {
    shown: Shown,
    /// Simulated time at which it began [s].
    from: Option<f64>,
    /// Simulated time at the end [s].
    end: f64,
}

impl Progress {
    pub(super) fn new(simulation: &Simulation, quiet: bool) -> Progress {
        let screen = if quiet { Screen::Nothing } else { Screen::here() };
        Progress::on(screen, Instant::now(), simulation.end_s())
    }

    fn on(screen: Screen, began: Instant, end: f64) -> Progress {
        Progress { shown: Shown::on(screen, began), from: None, end }
    }

    /// Shows how far the run is, now and then.
    pub(super) fn show(&mut self, simulation: &Simulation) {
        let line = self.line(Instant::now(), simulation.time_s(), || simulation.on_road());
        line.iter().for_each(|it| write(it));
    }

    /// The text to write at `now`, at the simulated `time` [s], if it is due.
    fn line(&mut self, now: Instant, time: f64, vehicles: impl FnOnce() -> usize) -> Option<String> {
        // A run that is resumed does not begin at 0.
        let (from, end) = (*self.from.get_or_insert(time), self.end);
        self.shown.line(now, |wall| {
            let (pace, vehicles) = ((time - from) / wall, vehicles());
            let left = (end - time) / pace.max(f64::MIN_POSITIVE);
            format!("{time:.0} of {end:.0} s, {vehicles} vehicles, {pace:.0} times real time, {left:.0} s remaining")
        })
    }

    /// Removes the line from the terminal.
    pub(super) fn clear(&mut self) {
        self.shown.clear();
    }
}

/// The progress of work of many threads, of which the share that is done is known.
pub(super) struct ShareDone {
    what: &'static str,
    shown: Mutex<Shown>,
}

impl ShareDone {
    /// Of work that begins now.
    pub(super) fn of(what: &'static str) -> ShareDone {
        ShareDone { what, shown: Mutex::new(Shown::on(Screen::here(), Instant::now())) }
    }

    /// Shows the share that is done, from 0 to 1, now and then.
    pub(super) fn show(&self, share: f64) {
        let mut shown = self.shown.lock().unwrap_or_else(PoisonError::into_inner);
        let line = shown.line(Instant::now(), |wall| share_line(self.what, share, wall));
        line.iter().for_each(|it| write(it));
    }

    /// Removes the line from the terminal.
    pub(super) fn clear(self) {
        self.shown.into_inner().unwrap_or_else(PoisonError::into_inner).clear();
    }
}

/// What is shown of a share that took so long [s].
fn share_line(what: &str, share: f64, wall: f64) -> String {
    let left = wall * (1.0 - share) / share.max(f64::MIN_POSITIVE);
    format!("{what}: {:.0} %, {left:.0} s remaining", 100.0 * share)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The lines that are written in a run that is checked every half second, and simulates five seconds in one
    /// second, each with its wall time [s].
    fn lines(screen: Screen, wall: u32) -> Vec<(f64, String)> {
        let began = Instant::now();
        let mut progress = Progress::on(screen, began, 1000.0);
        let look = |half: u32| {
            let wall = f64::from(half) / 2.0;
            let now = began + Duration::from_secs_f64(wall);
            progress.line(now, 5.0 * wall, || 7).map(|line| (wall, line))
        };
        (0..=2 * wall).filter_map(look).collect()
    }

    #[test]
    fn a_log_gets_a_line_a_minute() {
        let line = |wall, text: &str| (wall, format!("{text} remaining\n"));
        let expected = [
            line(60.0, "300 of 1000 s, 7 vehicles, 5 times real time, 140 s"),
            line(120.0, "600 of 1000 s, 7 vehicles, 5 times real time, 80 s"),
        ];
        assert_eq!(lines(Screen::Log, 179), expected);
        assert!(lines(Screen::Log, 59).is_empty());
    }

    #[test]
    fn a_terminal_shows_one_line_after_two_seconds() {
        let shown = lines(Screen::Terminal, 3);
        assert_eq!(shown.iter().map(|it| it.0).collect::<Vec<_>>(), [2.0, 2.5, 3.0]);
        assert!(shown.iter().all(|(_, line)| line.starts_with("\r\x1b[K") && !line.ends_with('\n')));
    }

    #[test]
    fn a_share_shows_the_time_that_remains() {
        assert_eq!(share_line("simulations", 0.25, 30.0), "simulations: 25 %, 90 s remaining");
    }
}
