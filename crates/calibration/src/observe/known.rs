//! What is told of drivers beside what their recording shows.

use std::collections::BTreeMap;

use laneweave_network::Side;
use laneweave_recordings::Matched;

use super::desired::DesiredSpeed;
use super::spells::{End, SpellTimes};

/// What is told of the drivers of a recording, each by the id of its vehicle. Of recorded drivers nothing is known:
/// [`Known::default`]. Of simulated drivers everything is. So it can be measured what a fit loses by each thing that a
/// recording does not show.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Known {
    /// Desired speeds, as factors on what the limit and the class allow. Those of all other drivers are estimated.
    pub desired: BTreeMap<i64, f64>,
    /// When each driver decides: the time since the last whole second of the recording [s], 0 to 1. Of all other
    /// drivers the ticks are counted from whole seconds on.
    pub turns: BTreeMap<i64, f64>,
    /// The times in which each driver could begin to want a change. They replace those that the recording shows, and
    /// the begins of desires replace those of changes, none of which is used then. `None`: they are not known.
    pub free: Option<BTreeMap<i64, Vec<FreeTime>>>,
}

/// A time in which a driver could begin to want a change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeTime {
    /// When it begins [s].
    pub from: f64,
    /// When it ends [s]: with a desire, or with the last sight of the driver.
    pub until: f64,
    /// The side to which the driver wants to change from then on.
    pub wanted: Option<Side>,
}

impl Known {
    /// The desired speeds of the drivers of all tracks: as they are told, or else as they were `estimated`.
    pub(super) fn desired_speeds(
        &self,
        matched: &Matched,
        estimated: Vec<DesiredSpeed>,
    ) -> Vec<DesiredSpeed> {
        let tracks = matched.recording.tracks.iter().zip(estimated);
        let told = |factor: &f64| DesiredSpeed { nodes: vec![(*factor, 1.0)], is_shown: true };
        tracks.map(|(track, estimated)| self.desired.get(&track.id).map_or(estimated, told)).collect()
    }

    /// When the driver of a vehicle decides: the time since the last whole second [s].
    pub(super) fn turn(&self, vehicle: i64) -> f64 {
        self.turns.get(&vehicle).copied().unwrap_or(0.0)
    }
}

/// The spells of all drivers whose `free` times are known, those of a vehicle one after the other.
pub(super) fn known_spells(matched: &Matched, free: &BTreeMap<i64, Vec<FreeTime>>) -> Vec<SpellTimes> {
    let mut tracks: Vec<(i64, usize)> = matched.recording.tracks.iter().map(|it| it.id).zip(0..).collect();
    tracks.sort_unstable();
    let of_track = |(vehicle, track): (i64, usize)| {
        free.get(&vehicle).into_iter().flatten().map(move |time| SpellTimes {
            track,
            from: time.from,
            until: time.until,
            is_after_change: false,
            end: time.wanted.map_or(End::Sight, End::Desire),
        })
    };
    tracks.into_iter().flat_map(of_track).collect()
}
