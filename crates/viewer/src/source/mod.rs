//! Where the traffic comes from: a simulation that runs now, a run that is driven again, or a recording.

mod driven;
mod driver;
mod ghosts;
mod hands;
mod lanes;
mod live;
mod marks;
mod pair;
mod recorded;
mod rerun;
mod saved;
mod shown;
mod styles;
mod turns;

use std::sync::{Arc, Mutex};

use laneweave::{Fault, VehicleId};
use serde::Serialize;

pub use hands::{Done, DriveSide, Hand, Hands};
pub use live::Live;
pub use recorded::Recorded;
pub use rerun::Rerun;
pub use saved::Saved;
pub use shown::Shown;
pub use styles::StyleFacts;

use crate::scene::Scene;
use crate::snapshot::Snapshot;

/// The kind of a source.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// A simulation that runs now.
    Live,
    /// A run that has ended, and is driven again.
    Run,
    /// A recording.
    Recording,
}

/// What a page is told first.
#[derive(Clone, Debug, Serialize)]
pub struct Hello {
    /// The version of the protocol.
    pub version: u32,
    /// The kind of the source.
    pub kind: Kind,
    /// Its name.
    pub title: String,
    /// Time between two instants [s].
    pub step_s: f64,
    /// The present time [s].
    pub time_s: f64,
    /// The first time [s].
    pub begin_s: f64,
    /// The last time, if there is one [s].
    pub end_s: Option<f64>,
    /// What can be done.
    pub can: Abilities,
    /// The styles of its drivers.
    pub styles: Vec<StyleFacts>,
    /// The demand of each entrance.
    pub demand: Vec<DemandFacts>,
}

/// What can be done with a source.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Abilities {
    /// A user can change it.
    pub hands: bool,
    /// Any of its times can be shown.
    pub seek: bool,
    /// Its drivers can be explained.
    pub explain: bool,
    /// A twin can be shown beside it.
    pub twin: bool,
}

/// The twin that is shown beside the traffic.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TwinFacts {
    /// The time from which on the two may differ [s].
    pub since_s: f64,
    /// What the twin has that the traffic has not, as it was given; nothing where only the traffic is changed, by hand.
    pub settings: Vec<String>,
}

/// The demand of an entrance.
#[derive(Clone, Debug, Serialize)]
pub struct DemandFacts {
    /// Its id.
    pub origin: String,
    /// Vehicles that arrive per hour.
    pub vehicles_per_hour: f64,
}

/// Something that happened, with its place.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mark {
    /// What happened.
    pub kind: MarkKind,
    /// When [s].
    pub time_s: f64,
    /// Where, to the east [m].
    pub x: f64,
    /// Where, to the north [m].
    pub y: f64,
    /// Which vehicle, by its id.
    pub vehicle: String,
    /// The other vehicle of a collision.
    pub other: Option<String>,
    /// The side of a lane change.
    pub side: Option<&'static str>,
    /// More about it: the kind of a lane change.
    pub text: Option<&'static str>,
}

/// What happened.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum MarkKind {
    /// A vehicle changed lanes.
    LaneChange,
    /// Two vehicles touched each other.
    Collision,
    /// A vehicle began to brake as hard as kinematics demanded.
    EmergencyBraking,
    /// A driver missed a turn.
    MissedTurn,
}

/// All marks of a source that has an end, up to the time for which they are known.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Marks {
    /// Up to here they are known [s].
    pub until_s: f64,
    /// In the order of their times.
    pub marks: Vec<Mark>,
}

/// What somebody wants to see beside the vehicles.
#[derive(Clone, Debug, Default)]
pub struct Wants {
    /// What drivers make of their lanes.
    pub desire: bool,
    /// What the lanes carry.
    pub lanes: bool,
    /// The vehicles that somebody has selected.
    pub selected: Vec<i64>,
}

/// Traffic that can be shown.
pub trait Source: Send {
    /// What stands still.
    fn scene(&self) -> Scene;

    /// What a page is told first.
    fn hello(&self) -> Hello;

    /// Time between two instants [s].
    fn step_s(&self) -> f64;

    /// The present time [s].
    fn time_s(&self) -> f64;

    /// Goes on to the next instant, and adds what happened up to there. At its end it stays.
    ///
    /// # Errors
    /// If something that was done by hand was not possible. Time has gone on.
    fn step(&mut self, marks: &mut Vec<Mark>) -> Result<(), Fault>;

    /// Whether there is no next instant.
    fn has_ended(&self) -> bool;

    /// Goes to a time [s], or as near as it can.
    ///
    /// # Errors
    /// If it cannot.
    fn seek(&mut self, time_s: f64) -> Result<(), Fault>;

    /// Adds what can be seen now to a snapshot.
    fn see(&self, wants: &Wants, snapshot: &mut Snapshot);

    /// Where a vehicle is on the map, if it is there [m].
    fn find(&self, id: i64) -> Option<[f64; 2]>;

    /// The marks of its whole time, which another thread may still be looking for.
    fn marks(&self) -> Option<Arc<Mutex<Marks>>>;

    /// Does something by hand. Returns the vehicle that it put on the road.
    ///
    /// # Errors
    /// If it is not possible.
    fn hand(&mut self, hand: &Hand) -> Result<Option<VehicleId>, Fault>;

    /// Whether something that was done by hand waits for the next step.
    fn waits(&self) -> bool {
        false
    }

    /// Takes back the last thing done by hand that can be taken back and is not yet.
    ///
    /// # Errors
    /// If there is none.
    fn undo(&mut self) -> Result<(), Fault>;

    /// Begins, or ends, to show the twin of the traffic, as ghosts: of a simulation that runs now the same traffic
    /// without what is done by hand from now on, of a run the one with other settings.
    ///
    /// # Errors
    /// If there can be none.
    fn twin(&mut self, is_wanted: bool) -> Result<(), Fault>;

    /// The twin that is shown, if one is.
    fn twin_facts(&self) -> Option<TwinFacts>;

    /// What was done by hand so far, and what is set by it.
    fn hands(&self) -> Hands;

    /// What of this is new or has changed since the last call, if anything has.
    fn news_of_hands(&mut self) -> Option<Hands>;

    /// Writes the scenario with all that was done by hand.
    ///
    /// # Errors
    /// If a file cannot be written.
    fn save(&self) -> Result<Saved, Fault>;

    /// Hash of all vehicles.
    fn state_hash(&self) -> u64;
}
