//! Vehicles enter the road: at the edge of the map at the speed of the traffic, at a trip end inside the map from
//! rest.

use laneweave_models::Style;
use laneweave_models::braking::is_secure;
use laneweave_models::change::deceleration_to_avoid;
use laneweave_models::follow::{Ahead, CarFollowing, Pace};

use laneweave_network::{ChainIndex, Position};

use crate::demand::arrivals::Arrivals;
use crate::demand::line::LineStop;
use crate::demand::source::{Arrival, Queue, Start};
use crate::driver::perceive::driver_of;
use crate::driver::stopping::speed_before_a_stop;
use crate::junction::need::Survey;
use crate::junction::state::JunctionState;
use crate::record::log::Log;
use crate::right_of_way::approach::sight;
use crate::right_of_way::may_pass::PassHindrance;
use crate::right_of_way::survey::stop_ahead;
use crate::route::fitting_speed::Outlook;
use crate::route::roads::Roads;
use crate::state::setup::Placement;
use crate::state::traffic::Traffic;
use crate::step::put_vehicle::{Named, put};
use crate::step::reserve_on_entering::{Entry, applicant, entry, reserve};
use crate::step::serve_stops::speed_before;
use crate::step::work::Work;
use crate::view::scene::{Found, Scene, nearer};

/// Vehicles arrive, wait in queues, and enter where there is space.
pub(crate) fn enter(
    roads: &Roads,
    traffic: &mut Traffic,
    junctions: &mut JunctionState,
    arrivals: &mut Arrivals,
    log: &mut Log,
    work: &mut Work,
) {
    if traffic.clock().begins_a_second() {
        arrivals.measure(traffic.lanes());
    }
    let (is_full, time) = (arrivals.is_full(), traffic.clock().time());
    let survey = &mut work.outbox().survey;
    let mut entering = Entering { roads, traffic, junctions, log };
    arrivals.depart(&entering.scene(), &roads.random(), time);
    for origin in 0..arrivals.sources().len() {
        arrivals.arrive(origin, &entering.scene(), &roads.random(), time);
        for queue in arrivals.queues_mut(origin) {
            while let Some(place) = queue.first(is_full)
                && entering.let_in(origin, queue, place, survey)
            {}
        }
    }
}

/// What an entering vehicle changes, and what it depends on.
struct Entering<'a> {
    roads: &'a Roads,
    traffic: &'a mut Traffic,
    junctions: &'a mut JunctionState,
    log: &'a mut Log,
}

impl Entering<'_> {
    fn scene(&self) -> Scene<'_> {
        Scene::of(self.roads, self.traffic, self.junctions)
    }

    /// Lets the vehicle at a `place` of a queue enter, if there is space for it. Returns whether it entered.
    fn let_in(&mut self, origin: usize, queue: &mut Queue, place: usize, survey: &mut Survey) -> bool {
        let clock = self.traffic.clock();
        let needs = entry(&self.scene(), queue, &queue.waiting[place], clock, survey);
        if let Entry::Refused(PassHindrance::Others) = needs {
            queue.asks_since.get_or_insert(clock.step);
        }
        let admitted = admit(&self.scene(), clock.dt, queue, &queue.waiting[place], needs);
        if let Some(vehicle) = admitted
            && let Some(arrival) = queue.waiting.remove(place)
        {
            let Arrival { id, time: arrived, length, line, .. } = arrival;
            let named = Named { id, arrived, length, line };
            put(self.roads, self.traffic, self.log, vehicle, named);
            if matches!(needs, Entry::Reserved { .. }) {
                reserve(self.traffic, self.junctions.reservations_mut(), queue, &arrival, survey);
            }
            queue.asks_since = None;
            self.log.note_origin(arrival.id, origin);
        }
        admitted.is_some()
    }
}

/// The vehicle as it enters the lane of `queue`, if there is space and it has what it needs.
fn admit(scene: &Scene, dt: f64, queue: &Queue, arrival: &Arrival, needs: Entry) -> Option<Placement> {
    let (granted, before) = match needs {
        Entry::Refused(_) => return None,
        Entry::Free => (0.0, None),
        Entry::Reserved { until, ahead } => (until, ahead),
    };
    let Arrival { class, length, parameters, destination, .. } = *arrival;
    let chain = queue.chain;
    let rear = queue.start.station();
    let x = rear + length;
    let style = &scene.driver_parameters[parameters as usize];
    let from = scene.viewpoint_at(applicant(scene, queue, arrival).from, chain, rear);
    let ahead = scene.ahead(from).map(|it| Ahead { gap: it.gap - length, ..it });
    let ahead = nearer(ahead, before);
    let speed = match queue.start {
        Start::Driving(_) => {
            let Scene { network, navigator, .. } = *scene;
            let outlook = Outlook { network, navigator, style, class, destination };
            let desired = outlook.fitting_speed(Position::new(chain, x), 0.0);
            let speed = entry_speed(style, desired, ahead, dt)?;
            let stop = stop_ahead(scene, from, granted, sight(scene, from.chain, desired));
            stop.map_or(speed, |it| speed.min(speed_before_a_stop(it.stop - length)))
        }
        Start::FromRest(_) => {
            let leaves_room = ahead.is_none_or(|it| it.gap >= room_to_start(style, it));
            let follower = scene.follower(from);
            let is_let_in = follower.is_none_or(|it| lets_start(scene, &it, dt));
            // Storage space that is kept for others stays free.
            let is_free = scene.reservations.kept_on(queue.section(scene.network)) == 0.0;
            (leaves_room && is_let_in && is_free).then_some(0.0)?
        }
    };
    let to_stop = before_a_stop(scene, arrival, chain, x).map_or(f64::INFINITY, speed_before);
    let speed = speed.min(to_stop);
    Some(Placement { chain, x, speed, class, parameters, destination })
}

