//! What drivers resolve to do in a step, written down on the snapshot and carried out afterwards.

use laneweave_models::change::Appraisal;
use laneweave_network::{ChainIndex, Position, Side, ZoneIndex};
use serde::{Deserialize, Serialize};

use crate::junction::need::Survey;
use crate::junction::storage_section::StorageSection;
use crate::junction::waiting::Turn;
use crate::junction::waiting::WaitingPriority;
use crate::record::counters::Counters;
use crate::record::events::{DrivingEvent, DrivingEventKind};
use crate::record::incidents::Incident;
use crate::state::clock::Clock;
use crate::state::goal::Destination;
use crate::state::lane::{Entry, Kind, Kinematics, Milestone, VehicleId};
use crate::view::scene::{Scene, Spot};

/// The resolutions of one lane's drivers. Kept from step to step, so that nothing is allocated anew; on cache lines of
/// its own, so that threads do not disturb each other, and on few of them: towns have thousands of lanes. Lines are
/// fetched in pairs, so it begins with a pair.
#[derive(Debug, Default)]
#[repr(align(128))]
pub(crate) struct Plan {
    /// How each entry moves at the end of the step.
    pub(crate) next: Vec<Kinematics>,
    /// Entries about which there is more to keep than how they move.
    pub(crate) upkeep: Vec<Upkeep>,
    /// What drivers who considered lanes keep in mind.
    pub(crate) notes: Vec<Note>,
    /// What some of them keep in mind beside.
    pub(crate) concerns: Vec<Concern>,
    /// Drivers who wait for their reservation, now and in the step before.
    pub(crate) waiting: Vec<Waiting>,
    pub(crate) waited: Vec<Waiting>,
    /// Distance that its vehicles have driven [m]: the only count that depends on the order in which it is added up.
    pub(crate) distance: f64,
}

const _: () = assert!(size_of::<Plan>() <= 256, "four cache lines");

impl Plan {
    /// Forgets the last step.
    pub(crate) fn clear(&mut self) {
        self.next.clear();
        self.upkeep.clear();
        self.notes.clear();
        self.concerns.clear();
        std::mem::swap(&mut self.waiting, &mut self.waited);
        self.waiting.clear();
    }
}

/// What concerns more than one lane, as one thread gathers it from the lanes that it happens to move: in no order that
/// may matter.
#[derive(Debug, Default)]
#[repr(align(128))]
pub(crate) struct Outbox {
    /// What drivers ask for.
    pub(crate) requests: Vec<Request>,
    /// What happened to lane changes.
    pub(crate) milestones: Vec<Milestone>,
    /// Entries that passed the ends of their chains.
    pub(crate) leaving: Vec<(ChainIndex, Entry)>,
    /// How far the vehicles with a reservation drove.
    pub(crate) progress: Vec<Progress>,
    /// What drivers ask for at junctions.
    pub(crate) reservation_requests: Vec<ReservationRequest>,
    /// Drivers who stand because there is no room for them beyond a junction.
    pub(crate) blocked: Vec<ReservationRequest>,
    /// Turns of those who wait for a side of a zone because of others.
    pub(crate) priorities: Vec<(ZoneIndex, u8, Turn)>,
    /// Drivers out of patience who wait for so much room on a storage section [m].
    pub(crate) space_requests: Vec<(StorageSection, WaitingPriority, f64)>,
    /// Drivers out of patience who wait for a ring to take them in, each between two chains.
    pub(crate) roundabouts: Vec<([ChainIndex; 2], WaitingPriority)>,
    /// Room for the thread's work on one driver, and on one lane: drivers who have a reservation revoked, and from
    /// where on; entries whose trips ended.
    pub(crate) survey: Survey,
    pub(crate) returns: Vec<(u32, f64)>,
    pub(crate) ended: Vec<u32>,
    /// What was counted since the counts were forgotten, but for distances.
    pub(crate) counters: Counters,
    /// What happened to vehicles on their way.
    pub(crate) driving: Vec<DrivingEvent>,
    /// Main entries whose trips ended on their chains.
    pub(crate) arrived: Vec<(ChainIndex, Entry)>,
    /// Vehicles that touch each other.
    pub(crate) incidents: Vec<Incident>,
    /// Lanes that had no vehicles when they were to be moved.
    pub(crate) empty: Vec<ChainIndex>,
}

