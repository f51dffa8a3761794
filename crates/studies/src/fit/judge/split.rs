//! The recordings in time: styles are fitted to the first two thirds, and traffic is simulated beside the last.

use laneweave_recordings::{Recording, Track};

use crate::fit::sources::{Part, Sources};

/// The part of the recorded time to which styles are fitted.
const FITTED: f64 = 2.0 / 3.0;
/// A piece that is simulated takes at least so long [s] (ours).
const SHORTEST: f64 = 60.0;
/// Drivers drive at least and at most so long before anything is measured [s] (ours).
const SETTLING: [f64; 2] = [10.0, 120.0];
/// The scales of other models are fitted to the last so many seconds before the cut (ours).
const SCALED: f64 = 600.0;

/// A rollout from a snapshot takes so long [s] (ours).
const SHORT: f64 = 40.0;
/// No more snapshots are taken (ours).
const MOST_SNAPSHOTS: usize = 24;

/// A stretch of a recording that is simulated.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Piece {
    /// The number of its recording.
    pub(super) part: usize,
    /// The frame from which on vehicles are drivers.
    pub(super) release: i64,
    /// The frames between which everything is measured.
    pub(super) measured: [i64; 2],
}

/// Recordings that are cut in time.
pub(super) struct Split {
    /// Those of the first two thirds.
    pub(super) fitted: Sources,
    /// Pieces of the first two thirds.
    pub(super) before: Vec<Piece>,
    /// Pieces of the last third.
    pub(super) after: Vec<Piece>,
    /// Short pieces of the last third, in which all vehicles become drivers where they were recorded.
    pub(super) snapshots: Vec<Piece>,
}

impl Split {
    /// The split of all recordings, one after the other.
    pub(super) fn of(sources: &Sources) -> Split {
        let settling = settling(sources);
        let total: f64 = sources.parts.iter().map(|it| seconds(&it.recording)).sum();
        let (mut left, mut fitted) = (FITTED * total, Vec::new());
        let (mut before, mut after, mut snapshots) = (Vec::new(), Vec::new(), Vec::new());
        for (number, part) in sources.parts.iter().enumerate() {
            let Some((first, last)) = part.recording.frames() else { continue };
            let step = part.recording.step;
            let cut = first + (left / step).round().clamp(0.0, (last - first) as f64) as i64;
            left -= (cut - first) as f64 * step;
            let piece = |from: i64, until: i64| piece(number, step, settling, [first, from, until]);
            before.extend(piece(first.max(cut - (SCALED / step) as i64), cut));
            after.extend(piece(cut, last));
            snapshots.extend(short_pieces(number, step, [cut, last]));
            if cut > first {
                let recording = between(&part.recording, [first, cut]);
                fitted.push(Part { name: part.name.clone(), recording, site: part.site });
            }
        }
        let maps = sources.sites.iter().map(|it| it.map.clone()).collect();
        let every = snapshots.len().div_ceil(MOST_SNAPSHOTS).max(1);
        let snapshots = snapshots.into_iter().step_by(every).collect();
        Split { fitted: Sources::of(maps, fitted), before, after, snapshots }
    }
}

/// The piece between two frames of a recording that begins with frame `first`, if it is long enough.
fn piece(part: usize, step: f64, settling: f64, [first, from, until]: [i64; 3]) -> Option<Piece> {
    let settling = (settling / step).round() as i64;
    let from = from.max(first + settling);
    let is_long = (until - from) as f64 * step >= SHORTEST;
    is_long.then_some(Piece { part, release: from - settling, measured: [from, until] })
}

/// The short pieces between two frames of a recording, one after the other.
fn short_pieces(part: usize, step: f64, [from, until]: [i64; 2]) -> impl Iterator<Item = Piece> {
    let length = (SHORT / step).round() as i64;
    let begins = (0..).map(move |it| from + it * length).take_while(move |it| it + length <= until);
    begins.map(move |it| Piece { part, release: it, measured: [it, it + length] })
}

/// The time after which most vehicles that were there have gone [s]: that for which a vehicle is seen in the median.
fn settling(sources: &Sources) -> f64 {
    let time =
        |it: &Track, step: f64| Some((it.states.last()?.frame - it.states.first()?.frame) as f64 * step);
    let of = |it: &Part| {
        let step = it.recording.step;
        it.recording.tracks.iter().filter_map(|track| time(track, step)).collect::<Vec<f64>>()
    };
    let mut times: Vec<f64> = sources.parts.iter().flat_map(of).collect();
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or(0.0).clamp(SETTLING[0], SETTLING[1])
}

/// From the first frame to the last [s].
fn seconds(recording: &Recording) -> f64 {
    recording.frames().map_or(0.0, |(first, last)| (last - first) as f64 * recording.step)
}

/// What was recorded from the first of two frames to the second.
pub(super) fn between(recording: &Recording, [first, last]: [i64; 2]) -> Recording {
    let tracks = recording.tracks.iter().filter_map(|it| {
        let within = |frame: i64| it.states.partition_point(|state| state.frame < frame);
        let states = it.states[within(first)..within(last + 1)].to_vec();
        (!states.is_empty()).then_some(Track { states, ..*it })
    });
    Recording { tracks: tracks.collect(), names: recording.names.clone(), ..*recording }
}
