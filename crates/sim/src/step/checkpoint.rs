//! Checkpoints: all parts of a world that change, as bytes. A new world of the same network, drivers and demand that
//! restores them goes on in the same way, bit for bit.

use laneweave_network::LaneletIndex;
use serde::{Deserialize, Serialize};
use thiserror::Error;
use xxhash_rust::xxh3::Xxh3;

use crate::demand::Demand;
use crate::demand::arrivals::Backlog;
use crate::driver::plan::Waiting;
use crate::junction::state::JunctionState;
use crate::record::counters::Counters;
use crate::record::log::Log;
use crate::route::guidance::Guidance;
use crate::route::renew_routes::Guided;
use crate::route::roads::Roads;
use crate::state::commands::Commands;
use crate::state::driver_parameters::{DriverParameters, ParameterChanges};
use crate::state::externals::{Kind, Service};
use crate::state::goal::Destination;
use crate::state::traffic::Traffic;
use crate::step::seal::{sealed, unsealed};
use crate::step::see_standing::seen;
use crate::step::world::World;

/// Why a world cannot go on from a checkpoint.
#[derive(Debug, Error, PartialEq)]
pub enum CheckpointError {
    /// The bytes are not those of a world.
    #[error("it is no state of a world: {0}")]
    Unreadable(String),
    /// They are those of another world.
    #[error("it is the state of another world, with other {0}")]
    Other(&'static str),
}

/// What a world must have in common with the saved one.
#[derive(Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Identity {
    /// Hash of its chains.
    network: u64,
    driver_parameters: usize,
    origins: usize,
    destinations: usize,
}

/// The saved state: the changing state of each part.
type Saved = (
    Identity,
    Traffic,
    JunctionState,
    Backlog,
    Log,
    // For each lane the drivers who wait for a reservation, and the distance driven [m].
    Vec<(Vec<Waiting>, f64)>,
    Counters,
    Option<(Guidance, Guided)>,
    (Commands, ParameterChanges, Vec<LaneletIndex>),
);

impl World {
    /// Saves all that changes, as it is after the last step.
    ///
    /// # Errors
    /// None, as long as there is memory.
    pub fn save(&self) -> Result<Vec<u8>, CheckpointError> {
        let World { roads, traffic, junctions, arrivals, log, commands, work, .. } = self;
        let kept: Vec<_> = work.plans.iter().map(|it| (&it.waiting, it.distance)).collect();
        let (identity, counters) = (Identity::of(roads, arrivals.demand()), work.counted());
        let closed = roads.navigator().closures().closed();
        let users = (commands, roads.changed_parameters().changes(), closed);
        let saved =
            (identity, traffic, junctions, arrivals.backlog(), log, kept, counters, roads.guided(), users);
        postcard::to_allocvec(&saved).map(sealed).map_err(unreadable)
    }

    /// Restores the saved state of a world of the same network, drivers, demand and seed.
    ///
    /// # Errors
    /// If the bytes are not those of such a world. This world is then unchanged.
    pub fn restore(&mut self, saved: &[u8]) -> Result<(), CheckpointError> {
        let body = unsealed(saved)?;
        // The identity comes first: the rest can be read as another world's only by chance.
        let (identity, _) = postcard::take_from_bytes(body).map_err(unreadable)?;
        Identity::of(&self.roads, self.arrivals.demand()).check(&identity)?;
        let saved: Saved = postcard::from_bytes(body).map_err(unreadable)?;
        let parameters = self.check(&saved)?;
        let World { roads, traffic, junctions, arrivals, log, commands, index, work, .. } = self;
        let (_, moving, passing, backlog, remembered, kept, counters, guided, users) = saved;
        let (given, _, closed) = users;
        index.forget();
        *commands = given;
        *roads.changed_parameters_mut() = parameters;
        (*traffic, *junctions) = (moving, passing);
        arrivals.restore(backlog);
        log.restore(remembered);
        for (plan, (waiting, distance)) in work.plans.iter_mut().zip(kept) {
            plan.clear();
            (plan.waiting, plan.distance) = (waiting, distance);
        }
        work.reset_counters(counters);
        roads.restore(guided);
        roads.close(closed);
        let seen = seen(roads.network(), traffic);
        roads.note_standing(seen);
        Ok(())
    }

