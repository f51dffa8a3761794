//! Queries of a world about itself.

use std::sync::Arc;

use laneweave_models::Style;
use laneweave_network::{ChainIndex, Class, Classes, Network, Position};
use xxhash_rust::xxh3::Xxh3;

use crate::demand::Demand;
use crate::demand::arrivals::{Arrivals, LineCount};
use crate::demand::assignment::{Assignment, Thinning};
use crate::demand::error::WorldError;
use crate::demand::line::{Line, LineStop};
use crate::driver::intention::{Intention, intention};
use crate::driver::plan::Waiting;
use crate::record::counters::Counters;
use crate::record::counts::Counts;
use crate::record::events::Event;
use crate::record::lanelet_aggregates::LaneletAggregate;
use crate::record::trip_log::TripRecord;
use crate::route::in_time::{LateTrip, LateTrips};
use crate::route::place::{InnerPlace, Place};
use crate::state::clock::Clock;
use crate::state::command::Commanded;
use crate::state::externals::{External, Kind};
use crate::state::lane::{Entry, VehicleId};
use crate::state::moment::Moment;
use crate::state::random::Random;
use crate::step::vehicle::Vehicle;
use crate::step::work::pool_for;
use crate::step::world::World;
use crate::view::scene::Spot;

impl World {
    /// The driver parameters of all drivers.
    pub fn driver_parameters(&self) -> &[Style] {
        self.roads.driver_parameters()
    }

    /// Replaces the driver parameters, each by the one at its index. Drivers go on with what they are doing.
    ///
    /// # Errors
    /// If their number differs.
    pub fn change_driver_parameters(&mut self, driver_parameters: Vec<Style>) -> Result<(), WorldError> {
        let [found, expected] = [driver_parameters.len(), self.roads.driver_parameters().len()];
        if found != expected {
            return Err(WorldError::Characters { found, expected });
        }
        self.roads.changed_parameters_mut().replace(driver_parameters);
        Ok(())
    }

    /// The random numbers.
    pub(crate) fn random(&self) -> Random {
        self.roads.random()
    }

    /// The arrivals, and the vehicles that wait to enter.
    pub(crate) fn arrivals(&self) -> &Arrivals {
        &self.arrivals
    }

    /// How the driver at `spot` waits at a junction, if it waits there.
    pub(crate) fn waits_at_a_junction(&self, spot: Spot) -> Option<&Waiting> {
        let id = self.traffic.lane(spot.chain).motions()[spot.index].id;
        self.work.plans[spot.chain.at()].waiting.iter().find(|it| it.id == id)
    }

    /// The trip record of a vehicle on the road, if trips are recorded.
    pub fn trip(&self, id: VehicleId) -> Option<&TripRecord> {
        self.log.trip(id)
    }

    /// The events of the last step.
    pub fn events(&self) -> &[Event] {
        self.log.events()
    }

    /// The clock.
    pub fn clock(&self) -> Clock {
        self.traffic.clock()
    }

    /// The network.
    pub fn network(&self) -> &Network {
        self.roads.network()
    }

    /// The network, which never changes, for use beyond the world.
    pub fn shared_network(&self) -> Arc<Network> {
        self.roads.shared_network()
    }

    /// The demand.
    pub fn demand(&self) -> &Demand {
        self.arrivals.demand()
    }

    /// The weight of each style of the population of its demand, for the vehicles that arrive now.
    pub fn style_weights(&self) -> &[f64] {
        self.arrivals.weights()
    }

    /// The average assignment of its demand between two times [s].
    pub fn assignment(&self, during: [f64; 2]) -> Assignment {
        Assignment::new(self.roads.network(), self.roads.navigator(), self.arrivals.demand(), during)
    }

    /// The assignment of its demand if these `rates` come to its origins [veh/h], and not all pass everywhere.
    pub fn assignment_of(&self, rates: &[f64], thinning: &Thinning) -> Assignment {
        let (network, navigator) = (self.roads.network(), self.roads.navigator());
        Assignment::of_rates(network, navigator, self.arrivals.demand(), rates, thinning)
    }

