//! The progress of a long run: in one line on the terminal, or as a line a minute elsewhere.

use std::io::{IsTerminal, Write, stderr};
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
    /// Runs shorter than this show nothing.
    fn patience(self) -> Duration {
        Duration::from_secs(if self == Screen::Log { 60 } else { 2 })
    }

    /// Time between two checks.
    fn period(self) -> Duration {
        if self == Screen::Log { Duration::from_secs(60) } else { Duration::from_millis(200) }
    }
}

/// The progress of a run.
pub(super) struct Progress {
    screen: Screen,
    began: Instant,
    next: Instant,
    /// Simulated time at which it began [s].
    from: Option<f64>,
    /// Simulated time at the end [s].
    end: f64,
    is_on_screen: bool,
}

impl Progress {
    pub(super) fn new(simulation: &Simulation, quiet: bool) -> Progress {
        let screen = match (quiet, stderr().is_terminal()) {
            (true, _) => Screen::Nothing,
            (false, true) => Screen::Terminal,
            (false, false) => Screen::Log,
        };
        Progress::on(screen, Instant::now(), simulation.end_s())
    }

    fn on(screen: Screen, began: Instant, end: f64) -> Progress {
        Progress { screen, began, next: began + screen.patience(), from: None, end, is_on_screen: false }
    }

    /// Shows how far the run is, now and then.
    pub(super) fn show(&mut self, simulation: &Simulation) {
        if self.screen == Screen::Nothing {
            return;
        }
        let Some(line) = self.line(Instant::now(), simulation.time_s(), simulation.on_road()) else { return };
        // An error is ignored: a closed terminal needs no progress.
        let _ = stderr().write_all(line.as_bytes());
    }

    /// The text to write at `now`, at the simulated `time` [s], if it is due.
    fn line(&mut self, now: Instant, time: f64, vehicles: usize) -> Option<String> {
        // A run that is resumed does not begin at 0.
        let from = *self.from.get_or_insert(time);
        if now < self.next {
            return None;
        }
        self.next = now + self.screen.period();
        let wall = (now - self.began).as_secs_f64();
        let pace = (time - from) / wall;
        let left = (self.end - time) / pace.max(f64::MIN_POSITIVE);
        let text = format!(
            "{time:.0} of {:.0} s, {vehicles} vehicles, {pace:.0} times real time, {left:.0} s remaining",
            self.end
        );
        if self.screen == Screen::Log {
            return Some(text + "\n");
        }
        self.is_on_screen = true;
        Some(format!("\r\x1b[K{text}"))
    }

    /// Removes the line from the terminal.
    pub(super) fn clear(&mut self) {
        if self.is_on_screen {
            let _ = stderr().write_all(b"\r\x1b[K");
        }
    }
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
            progress.line(now, 5.0 * wall, 7).map(|line| (wall, line))
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
}
