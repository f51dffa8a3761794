//! The world and its step.

use std::sync::Arc;

use laneweave_models::Style;
use laneweave_network::{ChainIndex, Network, Point, Pose};
use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::Xxh3;

use crate::demand::Demand;
use crate::demand::assignment::Assignment;
use crate::demand::error::WorldError;
use crate::demand::metering::Metering;
use crate::demand::source::Source;
use crate::driver::appeal::appeal;
use crate::driver::decide::decide;
use crate::driver::drive::drive;
use crate::driver::plan::{Outbox, Plan};
use crate::driver::turn::next_turn;
use crate::junction::passages::{NO_PASSAGE, Passages};
use crate::junction::signals::Signals;
use crate::record::events::Event;
use crate::record::incidents::{Incident, Touching};
use crate::record::journal::{Journal, TripRecord};
use crate::record::ledger::{Ledger, Mark, Stay};
use crate::record::overlap::overlaps;
use crate::record::records::Records;
use crate::record::tally::Tally;
use crate::record::trips::{Trips, free_time};
use crate::route::guidance::Guidance;
use crate::route::navigate::Navigator;
use crate::route::views::Views;
use crate::state::busy::Busy;
use crate::state::clock::Clock;
use crate::state::goal::Destination;
use crate::state::moment::Moment;
use crate::state::random::Random;
use crate::state::traffic::{Car, Entry, Kind, Lane, Mind, Motion, Phase, VehicleId};
use crate::state::trail::Trail;
use crate::state::vehicle::Class;
use crate::step::advance::{Ends, advance};
use crate::step::pool::Pool;
use crate::view::pose::{bumpers, lateral_offset, pose};
use crate::view::scene::{Scene, Spot};

/// Traffic on a network, and all that moves it.
pub struct World {
    pub(crate) network: Arc<Network>,
    pub(crate) navigator: Navigator,
    pub(crate) characters: Vec<Style>,
    pub(crate) clock: Clock,
    pub(crate) lanes: Vec<Lane>,
    pub(crate) plans: Vec<Plan>,
    pub(crate) busy: Busy,
    pub(crate) passages: Passages,
    pub(crate) signals: Signals,
    pub(crate) records: Records,
    pub(crate) trips: Trips,
    /// Where trips are recorded.
    pub(crate) journal: Option<Journal>,
    /// There too, what happens on the lanelets.
    pub(crate) ledger: Option<Ledger>,
    pub(crate) events: Vec<Event>,
    /// Who touches whom.
    pub(crate) touching: Touching,
    /// Whether it is looked for overlaps at every step.
    is_audited: bool,
    pub(crate) counts: Counts,
    /// One for each thread.
    pub(crate) outboxes: Vec<Outbox>,
    pub(crate) demand: Demand,
    pub(crate) sources: Vec<Source>,
    /// Where roads lead in rings.
    pub(crate) metering: Option<Metering>,
    pub(crate) random: Random,
    /// Where drivers are guided.
    pub(crate) guidance: Option<Guidance>,
    /// All threads, and one alone for steps too short to share.
    pools: [Pool; 2],
    /// Vehicles on the road.
    pub(crate) crowd: usize,
    pub(crate) next_id: VehicleId,
}

/// Counts of what the whole world, not a lane, does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Counts {
    /// Vehicles that entered.
    pub entered: u64,
    /// Vehicles that left.
    pub left: u64,
    /// Lane changes between lanes of equal worth for the route.
    pub discretionary_changes: u64,
    /// Lane changes for the route, or off it.
    pub route_changes: u64,
    /// Time on the map of those that left [s].
    pub trip_time: f64,
    /// Times that those that left came to a halt.
    pub stops: u64,
    /// Of those that left, those who had somewhere to go.
    pub planned: u64,
    /// What their trips took beyond the time on a free road, at the speeds that they desired, of the way that they had
    /// before them when they entered [s].
    pub delay: f64,
    /// The first incident, if there was any.
    pub first_incident: Option<Incident>,
}

