//! Vehicles are placed on the road.

use crate::demand::error::WorldError;
use crate::driver::turn::next_turn;
use crate::junction::reservations::NO_RESERVATION;
use crate::record::lanelet_aggregates::Mark;
use crate::record::log::Log;
use crate::record::trip_log::TripRecord;
use crate::record::trips::free_time;
use crate::route::fitting_speed::Outlook;
use crate::route::roads::Roads;
use crate::state::clock::Clock;
use crate::state::lane::{DriverState, Entry, Kinematics, LaneChangeKind, LaneChangeState, Phase, VehicleId};
use crate::state::previous_lanes::PreviousLanes;
use crate::state::setup::Placement;
use crate::state::traffic::Traffic;
use crate::step::world::World;
use laneweave_network::Position;

impl World {
    /// Places a vehicle on the road outside of the demand. Its place must be free. Returns its id.
    ///
    /// # Errors
    /// If it is not on a chain of the network, its speed is negative or no number, or there are no such driver
    /// parameters or destination.
    pub fn place(&mut self, vehicle: Placement) -> Result<VehicleId, WorldError> {
        self.index.forget();
        let World { roads, traffic, arrivals, log, .. } = self;
        check_new(roads, arrivals.demand().destinations.len(), &vehicle)?;
        let id = arrivals.new_id();
        let now = traffic.clock().time();
        put(roads, traffic, log, vehicle, Named { id, arrived: now });
        Ok(id)
    }
}

fn check_new(roads: &Roads, destinations: usize, vehicle: &Placement) -> Result<(), WorldError> {
    let Placement { chain, x, speed, class: _, parameters, destination } = *vehicle;
    let length = roads.network().chains.get(chain.at()).map(|it| it.length);
    let refused = [
        (length.is_none(), "there is no such chain"),
        (!length.is_some_and(|it| (0.0..=it).contains(&x)), "it would not be on its chain"),
        (!(speed.is_finite() && speed >= 0.0), "its speed is no number from 0 on"),
        (roads.driver_parameters().len() <= parameters as usize, "there are no such driver parameters"),
        (destination.is_some_and(|it| usize::from(it) >= destinations), "there is no such destination"),
    ];
    refused.into_iter().find(|it| it.0).map_or(Ok(()), |it| Err(WorldError::Vehicle(it.1)))
}

/// The id and the arrival of a vehicle.
#[derive(Clone, Copy)]
pub(crate) struct Named {
    pub(crate) id: VehicleId,
    /// Time of its arrival [s].
    pub(crate) arrived: f64,
}

/// Places a vehicle on the road.
pub(crate) fn put(
    roads: &Roads,
    traffic: &mut Traffic,
    log: &mut Log,
    vehicle: Placement,
    Named { id, arrived }: Named,
) {
    let Placement { chain, x, speed, class, parameters, destination } = vehicle;
    let (network, navigator, clock) = (roads.network(), roads.navigator(), traffic.clock());
    let destination = navigator.seen_by(class, destination);
    let style = roads.style(parameters);
    let outlook = Outlook { network, navigator, style, class, destination };
    let at = Position::new(chain, x);
    let free_time = free_time(&outlook, at);
    log.begin_trip(id, free_time, || TripRecord {
        arrived,
        entered: clock.time(),
        from: at,
        speed,
        destination: navigator.number(destination),
        free_time,
        mark: Mark { x, time: clock.time() },
        ..TripRecord::of(id, class, parameters)
    });
    traffic.enter(chain, entry(roads, clock, &vehicle, id));
}

/// The entry of a new vehicle.
pub(super) fn entry(roads: &Roads, clock: Clock, vehicle: &Placement, id: VehicleId) -> Entry {
    let Placement { chain, x, speed, class, parameters, destination } = *vehicle;
    let style = roads.style(parameters);
    let (network, navigator) = (roads.network(), roads.navigator());
    let outlook = Outlook { network, navigator, style, class, destination };
    let at = Position::new(chain, x);
    let length = class.body().length as f32;
    let motion = Kinematics { x, speed, acceleration: 0.0, headway_relaxation: 1.0, length, id };
    let due = next_turn(id, clock.step, clock.steps(style.attention.epoch));
    let desired = outlook.until_turn(at, speed, due, clock);
    let driver = DriverState {
        desired,
        limit_desired: desired,
        standing: 0.0,
        parameters,
        due,
        cooldown_until: 0,
        goal: destination.into(),
        class,
        phase: Phase::Cruises,
        is_shadow: false,
        in_emergency: false,
        needs_full_update: false,
        is_external: false,
    };
    let lane_change = LaneChangeState {
        side: network.driving_side.overtaking(),
        kind: LaneChangeKind::Discretionary,
        entered: clock.step,
        since: 0,
        stretch: 1.0,
        progress: 0.0,
        urgency: 0.0,
        record: 0,
        previous_lanes: PreviousLanes::NONE,
        counterpart: None,
        last_place: f64::INFINITY,
        lets_in: LaneChangeState::NOBODY,
        minds_offside: false,
        reservation: NO_RESERVATION,
    };
    Entry { motion, driver, lane_change }
}
