//! What the drivers of one lane resolve to do in a step, written down on the snapshot and carried out afterwards.

use laneweave_models::change::Appraisal;
use laneweave_network::{ChainIndex, Side};

use crate::navigate::Destination;
use crate::tally::Tally;
use crate::traffic::{Car, Kind, Milestone, Mind, Twin, VehicleId};

/// The resolutions of one lane's drivers. Kept from step to step, so that nothing is allocated anew; on cache lines of
/// its own, so that threads do not disturb each other.
#[derive(Debug, Default)]
#[repr(align(128))]
pub(crate) struct Plan {
    /// Acceleration of each entry [m/s²].
    pub(crate) accelerations: Vec<f64>,
    /// Main entries of vehicles in a change, with their shadows.
    pub(crate) couples: Vec<(u32, Twin)>,
    /// Entries whose braking kinematics decided.
    pub(crate) emergencies: Vec<u32>,
    /// Entries that touch their leaders.
    pub(crate) collisions: Vec<u32>,
    /// What drivers who considered lanes keep in mind.
    pub(crate) notes: Vec<Note>,
    /// What concerns other lanes.
    pub(crate) requests: Vec<Request>,
    /// Entries that passed the end of the chain.
    pub(crate) leaving: Vec<(Car, Mind)>,
    /// What happened to lane changes.
    pub(crate) milestones: Vec<Milestone>,
    /// Overlaps, if it was time to look for them.
    pub(crate) overlaps: u64,
    /// Counts.
    pub(crate) tally: Tally,
}

impl Plan {
    /// Forgets the last step.
    pub(crate) fn clear(&mut self) {
        self.accelerations.clear();
        self.couples.clear();
        self.emergencies.clear();
        self.collisions.clear();
        self.notes.clear();
        self.requests.clear();
    }
}

/// What a driver keeps in mind after considering lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Note {
    /// Its entry.
    pub(crate) index: u32,
    /// Step at which it considers lanes next.
    pub(crate) due: u32,
    /// Desired speed that the current limit gives [m/s].
    pub(crate) limit_desired: f32,
    /// Where it has to have left a wrong lane [m].
    pub(crate) last_place: f64,
    /// Time at standstill [s].
    pub(crate) standing: f32,
    /// How much the route presses it to the change that it wants, 0…1.
    pub(crate) urgency: f32,
    /// It no longer wants to change.
    pub(crate) gives_up: bool,
    /// It goes somewhere else from now on.
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
