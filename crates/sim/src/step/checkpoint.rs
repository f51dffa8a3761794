//! All of a world that moves, as bytes: a world that is made anew of the same network, drivers and demand, and given
//! them, goes on as this one would, bit for bit.

use serde::{Deserialize, Serialize};
use thiserror::Error;
use xxhash_rust::xxh3::{Xxh3, xxh3_64};

use crate::demand::metering::Metering;
use crate::demand::source::Source;
use crate::driver::plan::Waiting;
use crate::junction::state::JunctionState;
use crate::record::journal::Journal;
use crate::record::log::Log;
use crate::record::tally::Tally;
use crate::route::guidance::Guidance;
use crate::route::renew::Guided;
use crate::route::roads::Roads;
use crate::state::goal::Destination;
use crate::state::moving::Traffic;
use crate::state::traffic::{Lane, Phase, VehicleId};
use crate::step::world::World;

/// Why a world cannot go on from what was saved.
#[derive(Debug, Error, PartialEq)]
pub enum CheckpointError {
    /// The bytes are not those of a world.
    #[error("it is no state of a world: {0}")]
    Unreadable(String),
    /// They are those of another world.
    #[error("it is the state of another world, with other {0}")]
    Other(&'static str),
}

/// What a world has to share with the one that was saved.
#[derive(Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Identity {
    /// Hash of its chains.
    network: u64,
    characters: usize,
    origins: usize,
    destinations: usize,
}

/// What is saved: of each part what moves.
type Saved = (
    Identity,
    Traffic,
    JunctionState,
    (Vec<Source>, Option<Metering>, VehicleId),
    Log,
    // By lane those who wait for a passage, and the distance driven [m].
    Vec<(Vec<Waiting>, f64)>,
    Tally,
    Option<(Guidance, Guided)>,
);

/// Bytes of the hash at the end.
const HASH: usize = 8;

impl World {
    /// Everything that moves, as it is after the last step, as bytes.
    ///
    /// # Errors
    /// None, as long as there is memory.
    pub fn save(&self) -> Result<Vec<u8>, CheckpointError> {
        let World { roads, traffic, junctions, arrivals, log, work } = self;
        let coming = (&arrivals.sources, &arrivals.metering, arrivals.next_id);
        let kept: Vec<_> = work.plans.iter().map(|it| (&it.waiting, it.distance)).collect();
        let guided = roads.guidance.as_ref().map(|it| (it, roads.navigator.guided()));
        let saved = (self.identity(), traffic, junctions, coming, log, kept, self.counted(), guided);
        let mut bytes = postcard::to_allocvec(&saved).map_err(unreadable)?;
        bytes.extend(xxh3_64(&bytes).to_le_bytes());
        Ok(bytes)
    }

    /// Goes on from what was saved of a world of the same network, drivers, demand and seed.
    ///
    /// # Errors
    /// If the bytes are not those of such a world; this one is left as it was.
    pub fn restore(&mut self, saved: &[u8]) -> Result<(), CheckpointError> {
        let whole = saved.split_last_chunk::<HASH>();
        let whole = whole.filter(|(body, hash)| xxh3_64(body).to_le_bytes() == **hash);
        let (body, _) = whole.ok_or_else(|| CheckpointError::Unreadable("it is damaged".into()))?;
        // Whose world it is comes first: what follows can be read as that of another only by chance.
        let (identity, _) = postcard::take_from_bytes(body).map_err(unreadable)?;
        self.identity().check(&identity)?;
        let saved: Saved = postcard::from_bytes(body).map_err(unreadable)?;
        self.check(&saved)?;
        let (_, traffic, junctions, (sources, metering, next_id), log, kept, tally, guided) = saved;
        self.traffic = traffic;
        self.junctions = junctions;
        (self.arrivals.sources, self.arrivals.metering, self.arrivals.next_id) = (sources, metering, next_id);
        self.log = Log { is_audited: self.log.is_audited, ..log };
        for (plan, (waiting, distance)) in self.work.plans.iter_mut().zip(kept) {
            plan.clear();
            (plan.waiting, plan.distance) = (waiting, distance);
        }
        self.work.outboxes.iter_mut().for_each(|it| it.tally = Tally::default());
        if let Some(outbox) = self.work.outboxes.first_mut() {
            outbox.tally = tally;
        }
        self.roads.guidance = None;
        if let Some((guidance, guided)) = guided {
            self.roads.guidance = Some(guidance);
            self.roads.navigator.go_on(&self.roads.network, guided);
        }
        Ok(())
    }

