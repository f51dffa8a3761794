//! Vehicles are put on the road.

use laneweave_network::ChainIndex;

use crate::demand::error::WorldError;
use crate::driver::turn::next_turn;
use crate::junction::passages::NO_PASSAGE;
use crate::record::journal::TripRecord;
use crate::record::ledger::Mark;
use crate::record::trips::free_time;
use crate::state::setup::NewVehicle;
use crate::state::traffic::{Car, Entry, Kind, Mind, Motion, Phase, VehicleId};
use crate::state::trail::Trail;
use crate::step::world::World;

impl World {
    /// Puts a vehicle on the road outside of the demand, and names it. Its place must be free.
    ///
    /// # Errors
    /// If it is not on a chain of the network, its speed is no number from 0 on, or there is no such character or
    /// destination.
    pub fn place(&mut self, vehicle: NewVehicle) -> Result<VehicleId, WorldError> {
        self.check_new(&vehicle)?;
        let id = self.arrivals.next_id;
        self.arrivals.next_id += 1;
        self.put(vehicle, id, self.traffic.clock.time());
        Ok(id)
    }

    fn check_new(&self, vehicle: &NewVehicle) -> Result<(), WorldError> {
        let NewVehicle { chain, x, speed, class: _, character, destination } = *vehicle;
        let length = self.roads.network.chains.get(chain.at()).map(|it| it.length);
        let refused = [
            (length.is_none(), "there is no such chain"),
            (!length.is_some_and(|it| (0.0..=it).contains(&x)), "it would not be on its chain"),
            (!(speed.is_finite() && speed >= 0.0), "its speed is no number from 0 on"),
            (self.roads.characters.len() <= character as usize, "there is no such character"),
            (
                destination.is_some_and(|it| usize::from(it) >= self.arrivals.demand.destinations.len()),
                "there is no such destination",
            ),
        ];
        refused.into_iter().find(|it| it.0).map_or(Ok(()), |it| Err(WorldError::Vehicle(it.1)))
    }

    /// Puts a vehicle on the road that came at the time `arrived` [s].
    pub(crate) fn put(&mut self, vehicle: NewVehicle, id: VehicleId, arrived: f64) {
        let NewVehicle { chain, x, speed, class, character, destination } = vehicle;
        let style = &self.roads.characters[character as usize];
        let body = class.body();
        let desired = class.desired_speed(style, self.roads.network.chain(chain).limit(x)) as f32;
        let period = self.traffic.clock.steps(style.attention.epoch);
        let destination = self.roads.navigator.seen_by(class, destination);
        let desires = |limit| class.desired_speed(style, limit);
        let free_time =
            free_time(&self.roads.network, &self.roads.navigator, destination, (chain, x), desires);
        self.log.trips.begin(id, free_time);
        if let Some(journal) = &mut self.log.journal {
            let entered = self.traffic.clock.time();
            let destination = self.roads.navigator.number(destination);
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
            due: next_turn(id, self.traffic.clock.step, period),
            calm_until: 0,
            goal: destination.into(),
            class,
            phase: Phase::Cruises,
            is_shadow: false,
            in_emergency: false,
            needs_full_update: false,
        };
        let mind = Mind {
            side: self.roads.network.driving_side.overtaking(),
            kind: Kind::Discretionary,
            entered: self.traffic.clock.step,
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
        self.log.counts.entered += 1;
        self.traffic.crowd += 1;
    }

    /// Adds an entry to the lane of `chain`.
    pub(crate) fn insert(&mut self, chain: ChainIndex, entry: Entry) {
        self.traffic.busy.note(chain);
        self.traffic.lanes[chain.at()].insert(entry);
    }
}