    /// Checks whether the saved state fits this world, part by part. It must not refer to anything that does not
    /// exist. Returns its driver parameters.
    fn check(&self, saved: &Saved) -> Result<DriverParameters, CheckpointError> {
        let World { roads, traffic: own, junctions: own_junctions, arrivals, .. } = self;
        let (_, traffic, junctions, backlog, log, kept, _, guided, (_, changes, closed)) = saved;
        let (chains, driver_parameters) = (roads.network().chains.len(), roads.driver_parameters().len());
        let (clock, lanes) = (traffic.clock(), traffic.lanes());
        let is_known = |it: Destination| match guided {
            Some((_, guided)) => guided.has(it),
            None => roads.navigator().has(it),
        };
        let waits = |it: &(Vec<Waiting>, f64)| it.0.iter().all(|it| it.since <= clock.step);
        let externals = traffic.externals().all().iter();
        let lines = &arrivals.demand().lines;
        let is_served = |it: Service| {
            lines.get(usize::from(it.line)).is_some_and(|line| usize::from(it.stops) <= line.stops.len())
        };
        let mut services = externals
            .clone()
            .filter_map(|it| if let Kind::Line(service) = it.kind { Some(service) } else { None });
        let off_road = externals.filter_map(|it| Some(it.off_road()?.motion.id));
        let wrong = [
            (clock.dt != own.clock().dt, "steps"),
            (!traffic.fits(chains, driver_parameters, is_known), "lanes"),
            (!services.all(is_served), "lines"),
            (kept.len() != chains || !kept.iter().all(waits), "waiting drivers"),
            (!junctions.fits(own_junctions, clock), "junctions"),
            (!backlog.fits(arrivals.backlog(), clock, driver_parameters, is_known), "arrivals"),
            (!roads.accepts(guided.as_ref()), "guidance"),
            (closed.iter().any(|it| it.at() >= roads.network().lanelets.len()), "closed lanelets"),
            (!log.fits(roads.network(), lanes, off_road, &backlog.ids(), backlog.next_ids()), "records"),
        ];
        if let Some((_, what)) = wrong.into_iter().find(|it| it.0) {
            return Err(CheckpointError::Other(what));
        }
        let parameters = roads.changed_parameters().with(changes.clone());
        parameters.map_err(|_| CheckpointError::Other("driver parameters"))
    }
}

impl Identity {
    fn of(roads: &Roads, demand: &Demand) -> Identity {
        let network = roads.network();
        let mut hash = Xxh3::new();
        for chain in &network.chains {
            hash.update(&chain.length.to_bits().to_le_bytes());
            let ids = chain.lanelets.iter().map(|it| network.lanelets[it.at()].id);
            ids.for_each(|id| id.hash_with(|bytes| hash.update(bytes)));
            chain.following.iter().for_each(|it| hash.update(&it.0.to_le_bytes()));
        }
        Identity {
            network: hash.digest(),
            driver_parameters: roads.driver_parameters().len(),
            origins: demand.origins.len(),
            destinations: demand.destinations.len(),
        }
    }

    /// # Errors
    /// What differs.
    fn check(&self, saved: &Identity) -> Result<(), CheckpointError> {
        let Identity { network, driver_parameters, origins, destinations } = *saved;
        let differs = [
            (network != self.network, "lanes"),
            (driver_parameters != self.driver_parameters, "drivers"),
            (origins != self.origins, "origins"),
            (destinations != self.destinations, "destinations"),
        ];
        differs.into_iter().find(|it| it.0).map_or(Ok(()), |it| Err(CheckpointError::Other(it.1)))
    }
}

fn unreadable(error: postcard::Error) -> CheckpointError {
    CheckpointError::Unreadable(error.to_string())
}
