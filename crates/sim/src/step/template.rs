//! Many worlds of one kind: they share what does not change, and each has its own random numbers.

use crate::demand::error::WorldError;
use crate::state::commands::Commands;
use crate::step::index::Index;
use crate::step::work::Work;
use crate::step::world::World;

/// A world at its start, of which others are made. They share its network, routes, driver parameters and demand, so
/// that each costs little time and memory.
///
/// A world that changes what it shares, such as by guidance, gets a copy of its own first.
pub struct Template {
    start: World,
}

impl From<World> for Template {
    /// A template of worlds like `world`, whose time is 0.
    fn from(world: World) -> Template {
        debug_assert_eq!(world.clock().step, 0, "it is at its start");
        Template { start: world }
    }
}

impl Template {
    /// The world at its start.
    pub fn start(&self) -> &World {
        &self.start
    }

    /// Another world at its start, with the random numbers of `seed`, on so many `threads`.
    ///
    /// # Errors
    /// If the system does not start so many threads.
    pub fn spawn(&self, seed: u64, threads: usize) -> Result<World, WorldError> {
        let World { roads, traffic, junctions, arrivals, log, warmup_steps, .. } = &self.start;
        let roads = roads.with_seed(seed);
        let work = Work::new(roads.network().chains.len(), threads)
            .map_err(|error| WorldError::Threads { threads, why: error.to_string() })?;
        Ok(World {
            arrivals: arrivals.drawn_with(&roads.random()),
            roads,
            traffic: traffic.clone(),
            junctions: junctions.clone(),
            log: log.clone(),
            commands: Commands::default(),
            index: Index::default(),
            work,
            warmup_steps: *warmup_steps,
        })
    }
}

impl World {
    /// Becomes what `template` spawns with this `seed`, on the threads that it has, and keeps its memory for the
    /// vehicles to come. It was spawned by that template.
    pub fn reset(&mut self, template: &Template, seed: u64) {
        let World { roads, traffic, junctions, arrivals, log, warmup_steps, .. } = &template.start;
        self.roads = roads.with_seed(seed);
        self.traffic.begin_again(traffic);
        self.junctions.clone_from(junctions);
        self.arrivals = arrivals.drawn_with(&self.roads.random());
        self.log.clone_from(log);
        self.commands = Commands::default();
        self.index.forget();
        self.work.begin_again();
        self.warmup_steps = *warmup_steps;
    }
}