/// How a world is to run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setup {
    /// Length of a step [s].
    pub step: f64,
    /// Seed of all draws.
    pub seed: u64,
    /// Number of threads.
    pub threads: usize,
}

/// A vehicle as it is put on the road.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewVehicle {
    /// The chain.
    pub chain: ChainIndex,
    /// Front bumper along it [m].
    pub x: f64,
    /// Speed [m/s].
    pub speed: f64,
    /// Class.
    pub class: Class,
    /// Its driver's place in the table of characters.
    pub character: u32,
    /// Where it goes.
    pub destination: Destination,
}

impl World {
    /// An empty world on `network`, whose drivers come from `demand` with the given `characters`.
    ///
    /// # Errors
    /// If the step is not between 0.01 and 1 s, there are no characters, the demand is no demand, or has too many destinations.
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
        let views = Views::of(&network, &demand.fleet);
        let navigator = Navigator::with_views(&network, &demand.destinations, views);
        let metering = Metering::new(&network);
        let random = Random::new(setup.seed);
        let clock = Clock { step: 0, dt: setup.step };
        let lanes = vec![Lane::default(); network.chains.len()];
        let plans = lanes.iter().map(|_| Plan::default()).collect();
        Ok(World {
            sources: Source::all(&network, &navigator, &demand, &random),
            clock,
            pools: [Pool::new(setup.threads), Pool::new(1)],
            busy: Busy::none_of(lanes.len()),
            crowd: 0,
            passages: Passages::new(&network),
            signals: Signals::new(&network, clock),
            metering,
            network,
            navigator,
            characters,
            lanes,
            plans,
            demand,
            random,
            guidance: None,
            records: Records::default(),
            trips: Trips::default(),
            journal: None,
            ledger: None,
            events: Vec::new(),
            touching: Touching::default(),
            is_audited: false,
            counts: Counts::default(),
            outboxes: (0..setup.threads.max(1)).map(|_| Outbox::default()).collect(),
            next_id: 0,
        })
    }

    /// The same world with drivers guided by travel times that are measured in it every `interval` [s]. Where nobody has
    /// a choice of ways there is nothing to guide.
    ///
    /// # Errors
    /// If there are more destinations than can be guided to, or their ways would not fit into memory.
    pub fn guided(mut self, interval: f64) -> Result<World, WorldError> {
        if self.navigator.offers_a_choice() {
            let destinations = &self.demand.destinations;
            let chains = self.network.chains.len();
            if destinations.len() * chains * Navigator::WAYS > Navigator::MOST_WAYPOINTS {
                return Err(WorldError::Ways { destinations: destinations.len(), chains });
            }
            let guided = self.navigator.guide(&self.network, destinations);
            guided.map_err(|most| WorldError::Destinations(destinations.len(), most))?;
            self.guidance = Some(Guidance::new(self.navigator.links(), self.clock.steps(interval)));
        }
        Ok(self)
    }

    /// The same world, which records every trip until it ends, and what vehicles do on every lanelet.
    pub fn with_journal(mut self) -> World {
        self.journal = Some(Journal::default());
        self.ledger = Some(Ledger::new(&self.network));
        self
    }

    /// The same world, in which it is looked for overlaps at every step, not only once a second.
    pub fn audited(mut self) -> World {
        self.is_audited = true;
        self
    }

    /// One step: everybody perceives, decides and accelerates on one snapshot; then all move; what concerns two
    /// lanes is resolved in order; vehicles enter; drivers are guided.
    pub fn step(&mut self) {
        self.events.clear();
        let is_watched = self.is_watched();
        self.move_all(is_watched);
        self.clock.step += 1;
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

    /// Everybody perceives, decides and drives on what all see; then what was resolved is carried out.
    fn move_all(&mut self, is_watched: bool) {
        let World {
            network,
            navigator,
            characters,
            clock,
            random,
            lanes,
            plans,
            busy,
            passages,
            signals,
            outboxes,
            ..
        } = self;
        let chosen = busy.chosen();
        let (passages, signals) = (&*passages, &*signals);
        let (network, navigator, characters) = (&**network, &*navigator, &characters[..]);
        let moment = Moment { clock: *clock, random: *random, overtaking: network.driving_side.overtaking() };
        self.pools[pool_for(self.crowd)].look_then_act(
            outboxes,
            lanes,
            plans,
            chosen,
            |lanes, outbox, index, plan| {
                let scene = Scene { network, navigator, lanes, characters, passages, signals };
                let chain = ChainIndex(index as u32);
                plan.clear();
                decide(&scene, moment, chain, plan, outbox);
                drive(&scene, moment.clock, chain, plan, outbox);
                appeal(&scene, moment.clock, chain, plan, outbox);
                if is_watched {
                    overlaps(&scene, chain, moment.clock.time(), &mut outbox.incidents);
                }
            },
            |lane, outbox, index, plan| {
                let chain = ChainIndex(index as u32);
                let ends = Ends { length: network.chain(chain).length, trips: navigator.trip_ends(chain) };
                advance(lane, chain, ends, moment.clock, characters, plan, outbox);
            },
        );
    }

    /// Puts a vehicle on the road outside of the demand, and names it. Its place must be free.
    pub fn place(&mut self, vehicle: NewVehicle) -> VehicleId {
        let id = self.next_id;
        self.next_id += 1;
        self.put(vehicle, id, self.clock.time());
        id
    }

    /// Puts a vehicle on the road that came at the time `arrived` [s].
    pub(crate) fn put(&mut self, vehicle: NewVehicle, id: VehicleId, arrived: f64) {
        let NewVehicle { chain, x, speed, class, character, destination } = vehicle;
        let style = &self.characters[character as usize];
        let body = class.body();
        let desired = class.desired_speed(style, self.network.chain(chain).limit(x)) as f32;
        let period = self.clock.steps(style.attention.epoch);
        let destination = self.navigator.seen_by(class, destination);
        let desires = |limit| class.desired_speed(style, limit);
        let free_time = free_time(&self.network, &self.navigator, destination, (chain, x), desires);
        self.trips.begin(id, free_time);
        if let Some(journal) = &mut self.journal {
            let entered = self.clock.time();
            let destination = self.navigator.number(destination);
            journal.begin(TripRecord {
                arrived,
                entered,
                from: (chain, x),
                speed,
                destination,
                free_time,
                mark: Mark { x, time: entered },
                ..TripRecord::of(id, class, character)
            });
        }
        let motion = Motion { x, speed, acceleration: 0.0, tightness: 1.0, length: body.length as f32, id };
        let car = Car {
            desired,
            limit_desired: desired,
            standing: 0.0,
            character,
            due: next_turn(id, self.clock.step, period),
            calm_until: 0,
            goal: destination.into(),
            class,
            phase: Phase::Cruises,
            is_shadow: false,
            in_emergency: false,
            heeds_more: false,
        };
        let mind = Mind {
            side: self.network.driving_side.overtaking(),
            kind: Kind::Discretionary,
            entered: self.clock.step,
            since: 0,
            stretch: 1.0,
            progress: 0.0,
            urgency: 0.0,
            record: 0,
            trail: Trail::NONE,
            twin: None,
            last_place: f64::INFINITY,
            lets_in: Mind::NOBODY,
            passage: NO_PASSAGE,
        };
        self.insert(chain, Entry { motion, car, mind });
        self.counts.entered += 1;
        self.crowd += 1;
    }

    /// Adds an entry to the lane of `chain`.
    pub(crate) fn insert(&mut self, chain: ChainIndex, entry: Entry) {
        self.busy.note(chain);
        self.lanes[chain.at()].insert(entry);
    }

    /// What is done once a second is done now.
    pub(crate) fn begins_a_second(&self) -> bool {
        self.clock.step.is_multiple_of(self.clock.steps(1.0))
    }

    /// Overlaps are looked for once a second; in an audit at every step.
    fn is_watched(&self) -> bool {
        self.is_audited || self.begins_a_second()
    }

    /// The current instant.
    pub fn scene(&self) -> Scene<'_> {
        Scene {
            network: &self.network,
            navigator: &self.navigator,
            lanes: &self.lanes,
            characters: &self.characters,
            passages: &self.passages,
            signals: &self.signals,
        }
    }

    /// All different drivers.
    pub fn characters(&self) -> &[Style] {
        &self.characters
    }

    /// Gives the drivers other characters, each in the place of its own. What they are about they go on with.
    ///
    /// # Errors
    /// If there are not as many of them.
    pub fn change_characters(&mut self, characters: Vec<Style>) -> Result<(), WorldError> {
        let [found, expected] = [characters.len(), self.characters.len()];
        if found != expected {
            return Err(WorldError::Characters { found, expected });
        }
        self.characters = characters;
        Ok(())
    }

    /// The record of the trip of a vehicle on the road, where trips are recorded.
    pub fn trip(&self, id: VehicleId) -> Option<&TripRecord> {
        self.journal.as_ref()?.of(id)
    }

    /// What happened in the last step.
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// The clock.
    pub fn clock(&self) -> Clock {
        self.clock
    }

    /// The roads.
    pub fn network(&self) -> &Network {
        &self.network
    }

    /// The roads, for those who need them beyond the world: they never change.
    pub fn shared_network(&self) -> Arc<Network> {
        Arc::clone(&self.network)
    }

    /// Who comes, from where and to where.
    pub fn demand(&self) -> &Demand {
        &self.demand
    }

    /// Where its demand leads on average between two times [s].
    pub fn assignment(&self, during: [f64; 2]) -> Assignment {
        Assignment::new(&self.network, &self.navigator, &self.demand, during)
    }

    /// Whether drivers from an origin of the demand can reach one of its destinations, and would drive there.
    pub fn leads(&self, origin: usize, destination: usize) -> bool {
        let place = &self.demand.origins[origin].place;
        self.navigator.leads(&self.network, place, destination as u16)
    }

    /// What the drivers did so far, added up over threads, and distances over the lanes.
    pub fn tally(&self) -> Tally {
        Tally { distance: self.plans.iter().map(|it| it.distance).sum(), ..self.counted() }
    }

    /// The same without distances.
    pub(crate) fn counted(&self) -> Tally {
        let mut sum = Tally::default();
        self.outboxes.iter().for_each(|it| sum.add(&it.tally));
        sum
    }

    /// What the world did so far.
    pub fn counts(&self) -> &Counts {
        &self.counts
    }

    /// Forgets all counts: what follows is measured, what was before is warm-up. Vehicles on the road count as entered.
    pub fn reset_counts(&mut self) {
        self.plans.iter_mut().for_each(|it| it.distance = 0.0);
        self.outboxes.iter_mut().for_each(|it| it.tally = Tally::default());
        self.counts = Counts { entered: self.on_road() as u64, ..Counts::default() };
        self.put_down();
        self.ledger = self.ledger.as_ref().map(|_| Ledger::new(&self.network));
    }

    /// Puts down what vehicles did on the lanelets up to now, where trips are recorded.
    fn put_down(&mut self) {
        if let (Some(ledger), Some(journal)) = (&mut self.ledger, &mut self.journal) {
            ledger.look(&self.network, &self.lanes, journal, self.clock);
        }
    }

    /// What vehicles did on each lanelet since the counts were last forgotten, where trips are recorded.
    pub fn stays(&self) -> Vec<Stay> {
        let (Some(mut ledger), Some(mut journal)) = (self.ledger.clone(), self.journal.clone()) else {
            return Vec::new();
        };
        // Up to now, without a note of it: what is put down later does not depend on who asked.
        ledger.look(&self.network, &self.lanes, &mut journal, self.clock);
        ledger.stays
    }

    /// Vehicles on the road.
    pub fn on_road(&self) -> usize {
        self.lanes.iter().map(|lane| lane.cars().iter().filter(|car| !car.is_shadow).count()).sum()
    }

    /// Whether its steps are shared among all its threads: where few vehicles drive, one moves them all.
    pub fn moves_on_all_threads(&self) -> bool {
        self.pools[pool_for(self.crowd)].threads() > 1
    }

    /// Vehicles that wait to enter.
    pub fn waiting(&self) -> usize {
        self.sources.iter().map(Source::waiting).sum()
    }

    /// Vehicles that have arrived, whether they entered or wait.
    pub fn arrived(&self) -> u64 {
        self.sources.iter().map(Source::arrived).sum()
    }

    /// All vehicles, by chain and in driving order.
    pub fn vehicles(&self) -> impl Iterator<Item = Vehicle<'_>> {
        self.lanes.iter().enumerate().flat_map(move |(index, lane)| {
            let chain = ChainIndex(index as u32);
            let entries = lane.motions().iter().zip(lane.cars()).enumerate();
            entries.filter(|(_, (_, car))| !car.is_shadow).map(move |(index, (motion, car))| {
                let (spot, mind) = (Spot { chain, index }, &lane.minds()[index]);
                Vehicle { world: self, spot, motion, car, mind }
            })
        })
    }

    /// Hash of (id, lanelet, position, speed, state) of all vehicles in the order of their ids.
    pub fn state_hash(&self) -> u64 {
        let mut vehicles: Vec<Vehicle> = self.vehicles().collect();
        vehicles.sort_by_key(Vehicle::id);
        let mut hash = Xxh3::new();
        for vehicle in vehicles {
            let (lanelet, along) = self.network.lanelet_at(vehicle.spot.chain, vehicle.x());
            hash.update(&vehicle.id().to_le_bytes());
            hash.update(&lanelet.id.to_le_bytes());
            hash.update(&along.to_bits().to_le_bytes());
            hash.update(&vehicle.speed().to_bits().to_le_bytes());
            hash.update(&[vehicle.car.phase as u8]);
        }
        hash.digest()
    }
}

