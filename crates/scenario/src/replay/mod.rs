//! A recording is played in a world: its vehicles come, move and go as they were recorded, and some of them become
//! drivers who react.
//!
//! What a driver does up to a time t depends only on what was recorded up to t: its destination is drawn from the
//! destinations of the vehicles that had gone before it became a driver, its style from the scenario, and its desired
//! speed from its speed at that moment.
//!
//! Nobody is where a recording has him once he has become a driver. A recorded vehicle in whose way he is, is handed
//! over: it goes on along its recorded path as it can, and is back at its record when it has caught up. Whom it hinders
//! in turn is handed over, too.
//!
//! A [`Player`] puts recorded vehicles on the road, moves them and takes them off, between the steps. Its state is a
//! `Playback`, which checkpoints hold. So explanations and branches take a replay like any run.

mod asked;
mod boundary;
mod conflict;
mod course;
mod desire;
mod hand_over;
mod part;
mod playback;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use laneweave_network::{LaneletIndex, Position};
use laneweave_recorded::TurningShares;
use laneweave_recordings::{Matched, Recording, clean};
use laneweave_sim::{Purpose, Random, RecordedVehicle, VehicleId, World};

use crate::fault::Fault;
use crate::recording::open_recordings;
use crate::scenario::{Origin, Scenario};
use crate::script::first_step_from;
use asked::{check_numbers, check_place, chosen};
use boundary::{Boundary, GoesOn};
use part::Part;
use playback::Presence;

pub(crate) use playback::Playback;
pub use playback::{Departures, HandOver, Start};

/// A driver whose place is taken comes at most so far behind it [m] (ours).
const BEHIND: f64 = 30.0;

/// What a driver does when the record of its vehicle ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AtItsEnd {
    /// It is taken off the road: beyond, no recorded vehicle is there that it could react to.
    Leaves,
    /// It drives on to the end of the view, and beyond it as fast as recorded vehicles left. Vehicles that are first
    /// seen in the middle of the view do not come: they may be those that were lost before.
    DrivesOn,
}

/// A recording in memory, in place of the files that a scenario names.
#[derive(Clone, Debug, PartialEq)]
pub struct Recorded {
    /// The recording.
    pub recording: Recording,
    /// Time after its first frame at which the simulation begins [s]. What was recorded before shows only where
    /// vehicles go.
    pub from_s: f64,
    /// Lane changes (from, to) that the recording shows, and that drivers may make against the map.
    pub permitted: BTreeSet<[LaneletIndex; 2]>,
    /// What drivers do when their records end.
    pub at_its_end: AtItsEnd,
}

/// A recording that is played. What is due follows from the world, and from what has been played.
#[derive(Clone)]
pub struct Player {
    /// In the order in which they come.
    parts: Arc<[Part]>,
    /// The step from which on some are drivers; none: nobody ever is.
    from_step: Option<u32>,
    shares: Arc<TurningShares>,
    random: Random,
    /// By the id of a vehicle, what its file has as an id where that is no number.
    names: Arc<BTreeMap<i64, String>>,
    /// Time from the first frame to the last [s].
    duration_s: f64,
    /// Time of the recording at which the simulation begins [s].
    from_s: f64,
    permitted: Arc<BTreeSet<[LaneletIndex; 2]>>,
    /// Where drivers come into view and leave it; none: they leave when their records end.
    boundary: Option<Arc<Boundary>>,
}

/// A recorded vehicle of a world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Played {
    /// Its id in the recording.
    pub recorded: i64,
    /// Its id in the world.
    pub vehicle: VehicleId,
    /// Whether it is to become a driver.
    pub is_reactive: bool,
    /// Whether it has left its record because somebody is in its way.
    pub is_handed_over: bool,
}

impl Player {
    /// The recording that `scenario` replays, if it does, for a `world` at its start, whose (0, 0) is at the latitude
    /// and longitude `zero` [°].
    ///
    /// # Errors
    /// If a file cannot be read, if the recording is one of another place, or if a vehicle or a number does not fit.
    pub(crate) fn of(
        scenario: &Scenario,
        origin: &Origin,
        zero: Option<(f64, f64)>,
        world: &World,
    ) -> Result<Option<Player>, Fault> {
        let replay = &scenario.replay;
        check_numbers(replay, origin)?;
        if !replay.is_asked() {
            return Ok(None);
        }
        let (mut recording, _) = open_recordings(&replay.recording, replay.columns.as_deref())?;
        recording.place(zero);
        let permitted = BTreeSet::new();
        let recorded = Recorded { recording, from_s: 0.0, permitted, at_its_end: AtItsEnd::Leaves };
        Player::of_recorded(recorded, scenario, origin, world)
    }

