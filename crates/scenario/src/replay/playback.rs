//! How far a recording has been played in a world: the state of a replay. Checkpoints hold it.

use laneweave_sim::{VehicleId, World};
use serde::{Deserialize, Serialize};

use super::boundary::Leaving;
use super::course::Course;

/// What has been played so far.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Playback {
    /// Each part of the recording.
    pub(super) parts: Vec<Presence>,
    /// What happened otherwise than recorded.
    pub(crate) departures: Departures,
}

/// A part of the recording in a world.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Presence {
    /// The id of its vehicle, once that has come.
    pub(super) vehicle: Option<VehicleId>,
    /// Where the vehicle is on its path, while somebody is in its way, and until it is back at its record.
    pub(super) course: Option<Course>,
    /// Where it leaves the view as a driver.
    pub(super) leaving: Option<Leaving>,
    /// Who was in the way when a driver was to come.
    pub(super) refused_for: Option<VehicleId>,
    /// How far behind its place the driver came [m].
    pub(super) behind_m: f64,
}

/// What happened otherwise than recorded.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Departures {
    /// Hand-overs, in the order of their beginnings.
    pub hand_overs: Vec<HandOver>,
    /// Drivers who did not begin where and when their vehicles were first seen, or were to become drivers.
    pub starts: Vec<Start>,
    /// Drivers who were taken off the road when their records ended.
    pub taken_off: Vec<i64>,
    /// Vehicles for which there was no room before their records ended.
    pub never_came: Vec<i64>,
}

/// A recorded vehicle left its record, since somebody was in the way who is not where the recording had him.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HandOver {
    /// The id in the recording.
    pub recorded: i64,
    /// The id in the world.
    pub vehicle: VehicleId,
    /// Who was in the way.
    pub because_of: VehicleId,
    /// The step in which it left its record.
    pub from_step: u32,
    /// The step in which it was back at its record, or left the road; none: it has not been yet.
    pub until_step: Option<u32>,
    /// Where it was: east and north [m].
    pub at: [f64; 2],
}

/// A driver began otherwise than its record.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Start {
    /// The id in the recording.
    pub recorded: i64,
    /// The id in the world.
    pub vehicle: VehicleId,
    /// So many steps late.
    pub late_steps: u32,
    /// So far behind its place [m].
    pub behind_m: f64,
    /// The vehicle that was in the way; none: it was in no lane that leads on.
    pub because_of: Option<VehicleId>,
}

impl Playback {
    /// That of so many parts, none of which has come.
    pub(crate) fn of(parts: usize) -> Playback {
        Playback { parts: vec![Presence::default(); parts], ..Playback::default() }
    }

    /// Whether a vehicle is where the recording has it.
    pub(super) fn is_on_record(&self, id: VehicleId, world: &World) -> bool {
        let part = self.parts.iter().find(|it| it.vehicle == Some(id));
        let is_on_its_path = || world.vehicle(id).is_some_and(|it| it.is_on_its_own_path());
        part.is_some_and(|it| !it.is_handed_over()) && is_on_its_path()
    }

    /// Number of parts.
    pub(crate) fn len(&self) -> usize {
        self.parts.len()
    }
}

impl Presence {
    /// Whether the vehicle has left its record.
    pub(super) fn is_handed_over(&self) -> bool {
        self.course.is_some_and(|it| it.heeds.is_none())
    }
}

impl Departures {
    /// The last hand-over of a vehicle ends in this step.
    pub(super) fn end_hand_over(&mut self, vehicle: VehicleId, step: u32) {
        let last = self.hand_overs.iter_mut().rev().find(|it| it.vehicle == vehicle);
        last.into_iter().filter(|it| it.until_step.is_none()).for_each(|it| it.until_step = Some(step));
    }
}
