//! All of a world that moves, as bytes: a world that is made anew of the same network, drivers and demand, and given them, goes
//! on as this one would, bit for bit.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::demand::metering::Metering;
use crate::demand::source::Source;
use crate::driver::plan::Waiting;
use crate::junction::passages::Passages;
use crate::junction::signals::Signals;
use crate::record::incidents::Touching;
use crate::record::journal::Journal;
use crate::record::ledger::Ledger;
use crate::record::records::Records;
use crate::record::tally::Tally;
use crate::record::trips::Trips;
use crate::route::guidance::Guidance;
use crate::route::navigate::Guided;
use crate::state::busy::Busy;
use crate::state::clock::Clock;
use crate::state::traffic::{Lane, VehicleId};
use crate::step::world::{Counts, World};

/// Why a world cannot go on from what was saved.
#[derive(Debug, Error, PartialEq)]
pub enum CheckpointError {
    /// The bytes are not those of a world.
    #[error("it is no state of a world: {0}")]
    Unreadable(String),
    /// They are those of another world.
    #[error("it is the state of another world: of {found} lanes, not {expected}")]
    Other {
        /// Lanes of the world that was saved.
        found: usize,
        /// Lanes of this one.
        expected: usize,
    },
}

/// What moves on the roads, and what is counted of it.
#[derive(Serialize, Deserialize)]
struct Traffic {
    clock: Clock,
    lanes: Vec<Lane>,
    /// By lane: those who wait for a passage, and the distance driven [m].
    kept: Vec<(Vec<Waiting>, f64)>,
    busy: Busy,
    crowd: usize,
    next_id: VehicleId,
    records: Records,
    trips: Trips,
    journal: Option<Journal>,
    ledger: Option<Ledger>,
    counts: Counts,
    tally: Tally,
    touching: Touching,
}

/// What governs it.
#[derive(Serialize, Deserialize)]
struct Order {
    passages: Passages,
    signals: Signals,
    sources: Vec<Source>,
    metering: Option<Metering>,
    guidance: Option<Guidance>,
    guided: Option<Guided>,
}

impl World {
    /// Everything that moves, as it is after the last step, as bytes.
    ///
    /// # Errors
    /// None, as long as there is memory.
    pub fn save(&self) -> Result<Vec<u8>, CheckpointError> {
        let traffic = Traffic {
            clock: self.clock,
            lanes: self.lanes.clone(),
            kept: self.plans.iter().map(|it| (it.waiting.clone(), it.distance)).collect(),
            busy: self.busy.clone(),
            crowd: self.crowd,
            next_id: self.next_id,
            records: self.records.clone(),
            trips: self.trips.clone(),
            journal: self.journal.clone(),
            ledger: self.ledger.clone(),
            counts: self.counts,
            tally: self.counted(),
            touching: self.touching.clone(),
        };
        let order = Order {
            passages: self.passages.clone(),
            signals: self.signals.clone(),
            sources: self.sources.clone(),
            metering: self.metering.clone(),
            guidance: self.guidance.clone(),
            guided: self.guidance.as_ref().map(|_| self.navigator.guided()),
        };
        postcard::to_allocvec(&(traffic, order)).map_err(unreadable)
    }

    /// Goes on from what was saved of a world of the same network, drivers, demand and seed.
    ///
    /// # Errors
    /// If the bytes are not those of such a world; this one is left as it was.
    pub fn restore(&mut self, saved: &[u8]) -> Result<(), CheckpointError> {
        let (traffic, order): (Traffic, Order) = postcard::from_bytes(saved).map_err(unreadable)?;
        let (found, expected) = (traffic.lanes.len(), self.lanes.len());
        if found != expected || traffic.kept.len() != expected || order.sources.len() != self.sources.len() {
            return Err(CheckpointError::Other { found, expected });
        }
        self.clock = traffic.clock;
        self.lanes = traffic.lanes;
        for (plan, (waiting, distance)) in self.plans.iter_mut().zip(traffic.kept) {
            plan.clear();
            (plan.waiting, plan.distance) = (waiting, distance);
        }
        self.busy = traffic.busy;
        (self.crowd, self.next_id) = (traffic.crowd, traffic.next_id);
        self.records = traffic.records;
        self.trips = traffic.trips;
        self.journal = traffic.journal;
        self.ledger = traffic.ledger;
        self.counts = traffic.counts;
        self.touching = traffic.touching;
        self.outboxes.iter_mut().for_each(|it| it.tally = Tally::default());
        if let Some(outbox) = self.outboxes.first_mut() {
            outbox.tally = traffic.tally;
        }
        self.passages = order.passages;
        self.signals = order.signals;
        self.sources = order.sources;
        self.metering = order.metering;
        self.guidance = order.guidance;
        if let Some(guided) = order.guided {
            self.navigator.go_on(&self.network, guided);
        }
        self.events.clear();
        Ok(())
    }
}

fn unreadable(error: postcard::Error) -> CheckpointError {
    CheckpointError::Unreadable(error.to_string())
}
