//! The external vehicles: those that a user drives.

use laneweave_network::{Pose, Position, Rectangle};
use serde::{Deserialize, Serialize};

use crate::state::control::Control;
use crate::state::lane::{Entry, Phase, VehicleId};

/// The first id of the vehicles that users put on the road. So vehicles of the demand have the same ids, and with them
/// the same random numbers, whatever users do.
pub const FIRST_INSERTED: VehicleId = 1_000_000_000;
/// The first id of obstacles: they are numbered apart from vehicles.
pub const FIRST_OBSTACLE: VehicleId = 3_000_000_000;

/// The external vehicles, in the order of their ids, and what others see of accidents.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Externals {
    vehicles: Vec<External>,
    /// The obstacles that show where vehicles which lie within others reach back to.
    rears: Vec<(VehicleId, Position)>,
}

/// What an external vehicle is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Kind {
    /// A vehicle that a user drives.
    Driven,
    /// A recorded vehicle: its speed is known better than its place.
    Recorded,
    /// No vehicle, but something that stands on the road.
    Obstacle,
    /// A vehicle of a line. Its driver drives it, except that it serves stops.
    Line(Service),
}

impl Kind {
    /// Whether its own driver drives it: that of a line, between stops.
    pub(crate) fn is_left_to_its_driver(self) -> bool {
        matches!(self, Kind::Line(Service { rests_until: None, .. }))
    }
}

/// How far a vehicle of a line is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Service {
    /// Number of its line.
    pub(crate) line: u16,
    /// Stops that it has behind it.
    pub(crate) stops: u16,
    /// The step up to which it rests at the next one.
    pub(crate) rests_until: Option<u32>,
}

/// A vehicle that a user drives, or something that is moved or stands as one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct External {
    /// The vehicle.
    pub(crate) id: VehicleId,
    /// How the user drives it.
    pub(crate) control: Control,
    /// Position of its main entry. Off the road, the last one.
    pub(crate) at: Position,
    /// The phase of its lane change.
    pub(crate) phase: Phase,
    /// Its entries in other lanes that it touches.
    pub(crate) obstacles: Vec<Position>,
    /// What it is.
    pub(crate) kind: Kind,
    /// Its body, if the user drives it by poses.
    pub(crate) body: Option<Body>,
    /// Steps in which it stood although its driver would have gone.
    pub(crate) idle: u32,
    /// The step since which it stands in a lane so that drivers can go round it.
    pub(crate) passable_since: Option<u32>,
}

/// The body of a vehicle that a user drives by poses.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Body {
    /// The pose of its centre.
    pub(crate) pose: Pose,
    /// Length [m].
    pub(crate) length: f64,
    /// Width [m].
    pub(crate) width: f64,
    /// Speed that others see [m/s].
    pub(crate) speed: f64,
    /// Its main entry, if it is off the road, where it is in no lane.
    pub(crate) off_road: Option<Entry>,
}

impl Body {
    /// The ground that it covers.
    pub(crate) fn rectangle(&self) -> Rectangle {
        Rectangle { pose: self.pose, length: self.length, width: self.width }
    }
}

impl External {
    /// The vehicle `id`, which a user begins to drive, with its main entry at this position.
    pub(crate) fn new(id: VehicleId, control: Control, at: Position) -> External {
        External {
            id,
            control,
            at,
            phase: Phase::Cruises,
            obstacles: Vec::new(),
            kind: Kind::Driven,
            body: None,
            idle: 0,
            passable_since: None,
        }
    }

    /// Its main entry, if it is off the road.
    pub(crate) fn off_road(&self) -> Option<&Entry> {
        self.body.as_ref().and_then(|it| it.off_road.as_ref())
    }

    /// Counts the steps in which it is idle, up to `longest`. Once there are so many, they count until it moves.
    pub(crate) fn count_idle(&mut self, is_idle: bool, moves: bool, longest: u32) {
        self.idle = match self.idle {
            _ if moves => 0,
            count if count >= longest => count,
            count if is_idle => count + 1,
            _ => 0,
        };
    }

