//! Plans: what drivers decide in a step, recorded on the snapshot and carried out afterwards.

use laneweave_models::change::Appraisal;
use laneweave_network::{ChainIndex, Position, Side, ZoneIndex};
use serde::{Deserialize, Serialize};

use crate::junction::need::Survey;
use crate::junction::storage_section::StorageSection;
use crate::junction::waiting_priority::WaitingPriority;
use crate::junction::waiting_priority::WaitingTurn;
use crate::record::counters::Counters;
use crate::record::events::{DrivingEvent, DrivingEventKind};
use crate::record::incidents::Incident;
use crate::state::clock::Clock;
use crate::state::control::{Lateral, Longitudinal};
use crate::state::goal::Destination;
use crate::state::lane::{Entry, Kinematics, LaneChangeKind, VehicleId};
use crate::state::milestone::Milestone;
use crate::view::scene::{Scene, Spot};

/// The decisions of one lane's drivers. It is reused from step to step, so that nothing is allocated anew. It has
/// cache lines of its own, so that threads do not disturb each other, and few of them: towns have thousands of lanes.
/// Cache lines are fetched in pairs, so it begins with a pair.
#[derive(Debug, Default)]
#[repr(align(128))]
pub(crate) struct Plan {
    /// The kinematics of each entry at the end of the step.
    pub(crate) next: Vec<Kinematics>,
    /// Entries with more to update than their kinematics.
    pub(crate) upkeep: Vec<Upkeep>,
    /// Notes of drivers who considered lanes.
    pub(crate) notes: Vec<Note>,
    /// Additional notes of some of them.
    pub(crate) concerns: Vec<Concern>,
    /// Drivers who wait for a reservation, in this step and in the one before.
    pub(crate) waiting: Vec<Waiting>,
    pub(crate) waited: Vec<Waiting>,
    /// The entries of external vehicles, with what their users say.
    pub(crate) controls: Vec<Controlled>,
    /// Distance driven by its vehicles [m]: the only counter that depends on the order of addition.
    pub(crate) distance: f64,
}

const _: () = assert!(size_of::<Plan>() <= 256, "four cache lines");

impl Plan {
    /// Clears what belongs to the last step.
    pub(crate) fn clear(&mut self) {
        self.next.clear();
        self.upkeep.clear();
        self.notes.clear();
        self.concerns.clear();
        std::mem::swap(&mut self.waiting, &mut self.waited);
        self.waiting.clear();
    }
}

/// What concerns more than one lane, collected by one thread from the lanes that it happens to move. The order must
/// not matter.
#[derive(Debug, Default)]
#[repr(align(128))]
pub(crate) struct Outbox {
    /// Requests of drivers.
    pub(crate) requests: Vec<Request>,
    /// Milestones of lane changes.
    pub(crate) milestones: Vec<Milestone>,
    /// Entries that passed the ends of their chains.
    pub(crate) leaving: Vec<(ChainIndex, Entry)>,
    /// Distances driven by vehicles with a reservation.
    pub(crate) progress: Vec<Progress>,
    /// Requests of drivers at junctions.
    pub(crate) reservation_requests: Vec<ReservationRequest>,
    /// Drivers who stand because they have no storage space beyond a junction.
    pub(crate) blocked: Vec<ReservationRequest>,
    /// Turns of drivers who wait for a side of a zone because of others.
    pub(crate) priorities: Vec<(ZoneIndex, u8, WaitingTurn)>,
    /// Space requests of drivers out of patience: the storage section, and the space that they need there [m].
    pub(crate) space_requests: Vec<(StorageSection, WaitingPriority, f64)>,
    /// Drivers out of patience who wait to enter a roundabout, each from one chain to another.
    pub(crate) roundabouts: Vec<([ChainIndex; 2], WaitingPriority)>,
    /// Buffers for the thread's work on one driver or on one lane: a survey; drivers whose reservations are revoked,
    /// and from where on; entries whose trips ended.
    pub(crate) survey: Survey,
    pub(crate) returns: Vec<(u32, f64)>,
    pub(crate) ended: Vec<u32>,
    /// Counters since they were last reset, without distances.
    pub(crate) counters: Counters,
    /// Driving events of vehicles.
    pub(crate) driving: Vec<DrivingEvent>,
    /// External vehicles that stand although their drivers would go.
    pub(crate) idle: Vec<VehicleId>,
    /// Main entries whose trips ended on their chains.
    pub(crate) arrived: Vec<(ChainIndex, Entry)>,
    /// Vehicles that touch each other.
    pub(crate) incidents: Vec<Incident>,
    /// Lanes without vehicles at the time of the move.
    pub(crate) empty: Vec<ChainIndex>,
}

impl Outbox {
    /// Notes a driving event of the vehicle at `spot`.
    pub(crate) fn note(&mut self, scene: &Scene, clock: Clock, spot: Spot, kind: DrivingEventKind) {
        match kind {
            DrivingEventKind::EmergencyBraking => self.counters.emergency_brakings += 1,
            DrivingEventKind::HardBraking(_) => self.counters.hard_brakings += 1,
            DrivingEventKind::MissedTurn => self.counters.missed_turns += 1,
            DrivingEventKind::RouteChange => self.counters.route_changes += 1,
            DrivingEventKind::Halt | DrivingEventKind::SetOff { .. } => {}
        }
        let (motion, time) = (scene.motion(spot), clock.time());
        let event = DrivingEvent { kind, vehicle: motion.id, time, at: Position::new(spot.chain, motion.x) };
        self.driving.push(event);
    }

