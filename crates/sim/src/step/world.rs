//! The world and its step.

use std::sync::Arc;

use laneweave_models::Style;
use laneweave_network::Network;

use crate::demand::Demand;
use crate::demand::arrivals::Arrivals;
use crate::demand::error::WorldError;
use crate::junction::state::JunctionState;
use crate::record::journal::Journal;
use crate::record::ledger::Ledger;
use crate::record::log::Log;
use crate::route::guidance::Guidance;
use crate::route::navigate::Navigator;
use crate::route::roads::Roads;
use crate::state::moving::Traffic;
use crate::state::random::Random;
use crate::state::setup::Setup;
use crate::step::work::Work;
use crate::view::scene::Scene;

/// Traffic on a network, and all that moves it.
pub struct World {
    pub(crate) roads: Roads,
    pub(crate) traffic: Traffic,
    pub(crate) junctions: JunctionState,
    pub(crate) arrivals: Arrivals,
    pub(crate) log: Log,
    pub(crate) work: Work,
}

impl World {
    /// An empty world on `network`, whose drivers come from `demand` with the given `characters`.
    ///
    /// # Errors
    /// If the step is not between 0.01 and 1 s, there are no characters, the demand is no demand, or has too many
    /// destinations.
    pub fn new(
        network: impl Into<Arc<Network>>,
        characters: Vec<Style>,
        demand: Demand,
        setup: Setup,
    ) -> Result<World, WorldError> {
        let network = network.into();
        if !(0.01..=1.0).contains(&setup.step) {
            return Err(WorldError::Step(setup.step));
        }
        if characters.is_empty() {
            return Err(WorldError::NoCharacters);
        }
        demand.check()?;
        let (destinations, chains) = (demand.destinations.len(), network.chains.len());
        if destinations * chains > Navigator::MOST_WAYPOINTS {
            return Err(WorldError::Ways { destinations, chains });
        }
        let traffic = Traffic::new(network.chains.len(), setup.step);
        let roads =
            Roads::new(network, characters, &demand.destinations, &demand.fleet, Random::new(setup.seed));
        Ok(World {
            junctions: JunctionState::new(&roads.network, traffic.clock),
            arrivals: Arrivals::new(&roads, demand),
            work: Work::new(roads.network.chains.len(), setup.threads),
            log: Log::default(),
            roads,
            traffic,
        })
    }

    /// The same world with drivers guided by travel times that are measured in it every `interval` [s]. Where nobody
    /// has a choice of ways there is nothing to guide.
    ///
    /// # Errors
    /// If there are more destinations than can be guided to, or their ways would not fit into memory.
    pub fn guided(mut self, interval: f64) -> Result<World, WorldError> {
        if self.roads.navigator.offers_a_choice() {
            let destinations = &self.arrivals.demand.destinations;
            let chains = self.roads.network.chains.len();
            if destinations.len() * chains * Navigator::WAYS > Navigator::MOST_WAYPOINTS {
                return Err(WorldError::Ways { destinations: destinations.len(), chains });
            }
            let guided = self.roads.navigator.guide(&self.roads.network, destinations);
            guided.map_err(|most| WorldError::Destinations(destinations.len(), most))?;
            self.roads.guidance =
                Some(Guidance::new(self.roads.navigator.links(), self.traffic.clock.steps(interval)));
        }
        Ok(self)
    }

    /// The same world, which records every trip until it ends, and what vehicles do on every lanelet.
    pub fn with_journal(mut self) -> World {
        self.log.journal = Some(Journal::default());
        self.log.ledger = Some(Ledger::new(&self.roads.network));
        self
    }

    /// The same world, in which it is looked for overlaps at every step, not only once a second.
    pub fn audited(mut self) -> World {
        self.log.is_audited = true;
        self
    }

    /// One step: everybody perceives, decides and accelerates on one snapshot; then all move; what concerns two
    /// lanes is resolved in order; vehicles enter; drivers are guided.
    pub fn step(&mut self) {
        self.log.events.clear();
        let is_watched = self.is_watched();
        self.move_all(is_watched);
        self.traffic.clock.step += 1;
        self.switch_lights();
        self.gather();
        self.note_incidents(is_watched);
        self.account();
        self.pass_on();
        self.transfer();
        self.give_passages();
        self.resolve();
        self.enter();
        self.guide();
        if self.begins_a_second() {
            self.put_down();
        }
    }

    /// What is done once a second is done now.
    pub(crate) fn begins_a_second(&self) -> bool {
        self.traffic.clock.step.is_multiple_of(self.traffic.clock.steps(1.0))
    }

    /// Overlaps are looked for once a second; in an audit at every step.
    fn is_watched(&self) -> bool {
        self.log.is_audited || self.begins_a_second()
    }

    /// The current instant.
    pub fn scene(&self) -> Scene<'_> {
        Scene {
            network: &self.roads.network,
            navigator: &self.roads.navigator,
            lanes: &self.traffic.lanes,
            characters: &self.roads.characters,
            passages: &self.junctions.passages,
            signals: &self.junctions.signals,
        }
    }
}
