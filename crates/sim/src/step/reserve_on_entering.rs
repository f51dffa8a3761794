//! Entrances within conflict areas: a vehicle enters the road there with a reservation of the zones in which it would
//! stand. Until then it holds nothing: nobody on the road waits for it.

use laneweave_models::follow::Ahead;
use laneweave_network::{Position, ZoneKind};

use crate::demand::source::{Arrival, Queue, Start};
use crate::junction::need::Survey;
use crate::junction::reservations::Reservations;
use crate::junction::waiting_priority::ZoneReservation;
use crate::right_of_way::applicant::Applicant;
use crate::right_of_way::approach::{LONG, lets_go};
use crate::right_of_way::may_pass::{Asking, PassHindrance, leader_of, may_pass};
use crate::right_of_way::mergers::are_led_on;
use crate::right_of_way::survey::{STANDS_BEFORE_A_ZONE, survey};
use crate::route::fitting_speed::Outlook;
use crate::state::clock::Clock;
use crate::state::traffic::Traffic;
use crate::view::scene::{Scene, Viewpoint};

/// A vehicle waits for its reservation this far before the road [m].
const WAITS_BEFORE: f64 = STANDS_BEFORE_A_ZONE;

/// What a vehicle needs to enter the road, besides a gap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Entry {
    /// Nothing: it would stand in no zone.
    Free,
    /// The surveyed reservation.
    Reserved {
        /// End of the reservation, from the start of the lane [m].
        until: f64,
        /// The vehicle that goes first into the same merge, seen from the entering vehicle's front.
        ahead: Option<Ahead>,
    },
    /// It cannot enter now, for this reason.
    Refused(PassHindrance),
}

/// The vehicle of `arrival` as an applicant that waits before the lane of `queue`.
pub(crate) fn applicant<'a>(scene: &Scene<'a>, queue: &Queue, arrival: &Arrival) -> Applicant<'a> {
    let Arrival { id, class, length, parameters, destination, .. } = *arrival;
    let style = &scene.driver_parameters[parameters as usize];
    let Scene { network, navigator, .. } = *scene;
    let outlook = Outlook { network, navigator, style, class, destination };
    let desired = outlook.fitting_speed(Position::new(queue.chain, 0.0), 0.0);
    let x = queue.start.station() - WAITS_BEFORE;
    let from = Viewpoint { chain: queue.chain, x, ahead: 0, id, destination, class };
    Applicant { from, length, speed: desired, desired, style, reservation: None }
}

/// What `arrival` needs to enter the lane of `queue` now.
pub(crate) fn entry(
    scene: &Scene,
    queue: &Queue,
    arrival: &Arrival,
    clock: Clock,
    out: &mut Survey,
) -> Entry {
    let length = arrival.length;
    let reach = WAITS_BEFORE + length + STANDS_BEFORE_A_ZONE;
    let [first_place, _] = scene.network.junctions.places(queue.chain);
    if queue.start != Start::Driving(0.0) || first_place > reach {
        return Entry::Free;
    }
    let mut applicant = applicant(scene, queue, arrival);
    if !survey(scene, &applicant, [0.0, reach], |light, at| !lets_go(scene, light, at, applicant.speed), out)
    {
        return Entry::Free;
    }
    if out.has_stop_sign {
        applicant.speed = 0.0;
        out.stop = 0.0;
    }
    let asking = Asking::of(&applicant, queue.asks_since.unwrap_or(clock.step), clock);
    let may = may_pass(scene, &applicant, out, asking);
    match may {
        Err(why) => Entry::Refused(why),
        Ok(()) if !is_free(scene, out, reach) || !are_led_on(scene, &applicant, out) => {
            Entry::Refused(PassHindrance::Others)
        }
        Ok(()) => {
            let first = leader_of(scene, out, length >= LONG);
            let ahead = first.map(|it| Ahead { gap: it.gap - WAITS_BEFORE - length, ..it });
            let until = first_taken(scene, out).min(out.extent) - WAITS_BEFORE;
            Entry::Reserved { until, ahead }
        }
    }
}

/// Whether no other vehicle may pass the crossings that begin within `reach` [m]. The entering vehicle stands in them
/// at once.
fn is_free(scene: &Scene, surveyed: &Survey, reach: f64) -> bool {
    first_taken(scene, surveyed) > reach
}

/// Position of the first surveyed crossing that others pass first [m]; infinite if there is none.
fn first_taken(scene: &Scene, surveyed: &Survey) -> f64 {
    /// Distance before the place where vehicles stop for a crossing [m].
    const BEFORE: f64 = 0.01;
    let waits = |hold: &&ZoneReservation| {
        let is_crossing = scene.network.junctions.zones[hold.zone.at()].kind == ZoneKind::Crossing;
        is_crossing && scene.reservations.order(hold.zone).any(|(it, _)| it.side != hold.side)
    };
    let taken = surveyed.holds.iter().filter(waits).map(|it| it.enter - BEFORE);
    taken.fold(f64::INFINITY, f64::min)
}

/// Grants the surveyed reservation to the vehicle that has just entered the road.
pub(crate) fn reserve(
    traffic: &mut Traffic,
    reservations: &mut Reservations,
    queue: &Queue,
    arrival: &Arrival,
    out: &Survey,
) {
    let (step, length) = (traffic.clock().step, arrival.length);
    let lane = traffic.lane_mut(queue.chain);
    let Some(index) = lane.find(arrival.id, length) else { return };
    let (motion, driver, lane_change) = lane.entry_mut(index);
    lane_change.reservation = reservations.grant(lane_change.reservation, arrival.id, length, out);
    reservations.note_since(lane_change.reservation, queue.asks_since.unwrap_or(step));
    driver.needs_full_update = true;
    let (speed, desired) = (motion.speed, f64::from(driver.desired));
    reservations.advance(lane_change.reservation, WAITS_BEFORE + length, speed, desired);
}
