//! The lane changes of a recording, and why some of them cannot be used in a fit.

use laneweave_network::{LaneletIndex, Side};
use laneweave_recordings::{Extent, LaneChange, Matched, RecordedChangeKind};

use super::spells::{End, SpellTimes};

/// A recorded lane change.
#[derive(Clone, Debug, PartialEq)]
pub struct ObservedChange {
    /// Id of its vehicle.
    pub vehicle: i64,
    /// When its centre crossed the line [s].
    pub time: f64,
    /// The side.
    pub side: Side,
    /// Why it was made, as far as the later path shows.
    pub kind: RecordedChangeKind,
    /// The lanelets that it left and entered.
    pub lanelets: [LaneletIndex; 2],
    /// When it began [s].
    pub began: f64,
    /// Its duration, if all of it was seen [s].
    pub duration: Option<f64>,
    /// Time after which the vehicle came back, if within 30 s [s].
    pub returned_after: Option<f64>,
    /// It was seen for long enough that a return would have been seen.
    pub shows_return: bool,
    /// Why it is not used.
    pub unused: Option<Unused>,
}

/// Why a lane change is not used in a fit of decisions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Unused {
    /// It had begun before its vehicle was first seen.
    BegunBefore,
    /// Its driver was seen for less than a second in which it could decide.
    SeenTooBriefly,
    /// It began in the cooldown after another one.
    InCooldown,
    /// The map does not permit it there.
    NotPermitted,
}

impl Unused {
    /// All reasons.
    pub const ALL: [Unused; 4] =
        [Unused::BegunBefore, Unused::SeenTooBriefly, Unused::InCooldown, Unused::NotPermitted];

    /// Its name in results.
    pub fn name(self) -> &'static str {
        match self {
            Unused::BegunBefore => "begun_before_seen",
            Unused::SeenTooBriefly => "seen_too_briefly",
            Unused::InCooldown => "in_cooldown",
            Unused::NotPermitted => "not_permitted",
        }
    }
}

/// A change that begins or ends this near to the first or last sight of its vehicle was cut off there [s].
pub(super) const EDGE: f64 = 0.2;
/// A vehicle that is seen for less than this after a change does not show whether it would have come back [s].
const RETURN: f64 = 30.0;

impl ObservedChange {
    /// A change with its begin and end as they are used, and as its path shows them.
    pub(super) fn of(matched: &Matched, change: &LaneChange, [extent, shown]: [Extent; 2]) -> ObservedChange {
        let states = &matched.recording.tracks[change.track].states;
        let time = |frame: Option<i64>| frame.map(|it| it as f64 * matched.recording.step);
        let first = time(states.first().map(|it| it.frame)).unwrap_or(f64::INFINITY);
        let last = time(states.last().map(|it| it.frame)).unwrap_or(f64::NEG_INFINITY);
        let begun_before = extent.began < first + EDGE;
        let is_whole = shown.began >= first + EDGE && shown.ended <= last - EDGE;
        ObservedChange {
            vehicle: change.vehicle,
            time: change.time,
            side: change.side,
            kind: change.kind,
            lanelets: [change.from, change.to],
            began: extent.began,
            duration: is_whole.then_some(shown.ended - shown.began),
            returned_after: change.returned_after,
            shows_return: change.seen_after >= RETURN || change.returned_after.is_some(),
            unused: begun_before.then_some(Unused::BegunBefore),
        }
    }
}

/// Marks the changes that end no spell, or one that is too short.
pub(super) fn mark_unused(changes: &mut [ObservedChange], times: &[SpellTimes]) {
    /// A driver decides once in this time [s].
    const DECIDES_WITHIN: f64 = 1.0;
    let mut length = vec![None; changes.len()];
    for spell in times {
        if let End::Change(change) = spell.end {
            length[change] = Some((spell.until - spell.from, spell.is_after_change));
        }
    }
    for (change, length) in changes.iter_mut().zip(length) {
        if change.unused.is_some() {
            continue;
        }
        change.unused = match length {
            None => Some(Unused::InCooldown),
            Some((length, _)) if length >= DECIDES_WITHIN => None,
            Some((_, true)) => Some(Unused::InCooldown),
            Some((_, false)) => Some(Unused::SeenTooBriefly),
        };
    }
}
