//! Several recordings that continue one another, joined by ids, frames and places.
//!
//! Some datasets cut their recordings into windows. In some of them frames are counted on, in others each window begins
//! at frame 0. So the offset of a window is found by its vehicles: those with an id that another window has, too, are
//! where that recording ends, moved on for some time. The offset in time is the mean over the vehicles that agree with
//! the median. Without an offset that fits, the window continues none of the others.

use std::collections::{BTreeMap, HashMap};

use thiserror::Error;

use crate::recording::{Recording, State, Track, free_ids};
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
const LONGEST: f64 = 3.0;
/// No recordings of one place are further apart, by the places of their vehicles [s].
const FARTHEST: f64 = 1e9;
/// At least this share of the vehicles with known ids are where they should be.
const SHARE: f64 = 0.8;

/// Recordings that were joined.
#[derive(Clone, Debug, PartialEq)]
pub struct Joined {
    /// All of them, in the frames of the first.
    pub recording: Recording,
    /// For each of them, in their order, the number of its frame 0 in the whole.
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
    /// One continues none of the others.
    #[error(
        "recording {number} continues none of the others: of {common} vehicles with the same ids {agreeing} are where they would \
         be; give recordings of one place that continue one another"
    )]
    Elsewhere {
        /// Its number, from 1 on.
        number: usize,
        /// Ids that it has in common with those that were joined.
        common: usize,
        /// Of them, those at the right place at the best offset.
        agreeing: usize,
    },
}

/// Recordings that continue one another, of several that were given.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// The whole.
    pub joined: Joined,
    /// The numbers of its recordings, from 1 on, in their order.
    pub numbers: Vec<usize>,
    /// Why it continues none of the recordings of the first series; none for that.
    pub apart: Option<JoinError>,
}

/// Joins recordings as far as they continue one another, in any order. One that continues none of the others is a
/// series of its own.
pub fn series(mut parts: Vec<Recording>) -> Vec<Series> {
    number_by_names(&mut parts);
    let mut left: Vec<(usize, Recording)> = (1..).zip(parts).collect();
    let mut all: Vec<Series> = Vec::new();
    let mut apart: HashMap<usize, JoinError> = HashMap::new();
    while !left.is_empty() {
        let (first, part) = left.remove(0);
        let mut whole = Whole::of(part, first);
        while let Some((at, offset)) = whole.next(&left) {
            let (number, part) = left.remove(at);
            whole.add(part, number, offset);
        }
        if all.is_empty() {
            let refused =
                |(number, it): &(usize, Recording)| Some((*number, whole.fit_of(it, *number).err()?));
            apart.extend(left.iter().filter_map(refused));
        }
        let (joined, numbers) = whole.finish();
        all.push(Series { joined, numbers, apart: apart.remove(&first) });
    }
    all
}

/// Joins recordings that continue one another, in any order.
///
/// # Errors
/// If one has another frame rate, or continues none of the others.
pub fn join(parts: Vec<Recording>) -> Result<Joined, JoinError> {
    let mut all = series(parts);
    let apart = all.iter_mut().find_map(|it| it.apart.take());
    apart.map_or_else(|| all.pop().map(|it| it.joined).ok_or(JoinError::Nothing), Err)
}

/// Gives tracks with the same name the same id in all `parts`.
fn number_by_names(parts: &mut [Recording]) {
    let is_named = |part: &Recording, id: i64| part.names.contains_key(&id);
    let own = parts
        .iter()
        .flat_map(|part| part.tracks.iter().map(|it| it.id).filter(move |it| !is_named(part, *it)));
    let mut free = free_ids(own.collect());
    let mut ids: HashMap<String, i64> = HashMap::new();
    for part in parts {
        let mut names = BTreeMap::new();
        for track in &mut part.tracks {
            let Some(name) = part.names.get(&track.id) else { continue };
            track.id = *ids.entry(name.clone()).or_insert_with(|| free.next().unwrap_or_default());
            names.insert(track.id, name.clone());
        }
        part.names = names;
    }
}

/// What was joined so far.
struct Whole {
    /// With all tracks.
    recording: Recording,
    /// The latest track of each id.
    by_id: HashMap<i64, usize>,
    /// The number of each recording, from 1 on, and that of its frame 0 in the whole.
    offsets: Vec<(usize, i64)>,
    continued: usize,
    renamed: usize,
}

