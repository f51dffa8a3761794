//! A recording under construction, row by row.

use std::collections::{BTreeMap, HashMap};

use laneweave_maps::Problem;

use super::id::Id;
use super::known::Known;
use super::layout::{Axes, Field, Layout, Point};
use super::row::{Class, Flaw, Row};
use super::times::{Times, in_range, shortest};
use crate::error::RecordingError;
use crate::gaps::leave_out_parts;
use crate::problems::Problems;
use crate::recording::{Recording, RoadUser, State, Track, free_ids};
use crate::smooth::motion;

/// Positions this long before and after a moment give a motion that the table does not give [s].
const REACH: f64 = 0.5;
/// Below this speed a motion has no direction [m/s].
const STANDSTILL: f64 = 0.5;

/// What was read so far.
pub(super) struct Draft<'a> {
    layout: &'a Layout,
    known: &'a Known,
    rows: usize,
    tracks: Vec<Reading>,
    by_id: HashMap<Id, usize>,
    /// Index of the track of the row before.
    last: usize,
    times: Times,
    problems: Problems,
}

/// A track that is being read.
struct Reading {
    id: Id,
    /// Its id becomes a number at the end.
    track: Track,
    /// Line of its first row.
    line: usize,
    /// The times of its states [ms], where they have no frames.
    times_ms: Vec<f64>,
}

impl<'a> Draft<'a> {
    pub(super) fn of(layout: &'a Layout, known: &'a Known) -> Draft<'a> {
        Draft {
            layout,
            known,
            rows: 0,
            tracks: Vec::new(),
            by_id: HashMap::new(),
            last: 0,
            times: Times::default(),
            problems: Problems::default(),
        }
    }

    /// Adds what was read of the row in `line`.
    pub(super) fn add(&mut self, row: Result<Row, Flaw>, line: usize) {
        self.rows += 1;
        match row {
            Ok(row) => self.keep(row, line),
            Err(flaw) => self.problems.add("row that cannot be read", flaw.remedy, line, || {
                ("row".into(), format!("{}, so it is left out", flaw.what))
            }),
        }
    }

    fn keep(&mut self, row: Row, line: usize) {
        let is_last = self.tracks.get(self.last).is_some_and(|it| it.id == row.track);
        if !is_last {
            let next = self.tracks.len();
            self.last = *self.by_id.entry(row.track.clone()).or_insert(next);
            if self.last == next {
                let track = self.begin(&row, line);
                self.tracks.push(Reading { id: row.track.clone(), track, line, times_ms: Vec::new() });
            }
        }
        let reading = &mut self.tracks[self.last];
        if let Some(frame) = row.frame {
            if reading.track.states.last().is_some_and(|it| it.frame == frame) {
                return again(&mut self.problems, &row.track, frame, line);
            }
            if let Some(time_ms) = row.time_ms {
                self.times.add(frame, time_ms, line);
            }
        } else {
            reading.times_ms.extend(row.time_ms);
        }
        reading.track.states.push(State { frame: row.frame.unwrap_or(0), ..row.state });
    }

    /// The track that begins with `row`.
    fn begin(&mut self, row: &Row, line: usize) -> Track {
        let element = || format!("track {}", row.track);
        let class = match &row.class {
            Class::Known(class) => *class,
            Class::Unknown(name) => {
                let remedy = "use one of car, van, truck, bus, motorcycle, bicycle, pedestrian";
                let column = self.layout.columns.name(Field::Class).unwrap_or_default();
                self.problems.add("unknown class", remedy, line, || {
                    (element(), format!("its {column} {name:?} is unknown, so it is not used as a vehicle"))
                });
                RoadUser::Other
            }
            Class::NotGiven => self.known.classes.get(&row.track).copied().unwrap_or_else(|| {
                let remedy = "put the dataset's other files beside it, or give the table a column for it";
                self.problems.add("road user without a class", remedy, line, || {
                    (element(), "it has no class, so it counts as a car".into())
                });
                RoadUser::Car
            }),
        };
        let (length, width) = class.usual_size();
        if class.is_vehicle() && (row.length.is_none() || row.width.is_none()) {
            self.problems.add("vehicle without a size", "fill in length and width", line, || {
                (element(), format!("it has no size, so {length} m × {width} m is assumed"))
            });
        }
        let (length, width) = (row.length.unwrap_or(length), row.width.unwrap_or(width));
        Track { id: 0, class, length, width, states: Vec::new() }
    }

    pub(super) fn finish(mut self) -> Result<(Recording, Vec<Problem>), RecordingError> {
        if self.tracks.is_empty() {
            let problem = self.problems.first().map(|it| it.to_string());
            return Err(RecordingError::NoRows { rows: self.rows, problem });
        }
        let step = self.step()?;
        let names = self.number_tracks();
        let mut tracks = Vec::with_capacity(self.tracks.len());
        for reading in std::mem::take(&mut self.tracks) {
            let line = reading.line;
            tracks.push((reading.sorted(&mut self.problems), line));
        }
        let mut tracks = match self.layout.reused_after_s {
            Some(pause) => self.told_apart(tracks, (pause / step) as i64),
            None => tracks.into_iter().map(|it| it.0).collect(),
        };
        tracks.iter_mut().for_each(|it| self.complete(it, step));
        let utm_origin = self.known.utm_origin;
        let mut recording = Recording { step, tracks, names, utm_origin };
        let mut problems = self.problems.into_list();
        leave_out_parts(&mut recording, &mut problems);
        Ok((recording, problems))
    }

    /// Gives tracks their numbers: their own, and free ones where the table has texts, which are returned.
    fn number_tracks(&mut self) -> BTreeMap<i64, String> {
        let numbers = self.tracks.iter().filter_map(|it| match it.id {
            Id::Number(number) => Some(number),
            Id::Text(_) => None,
        });
        let mut free = free_ids(numbers.collect());
        let mut names = BTreeMap::new();
        for Reading { id, track, .. } in &mut self.tracks {
            track.id = match id {
                Id::Number(number) => *number,
                Id::Text(text) => {
                    let number = free.next().unwrap_or_default();
                    names.insert(number, text.to_string());
                    number
                }
            };
        }
        names
    }

    /// The time between frames [s]. Where frames have no numbers, they get them.
    fn step(&mut self) -> Result<f64, RecordingError> {
        let columns = &self.layout.columns;
        let per_second = self.known.frames_per_second.or(self.layout.frames_per_second);
        match (&columns.frame, &columns.time) {
            (Some(frame), Some(time)) => self.times.step([time, frame]),
            (Some(_), None) => {
                let step_ms = 1000.0 / per_second.ok_or(RecordingError::NoFrameRate)?;
                in_range(step_ms, 1, "frames_per_second")?;
                Ok(step_ms / 1000.0)
            }
            (None, Some(time)) => {
                let found = || shortest(self.tracks.iter().map(|it| &it.times_ms[..]));
                let one_frame = RecordingError::OneFrame { line: self.tracks[0].line, frame: 0 };
                let step_ms = per_second.map(|it| 1000.0 / it).or_else(found).ok_or(one_frame)?;
                in_range(step_ms, self.tracks[0].line, time)?;
                self.number_frames(step_ms);
                Ok(step_ms / 1000.0)
            }
            (None, None) => Err(RecordingError::NoTime),
        }
    }

    /// Gives frames numbers by their times, the first of all 0.
    fn number_frames(&mut self, step_ms: f64) {
        let times = self.tracks.iter().flat_map(|it| &it.times_ms).copied();
        let first = times.fold(f64::INFINITY, f64::min);
        for reading in &mut self.tracks {
            for (state, time_ms) in reading.track.states.iter_mut().zip(&reading.times_ms) {
                state.frame = ((time_ms - first) / step_ms).round() as i64;
            }
            reading.times_ms = Vec::new();
        }
    }

    /// The tracks, each with the line where it begins, those with an id that was used again after more than `pause`
    /// frames with an id of their own.
    fn told_apart(&mut self, tracks: Vec<(Track, usize)>, pause: i64) -> Vec<Track> {
        let mut free_ids = free_ids(tracks.iter().map(|it| it.0.id).collect());
        let mut all = Vec::with_capacity(tracks.len());
        for (track, line) in tracks {
            let id = track.id;
            for (number, states) in track.states.chunk_by(|a, b| b.frame - a.frame <= pause).enumerate() {
                let free = if number == 0 { id } else { free_ids.next().unwrap_or(id) };
                if number > 0 {
                    let remedy = "give every road user an id of its own";
                    self.problems.add("id that is used again", remedy, line, || {
                        let from = states[0].frame;
                        (
                            format!("track {id}"),
                            format!("its id is used again from frame {from} on: that is {free}"),
                        )
                    });
                }
                all.push(Track { id: free, states: states.to_vec(), ..track });
            }
        }
        all
    }

    /// Fills in speeds and headings that the table does not give, and moves positions to the centre.
    fn complete(&self, track: &mut Track, step: f64) {
        let Track { length, width, states, .. } = track;
        let is_along_y = |heading: f64| heading.sin().abs() > heading.cos().abs();
        if states.iter().any(|it| it.speed.is_nan() || it.heading.is_nan()) {
            move_as_positions_do(states, step, self.layout.columns.vx.is_some());
        }
        fill_headings(states);
        match self.layout.point {
            Point::Centre => {}
            Point::Front => {
                for state in states {
                    let (sin, cos) = state.heading.sin_cos();
                    (state.x, state.y) = (state.x - 0.5 * *length * cos, state.y - 0.5 * *length * sin);
                }
            }
            Point::Corner => {
                let up = if self.layout.axes == Axes::YDown { -1.0 } else { 1.0 };
                for state in states {
                    let box_of = [*length, *width];
                    let [along_x, along_y] =
                        if is_along_y(state.heading) { [box_of[1], box_of[0]] } else { box_of };
                    (state.x, state.y) = (state.x + 0.5 * along_x, state.y + up * 0.5 * along_y);
                }
            }
        }
    }
}