    /// The same of a recording in memory.
    pub(crate) fn of_recorded(
        recorded: Recorded,
        scenario: &Scenario,
        origin: &Origin,
        world: &World,
    ) -> Result<Option<Player>, Fault> {
        let (replay, dt) = (&scenario.replay, world.clock().dt);
        let Recorded { mut recording, from_s, permitted, at_its_end } = recorded;
        let Some((first, last)) = recording.frames() else { return Ok(None) };
        shift(&mut recording, first);
        let (cleaned, _) = clean(recording.clone());
        let matched = Matched::new(world.network(), &cleaned);
        check_place(&matched, scenario)?;
        let shares = TurningShares::of(&matched, world.scene().navigator).into();
        let begin = (from_s / recording.step).round() as i64;
        let boundary = (at_its_end == AtItsEnd::DrivesOn)
            .then(|| Boundary::of(&matched).beginning_at(begin as f64 * recording.step));
        shift(&mut recording, begin);
        let reactive = chosen(&recording, replay, origin)?;
        let from_step = first_step_from(replay.reactive_from_s, dt);
        let mut parts = part::parts(&recording, &reactive, dt);
        if let Some(boundary) = &boundary {
            let comes =
                |it: &Part| it.first_step == 0 || !it.is_vehicle || boundary.is_entry(it.vehicle().pose);
            parts.retain(comes);
        }
        Ok(Some(Player {
            parts: parts.into(),
            from_step: (!reactive.is_empty()).then_some(from_step),
            shares,
            random: Random::new(scenario.run.seed),
            names: recording.names.into(),
            duration_s: (last - first - begin) as f64 * recording.step,
            from_s: begin as f64 * recording.step,
            permitted: permitted.into(),
            boundary: boundary.map(Arc::new),
        }))
    }

    /// The same recording with other destinations of the drivers.
    pub fn with_seed(&self, seed: u64) -> Player {
        Player { random: Random::new(seed), ..self.clone() }
    }

    /// The same recording, in which nobody reacts.
    pub fn as_recorded(&self) -> Player {
        Player { from_step: None, ..self.clone() }
    }

    /// Time from the first frame of the recording to the last [s].
    pub fn duration_s(&self) -> f64 {
        self.duration_s
    }

    /// What the recording's file has as the id of a vehicle, where that is no number.
    pub fn name(&self, recorded: i64) -> Option<&str> {
        self.names.get(&recorded).map(String::as_str)
    }

    /// Pairs of lanelets between which its drivers may change lanes, whatever the map says.
    pub(crate) fn permitted(&self) -> &BTreeSet<[LaneletIndex; 2]> {
        &self.permitted
    }

    /// Number of its parts: a vehicle that was lost and seen again has several.
    pub(crate) fn len(&self) -> usize {
        self.parts.len()
    }

    /// The vehicles that have come so far.
    pub(crate) fn played<'a>(&'a self, playback: &'a Playback) -> impl Iterator<Item = Played> + 'a {
        self.parts.iter().zip(&playback.parts).filter_map(|(part, presence)| {
            let is_reactive = self.is_driver(part, part.last_step());
            let is_handed_over = presence.is_handed_over();
            let recorded = part.recorded;
            presence.vehicle.map(|vehicle| Played { recorded, vehicle, is_reactive, is_handed_over })
        })
    }

    /// Before a step: the vehicles go where they are at its end.
    pub(crate) fn move_on(&self, playback: &mut Playback, world: &mut World) {
        self.advance_courses(playback, world);
        let next = world.clock().step + 1;
        for (part, presence) in self.parts.iter().zip(&playback.parts) {
            let pose = match presence.course {
                Some(course) => Some(part.along(course.way, course.speed)),
                None => part.pose(next),
            };
            if let (Some(id), Some(pose)) = (presence.vehicle, pose) {
                world.move_recorded(id, pose);
            }
        }
    }

    /// At the start, and after a step: the vehicles that are no longer seen go, those that are seen for the first time
    /// come, those whose time has come become drivers, and those in whose way somebody is are handed over.
    pub(crate) fn come_and_go(&self, playback: &mut Playback, world: &mut World) {
        self.go(playback, world);
        let now = world.clock().step;
        for (number, part) in self.parts.iter().enumerate() {
            if playback.parts[number].vehicle.is_some() || now < part.first_step {
                continue;
            }
            if now <= part.last_step() {
                self.come(number, playback, world);
            } else if now == part.last_step() + 1 {
                playback.departures.never_came.push(part.recorded);
            }
        }
        let Playback { parts, departures } = playback;
        for (part, presence) in self.parts.iter().zip(parts) {
            if self.is_driver(part, now)
                && let Some(id) = presence.vehicle
            {
                self.release(part, id, presence, departures, world);
            }
        }
        self.heed(playback, world);
    }

    /// Takes the vehicles off the road whose records have ended.
    fn go(&self, playback: &mut Playback, world: &mut World) {
        let now = world.clock().step;
        let Playback { parts, departures } = playback;
        for (part, presence) in self.parts.iter().zip(parts) {
            let Some(vehicle) = presence.vehicle.and_then(|it| world.vehicle(it)) else { continue };
            let (id, is_driver) = (vehicle.id(), !vehicle.is_on_its_own_path());
            let has_ended = part.last_step() < now;
            let goes = match (presence.course, &self.boundary) {
                (Some(course), _) => has_ended && course.is_over(part.path()),
                (None, Some(boundary)) if is_driver => leaves_the_view(boundary, presence, id, world),
                (None, _) => has_ended,
            };
            if !goes {
                continue;
            }
            world.remove_recorded(id);
            if is_driver && self.boundary.is_none() {
                departures.taken_off.push(part.recorded);
            }
            if presence.course.take().is_some() {
                departures.end_hand_over(id, now);
            }
        }
    }

