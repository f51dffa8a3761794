//! Track files of the INTERACTION dataset (Zhan et al., 2019): CSV, one row for a road user in a frame.
//!
//! The columns track_id, frame_id, timestamp_ms, agent_type, x, y, vx, vy are required. psi_rad, length and width may
//! be missing or empty, as they are for pedestrians and cyclists. Columns are identified by name; rows may be in any
//! order.

mod header;
mod row;
mod write;

use std::collections::HashMap;

use laneweave_maps::Problem;

use crate::error::RecordingError;
use crate::problems::Problems;
use crate::recording::{Recording, State, Track};
use header::Header;
use row::Row;
pub use write::write;

/// Largest file that is read [B].
const MAXIMUM_SIZE: u64 = 512 << 20;
/// Least and greatest time between frames [ms].
const STEPS: (f64, f64) = (10.0, 2000.0);
/// Times are whole milliseconds, so they may be off by this [ms].
const ROUNDING: f64 = 1.0;

/// Reads a track file. Rows that cannot be used are left out and listed as problems.
///
/// # Errors
/// If a required column is missing, no row is left, or the times do not belong to frames at equal distances.
pub fn read(bytes: &[u8]) -> Result<(Recording, Vec<Problem>), RecordingError> {
    if bytes.len() as u64 > MAXIMUM_SIZE {
        return Err(RecordingError::TooLarge { bytes: bytes.len() as u64, limit: MAXIMUM_SIZE });
    }
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let mut lines = bytes.split(|it| *it == b'\n').map(|it| it.strip_suffix(b"\r").unwrap_or(it)).zip(1..);
    let header = Header::of(lines.next().map_or(&[][..], |(line, _)| line))?;
    let mut reader = Reader::default();
    for (text, line) in lines.filter(|(text, _)| !text.is_empty()) {
        reader.rows += 1;
        match header.row(text) {
            Ok(row) => reader.add(row, line),
            Err(flaw) => reader.problems.add("row that cannot be read", flaw.remedy, line, || {
                ("row".into(), format!("{}, so it is left out", flaw.what))
            }),
        }
    }
    reader.finish()
}

/// What was read so far.
#[derive(Default)]
struct Reader {
    rows: usize,
    tracks: Vec<Reading>,
    by_id: HashMap<i64, usize>,
    /// Index of the track of the row before.
    last: usize,
    problems: Problems,
}

/// A track that is being read.
struct Reading {
    track: Track,
    times: Vec<Time>,
}

/// Time of a state, and its line in the file.
#[derive(Clone, Copy)]
struct Time {
    frame: i64,
    timestamp_ms: i64,
    line: usize,
}

impl Reader {
    fn add(&mut self, row: Row, line: usize) {
        let is_last = self.tracks.get(self.last).is_some_and(|it| it.track.id == row.track);
        if !is_last {
            let next = self.tracks.len();
            self.last = *self.by_id.entry(row.track).or_insert(next);
            if self.last == next {
                let track = self.begin(&row, line);
                self.tracks.push(Reading { track, times: Vec::new() });
            }
        }
        let reading = &mut self.tracks[self.last];
        reading.track.states.push(row.state);
        reading.times.push(Time { frame: row.state.frame, timestamp_ms: row.timestamp_ms, line });
    }

    /// The track that begins with `row`.
    fn begin(&mut self, row: &Row, line: usize) -> Track {
        let element = || format!("track {}", row.track);
        if let Some(unknown) = &row.unknown_class {
            let remedy = "use one of car, van, truck, bus, motorcycle, bicycle, pedestrian";
            self.problems.add("unknown agent_type", remedy, line, || {
                (element(), format!("its agent_type {unknown:?} is unknown, so it is not used as a vehicle"))
            });
        }
        let (length, width) = row.class.usual_size();
        if row.class.is_vehicle() && (row.length.is_none() || row.width.is_none()) {
            self.problems.add("vehicle without a size", "fill in length and width", line, || {
                (element(), format!("it has no size, so {length} m × {width} m is assumed"))
            });
        }
        Track {
            id: row.track,
            class: row.class,
            length: row.length.unwrap_or(length),
            width: row.width.unwrap_or(width),
            states: Vec::new(),
        }
    }

    fn finish(mut self) -> Result<(Recording, Vec<Problem>), RecordingError> {
        let step = self.step()?;
        let mut tracks = Vec::with_capacity(self.tracks.len());
        for reading in self.tracks {
            tracks.push(reading.finish(&mut self.problems));
        }
        Ok((Recording { step, tracks }, self.problems.into_list()))
    }

    /// The time between frames [s]; all timestamps must agree with it.
    fn step(&self) -> Result<f64, RecordingError> {
        let times = || self.tracks.iter().flat_map(|it| &it.times);
        let empty = || RecordingError::NoRows {
            rows: self.rows,
            problem: self.problems.first().map(|it| it.to_string()),
        };
        let first = times().min_by_key(|it| it.frame).ok_or_else(empty)?;
        let last = times().max_by_key(|it| it.frame).ok_or_else(empty)?;
        if first.frame == last.frame {
            return Err(RecordingError::OneFrame { line: first.line, frame: first.frame });
        }
        let step_ms = (last.timestamp_ms - first.timestamp_ms) as f64 / (last.frame - first.frame) as f64;
        let (from, to) = STEPS;
        if !(from..=to).contains(&step_ms) {
            return Err(RecordingError::Step { line: first.line, step_ms, from, to });
        }
        let expected = |time: &Time| first.timestamp_ms as f64 + (time.frame - first.frame) as f64 * step_ms;
        match times().find(|it| (it.timestamp_ms as f64 - expected(it)).abs() > ROUNDING) {
            Some(time) => Err(RecordingError::Timestamp {
                line: time.line,
                frame: time.frame,
                found_ms: time.timestamp_ms,
                expected_ms: expected(time),
                step_ms,
            }),
            None => Ok(step_ms / 1000.0),
        }
    }
}

impl Reading {
    /// The track with its states in order of frames, each once, and with a heading.
    fn finish(mut self, problems: &mut Problems) -> Track {
        if !self.times.is_sorted_by(|a, b| a.frame < b.frame) {
            let mut order: Vec<usize> = (0..self.times.len()).collect();
            order.sort_by_key(|it| (self.times[*it].frame, *it));
            order.dedup_by(|later, kept| {
                let Time { frame, line, .. } = self.times[*later];
                let is_again = frame == self.times[*kept].frame;
                if is_again {
                    problems.add("duplicate row", "keep one row for each frame", line, || {
                        let element = format!("track {}", self.track.id);
                        (element, format!("frame {frame} occurs again, so only its first row is used"))
                    });
                }
                is_again
            });
            self.track.states = order.iter().map(|it| self.track.states[*it]).collect();
        }
        fill_headings(&mut self.track.states);
        self.track
    }
}

/// Fills in missing headings: that of the state before, or else of the first that has one, or else east.
fn fill_headings(states: &mut [State]) {
    let first = states.iter().map(|it| it.heading).find(|it| !it.is_nan());
    let mut heading = first.unwrap_or(0.0);
    for state in states {
        if state.heading.is_nan() {
            state.heading = heading;
        }
        heading = state.heading;
    }
}