impl Reading {
    /// The track with its states in order of frames, each once.
    fn sorted(mut self, problems: &mut Problems) -> Track {
        let states = &mut self.track.states;
        if !states.is_sorted_by(|a, b| a.frame < b.frame) {
            states.sort_by_key(|it| it.frame);
            states.dedup_by(|later, kept| {
                let is_again = later.frame == kept.frame;
                if is_again {
                    again(problems, &self.id, kept.frame, self.line);
                }
                is_again
            });
        }
        self.track
    }
}

fn again(problems: &mut Problems, track: &Id, frame: i64, line: usize) {
    problems.add("duplicate row", "keep one row for each frame", line, || {
        (format!("track {track}"), format!("frame {frame} occurs again, so only its first row is used"))
    });
}

/// Gives states without a speed or a heading those of a line through the positions around them. A table
/// `with_velocities` has no headings where the velocity has no direction: those stay open.
fn move_as_positions_do(states: &mut [State], step: f64, with_velocities: bool) {
    if with_velocities {
        return;
    }
    let motions: Vec<_> = (0..states.len()).map(|at| motion(states, at, REACH, step)).collect();
    for (state, motion) in states.iter_mut().zip(motions) {
        if state.speed.is_nan() {
            state.speed = motion.speed();
        }
        if state.heading.is_nan() && motion.speed() > STANDSTILL {
            state.heading = motion.heading();
        }
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