    /// Puts a vehicle on the road where it is first seen. If somebody is in the way who is not where the recording has
    /// him, a recorded vehicle waits for room there, and is handed over from then on; a vehicle that is to be a driver
    /// comes behind its place, or as soon as there is room.
    fn come(&self, number: usize, playback: &mut Playback, world: &mut World) {
        let (part, now) = (&self.parts[number], world.clock().step);
        let vehicle = part.vehicle();
        let is_driver = self.is_driver(part, now);
        let in_the_way = world.room_for(&vehicle, 0.0).err();
        let makes_way = |it: &VehicleId| part.is_vehicle && !playback.is_on_record(*it, world);
        let in_the_way = in_the_way.filter(|it| is_driver || makes_way(it));
        let place = match in_the_way {
            None => Ok(vehicle),
            Some(_) if is_driver => world.room_for(&vehicle, BEHIND),
            Some(other) => Err(other),
        };
        let Presence { vehicle: id, refused_for, behind_m, .. } = &mut playback.parts[number];
        *refused_for = refused_for.or(in_the_way);
        let Ok(place) = place else { return };
        // Its numbers are in their ranges.
        *id = world.put_recorded(&place).ok();
        *behind_m = apart(&vehicle, &place);
        if let (Some(because_of), Some(id), false) = (*refused_for, *id, is_driver) {
            self.come_late(number, because_of, id, playback, world);
        }
    }

    /// Whether a vehicle is a driver at a step.
    fn is_driver(&self, part: &Part, now: u32) -> bool {
        part.is_reactive && self.from_step.is_some_and(|it| it <= now)
    }

    /// Lets a vehicle become a driver, if it is not one and is in a lane.
    fn release(
        &self,
        part: &Part,
        id: VehicleId,
        presence: &mut Presence,
        departures: &mut Departures,
        world: &mut World,
    ) {
        let Some(vehicle) = world.vehicle(id).filter(|it| it.is_on_its_own_path() && it.is_in_lane()) else {
            return;
        };
        let at = Position::new(vehicle.spot.chain, vehicle.x());
        let (lanelet, _) = world.network().chain(at.chain).lanelet(at.x);
        let navigator = world.scene().navigator;
        let draw = self.random.uniform(part.subject(), Purpose::Destination, 0);
        let time = self.from_s + world.clock().time();
        let drawn = self.shares.draw(navigator, (lanelet, at), time, draw);
        let number = navigator.number(drawn);
        let destination = number.and_then(|it| world.demand().destinations.get(it)).map(|it| it.id());
        let draw = self.random.uniform(part.subject(), Purpose::Character, 0);
        let parameters = desire::parameters(&vehicle, world, draw);
        if !world.release_recorded(id, destination, parameters) {
            return;
        }
        let now = world.clock().step;
        if presence.course.take().is_some() {
            departures.end_hand_over(id, now);
        }
        let due = part.first_step.max(self.from_step.unwrap_or(0));
        let (late_steps, behind_m) = (now - due, presence.behind_m);
        if late_steps > 0 || behind_m > 0.0 {
            let because_of = presence.refused_for;
            let start = Start { recorded: part.recorded, vehicle: id, late_steps, behind_m, because_of };
            departures.starts.push(start);
        }
    }
}

/// Whether a driver is to be taken off the road, since it has left the view. Before, and for a while beyond, it is no
/// faster than vehicles were that left there.
fn leaves_the_view(boundary: &Boundary, presence: &mut Presence, id: VehicleId, world: &mut World) -> bool {
    let Some(vehicle) = world.vehicle(id) else { return false };
    match boundary.goes_on(&mut presence.leaving, &vehicle, world) {
        GoesOn::Freely => false,
        GoesOn::FreelyAgain => !world.limit_recorded(id, None),
        GoesOn::AtMost(speed, lateral) => !world.limit_recorded(id, Some((speed, lateral))),
        GoesOn::OutOfSight => true,
    }
}

/// The distance between the places of two vehicles [m].
fn apart(one: &RecordedVehicle, other: &RecordedVehicle) -> f64 {
    let [from, to] = [one.pose, other.pose];
    if from == to { 0.0 } else { (to.x - from.x).hypot(to.y - from.y) }
}

/// Makes `first` the frame 0 of a recording. What was recorded before is left out.
fn shift(recording: &mut Recording, first: i64) {
    for track in &mut recording.tracks {
        track.states.retain(|it| it.frame >= first);
        track.states.iter_mut().for_each(|it| it.frame -= first);
    }
    recording.tracks.retain(|it| !it.states.is_empty());
}