    /// Whether drivers of some class of the demand can reach one of its destinations from an origin, and would choose
    /// it.
    pub fn leads(&self, origin: usize, destination: usize) -> bool {
        let demand = self.arrivals.demand();
        let (place, classes) = (&demand.origins[origin].place, demand.fleet.classes());
        self.roads.navigator().leads(self.roads.network(), place, destination as u16, classes)
    }

    /// The trips with too little road for their lane changes, for classes of the demand: those that it has all the
    /// same, and those that it leaves out.
    pub fn late_trips(&self) -> [Vec<LateTrip>; 2] {
        let (navigator, demand) = (self.roads.navigator(), self.arrivals.demand());
        let [mut driven, mut left_out] = [Vec::new(), Vec::new()];
        for it in &self.arrivals.late().late {
            let source = &self.arrivals.sources()[it.origin];
            let has_any = demand.origins[it.origin].rate.highest() > 0.0;
            let of_demand = demand.classes().iter().filter(|class| it.classes.has(*class));
            let (yes, no): (Vec<Class>, Vec<Class>) =
                of_demand.partition(|class| has_any && source.leads_to(it.destination, *class, navigator));
            for (classes, list) in [(yes, &mut driven), (no, &mut left_out)] {
                let classes: Classes = classes.into_iter().collect();
                list.extend((!classes.is_empty()).then_some(LateTrip { classes, ..*it }));
            }
        }
        [driven, left_out]
    }

    /// The origins from which nobody of the demand has a trip with road enough for its lane changes, though it has late
    /// ones. None, if that is so of all origins.
    pub fn late_origins(&self) -> Vec<usize> {
        let LateTrips { late, in_time } = self.arrivals.late();
        let classes = self.arrivals.demand().classes();
        let is_left_early = |it: &usize| in_time[*it].iter().any(|class| classes.has(class));
        let mut origins: Vec<usize> =
            late.iter().map(|it| it.origin).filter(|it| !is_left_early(it)).collect();
        origins.dedup();
        if (0..in_time.len()).any(|it| is_left_early(&it)) { origins } else { Vec::new() }
    }

    /// The classes of the demand that start at an origin: those that may use one of its lanes, and reach a destination
    /// from it.
    pub fn starting_at(&self, origin: usize) -> Classes {
        self.arrivals.sources()[origin].possible()
    }

    /// The counters of drivers, added over threads, with distances added over lanes.
    pub fn counters(&self) -> Counters {
        Counters { distance: self.work.plans.iter().map(|it| it.distance).sum(), ..self.work.counted() }
    }

    /// The first line of the demand, and the number of its stop, to which no route leads from the place before; the
    /// number after the last stop is its destination.
    pub fn line_without_a_route(&self) -> Option<(usize, usize)> {
        let (demand, network, navigator) =
            (self.arrivals.demand(), self.roads.network(), self.roads.navigator());
        let leads = |line: &Line, number: usize| {
            let Some(goal) = navigator.seen_by(line.class, Some(line.goal(number as u16))) else {
                return false;
            };
            let before = number.checked_sub(1).and_then(|it| line.stops.get(it));
            match before.map(|it| &demand.destinations[it.destination]) {
                Some(Place::Inside(InnerPlace { chain, station, .. })) => {
                    let x = (station - LineStop::MARGIN).max(0.0);
                    navigator.waypoint(Some(goal), *chain).leads_on(x)
                }
                _ => navigator.leads_to(network, &demand.origins[line.origin].place, goal),
            }
        };
        let legs = demand.lines.iter().enumerate();
        let mut legs =
            legs.flat_map(|(at, line)| (0..=line.stops.len()).map(move |number| (at, line, number)));
        legs.find(|(_, line, number)| !leads(line, *number)).map(|(at, _, number)| (at, number))
    }

    /// What the vehicles of each line of the demand did.
    pub fn lines(&self) -> &[LineCount] {
        self.arrivals.lines()
    }

    /// The counts of the world.
    pub fn counts(&self) -> &Counts {
        self.log.counts()
    }

    /// Resets all counts at the end of the warm-up. Vehicles on the road count as entered.
    pub fn reset_counts(&mut self) {
        let on_road = self.on_road();
        let World { roads, traffic, arrivals, log, work, .. } = self;
        arrivals.reset_stops();
        work.plans.iter_mut().for_each(|it| it.distance = 0.0);
        work.reset_counters(Counters::default());
        log.reset_counts(on_road);
        log.put_down(roads.network(), traffic.lanes(), traffic.clock());
        log.reset_lanelet_aggregates(roads.network());
    }

