//! Stuck vehicles: a vehicle is stuck if it has stood for long, and nothing that is sure to end blocks it.

use laneweave_network::ZoneIndex;

use crate::driver::consider::STUCK_AFTER;
use crate::driver::drive::acceleration;
use crate::driver::request_reservation::surveyed;
use crate::junction::need::Survey;
use crate::right_of_way::applicant::Applicant;
use crate::right_of_way::approach::look;
use crate::right_of_way::may_pass::{Asking, PassHindrance, may_pass};
use crate::state::clock::Clock;
use crate::state::standstill::STANDSTILL;
use crate::view::scene::{Scene, Spot};

/// A light that was green within this time will be green again [s].
const RECENTLY: f64 = 180.0;
/// A longer chain of blocked vehicles is a cycle.
const LONGEST: usize = 1000;

/// What blocks a standing vehicle.
enum Blocker {
    /// The vehicle at a spot.
    Vehicle(Spot),
    /// A light that was green recently.
    Light,
    /// Nothing: the vehicle is about to drive off.
    Nothing,
    /// Something else.
    Other,
}

/// Whether the vehicle at `spot`, which has stood for long, is stuck. It is not stuck if the first of the vehicles
/// that block it moves, drives off now, is about to move, waits at a light that was green recently, or is driven by a
/// user and could not be passed. Vehicles that wait for each other are all stuck.
#[inline(never)]
pub(crate) fn is_stuck(scene: &Scene, spot: Spot, clock: Clock, survey: &mut Survey) -> bool {
    let (mut at, mut behind) = (spot, spot);
    for _ in 0..LONGEST {
        if is_held(scene, at) {
            return at != spot && could_go_round(scene, at, clock) && has_a_way_out(scene, behind);
        }
        match blocker(scene, at, clock, survey) {
            Blocker::Nothing | Blocker::Other if acceleration(scene, clock, at) > 0.0 => return false,
            Blocker::Other if waits_for_a_user(scene, at, survey) => return false,
            Blocker::Vehicle(next) if scene.motion(next).speed >= STANDSTILL => return false,
            Blocker::Vehicle(next) => (at, behind) = (next, at),
            Blocker::Light => return false,
            // A vehicle that is itself about to drive off did not stand because of another.
            Blocker::Nothing => return at == spot,
            Blocker::Other => return true,
        }
    }
    true
}

/// Whether a user drives the vehicle at `at`, or it rests at a stop of its line.
fn is_held(scene: &Scene, at: Spot) -> bool {
    let external = || scene.externals.of(scene.motion(at).id);
    scene.driver(at).is_external || external().is_some_and(|it| !it.kind.is_left_to_its_driver())
}

/// Whether drivers could have gone round the vehicle at `at`, which is held, for as long as whoever is stuck has
/// stood.
fn could_go_round(scene: &Scene, at: Spot, clock: Clock) -> bool {
    let external = scene.externals.of(scene.motion(at).id);
    let since = external.and_then(|it| it.passable_since);
    since.is_some_and(|it| it <= clock.step && clock.since(it) >= f64::from(STUCK_AFTER))
}

/// Whether the vehicle at `at` is not yet so near to what stands on its lane that it may not change lanes any more.
fn has_a_way_out(scene: &Scene, at: Spot) -> bool {
    scene.closure_ahead(scene.viewpoint(at)).is_some()
}

/// Whether the vehicle at `at`, which waits at or in the junction that was surveyed, waits for a vehicle that a user
/// drives: one that has a reservation there, or for which others wait that go first.
fn waits_for_a_user(scene: &Scene, at: Spot, survey: &Survey) -> bool {
    if scene.externals.is_empty() {
        return false;
    }
    let held = scene.reservation(at).map_or(&[][..], |it| &it.holds);
    let mut zones: Vec<ZoneIndex> = survey.holds.iter().chain(held).map(|it| it.zone).collect();
    let mut next = 0;
    while let Some(zone) = zones.get(next).copied() {
        next += 1;
        for (_, reservation) in scene.reservations.order(zone) {
            if scene.externals.of(reservation.vehicle).is_some_and(|it| !it.kind.is_left_to_its_driver()) {
                return true;
            }
            let beyond = reservation.holds.iter().map(|it| it.zone).filter(|it| !zones.contains(it));
            let beyond: Vec<ZoneIndex> = beyond.collect();
            zones.extend(beyond);
        }
    }
    false
}

fn blocker(scene: &Scene, at: Spot, clock: Clock, survey: &mut Survey) -> Blocker {
    let from = scene.viewpoint(at);
    let is_let_go = || {
        let junction = look(scene, at);
        let stands = junction.leader.is_some_and(|it| it.ahead.speed < STANDSTILL);
        scene.reservation(at).is_some_and(|it| it.left() > 0.0) && junction.stop.is_none() && !stands
    };
    let on_way = || match scene.leader_spot(from) {
        Some(leader) => Blocker::Vehicle(leader),
        None if is_let_go() => Blocker::Nothing,
        None => Blocker::Other,
    };
    // It waits behind a leader, or for a vehicle that goes first into a merge, or it is itself the head.
    let is_head = surveyed(scene, &Applicant::at(scene, at), survey)
        && scene.ahead(from).is_none_or(|it| it.gap > survey.stop);
    if !is_head {
        return on_way();
    }
    let applicant = Applicant::at(scene, at);
    match may_pass(scene, &applicant, survey, Asking::of(&applicant, clock.step, clock)) {
        Err(PassHindrance::Space | PassHindrance::Roundabout) => on_way(),
        Err(PassHindrance::Light) => {
            let since = |it| f64::from(clock.step - scene.signals.green_at(it, clock)) * clock.dt;
            let was_green = survey.lights.iter().all(|(it, _)| since(*it) <= RECENTLY);
            if was_green { Blocker::Light } else { Blocker::Other }
        }
        Ok(()) => Blocker::Nothing,
        Err(PassHindrance::Sign | PassHindrance::Blocked | PassHindrance::Others) => Blocker::Other,
    }
}
