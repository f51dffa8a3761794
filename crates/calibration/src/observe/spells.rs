//! The times in which recorded drivers could begin a change: while they are seen on lanelets, not within a change, and
//! not in the cooldown after one.

use laneweave_network::Side;
use laneweave_recordings::{Extent, LaneChange, Matched};

/// A time in which a driver could begin a change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SpellTimes {
    pub(super) track: usize,
    /// When it begins and ends [s].
    pub(super) from: f64,
    pub(super) until: f64,
    /// It comes after the cooldown of another change.
    pub(super) is_after_change: bool,
    /// How it ends.
    pub(super) end: End,
}

/// How a time ends in which a driver could begin a change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// With the last sight of the driver.
    Sight,
    /// With the begin of the change of this number.
    Change(usize),
    /// With a desire for this side, whose begin is known.
    Desire(Side),
}

/// All spells, those of a vehicle one after the other.
pub(super) fn spell_times(
    matched: &Matched,
    changes: &[LaneChange],
    extents: &[Extent],
    cooldown: f64,
) -> Vec<SpellTimes> {
    let mut by_track: Vec<Vec<usize>> = vec![Vec::new(); matched.recording.tracks.len()];
    changes.iter().enumerate().for_each(|(number, it)| by_track[it.track].push(number));
    let mut order: Vec<usize> = (0..matched.recording.tracks.len()).collect();
    order.sort_by_key(|it| {
        let track = &matched.recording.tracks[*it];
        (track.id, track.states.first().map(|it| it.frame))
    });
    let mut spells = Vec::new();
    for track in order {
        if !matched.recording.tracks[track].class.is_vehicle() {
            continue;
        }
        for (from, until) in seen(matched, track) {
            split(&mut spells, track, (from, until), &by_track[track], extents, cooldown);
        }
    }
    spells
}

/// The times for which a vehicle was seen on lanelets [s].
fn seen(matched: &Matched, track: usize) -> Vec<(f64, f64)> {
    let step = matched.recording.step;
    let states = matched.recording.tracks[track].states.iter().zip(&matched.places[track]);
    let mut times: Vec<(f64, f64)> = Vec::new();
    for (state, _) in states.filter(|it| it.1.is_some()) {
        let time = state.frame as f64 * step;
        match times.last_mut() {
            Some((_, until)) if time - *until < 1.5 * step => *until = time,
            _ => times.push((time, time)),
        }
    }
    times
}

/// Splits a time at the changes that lie in it.
fn split(
    spells: &mut Vec<SpellTimes>,
    track: usize,
    (seen_from, seen_until): (f64, f64),
    changes: &[usize],
    extents: &[Extent],
    cooldown: f64,
) {
    let (mut from, mut is_after_change) = (seen_from, false);
    for number in changes {
        let Extent { began, ended } = extents[*number];
        if ended < seen_from || began > seen_until {
            continue;
        }
        if began > from {
            spells.push(SpellTimes { track, from, until: began, is_after_change, end: End::Change(*number) });
        }
        (from, is_after_change) = (from.max(ended + cooldown), true);
    }
    if seen_until > from {
        spells.push(SpellTimes { track, from, until: seen_until, is_after_change, end: End::Sight });
    }
}
