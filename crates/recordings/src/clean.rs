//! Cleaning: data that no real road user can produce is corrected, or cut out, and reported.

mod ends;
mod motion;
mod positions;
mod report;

use crate::recording::{Recording, RoadUser, State, Track};
use report::Noted;
pub use report::{CleaningReport, Example, Finding};

/// Cleans a recording, whatever its source.
///
/// The steps for each track, in this order: An impossible size is replaced by the usual one of its class. States with
/// numbers that are not finite are left out, and further states of one frame. Single states far off the path are left
/// out, too; where the path itself jumps, the track is split. Missing frames are interpolated up to 1 s; a longer gap
/// splits the track. The first and last positions of a vehicle that was seen only in part, too far in view for any
/// acceleration, are put where the motion after and before them says. A speed that contradicts the positions by more
/// than 5 m/s is replaced by that of smoothed positions. A heading more than 45° off the direction of motion is
/// replaced in the same way.
pub fn clean(mut recording: Recording) -> (Recording, CleaningReport) {
    let mut report = CleaningReport {
        states: recording.tracks.iter().map(|it| it.states.len()).sum(),
        ..Default::default()
    };
    let step = recording.step;
    let mut tracks = Vec::with_capacity(recording.tracks.len());
    for track in std::mem::take(&mut recording.tracks) {
        let mut noted = Noted { report: &mut report, track: track.id, step };
        let (length, width) = size(&track, &mut noted);
        let states = readable(track.states, &mut noted);
        for mut states in positions::parts(states, step, &mut noted) {
            ends::complete(&mut states, step, &mut noted);
            motion::mend(&mut states, step, &mut noted);
            tracks.push(Track { id: track.id, class: track.class, length, width, states });
        }
    }
    (Recording { tracks, ..recording }, report)
}

/// The track's length and width, or the usual ones.
fn size(track: &Track, noted: &mut Noted<'_>) -> (f64, f64) {
    // Road trains are up to 25 m long, those of some countries 30 m [m].
    let (lengths, widths) = match track.class {
        RoadUser::Pedestrian | RoadUser::Bicycle | RoadUser::Other => (0.1..=30.0, 0.1..=4.0),
        _ => (1.0..=30.0, 0.4..=4.0),
    };
    if lengths.contains(&track.length) && widths.contains(&track.width) {
        return (track.length, track.width);
    }
    noted.add(|report| &mut report.sizes, track.states.first().map_or(0, |it| it.frame));
    track.class.usual_size()
}

/// States with finite numbers in order of frames, each frame once.
fn readable(mut states: Vec<State>, noted: &mut Noted<'_>) -> Vec<State> {
    states.retain(|it| {
        let is_finite = [it.x, it.y, it.speed, it.heading].iter().all(|number| number.is_finite());
        if !is_finite {
            noted.add(|report| &mut report.not_finite, it.frame);
        }
        is_finite
    });
    states.sort_by_key(|it| it.frame);
    states.dedup_by(|later, kept| {
        let is_again = later.frame == kept.frame;
        if is_again {
            noted.add(|report| &mut report.duplicates, later.frame);
        }
        is_again
    });
    states
}