impl Outbox {
    /// Notes what happens to the vehicle at `spot` on its way.
    pub(crate) fn note(&mut self, scene: &Scene, clock: Clock, spot: Spot, kind: DrivingEventKind) {
        match kind {
            DrivingEventKind::EmergencyBraking => self.counters.emergency_brakings += 1,
            DrivingEventKind::MissedTurn => self.counters.missed_turns += 1,
            DrivingEventKind::RouteChange => self.counters.route_changes += 1,
            DrivingEventKind::Halt | DrivingEventKind::SetOff { .. } => {}
        }
        let (motion, time) = (scene.motion(spot), clock.time());
        let event = DrivingEvent { kind, vehicle: motion.id, time, at: Position::new(spot.chain, motion.x) };
        self.driving.push(event);
    }

    /// Takes over all that is in `other`.
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
        take_over(&mut self.arrived, &mut other.arrived);
        take_over(&mut self.incidents, &mut other.incidents);
        take_over(&mut self.empty, &mut other.empty);
    }
}

/// Appends `other`, and writes to it only if there is something: its thread keeps it in its own cache.
fn take_over<T>(list: &mut Vec<T>, other: &mut Vec<T>) {
    if !other.is_empty() {
        list.append(other);
    }
}

/// What became in a step of an entry that does not only follow.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Upkeep {
    /// The entry.
    pub(crate) index: u32,
    /// Distance driven [m].
    pub(crate) distance: f64,
    /// Kinematics decided in the present braking.
    pub(crate) in_emergency: bool,
    /// The reservation that it had is over.
    pub(crate) reservation_is_over: bool,
}

/// A driver who waits for its reservation.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct Waiting {
    /// Its entry.
    pub(crate) index: u32,
    /// Who.
    pub(crate) id: VehicleId,
    /// Step in which it first asked.
    pub(crate) since: u32,
    /// The next that it has to pass is a light at which it does not go on.
    pub(crate) is_held: bool,
}

/// How far a vehicle with a reservation drove.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Progress {
    /// Where the reservation is kept.
    pub(crate) slot: u32,
    /// Whose it is.
    pub(crate) id: VehicleId,
    /// Distance driven [m].
    pub(crate) distance: f64,
    /// Speed now [m/s].
    pub(crate) speed: f64,
    /// Desired speed [m/s].
    pub(crate) desired: f64,
}

/// What a driver asks for at a junction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ReservationRequest {
    /// Step in which it first asked; who asked first comes first.
    pub(crate) since: u32,
    /// Who.
    pub(crate) id: VehicleId,
    /// Its chain.
    pub(crate) chain: ChainIndex,
    /// Where it was on the snapshot [m].
    pub(crate) x: f64,
    /// What.
    pub(crate) what: RequestKind,
}

/// What there is to ask for at a junction.
#[derive(Clone, Copy, Debug)]
pub(crate) enum RequestKind {
    /// To pass.
    Pass,
    /// To have a reservation revoked from this distance from its beginning on [m].
    Revoke(f64),
}

/// What every driver keeps in mind after considering lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Note {
    /// Its entry.
    pub(crate) index: u32,
    /// Step at which it considers lanes next.
    pub(crate) due: u32,
    /// Desired speed that the current limit gives [m/s].
    pub(crate) limit_desired: f32,
    /// Time at standstill [s].
    pub(crate) standing: f32,
}

/// What a driver keeps in mind beside, who has to leave its lane soon, reacts to more than its leader, or wants to
/// change.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Concern {
    /// Its entry.
    pub(crate) index: u32,
    /// Where it has to have left a wrong lane soon [m]; infinite if it has not.
    pub(crate) last_place: f64,
    /// How much it is pressed to the change that it wants, 0…1.
    pub(crate) urgency: f32,
    /// It no longer wants to change.
    pub(crate) gives_up: bool,
    /// It may have to stay behind slower drivers on the lane for overtaking.
    pub(crate) minds_offside: bool,
    /// It goes somewhere else, or another way, from now on.
    pub(crate) rerouted: Option<Destination>,
}

/// Something that concerns another lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Request {
    /// How pressing, 0…1; the most pressing goes first.
    pub(crate) urgency: f32,
    /// Who asks.
    pub(crate) id: VehicleId,
    /// Its chain.
    pub(crate) chain: ChainIndex,
    /// Where it was on the snapshot [m].
    pub(crate) x: f64,
    /// What it asks for.
    pub(crate) ask: Ask,
}

/// What a request asks for.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Ask {
    /// To wait for a gap.
    Want(Want),
    /// To change now.
    Change,
    /// To be let in by a follower, who is seen at `x` of `chain`.
    LetIn { follower: VehicleId, chain: ChainIndex, x: f64, gap: f32, speed: f32 },
    /// To go back.
    Abort,
}

/// A desire to change.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Want {
    /// To where.
    pub(crate) side: Side,
    /// Why.
    pub(crate) kind: Kind,
    /// What the driver makes of it.
    pub(crate) appraisal: Appraisal,
    /// Anticipated gain of speed [m/s].
    pub(crate) speed_gain: f32,
}