/// The way that a vehicle of a line has from `x` on `chain` to its first stop [m], if it has one.
fn before_a_stop(scene: &Scene, arrival: &Arrival, chain: ChainIndex, x: f64) -> Option<f64> {
    let is_stop = arrival.line.is_some() && scene.navigator.is_stop(arrival.destination);
    let waypoint = is_stop.then(|| scene.navigator.waypoint(arrival.destination, chain))?;
    Some(waypoint.distance - x - LineStop::MARGIN)
}

/// Speed at which a driver enters behind `ahead` [m/s]; `None` if it has to wait.
fn entry_speed(style: &Style, desired: f64, ahead: Option<Ahead>, dt: f64) -> Option<f64> {
    /// A driver who would have to enter slower than its leader, and than this share of its desired speed, waits
    /// (ours).
    const LEAST_SHARE: f64 = 0.8;
    let fastest = speed_on_a_free_road(style, desired);
    let Some(ahead) = ahead else { return Some(fastest) };
    let fits = |speed: f64| {
        let behind = |gap| style.follow.acceleration(Pace::new(speed, desired), Some(Ahead { gap, ..ahead }));
        // A driver who would have to brake at once delays those behind. Some models brake even on a free road.
        let least = behind(FAR).min(0.0);
        ahead.gap >= style.follow.jam_gap() && behind(ahead.gap) >= least && is_secure(speed, ahead, dt)
    };
    if fits(fastest) {
        return Some(fastest);
    }
    let (mut slow, mut fast) = (ahead.speed.min(LEAST_SHARE * fastest), fastest);
    if !fits(slow) {
        return None;
    }
    for _ in 0..20 {
        let middle = 0.5 * (slow + fast);
        if fits(middle) { slow = middle } else { fast = middle }
    }
    Some(slow)
}

/// A vehicle this far ahead has no influence [m].
const FAR: f64 = 1e4;

/// Speed that a driver who wants `desired` keeps on a free road [m/s]: less where its car-following model never
/// reaches that, as the literal optimal velocity does not.
fn speed_on_a_free_road(style: &Style, desired: f64) -> f64 {
    /// A model that brakes less than this on a free road keeps its speed there [m/s²].
    const KEEPS: f64 = 0.01;
    let keeps = |speed: f64| {
        let ahead = Ahead::steady(FAR, speed);
        style.follow.acceleration(Pace::new(speed, desired), Some(ahead)) >= -KEEPS
    };
    if keeps(desired) {
        return desired;
    }
    let (mut slow, mut fast) = (0.0, desired);
    for _ in 0..30 {
        let middle = 0.5 * (slow + fast);
        if keeps(middle) { slow = middle } else { fast = middle }
    }
    slow
}

/// Gap to a leader with which a driver starts from a trip end inside the map [m]. It does not start into a queue.
fn room_to_start(style: &Style, ahead: Ahead) -> f64 {
    /// A vehicle slower than this stands in a queue [m/s], and this distance to a queue is kept free [m]; ours.
    const QUEUES: f64 = 2.0;
    const WAY_TO_A_QUEUE: f64 = 30.0;
    if ahead.speed < QUEUES { WAY_TO_A_QUEUE } else { style.follow.jam_gap() }
}

/// Whether a vehicle may start from rest in front of `follower`. The gap must be secure, and neither the follower's
/// model nor kinematics may require more than moderate braking.
fn lets_start(scene: &Scene, follower: &Found, dt: f64) -> bool {
    /// Braking that a driver may expect of its follower [m/s²] (ours).
    const MODERATE: f64 = 2.0;
    if scene.has_reservation(follower.spot, follower.distance) {
        return false;
    }
    let behind = driver_of(scene, follower.spot);
    let ahead = Ahead::standing(follower.distance);
    ahead.gap >= behind.follow.jam_gap()
        && is_secure(behind.pace.speed, ahead, dt)
        && deceleration_to_avoid(ahead.gap, behind.pace.speed, 0.0) <= MODERATE
        && behind.follow.acceleration(behind.pace, Some(ahead)) >= -MODERATE
}
