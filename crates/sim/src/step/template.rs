//! Many worlds of one kind: they share what does not change, and each has its own random numbers.

use crate::demand::arrivals::Arrivals;
use crate::demand::error::WorldError;
use crate::state::random::Random;
use crate::step::index::Index;
use crate::step::work::Work;
use crate::step::world::World;

/// A world of which others are made. They share its network, routes, driver parameters and demand, so that each costs
/// little time and memory. If it has made steps, the others go on from there, each with its own random numbers.
///
/// A world that changes what it shares, such as by guidance, gets a copy of its own first.
pub struct Template {
    start: World,
}

impl From<World> for Template {
    /// A template of worlds like `world`.
    fn from(world: World) -> Template {
        Template { start: world }
    }
}

impl Template {
    /// The world of which others are made.
    pub fn start(&self) -> &World {
        &self.start
    }

    /// Another world, with the random numbers of `seed` from now on, on so many `threads`.
    ///
    /// # Errors
    /// If the system does not start so many threads.
    pub fn spawn(&self, seed: u64, threads: usize) -> Result<World, WorldError> {
        let World { roads, traffic, junctions, log, commands, work: done, warmup_steps, .. } = &self.start;
        let roads = roads.with_seed(seed);
        let mut work = Work::new(roads.network().chains.len(), threads)
            .map_err(|error| WorldError::Threads { threads, why: error.to_string() })?;
        work.go_on_from(done);
        Ok(World {
            arrivals: self.arrivals(&roads.random()),
            roads,
            traffic: traffic.clone(),
            junctions: junctions.clone(),
            log: log.clone(),
            commands: commands.clone(),
            index: Index::default(),
            work,
            warmup_steps: *warmup_steps,
        })
    }

    /// The arrivals to come. The first ones are drawn by whoever begins.
    fn arrivals(&self, random: &Random) -> Arrivals {
        let World { arrivals, traffic, .. } = &self.start;
        if traffic.clock().step == 0 { arrivals.drawn_with(random) } else { arrivals.clone() }
    }
}

impl World {
    /// Becomes what `template` spawns with this `seed`, on the threads that it has, and keeps its memory for the
    /// vehicles to come. It was spawned by that template.
    pub fn reset(&mut self, template: &Template, seed: u64) {
        let World { roads, traffic, junctions, log, commands, work, warmup_steps, .. } = &template.start;
        self.roads = roads.with_seed(seed);
        self.traffic.begin_again(traffic);
        self.junctions.clone_from(junctions);
        self.arrivals = template.arrivals(&self.roads.random());
        self.log.clone_from(log);
        self.commands.clone_from(commands);
        self.index.forget();
        self.work.go_on_from(work);
        self.warmup_steps = *warmup_steps;
    }
}
