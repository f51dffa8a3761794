//! The world and its step.

use std::sync::Arc;

use laneweave_models::Style;
use laneweave_network::Network;

use crate::demand::Demand;
use crate::demand::arrivals::Arrivals;
use crate::demand::error::WorldError;
use crate::junction::state::JunctionState;
use crate::record::log::Log;
use crate::route::class_restrictions::ClassRestrictions;
use crate::route::navigate::Navigator;
use crate::route::roads::Roads;
use crate::state::commands::Commands;
use crate::state::goal::Goal;
use crate::state::random::Random;
use crate::state::setup::Setup;
use crate::state::traffic::Traffic;
use crate::step::carry_out::CarryingOut;
use crate::step::change_roads::change_roads;
use crate::step::enter::enter;
use crate::step::externals::{follow_externals, hand_out_controls};
use crate::step::gather::gather;
use crate::step::grant_reservations::{advance_reservations, grant_reservations};
use crate::step::guide::guide;
use crate::step::index::Index;
use crate::step::move_all::move_all;
use crate::step::move_externals::move_externals;
use crate::step::note_incidents::note_incidents;
use crate::step::note_milestones::note_milestones;
use crate::step::resolve::resolve;
use crate::step::see_standing::see_standing;
use crate::step::serve_stops::serve_stops;
use crate::step::switch_lights::switch_lights;
use crate::step::transfer::transfer;
use crate::step::work::Work;
use crate::view::scene::Scene;

/// A world: traffic on a network, and all that moves it.
pub struct World {
    pub(super) roads: Roads,
    pub(super) traffic: Traffic,
    pub(super) junctions: JunctionState,
    pub(super) arrivals: Arrivals,
    pub(super) log: Log,
    pub(super) commands: Commands,
    pub(super) index: Index,
    pub(super) work: Work,
    /// The step at whose end the warm-up ends; 0: there is none.
    pub(super) warmup_steps: u32,
}

impl World {
    /// An empty world on `network`, whose drivers come from `demand` with the given `driver_parameters`.
    ///
    /// # Errors
    /// If the step is not between 0.01 and 1 s, there are no driver parameters, the demand is not valid, it has too
    /// many destinations, or the system does not start so many threads.
    pub fn new(
        network: impl Into<Arc<Network>>,
        driver_parameters: Vec<Style>,
        demand: Demand,
        setup: Setup,
    ) -> Result<World, WorldError> {
        let network = network.into();
        if !(0.01..=1.0).contains(&setup.step) {
            return Err(WorldError::Step(setup.step));
        }
        if driver_parameters.is_empty() {
            return Err(WorldError::NoDriverParameters);
        }
        demand.check(&network)?;
        let (destinations, chains) = (demand.destinations.len(), network.chains.len());
        let restrictions = ClassRestrictions::of(&network, demand.classes());
        if destinations * chains * restrictions.count() > Navigator::MOST_WAYPOINTS {
            return Err(WorldError::Ways { destinations, chains });
        }
        let most = usize::from(Goal::NONE) / restrictions.count() - 1;
        if destinations > most {
            return Err(WorldError::Destinations(destinations, most));
        }
        let traffic = Traffic::new(network.chains.len(), setup.step);
        let ends = (&demand.destinations[..], demand.stops);
        let roads = Roads::new(network, driver_parameters, ends, restrictions, Random::new(setup.seed));
        let threads = setup.threads;
        let work = Work::new(roads.network().chains.len(), threads)
            .map_err(|error| WorldError::Threads { threads, why: error.to_string() })?;
        Ok(World {
            junctions: JunctionState::new(roads.network(), traffic.clock()),
            arrivals: Arrivals::new(&roads, demand),
            work,
            log: Log::default(),
            commands: Commands::default(),
            index: Index::default(),
            warmup_steps: 0,
            roads,
            traffic,
        })
    }

    /// The same world, with drivers guided by travel times that are measured in it every `interval` [s]. Without a
    /// choice of routes there is no guidance.
    ///
    /// # Errors
    /// If there are more destinations than guidance supports, or their routes would not fit into memory.
    pub fn guided(mut self, interval: f64) -> Result<World, WorldError> {
        let World { roads, traffic, arrivals, .. } = &mut self;
        if roads.navigator().offers_a_choice() {
            let destinations = &arrivals.demand().destinations;
            let (count, chains) = (destinations.len(), roads.network().chains.len());
            let tables = count * roads.navigator().restrictions().count() * Navigator::WAYS;
            if tables * chains > Navigator::MOST_WAYPOINTS {
                return Err(WorldError::Ways { destinations: count, chains });
            }
            let guided = roads.guide(destinations, traffic.clock().steps(interval));
            guided.map_err(|most| WorldError::Destinations(count, most))?;
        }
        Ok(self)
    }

    /// The same world, which records every trip until it ends, and lanelet aggregates.
    pub fn with_trip_log(mut self) -> World {
        self.log.record_trips(self.roads.network());
        self
    }

    /// The same world, which checks for overlaps at every step, not only once a second.
    pub fn audited(mut self) -> World {
        self.log.audit();
        self
    }

    /// The same world, which warms up for so many steps: at the end of the last one all counts begin anew.
    pub fn warming_up(mut self, steps: u32) -> World {
        self.warmup_steps = steps;
        self
    }

    /// Simulates one step. All drivers perceive, decide and accelerate on one snapshot; then all vehicles move.
    /// Requests between lanes are resolved in order, vehicles enter, and drivers are guided.
    pub fn step(&mut self) {
        let World { roads, traffic, junctions, arrivals, log, commands, index, work, .. } = self;
        log.begin_step();
        let commands = commands.begin_step();
        change_roads(roads, traffic, commands);
        let mut carrying_out = CarryingOut { roads, traffic, junctions, arrivals, log, index };
        carrying_out.all(commands);
        serve_stops(&mut carrying_out);
        index.forget();
        hand_out_controls(traffic, work);
        // Overlaps are checked once a second; in an audit at every step.
        let is_watched = log.is_audited() || traffic.clock().begins_a_second();
        move_all(roads, traffic, junctions, work, is_watched);
        traffic.tick();
        switch_lights(roads, traffic, junctions);
        gather(traffic, log, work);
        note_incidents(log, work, is_watched);
        note_milestones(roads, traffic, log, work);
        advance_reservations(junctions, work);
        transfer(roads, traffic, junctions, log, work);
        move_externals(roads, traffic, junctions, log, work);
        grant_reservations(roads, traffic, junctions, work);
        resolve(roads, traffic, junctions, log, work);
        enter(roads, traffic, junctions, arrivals, log, work);
        guide(roads, traffic, arrivals);
        follow_externals(roads.network(), traffic, work);
        see_standing(roads, traffic);
        if traffic.clock().begins_a_second() {
            log.put_down(roads.network(), traffic.lanes(), traffic.clock());
        }
        if self.clock().step == self.warmup_steps {
            self.reset_counts();
        }
    }

    /// Forgets where vehicles are, after one came by a command.
    pub(super) fn forget_index(&mut self) {
        self.index.forget();
    }

    /// The current scene.
    pub fn scene(&self) -> Scene<'_> {
        Scene::of(&self.roads, &self.traffic, &self.junctions)
    }
}
