//! Several recordings that continue one another, joined by ids, frames and places.
//!
//! Some datasets cut their recordings into windows. In some of them frames are counted on, in others each window begins
//! at frame 0. So the offset of a window is found by its vehicles: those with an id that the recording before it has,
//! too, are where that recording ends, moved on for some time. The offset in time is the one that fits them best (least
//! squares over the vehicles that agree with the median). Without an offset that fits, the window does not continue the
//! others.

use std::collections::HashMap;

use thiserror::Error;

use crate::recording::{Recording, State, Track};
use crate::smooth::{Motion, motion};

/// Positions this long before and after the cut give the motion there [s].
const REACH: f64 = 0.4;
/// A vehicle is where it should be within this distance [m], and within what this acceleration does in the time between
/// [m/s²].
const TOLERANCE: f64 = 1.0;
const ACCELERATION: f64 = 3.0;
/// Slower vehicles do not show how much time has passed [m/s].
const SLOWEST: f64 = 2.0;
/// No more time is missing between two windows [s].
const LONGEST: f64 = 10.0;
/// At least this share of the vehicles with known ids are where they should be.
const SHARE: f64 = 0.8;

/// Recordings that were joined.
#[derive(Clone, Debug, PartialEq)]
pub struct Joined {
    /// All of them, in the frames of the first.
    pub recording: Recording,
    /// For each of them the number of its frame 0 in the whole.
    pub offsets: Vec<i64>,
    /// Vehicles that go on from one recording to the next.
    pub continued: usize,
    /// Vehicles with the id of another one, which got a new id.
    pub renamed: usize,
}

/// Why recordings cannot be joined.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum JoinError {
    /// There is none.
    #[error("no recording is given; give two or more that continue one another")]
    Nothing,
    /// One has another frame rate.
    #[error(
        "recording {number}: its frames are {found} s apart, those of the first {expected} s; join recordings of one frame rate"
    )]
    Step {
        /// Its number, from 1 on.
        number: usize,
        /// Its time between frames [s].
        found: f64,
        /// That of the first [s].
        expected: f64,
    },
    /// One does not continue those before it.
    #[error(
        "recording {number} does not continue those before it: of {common} vehicles with the same ids {agreeing} are where they \
         would be; give recordings of one place in the order of their times"
    )]
    Elsewhere {
        /// Its number, from 1 on.
        number: usize,
        /// Ids that it has in common with those before it.
        common: usize,
        /// Of them, those at the right place at the best offset.
        agreeing: usize,
    },
}

/// Joins recordings that continue one another, in their order.
///
/// # Errors
/// If one has another frame rate, or does not continue those before it.
pub fn join(parts: Vec<Recording>) -> Result<Joined, JoinError> {
    let mut parts = parts.into_iter();
    let first = parts.next().ok_or(JoinError::Nothing)?;
    let mut whole = Whole::of(first);
    for (part, number) in parts.zip(2..) {
        let (found, expected) = (part.step, whole.step);
        if (found - expected).abs() > 1e-6 {
            return Err(JoinError::Step { number, found, expected });
        }
        let offset = whole.offset_of(&part, number)?;
        whole.add(part, offset);
    }
    Ok(whole.finish())
}

/// What was joined so far.
struct Whole {
    step: f64,
    tracks: Vec<Track>,
    /// The latest track of each id.
    by_id: HashMap<i64, usize>,
    offsets: Vec<i64>,
    continued: usize,
    renamed: usize,
}

/// A vehicle on both sides of a cut.
struct Pair<'a> {
    before: &'a [State],
    after: &'a [State],
}

impl Whole {
    fn of(first: Recording) -> Whole {
        let by_id = first.tracks.iter().enumerate().map(|(index, it)| (it.id, index)).collect();
        let Recording { step, tracks } = first;
        Whole { step, tracks, by_id, offsets: vec![0], continued: 0, renamed: 0 }
    }