    fn identity(&self) -> Identity {
        let mut hash = Xxh3::new();
        for chain in &self.roads.network.chains {
            hash.update(&chain.length.to_bits().to_le_bytes());
            let ids = chain.lanelets.iter().map(|it| self.roads.network.lanelets[it.at()].id);
            ids.for_each(|id| hash.update(&id.to_le_bytes()));
            chain.following.iter().for_each(|it| hash.update(&it.0.to_le_bytes()));
        }
        let demand = &self.arrivals.demand;
        Identity {
            network: hash.digest(),
            characters: self.roads.characters.len(),
            origins: demand.origins.len(),
            destinations: demand.destinations.len(),
        }
    }
}

impl World {
    /// Whether all that was saved fits this world, part by part: nothing in it may name what is not there.
    fn check(&self, saved: &Saved) -> Result<(), CheckpointError> {
        let World { roads, traffic: own, junctions: own_junctions, arrivals, log: _, work: _ } = self;
        let (_, traffic, junctions, (sources, metering, next_id), log, kept, _, guided) = saved;
        let (chains, characters) = (roads.network.chains.len(), roads.characters.len());
        let tables = roads.navigator.tables();
        let is_known = |it: Destination| match guided {
            Some((_, guided)) => guided.has(it),
            None => roads.navigator.has(it),
        };
        let waits = |(it, lane): (&(Vec<Waiting>, f64), &Lane)| {
            it.0.iter().all(|it| (it.index as usize) < lane.motions().len() && it.since <= traffic.clock.step)
        };
        let metering_fits = match (metering, &arrivals.metering) {
            (Some(one), Some(other)) => one.fits(other),
            (one, other) => one.is_none() && other.is_none(),
        };
        let guidance_fits = match (guided, &roads.guidance) {
            (Some((guidance, guided)), Some(_)) => {
                guidance.fits(roads.navigator.links().all().len(), tables) && roads.navigator.accepts(guided)
            }
            (one, other) => one.is_none() && other.is_none(),
        };
        let sources_fit = sources.len() == arrivals.sources.len()
            && sources
                .iter()
                .zip(&arrivals.sources)
                .all(|(one, other)| one.fits(other, traffic.clock, characters, is_known));
        let wrong = [
            (traffic.clock.dt != own.clock.dt, "steps"),
            (!traffic.fits(chains, characters, is_known), "lanes"),
            (kept.len() != chains || !kept.iter().zip(&traffic.lanes).all(waits), "waiting drivers"),
            (!junctions.fits(own_junctions, traffic.clock), "junctions"),
            (!sources_fit || !metering_fits, "arrivals"),
            (!guidance_fits, "guidance"),
            (!log_fits(log, traffic, sources, roads, *next_id), "records"),
        ];
        wrong.into_iter().find(|it| it.0).map_or(Ok(()), |it| Err(CheckpointError::Other(it.1)))
    }
}

/// Whether a log knows all vehicles on the road, and those who wait to enter can still begin.
fn log_fits(log: &Log, traffic: &Traffic, sources: &[Source], roads: &Roads, next_id: VehicleId) -> bool {
    let Log { records, trips, journal, ledger, events: _, touching: _, is_audited: _, counts: _ } = log;
    let knows = |id: VehicleId| id < next_id && trips.has(id) && journal.as_ref().is_none_or(|it| it.has(id));
    let lane_fits = |lane: &Lane| {
        let ids = lane.motions().iter().map(|it| it.id);
        let mut changes = lane.cars().iter().zip(lane.minds()).filter(|(it, _)| it.phase != Phase::Cruises);
        ids.into_iter().all(knows) && changes.all(|(_, it)| records.has(it.record))
    };
    let waiting = || sources.iter().flat_map(|it| it.lanes()).flat_map(|it| &it.waiting);
    let count = waiting().count();
    let journal_fits = |it: &Journal| it.fits(roads.network.chains.len()) && it.reaches(next_id, count);
    records.is_sound()
        && journal.as_ref().is_none_or(journal_fits)
        && ledger.as_ref().is_none_or(|it| it.stays.len() == roads.network.lanelets.len())
        && traffic.lanes.iter().all(lane_fits)
        && trips.reach(next_id, count)
        && waiting().all(|it| it.id < next_id && trips.can_begin(it.id))
}

impl Identity {
    /// # Errors
    /// What differs.
    fn check(&self, saved: &Identity) -> Result<(), CheckpointError> {
        let Identity { network, characters, origins, destinations } = *saved;
        let differs = [
            (network != self.network, "lanes"),
            (characters != self.characters, "drivers"),
            (origins != self.origins, "origins"),
            (destinations != self.destinations, "destinations"),
        ];
        differs.into_iter().find(|it| it.0).map_or(Ok(()), |it| Err(CheckpointError::Other(it.1)))
    }
}

fn unreadable(error: postcard::Error) -> CheckpointError {
    CheckpointError::Unreadable(error.to_string())
}