    /// Takes all of `other`.
    pub(crate) fn gather(&mut self, other: &mut Outbox) {
        take_over(&mut self.requests, &mut other.requests);
        take_over(&mut self.milestones, &mut other.milestones);
        take_over(&mut self.leaving, &mut other.leaving);
        take_over(&mut self.progress, &mut other.progress);
        take_over(&mut self.reservation_requests, &mut other.reservation_requests);
        take_over(&mut self.priorities, &mut other.priorities);
        take_over(&mut self.blocked, &mut other.blocked);
        take_over(&mut self.space_requests, &mut other.space_requests);
        take_over(&mut self.roundabouts, &mut other.roundabouts);
        take_over(&mut self.driving, &mut other.driving);
        take_over(&mut self.idle, &mut other.idle);
        take_over(&mut self.arrived, &mut other.arrived);
        take_over(&mut self.incidents, &mut other.incidents);
        take_over(&mut self.empty, &mut other.empty);
    }
}

/// Appends `other`. Writes to it only if it is not empty, so that it stays in the cache of its own thread.
fn take_over<T>(list: &mut Vec<T>, other: &mut Vec<T>) {
    if !other.is_empty() {
        list.append(other);
    }
}

/// The update of an entry that does not only follow its leader.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Upkeep {
    /// The entry.
    pub(crate) index: u32,
    /// Distance driven [m].
    pub(crate) distance: f64,
    /// Kinematics decided in the present braking.
    pub(crate) in_emergency: bool,
    /// The reservation that it had has ended.
    pub(crate) reservation_is_over: bool,
    /// The share of its lane change that it has to do on each metre, since little road is left; 0 if there is enough.
    pub(crate) per_metre: f32,
}

/// An entry of an external vehicle, and what its user says in this step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Controlled {
    /// The entry.
    pub(crate) index: u32,
    /// What the user says.
    pub(crate) told: Told,
    /// Its user has held it for some time although its driver would go: it yields its turn.
    pub(crate) gives_way: bool,
}

/// What the user of an external vehicle says.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Told {
    /// Drive in lanes, so fast and with these lane changes.
    Drive(Longitudinal, Lateral),
    /// The entry stays where it is: the user moves the vehicle after all others have moved.
    Stay,
}

/// A driver who waits for a reservation.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct Waiting {
    /// Its entry.
    pub(crate) index: u32,
    /// Its vehicle.
    pub(crate) id: VehicleId,
    /// Step of its first request.
    pub(crate) since: u32,
    /// It waits at a light that is next on its route.
    pub(crate) is_held: bool,
}

/// How far a vehicle with a reservation drove.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Progress {
    /// The slot of the reservation.
    pub(crate) slot: u32,
    /// Its vehicle.
    pub(crate) id: VehicleId,
    /// Distance driven [m].
    pub(crate) distance: f64,
    /// Speed now [m/s].
    pub(crate) speed: f64,
    /// Desired speed [m/s].
    pub(crate) desired: f64,
}

/// A driver's request at a junction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ReservationRequest {
    /// Step of its first request; the earliest comes first.
    pub(crate) since: u32,
    /// The vehicle.
    pub(crate) id: VehicleId,
    pub(crate) chain: ChainIndex,
    /// Its position on the snapshot [m].
    pub(crate) x: f64,
    /// The kind of request.
    pub(crate) what: RequestKind,
}

/// The kinds of requests at a junction.
#[derive(Clone, Copy, Debug)]
pub(crate) enum RequestKind {
    /// To pass.
    Pass,
    /// To revoke the reservation from this distance from its start on [m].
    Revoke(f64),
}

/// What every driver stores after it considered lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Note {
    /// Its entry.
    pub(crate) index: u32,
    /// Step in which it considers lanes next.
    pub(crate) due: u32,
    /// Desired speed at the current limit [m/s].
    pub(crate) limit_desired: f32,
    /// Time at standstill [s].
    pub(crate) standing: f32,
}

/// What a driver stores in addition if it has to leave its lane soon, reacts to more than its leader, or wants to
/// change.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Concern {
    /// Its entry.
    pub(crate) index: u32,
    /// The place by which it has to have left a wrong lane [m]; infinite if it has not, or if that is far.
    pub(crate) last_place: f64,
    /// How much it is pressed to make the change that it wants, 0…1.
    pub(crate) urgency: f32,
    /// It no longer wants to change.
    pub(crate) gives_up: bool,
    /// It may have to stay behind slower drivers in the lane for overtaking.
    pub(crate) minds_offside: bool,
    /// Its new destination or route, if it has one.
    pub(crate) rerouted: Option<Destination>,
}

/// A request that concerns another lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Request {
    /// Urgency, 0…1; the most urgent request goes first.
    pub(crate) urgency: f32,
    /// The vehicle.
    pub(crate) id: VehicleId,
    pub(crate) chain: ChainIndex,
    /// Its position on the snapshot [m].
    pub(crate) x: f64,
    /// What is requested.
    pub(crate) ask: Ask,
}

/// The kinds of requests.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Ask {
    /// To wait for a gap.
    Want(Want),
    /// To change now.
    Change,
    /// To be let in by a follower, who is seen at `x` of `chain`.
    LetIn { follower: VehicleId, chain: ChainIndex, x: f64, gap: f32, speed: f32 },
    /// To abort the change.
    Abort,
}

/// A desire to change.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Want {
    pub(crate) side: Side,
    /// The kind of change.
    pub(crate) kind: LaneChangeKind,
    /// The driver's appraisal of the change.
    pub(crate) appraisal: Appraisal,
    /// Gain of anticipated speed [m/s].
    pub(crate) speed_gain: f32,
}