    /// The aggregates of each lanelet since the counts were last reset, if trips are recorded.
    pub fn lanelet_aggregates(&self) -> Vec<LaneletAggregate> {
        self.log.lanelet_aggregates(self.roads.network(), self.traffic.lanes(), self.traffic.clock())
    }

    /// Number of vehicles on the road. Those that users drive off it are among them.
    pub fn on_road(&self) -> usize {
        self.traffic
            .lanes()
            .iter()
            .map(|lane| lane.drivers().iter().filter(|driver| !driver.is_shadow).count())
            .sum::<usize>()
            + self.traffic.externals().off_road()
    }

    /// Whether all threads share its steps. With few vehicles one thread moves them all.
    pub fn moves_on_all_threads(&self) -> bool {
        self.work.pools[pool_for(self.traffic.crowd())].threads() > 1
    }

    /// Number of vehicles that wait to enter.
    pub fn waiting(&self) -> usize {
        self.arrivals.count_waiting()
    }

    /// Number of vehicles that have arrived, whether they have entered or wait.
    pub fn arrived(&self) -> u64 {
        self.arrivals.count_arrived()
    }

    /// All vehicles, by chain and in driving order; then those that users drive off the road.
    pub fn vehicles(&self) -> impl Iterator<Item = Vehicle<'_>> {
        let in_lanes = self.traffic.lanes().iter().enumerate().flat_map(move |(index, lane)| {
            let chain = ChainIndex(index as u32);
            let entries = lane.motions().iter().zip(lane.drivers()).enumerate();
            entries.filter(|(_, (_, driver))| !driver.is_shadow).map(move |(index, (motion, driver))| {
                let (spot, lane_change) = (Spot { chain, index }, &lane.lane_change_states()[index]);
                Vehicle { world: self, spot, motion, driver, lane_change }
            })
        });
        in_lanes.chain(self.traffic.externals().all().iter().filter_map(|it| self.off_road(it)))
    }

    /// A vehicle that a user drives off the road.
    fn off_road<'a>(&'a self, external: &'a External) -> Option<Vehicle<'a>> {
        let spot = Spot { chain: external.at.chain, index: Vehicle::NO_ENTRY };
        let Entry { motion, driver, lane_change } = external.off_road()?;
        Some(Vehicle { world: self, spot, motion, driver, lane_change })
    }

    /// The vehicle with this id, if it is on the road.
    pub fn vehicle(&self, id: VehicleId) -> Option<Vehicle<'_>> {
        let Some(spot) = self.index.spot(self.traffic.lanes(), id) else {
            return self.off_road(self.traffic.externals().of(id)?);
        };
        let lane = self.traffic.lane(spot.chain);
        Some(Vehicle {
            world: self,
            spot,
            motion: &lane.motions()[spot.index],
            driver: &lane.drivers()[spot.index],
            lane_change: &lane.lane_change_states()[spot.index],
        })
    }

    /// What the driver of a vehicle intends to do in the next step, whoever drives the vehicle. `None` if the vehicle
    /// is in no lane.
    pub fn intention(&self, id: VehicleId) -> Option<Intention> {
        let spot = self.index.spot(self.traffic.lanes(), id)?;
        let (clock, random) = (self.traffic.clock(), self.roads.random());
        let overtaking = self.roads.network().driving_side.overtaking();
        Some(intention(&self.scene(), Moment { clock, random, overtaking }, spot))
    }

    /// The ids of the external vehicles, which users drive, in order.
    pub fn externals(&self) -> impl Iterator<Item = VehicleId> {
        let all = self.traffic.externals().all().iter();
        all.filter(|it| matches!(it.kind, Kind::Driven | Kind::Recorded)).map(|it| it.id)
    }

    /// The commands that were carried out in the last step, in their order.
    pub fn commands(&self) -> &[Commanded] {
        self.commands.done()
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
            lanelet.id.hash_with(|bytes| hash.update(bytes));
            hash.update(&along.to_bits().to_le_bytes());
            hash.update(&vehicle.speed().to_bits().to_le_bytes());
            hash.update(&[vehicle.driver.phase as u8]);
        }
        hash.digest()
    }
}
