//! Times of frames: they are at equal distances.

use std::collections::HashMap;

use crate::error::RecordingError;

/// Least and greatest time between frames [ms].
const STEPS: (f64, f64) = (10.0, 2000.0);
/// Times in tables are whole milliseconds, so they may be off by this [ms].
const ROUNDING: f64 = 1.0;

/// The time of each frame, by its first row.
#[derive(Default)]
pub(super) struct Times {
    of_frame: HashMap<i64, At>,
    /// The first row whose time is not that of its frame.
    conflict: Option<(i64, At)>,
}

/// A time, and its line in the file.
#[derive(Clone, Copy)]
struct At {
    time_ms: f64,
    line: usize,
}

impl Times {
    pub(super) fn add(&mut self, frame: i64, time_ms: f64, line: usize) {
        let at = At { time_ms, line };
        let first = self.of_frame.entry(frame).or_insert(at);
        if (first.time_ms - time_ms).abs() > ROUNDING && self.conflict.is_none() {
            self.conflict = Some((frame, at));
        }
    }

    /// The time between frames [s]; all times must agree with it. `time` is the name of their column, `frame` that of
    /// the frames.
    pub(super) fn step(&self, [time, frame]: [&str; 2]) -> Result<f64, RecordingError> {
        let by_frame = |it: &(&i64, &At)| *it.0;
        let (Some((first, from)), Some((last, to))) =
            (self.of_frame.iter().min_by_key(by_frame), self.of_frame.iter().max_by_key(by_frame))
        else {
            return Err(RecordingError::NoRows { rows: 0, problem: None });
        };
        if first == last {
            return Err(RecordingError::OneFrame { line: from.line, frame: *first });
        }
        let step_ms = (to.time_ms - from.time_ms) / (last - first) as f64;
        let columns = format!("{time} or {frame}");
        in_range(step_ms, from.line, &columns)?;
        let expected = |it: i64| from.time_ms + (it - first) as f64 * step_ms;
        let rows = self.of_frame.iter().map(|(frame, at)| (*frame, *at)).chain(self.conflict);
        let wrong = rows.filter(|(frame, at)| (at.time_ms - expected(*frame)).abs() > ROUNDING);
        match wrong.min_by_key(|it| it.1.line) {
            Some((frame, at)) => Err(RecordingError::Timestamp {
                line: at.line,
                frame,
                found_ms: at.time_ms,
                expected_ms: expected(frame),
                step_ms,
                columns,
            }),
            None => Ok(step_ms / 1000.0),
        }
    }
}

/// Whether a recording may have this time between frames [ms].
pub(crate) fn in_range(step_ms: f64, line: usize, columns: &str) -> Result<(), RecordingError> {
    let (from, to) = STEPS;
    if (from..=to).contains(&step_ms) {
        return Ok(());
    }
    Err(RecordingError::Step { line, step_ms, from, to, columns: columns.to_owned() })
}

/// The time between frames [ms] of a table without numbers of frames, by the times of its tracks: about the shortest
/// that two successive rows of a track are apart, `None` if no two are. The whole time of the table is a multiple of
/// it.
pub(super) fn shortest<'a>(tracks: impl Iterator<Item = &'a [f64]> + Clone) -> Option<f64> {
    let apart = tracks.clone().flat_map(|times| times.windows(2).map(|it| (it[1] - it[0]).abs()));
    let shortest = apart.filter(|it| *it > ROUNDING).reduce(f64::min)?;
    let all = tracks.flatten();
    let [from, to] =
        all.fold([f64::INFINITY, f64::NEG_INFINITY], |[from, to], it| [from.min(*it), to.max(*it)]);
    Some((to - from) / ((to - from) / shortest).round())
}
