//! Vehicles of lines serve their stops: they brake gently for a stop, rest there with the door open, and go on to the
//! next one. Others see who rests as something that stands in the lane. Who could not get to a stop in time goes on.

use laneweave_network::Position;

use crate::demand::line::{Line, LineStop};
use crate::state::control::{Control, Lateral, Longitudinal};
use crate::state::externals::{Kind, Service};
use crate::state::lane::VehicleId;
use crate::step::carry_out::CarryingOut;
use crate::view::scene::Spot;

/// A driver brakes for a stop at this deceleration [m/s²], comfortable for people who stand (ours).
const BRAKING: f64 = 1.0;
/// Who stands within this distance before the stop serves it [m] (ours).
const NEAR: f64 = 3.0;
/// Who is nearer to the stop than this stops at once [m] (ours).
const THERE: f64 = 0.3;

/// What a vehicle of a line does next.
enum Next {
    /// It drives as its driver does.
    Drives,
    /// It drives no faster than this [m/s].
    Slows(f64),
    /// It begins to rest.
    Rests,
    /// It drives on, after it has served the stop or could not.
    GoesOn { has_served: bool },
    /// Its present control stays.
    Stays,
}

/// The speed from which a vehicle brakes for a stop that is `left` ahead [m/s].
pub(super) fn speed_before(left: f64) -> f64 {
    (2.0 * BRAKING * left.max(0.0)).sqrt()
}

/// Lets the vehicles of lines serve their stops.
pub(super) fn serve_stops(carrying_out: &mut CarryingOut) {
    let services = carrying_out.traffic.externals().all().iter();
    let services: Vec<(VehicleId, Service)> = services
        .filter_map(|it| if let Kind::Line(service) = it.kind { Some((it.id, service)) } else { None })
        .collect();
    for (id, service) in services {
        let next = next(carrying_out, id, service);
        carry_on(carrying_out, id, service, next);
    }
}

/// What the vehicle does next.
fn next(carrying_out: &CarryingOut, id: VehicleId, service: Service) -> Next {
    let clock = carrying_out.traffic.clock();
    if let Some(until) = service.rests_until {
        return if clock.step >= until { Next::GoesOn { has_served: true } } else { Next::Stays };
    }
    let lines = &carrying_out.arrivals.demand().lines;
    if usize::from(service.stops) >= lines[usize::from(service.line)].stops.len() {
        return Next::Drives;
    }
    let Some((left, spot)) = left(carrying_out, id, &lines[usize::from(service.line)], service) else {
        // Its reservation is for the way to this stop.
        let keeps_way = carrying_out.has_reservation(id);
        return if keeps_way { Next::Drives } else { Next::GoesOn { has_served: false } };
    };
    let lane = carrying_out.traffic.lane(spot.chain);
    let (speed, is_between_lanes) =
        (lane.motions()[spot.index].speed, lane.drivers()[spot.index].phase.is_between_lanes());
    let fastest = speed_before(left);
    match () {
        () if left < -NEAR => Next::GoesOn { has_served: false },
        () if speed == 0.0 && left < NEAR && !is_between_lanes => Next::Rests,
        () if left < THERE && !is_between_lanes => Next::Slows(0.0),
        () if is_between_lanes => Next::Slows(fastest.max(1.0)),
        () => Next::Slows(fastest),
    }
}

/// The way that a vehicle has left to its next stop [m], and its entry; `None` if it can no longer get there in time on
/// its route.
fn left(carrying_out: &CarryingOut, id: VehicleId, line: &Line, service: Service) -> Option<(f64, Spot)> {
    let CarryingOut { roads, traffic, .. } = carrying_out;
    let Position { chain, x } = traffic.externals().of(id)?.at;
    let lane = traffic.lane(chain);
    let index = lane.find(id, x)?;
    let (navigator, number) = (roads.navigator(), line.goal(service.stops));
    // It may follow another route there than the usual one.
    let own = lane.drivers()[index].goal.destination();
    let is_there = navigator.number(own) == Some(usize::from(number));
    let to = if is_there { own } else { navigator.seen_by(line.class, Some(number)) };
    let waypoint = navigator.waypoint(to, chain);
    let left = waypoint.distance - x - LineStop::MARGIN;
    waypoint.leads_on(x).then_some((left, Spot { chain, index }))
}

/// Does what comes `next`.
fn carry_on(carrying_out: &mut CarryingOut, id: VehicleId, service: Service, next: Next) {
    let clock = carrying_out.traffic.clock();
    let slows =
        |speed| Control::Drive { longitudinal: Longitudinal::AtMost(speed), lateral: Lateral::Driver };
    match next {
        Next::Stays => {}
        Next::Drives => carrying_out.direct(id, service, Control::DRIVER),
        Next::Slows(speed) => carrying_out.direct(id, service, slows(speed.min(Control::FASTEST))),
        Next::Rests => {
            let demand = carrying_out.arrivals.demand();
            let stop = &demand.lines[usize::from(service.line)].stops[usize::from(service.stops)];
            let has_rested = clock.step + clock.steps(stop.rest_s);
            let goes_on = stop.until_s.map_or(0, |it| (it / clock.dt).ceil() as u32);
            let rests_until = Some(has_rested.max(goes_on));
            let rests = Control::Drive { longitudinal: Longitudinal::Speed(0.0), lateral: Lateral::Keep };
            carrying_out.direct(id, Service { rests_until, ..service }, rests);
        }
        Next::GoesOn { has_served } => {
            let service = Service { stops: service.stops + 1, rests_until: None, ..service };
            let goal = carrying_out.arrivals.demand().lines[usize::from(service.line)].goal(service.stops);
            carrying_out.direct(id, service, Control::DRIVER);
            carrying_out.set_destination(id, Some(goal));
            carrying_out.arrivals.count_stop(usize::from(service.line), has_served);
        }
    }
}
