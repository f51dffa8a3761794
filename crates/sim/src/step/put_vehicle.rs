//! Vehicles come onto the road.

use crate::driver::consider::last_place;
use crate::driver::turn::next_turn;
use crate::junction::reservations::NO_RESERVATION;
use crate::record::lanelet_aggregates::Mark;
use crate::record::log::Log;
use crate::record::trip_log::TripRecord;
use crate::record::trips::free_time;
use crate::route::fitting_speed::Outlook;
use crate::route::roads::Roads;
use crate::state::clock::Clock;
use crate::state::control::Control;
use crate::state::externals::{External, Kind, Service};
use crate::state::lane::{DriverState, Entry, Kinematics, LaneChangeKind, LaneChangeState, Phase, VehicleId};
use crate::state::previous_lanes::PreviousLanes;
use crate::state::setup::Placement;
use crate::state::traffic::Traffic;
use laneweave_network::Position;

/// The id and the arrival of a vehicle, and what else the demand says of it.
#[derive(Clone, Copy)]
pub(crate) struct Named {
    pub(crate) id: VehicleId,
    /// Time of its arrival [s].
    pub(crate) arrived: f64,
    /// Length [m].
    pub(crate) length: f64,
    /// The line that it serves.
    pub(crate) line: Option<u16>,
}

/// Places a vehicle on the road.
pub(crate) fn put(
    roads: &Roads,
    traffic: &mut Traffic,
    log: &mut Log,
    vehicle: Placement,
    Named { id, arrived, length, line }: Named,
) {
    let Placement { chain, x, speed, class, parameters, destination } = vehicle;
    let (network, navigator, clock) = (roads.network(), roads.navigator(), traffic.clock());
    let destination = navigator.seen_by(class, destination);
    let style = roads.style(parameters);
    let outlook = Outlook { network, navigator, style, class, destination };
    let at = Position::new(chain, x);
    // A vehicle of a line has its stops.
    let free_time = if line.is_some() { None } else { free_time(&outlook, at) };
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
    let mut new = entry(roads, clock, &Placement { destination, ..vehicle }, id);
    new.motion.length = length as f32;
    traffic.enter(chain, new);
    if let Some(line) = line {
        let kind = Kind::Line(Service { line, stops: 0, rests_until: None });
        traffic.externals_mut().add(External { kind, ..External::new(id, Control::DRIVER, at) });
    }
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
    let last_place = last_place(&navigator.waypoint_from(network, destination, chain, x), x);
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
        needs_full_update: last_place.is_finite(),
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
        gain: 0.0,
        record: 0,
        previous_lanes: PreviousLanes::NONE,
        counterpart: None,
        last_place,
        lets_in: LaneChangeState::NOBODY,
        minds_offside: false,
        reservation: NO_RESERVATION,
    };
    Entry { motion, driver, lane_change }
}