/// Where a recording belongs.
#[derive(Clone, Copy)]
struct Fit {
    /// The number of its frame 0 in the whole.
    offset: i64,
    /// The least time for which a vehicle of both was not seen [s]; 0 where they overlap.
    missing: f64,
}

/// A vehicle on both sides of a cut.
struct Pair<'a> {
    before: &'a [State],
    after: &'a [State],
}

impl Whole {
    fn of(first: Recording, number: usize) -> Whole {
        let by_id = first.tracks.iter().enumerate().map(|(index, it)| (it.id, index)).collect();
        Whole { recording: first, by_id, offsets: vec![(number, 0)], continued: 0, renamed: 0 }
    }

    /// Which of `left` continues it with the least time between, and where it belongs.
    fn next(&self, left: &[(usize, Recording)]) -> Option<(usize, i64)> {
        let fits = left.iter().map(|(number, it)| self.fit_of(it, *number)).enumerate();
        let nearest = fits.filter_map(|(at, it)| Some((at, it.ok()?)));
        let nearest = nearest.min_by(|a, b| a.1.missing.total_cmp(&b.1.missing));
        nearest.map(|(at, it)| (at, it.offset))
    }

    /// The vehicles of `part` whose ids are known.
    fn pairs<'a>(&'a self, part: &'a Recording) -> Vec<Pair<'a>> {
        let pair = |track: &'a Track| {
            let before = &self.recording.tracks[*self.by_id.get(&track.id)?].states;
            (!before.is_empty() && !track.states.is_empty()).then_some(Pair { before, after: &track.states })
        };
        part.tracks.iter().filter_map(pair).collect()
    }

    /// Where `part` belongs.
    fn fit_of(&self, part: &Recording, number: usize) -> Result<Fit, JoinError> {
        if (part.step - self.recording.step).abs() > 1e-6 {
            return Err(JoinError::Step { number, found: part.step, expected: self.recording.step });
        }
        let pairs = self.pairs(part);
        let agreeing = |offset: i64| pairs.iter().filter(|it| it.fits(offset, self.recording.step)).count();
        // Frames that are counted on are those that the dataset means, if vehicles agree.
        let by_places = self.by_places(&pairs).filter(|it| agreeing(*it) > agreeing(0));
        let offset = by_places.unwrap_or(0);
        let (common, agreeing) = (pairs.len(), agreeing(offset));
        if agreeing == 0 || (agreeing as f64) < SHARE * common as f64 {
            return Err(JoinError::Elsewhere { number, common, agreeing });
        }
        let missing =
            pairs.iter().filter(|it| it.fits(offset, self.recording.step)).map(|it| it.missing(offset));
        Ok(Fit { offset, missing: missing.min().unwrap_or(0) as f64 * self.recording.step })
    }

    /// The offset that fits the places of vehicles best.
    fn by_places(&self, pairs: &[Pair]) -> Option<i64> {
        let mut lags: Vec<f64> = pairs.iter().filter_map(|it| it.lag(self.recording.step)).collect();
        lags.sort_by(f64::total_cmp);
        let median = *lags.get(lags.len() / 2)?;
        /// Lags that differ by more than this from the median are those of other vehicles with the same ids [s].
        const NEAR: f64 = 0.5;
        let near: Vec<f64> = lags.into_iter().filter(|it| (it - median).abs() < NEAR).collect();
        let mean = near.iter().sum::<f64>() / near.len() as f64;
        Some((mean / self.recording.step).round() as i64)
    }

    /// Adds `part` with its frame 0 at `offset`.
    fn add(&mut self, part: Recording, number: usize, offset: i64) {
        let mut free = free_ids(self.recording.tracks.iter().chain(&part.tracks).map(|it| it.id).collect());
        let known = self.by_id.clone();
        for mut track in part.tracks {
            let step = self.recording.step;
            let before = known.get(&track.id).copied();
            let is_same = before.is_some_and(|it| {
                let (before, after) = (&self.recording.tracks[it].states[..], &track.states[..]);
                before.is_empty() || after.is_empty() || Pair { before, after }.fits(offset, step)
            });
            track.states.iter_mut().for_each(|it| it.frame += offset);
            match before.filter(|_| is_same) {
                Some(index) => {
                    let states = &mut self.recording.tracks[index].states;
                    states.append(&mut track.states);
                    // Of a frame that both have the first counts: the order of equal ones stays.
                    states.sort_by_key(|it| it.frame);
                    states.dedup_by_key(|it| it.frame);
                    self.continued += 1;
                }
                None => {
                    let name = part.names.get(&track.id);
                    if before.is_some() {
                        track.id = free.next().unwrap_or(track.id);
                        self.renamed += 1;
                    }
                    self.recording.names.extend(name.map(|it| (track.id, it.clone())));
                    self.by_id.insert(track.id, self.recording.tracks.len());
                    self.recording.tracks.push(track);
                }
            }
        }
        self.offsets.push((number, offset));
    }

    /// The whole, and the numbers of its recordings.
    fn finish(self) -> (Joined, Vec<usize>) {
        let Whole { recording, mut offsets, continued, renamed, .. } = self;
        offsets.sort_unstable();
        let (numbers, offsets) = offsets.into_iter().unzip();
        (Joined { recording, offsets, continued, renamed }, numbers)
    }
}