/// Which pool moves so many vehicles: a step of fewer is over before another thread has begun.
fn pool_for(crowd: usize) -> usize {
    const WORTH_SHARING: usize = 300;
    usize::from(crowd < WORTH_SHARING)
}

/// A vehicle on the road.
#[derive(Clone, Copy)]
pub struct Vehicle<'a> {
    world: &'a World,
    /// Where its main entry stands.
    pub spot: Spot,
    /// How it moves.
    pub motion: &'a Motion,
    /// Its driver's hot part.
    pub car: &'a Car,
    /// Its driver's warm part.
    pub mind: &'a Mind,
}

impl Vehicle<'_> {
    /// Who it is.
    pub fn id(&self) -> VehicleId {
        self.motion.id
    }

    /// Front bumper along its chain [m].
    pub fn x(&self) -> f64 {
        self.motion.x
    }

    /// Speed [m/s].
    pub fn speed(&self) -> f64 {
        self.motion.speed
    }

    /// Where its body is.
    pub fn pose(&self) -> Pose {
        pose(&self.world.scene(), self.spot)
    }

    /// The middles of its front and its rear bumper.
    pub fn bumpers(&self) -> [Point; 2] {
        bumpers(&self.world.scene(), self.spot)
    }

    /// How far it is to the left of the centre of its lane [m].
    pub fn lateral_offset(&self) -> f64 {
        lateral_offset(&self.world.scene(), self.spot)
    }

    /// Its driver's style.
    pub fn style(&self) -> &Style {
        &self.world.characters[self.car.character as usize]
    }
}