    /// The same, mutable.
    pub(crate) fn off_road_mut(&mut self) -> Option<&mut Entry> {
        self.body.as_mut().and_then(|it| it.off_road.as_mut())
    }
}

impl Externals {
    /// Whether there are none, and no traces of any.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.vehicles.is_empty() && self.rears.is_empty()
    }

    /// The obstacles that show where vehicles which lie within others reach back to.
    pub(crate) fn rears(&self) -> &[(VehicleId, Position)] {
        &self.rears
    }

    /// Adds such an obstacle.
    pub(crate) fn note_rear(&mut self, id: VehicleId, at: Position) {
        self.rears.push((id, at));
    }

    /// Takes all such obstacles out.
    pub(crate) fn take_rears(&mut self) -> Vec<(VehicleId, Position)> {
        std::mem::take(&mut self.rears)
    }

    /// All of them.
    #[inline]
    pub(crate) fn all(&self) -> &[External] {
        &self.vehicles
    }

    /// All of them, mutable.
    pub(crate) fn all_mut(&mut self) -> &mut [External] {
        &mut self.vehicles
    }

    /// The external vehicle with this id.
    pub(crate) fn of(&self, id: VehicleId) -> Option<&External> {
        self.vehicles.binary_search_by_key(&id, |it| it.id).ok().map(|it| &self.vehicles[it])
    }

    /// The same, mutable.
    pub(crate) fn of_mut(&mut self, id: VehicleId) -> Option<&mut External> {
        self.vehicles.binary_search_by_key(&id, |it| it.id).ok().map(|it| &mut self.vehicles[it])
    }

    /// The body of a vehicle that a user drives by poses.
    pub(crate) fn body(&self, id: VehicleId) -> Option<&Body> {
        self.of(id)?.body.as_ref()
    }

    /// Number of vehicles off the road.
    pub(crate) fn off_road(&self) -> usize {
        self.vehicles.iter().filter(|it| it.off_road().is_some()).count()
    }

    /// Whether they are in order, have valid numbers, and are on chains of a network with this many. Main entries off
    /// the road have to `fit`.
    pub(crate) fn fit(&self, chains: usize, fit: impl Fn(&Entry) -> bool) -> bool {
        let is_place = |it: &Position| it.chain.at() < chains && it.x.is_finite();
        let is_number = |it: &Entry| it.motion.x.is_finite() && it.motion.speed.is_finite();
        let body_fits = |it: &Body| {
            let Pose { at, heading } = it.pose;
            [at.x, at.y, at.z, heading, it.speed, it.length, it.width].iter().all(|it| it.is_finite())
        };
        let is_sound = |it: &External| {
            it.control.is_sound()
                && is_place(&it.at)
                && it.obstacles.iter().all(is_place)
                && it.body.as_ref().is_none_or(body_fits)
                && it
                    .off_road()
                    .is_none_or(|entry| entry.motion.id == it.id && is_number(entry) && fit(entry))
        };
        self.vehicles.iter().all(is_sound)
            && self.rears.iter().all(|(_, at)| is_place(at))
            && self.vehicles.is_sorted_by(|a, b| a.id < b.id)
    }

    /// Adds a vehicle that a user begins to drive.
    pub(crate) fn add(&mut self, external: External) {
        match self.vehicles.binary_search_by_key(&external.id, |it| it.id) {
            Ok(place) => self.vehicles[place] = external,
            Err(place) => self.vehicles.insert(place, external),
        }
    }

    /// Takes a vehicle out.
    pub(crate) fn take(&mut self, id: VehicleId) -> Option<External> {
        let place = self.vehicles.binary_search_by_key(&id, |it| it.id).ok()?;
        Some(self.vehicles.remove(place))
    }

    /// Keeps the vehicles that `follow` finds.
    pub(crate) fn retain(&mut self, follow: impl FnMut(&mut External) -> bool) {
        self.vehicles.retain_mut(follow);
    }
}