    /// The vehicles of `part` whose ids are known.
    fn pairs<'a>(&'a self, part: &'a Recording) -> Vec<Pair<'a>> {
        let pair = |track: &'a Track| {
            let before = &self.tracks[*self.by_id.get(&track.id)?].states;
            (!before.is_empty() && !track.states.is_empty()).then_some(Pair { before, after: &track.states })
        };
        part.tracks.iter().filter_map(pair).collect()
    }

    /// The number of frame 0 of `part` in the whole.
    fn offset_of(&self, part: &Recording, number: usize) -> Result<i64, JoinError> {
        let pairs = self.pairs(part);
        let agreeing = |offset: i64| pairs.iter().filter(|it| it.fits(offset, self.step)).count();
        let candidates = [Some(0), self.by_places(&pairs)];
        let best = candidates.into_iter().flatten().max_by_key(|it| agreeing(*it)).unwrap_or(0);
        let (common, agreeing) = (pairs.len(), agreeing(best));
        if agreeing == 0 || (agreeing as f64) < SHARE * common as f64 {
            return Err(JoinError::Elsewhere { number, common, agreeing });
        }
        Ok(best)
    }

    /// The offset that fits the places of vehicles best.
    fn by_places(&self, pairs: &[Pair]) -> Option<i64> {
        let mut lags: Vec<f64> = pairs.iter().filter_map(|it| it.lag(self.step)).collect();
        lags.sort_by(f64::total_cmp);
        let median = *lags.get(lags.len() / 2)?;
        /// Lags that differ by more than this from the median are those of other vehicles with the same ids [s].
        const NEAR: f64 = 0.5;
        let near: Vec<f64> = lags.into_iter().filter(|it| (it - median).abs() < NEAR).collect();
        let mean = near.iter().sum::<f64>() / near.len() as f64;
        Some((mean / self.step).round() as i64)
    }

    /// Adds `part` with its frame 0 at `offset`.
    fn add(&mut self, part: Recording, offset: i64) {
        let mut free = self.tracks.iter().chain(&part.tracks).map(|it| it.id).max().unwrap_or(0) + 1;
        let known = self.by_id.clone();
        for mut track in part.tracks {
            let step = self.step;
            let before = known.get(&track.id).copied();
            let is_same = before.is_some_and(|it| {
                let (before, after) = (&self.tracks[it].states[..], &track.states[..]);
                before.is_empty() || after.is_empty() || Pair { before, after }.fits(offset, step)
            });
            track.states.iter_mut().for_each(|it| it.frame += offset);
            match before.filter(|_| is_same) {
                Some(index) => {
                    let states = &mut self.tracks[index].states;
                    let last = states.last().map_or(i64::MIN, |it| it.frame);
                    states.extend(track.states.into_iter().filter(|it| it.frame > last));
                    self.continued += 1;
                }
                None => {
                    if before.is_some() {
                        track.id = free;
                        free += 1;
                        self.renamed += 1;
                    }
                    self.by_id.insert(track.id, self.tracks.len());
                    self.tracks.push(track);
                }
            }
        }
        self.offsets.push(offset);
    }

    fn finish(self) -> Joined {
        let Whole { step, tracks, offsets, continued, renamed, .. } = self;
        Joined { recording: Recording { step, tracks }, offsets, continued, renamed }
    }
}

impl Pair<'_> {
    /// The motions on both sides of the cut.
    fn motions(&self, step: f64) -> [Motion; 2] {
        [motion(self.before, self.before.len() - 1, REACH, step), motion(self.after, 0, REACH, step)]
    }

    /// The time of frame 0 of the second recording in the first [s], by the place of this vehicle; `None` if it is too
    /// slow to show it.
    fn lag(&self, step: f64) -> Option<f64> {
        let [before, after] = self.motions(step);
        let velocity = [0.5 * (before.vx + after.vx), 0.5 * (before.vy + after.vy)];
        let squared = velocity[0] * velocity[0] + velocity[1] * velocity[1];
        if squared < SLOWEST * SLOWEST {
            return None;
        }
        let way = [after.x - before.x, after.y - before.y];
        let time = (way[0] * velocity[0] + way[1] * velocity[1]) / squared;
        let [last, first] = [self.before[self.before.len() - 1].frame, self.after[0].frame];
        Some((last - first) as f64 * step + time)
    }

    /// Whether the vehicle is where it would be if frame 0 of the second recording were the frame `offset` of the
    /// first.
    fn fits(&self, offset: i64, step: f64) -> bool {
        let [before, after] = self.motions(step);
        let [last, first] = [self.before[self.before.len() - 1].frame, self.after[0].frame + offset];
        if first <= last {
            return self.agrees(offset);
        }
        let time = (first - last) as f64 * step;
        let [x, y] =
            [before.x + 0.5 * (before.vx + after.vx) * time, before.y + 0.5 * (before.vy + after.vy) * time];
        let off = (after.x - x).hypot(after.y - y);
        time <= LONGEST && off <= TOLERANCE + 0.5 * ACCELERATION * time * time / 4.0
    }

    /// Whether both recordings show it at the same places where they overlap.
    fn agrees(&self, offset: i64) -> bool {
        let mut shared = self.after.iter().filter_map(|it| {
            let at = self.before.binary_search_by_key(&(it.frame + offset), |it| it.frame).ok()?;
            Some((self.before[at].x - it.x).hypot(self.before[at].y - it.y))
        });
        shared.next().is_some_and(|it| it <= TOLERANCE) && shared.all(|it| it <= TOLERANCE)
    }
}
