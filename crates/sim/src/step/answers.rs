//! What a world says of itself.

use std::sync::Arc;

use laneweave_models::Style;
use laneweave_network::{ChainIndex, Network, Position};
use xxhash_rust::xxh3::Xxh3;

use crate::demand::Demand;
use crate::demand::arrivals::Arrivals;
use crate::demand::assignment::Assignment;
use crate::demand::error::WorldError;
use crate::driver::plan::Waiting;
use crate::record::counters::Counters;
use crate::record::counts::Counts;
use crate::record::events::Event;
use crate::record::lanelet_aggregates::LaneletAggregate;
use crate::record::trip_log::TripRecord;
use crate::state::clock::Clock;
use crate::state::lane::VehicleId;
use crate::state::random::Random;
use crate::step::vehicle::Vehicle;
use crate::step::work::pool_for;
use crate::step::world::World;
use crate::view::scene::Spot;

impl World {
    /// All different drivers.
    pub fn driver_parameters(&self) -> &[Style] {
        self.roads.driver_parameters()
    }

    /// Gives the drivers other driver parameters, each in the place of its own. What they are about they go on with.
    ///
    /// # Errors
    /// If there are not as many of them.
    pub fn change_driver_parameters(&mut self, driver_parameters: Vec<Style>) -> Result<(), WorldError> {
        let [found, expected] = [driver_parameters.len(), self.roads.driver_parameters().len()];
        if found != expected {
            return Err(WorldError::Characters { found, expected });
        }
        self.roads.change_driver_parameters(driver_parameters);
        Ok(())
    }

    /// The random numbers.
    pub(crate) fn random(&self) -> Random {
        self.roads.random()
    }

    /// Who comes, and who waits to enter.
    pub(crate) fn arrivals(&self) -> &Arrivals {
        &self.arrivals
    }

    /// Since when the driver at `spot` waits at a junction, if it does.
    pub(crate) fn waits_at_a_junction(&self, spot: Spot) -> Option<&Waiting> {
        let id = self.traffic.lane(spot.chain).motions()[spot.index].id;
        self.work.plans[spot.chain.at()].waiting.iter().find(|it| it.id == id)
    }

    /// The record of the trip of a vehicle on the road, where trips are recorded.
    pub fn trip(&self, id: VehicleId) -> Option<&TripRecord> {
        self.log.trip(id)
    }

    /// What happened in the last step.
    pub fn events(&self) -> &[Event] {
        self.log.events()
    }

    /// The clock.
    pub fn clock(&self) -> Clock {
        self.traffic.clock()
    }

    /// The roads.
    pub fn network(&self) -> &Network {
        self.roads.network()
    }

    /// The roads, for those who need them beyond the world: they never change.
    pub fn shared_network(&self) -> Arc<Network> {
        self.roads.shared_network()
    }

    /// Who comes, from where and to where.
    pub fn demand(&self) -> &Demand {
        self.arrivals.demand()
    }

    /// Where its demand leads on average between two times [s].
    pub fn assignment(&self, during: [f64; 2]) -> Assignment {
        Assignment::new(self.roads.network(), self.roads.navigator(), self.arrivals.demand(), during)
    }

    /// Whether drivers from an origin of the demand can reach one of its destinations, and would drive there.
    pub fn leads(&self, origin: usize, destination: usize) -> bool {
        let place = &self.arrivals.demand().origins[origin].place;
        self.roads.navigator().leads(self.roads.network(), place, destination as u16)
    }

    /// What the drivers did so far, added up over threads, and distances over the lanes.
    pub fn counters(&self) -> Counters {
        Counters { distance: self.work.plans.iter().map(|it| it.distance).sum(), ..self.work.counted() }
    }

    /// What the world did so far.
    pub fn counts(&self) -> &Counts {
        self.log.counts()
    }

    /// Forgets all counts: what follows is measured, what was before is warm-up. Vehicles on the road count as entered.
    pub fn reset_counts(&mut self) {
        let on_road = self.on_road();
        let World { roads, traffic, log, work, .. } = self;
        work.plans.iter_mut().for_each(|it| it.distance = 0.0);
        work.reset_counters(Counters::default());
        log.reset_counts(on_road);
        log.put_down(roads.network(), traffic.lanes(), traffic.clock());
        log.reset_lanelet_aggregates(roads.network());
    }

    /// What vehicles did on each lanelet since the counts were last forgotten, where trips are recorded.
    pub fn lanelet_aggregates(&self) -> Vec<LaneletAggregate> {
        self.log.lanelet_aggregates(self.roads.network(), self.traffic.lanes(), self.traffic.clock())
    }

    /// Vehicles on the road.
    pub fn on_road(&self) -> usize {
        self.traffic
            .lanes()
            .iter()
            .map(|lane| lane.drivers().iter().filter(|driver| !driver.is_shadow).count())
            .sum()
    }

    /// Whether its steps are shared among all its threads: where few vehicles drive, one moves them all.
    pub fn moves_on_all_threads(&self) -> bool {
        self.work.pools[pool_for(self.traffic.crowd())].threads() > 1
    }

    /// Vehicles that wait to enter.
    pub fn waiting(&self) -> usize {
        self.arrivals.count_waiting()
    }

    /// Vehicles that have arrived, whether they entered or wait.
    pub fn arrived(&self) -> u64 {
        self.arrivals.count_arrived()
    }

    /// All vehicles, by chain and in driving order.
    pub fn vehicles(&self) -> impl Iterator<Item = Vehicle<'_>> {
        self.traffic.lanes().iter().enumerate().flat_map(move |(index, lane)| {
            let chain = ChainIndex(index as u32);
            let entries = lane.motions().iter().zip(lane.drivers()).enumerate();
            entries.filter(|(_, (_, driver))| !driver.is_shadow).map(move |(index, (motion, driver))| {
                let (spot, lane_change) = (Spot { chain, index }, &lane.lane_change_states()[index]);
                Vehicle { world: self, spot, motion, driver, lane_change }
            })
        })
    }

    /// Hash of (id, lanelet, position, speed, state) of all vehicles in the order of their ids.
    pub fn state_hash(&self) -> u64 {
        let mut vehicles: Vec<Vehicle> = self.vehicles().collect();
        vehicles.sort_by_key(Vehicle::id);
        let mut hash = Xxh3::new();
        for vehicle in vehicles {
            let (lanelet, along) =
                self.roads.network().lanelet_at(Position::new(vehicle.spot.chain, vehicle.x()));
            hash.update(&vehicle.id().to_le_bytes());
            hash.update(&lanelet.id.to_le_bytes());
            hash.update(&along.to_bits().to_le_bytes());
            hash.update(&vehicle.speed().to_bits().to_le_bytes());
            hash.update(&[vehicle.driver.phase as u8]);
        }
        hash.digest()
    }
}