impl Pair<'_> {
    /// The time of frame 0 of the second recording in the first [s], by the places of this vehicle; `None` if it is too
    /// slow to show it.
    fn lag(&self, step: f64) -> Option<f64> {
        let (here, there) = self.nearest();
        let [a, b] = [motion(self.before, here, REACH, step), motion(self.after, there, REACH, step)];
        let velocity = velocity_between((self.before, a), (self.after, b));
        let squared = velocity[0] * velocity[0] + velocity[1] * velocity[1];
        if squared < SLOWEST * SLOWEST {
            return None;
        }
        let time = ((b.x - a.x) * velocity[0] + (b.y - a.y) * velocity[1]) / squared;
        let lag = (self.before[here].frame - self.after[there].frame) as f64 * step + time;
        // This form also refuses NaN.
        (lag.abs() <= FARTHEST).then_some(lag)
    }

    /// The two states that are nearest to each other, one of them the first or last of its recording.
    fn nearest(&self) -> (usize, usize) {
        let distance = |(here, there): (usize, usize)| {
            let (a, b) = (&self.before[here], &self.after[there]);
            (a.x - b.x).hypot(a.y - b.y)
        };
        let (ends, others) = ([0, self.before.len() - 1], [0, self.after.len() - 1]);
        let from_here = ends.into_iter().flat_map(|it| (0..self.after.len()).map(move |there| (it, there)));
        let from_there = others.into_iter().flat_map(|it| (0..self.before.len()).map(move |here| (here, it)));
        let nearest = from_here.chain(from_there).min_by(|a, b| distance(*a).total_cmp(&distance(*b)));
        nearest.unwrap_or((ends[1], 0))
    }

    /// Whether the vehicle is where it would be if frame 0 of the second recording were the frame `offset` of the
    /// first.
    fn fits(&self, offset: i64, step: f64) -> bool {
        let (first, last) = (self.before[0].frame, self.before[self.before.len() - 1].frame);
        let [from, to] = [0, self.after.len() - 1].map(|it| self.after[it].frame + offset);
        if from > last {
            return goes_on(self.before, self.after, (from - last) as f64 * step, step);
        }
        if to < first {
            return goes_on(self.after, self.before, (first - to) as f64 * step, step);
        }
        self.agrees(offset)
    }

    /// Frames between the two recordings in which it was not seen.
    fn missing(&self, offset: i64) -> i64 {
        let (first, last) = (self.before[0].frame, self.before[self.before.len() - 1].frame);
        let [from, to] = [0, self.after.len() - 1].map(|it| self.after[it].frame + offset);
        (from - last).max(first - to).max(0)
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

/// The velocity between two motions, each with the states that show it: a single state shows none.
fn velocity_between((before, a): (&[State], Motion), (after, b): (&[State], Motion)) -> [f64; 2] {
    match (before.len(), after.len()) {
        (_, 1) => [a.vx, a.vy],
        (1, _) => [b.vx, b.vy],
        _ => [0.5 * (a.vx + b.vx), 0.5 * (a.vy + b.vy)],
    }
}

/// Whether a vehicle that was last seen in `earlier` is, `time` [s] later, where `later` begins.
fn goes_on(earlier: &[State], later: &[State], time: f64, step: f64) -> bool {
    let [a, b] = [motion(earlier, earlier.len() - 1, REACH, step), motion(later, 0, REACH, step)];
    let [vx, vy] = velocity_between((earlier, a), (later, b));
    let [x, y] = [a.x + vx * time, a.y + vy * time];
    time <= LONGEST && (b.x - x).hypot(b.y - y) <= TOLERANCE + 0.125 * ACCELERATION * time * time
}
