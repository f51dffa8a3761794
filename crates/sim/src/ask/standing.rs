//! Why a vehicle stands, or hardly moves: the nearest of all that its driver reacts to.

use laneweave_network::{Id, Position};

use crate::driver::lane_end::lane_end;
use crate::driver::last_place::place_to_wait;
use crate::driver::request_reservation::surveyed;
use crate::driver::window::Window;
use crate::junction::need::Survey;
use crate::right_of_way::applicant::Applicant;
use crate::right_of_way::approach::{earlier, look, sight};
use crate::right_of_way::may_pass::{Asking, PassHindrance, may_pass};
use crate::right_of_way::mergers::not_led_on;
use crate::right_of_way::survey::stop_ahead;
use crate::state::externals::{Kind, Service};
use crate::state::lane::VehicleId;
use crate::step::world::World;
use crate::view::scene::{Scene, Spot};

/// What a vehicle stands for.
#[derive(Clone, Debug, PartialEq)]
pub enum StandsFor {
    /// The vehicle ahead.
    Leader {
        /// Its id.
        vehicle: VehicleId,
        /// The gap to it [m].
        gap: f64,
    },
    /// A light, by its id in the map.
    Light(Id),
    /// A stop sign, at which it has not stopped yet.
    StopSign,
    /// It waits for its reservation before a conflict area.
    Junction {
        /// The two chains of each conflict area, and where it begins on each [m].
        areas: Vec<[Position; 2]>,
        /// Why the reservation is not granted.
        why: JunctionHindrance,
        /// The vehicles that have a reservation of the area, or a waiting priority there.
        others: Vec<VehicleId>,
    },
    /// It goes after these vehicles.
    After(Vec<VehicleId>),
    /// The end of its lane, so far ahead [m].
    LaneEnd(f64),
    /// The last place for a necessary change, so far ahead [m].
    LastPlace(f64),
    /// A vehicle that stands in its lane, and that it has to go round.
    Obstacle {
        /// Its id.
        vehicle: VehicleId,
        /// The gap to it [m].
        gap: f64,
    },
    /// It lets in a vehicle so far ahead [m].
    LetsIn(f64),
    /// It rests at a stop of its line, for so long yet [s].
    Stop(f64),
    /// Nothing: it drives off.
    Nothing,
}

/// Why a driver's reservation is not granted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JunctionHindrance {
    /// Others go first.
    Others,
    /// There is no storage space beyond.
    Space,
    /// A roundabout is full.
    Roundabout,
}

/// What the vehicle at `spot` stands for.
pub fn stands_for(world: &World, spot: Spot) -> StandsFor {
    let scene = world.scene();
    let (motion, lane_change) = (scene.motion(spot), scene.lane_change(spot));
    if let Some(Kind::Line(Service { rests_until: Some(step), .. })) =
        scene.externals.of(motion.id).map(|it| it.kind)
    {
        return StandsFor::Stop(step.saturating_sub(world.clock().step) as f64 * world.clock().dt);
    }
    let junction = look(&scene, spot);
    let from = scene.viewpoint(spot);
    let leader = scene.ahead(from).zip(scene.leader_spot(from));
    let leader = leader.map(|(it, spot)| (it.gap, scene.motion(spot)));
    let is_there = |it: f64| (motion.x + it - lane_change.last_place).abs() < 1.0;
    let is_passable = |id| scene.externals.of(id).is_some_and(|it| it.passable_since.is_some());
    let waits_before_it = scene.closure_ahead(from).is_some_and(|it| is_there(it.ahead));
    let obstacle = leader.filter(|(_, it)| waits_before_it && is_passable(it.id));
    let leader = leader.map(|(gap, it)| (gap, StandsFor::Leader { vehicle: it.id, gap }));
    let stop = junction.stop.map(|it| (it, before_a_junction(world, &scene, spot, it)));
    let merge =
        junction.leader.map(|it| (it.ahead.gap.max(it.stop), StandsFor::After(before_it(&scene, spot))));
    let end = lane_end(&scene, spot.chain, from.class).map(|it| it.of_entry(&scene, spot) - motion.x);
    let place = lane_change
        .last_place
        .is_finite()
        .then(|| place_to_wait(&scene, world.clock(), spot, Window::of(&scene, spot)));
    let lets_in = Some(f64::from(lane_change.lets_in.0)).filter(|it| it.is_finite());
    let all = [
        leader,
        stop,
        merge,
        end.map(|it| (it, StandsFor::LaneEnd(it))),
        place.map(|it| match obstacle {
            Some((gap, vehicle)) => (it, StandsFor::Obstacle { vehicle: vehicle.id, gap }),
            None => (it, StandsFor::LastPlace(lane_change.last_place - motion.x)),
        }),
        lets_in.map(|it| (it, StandsFor::LetsIn(it))),
    ];
    /// Nothing farther ahead than this makes a vehicle stand [m].
    const FAR: f64 = 30.0;
    let near = all.into_iter().flatten().filter(|it| it.0 < FAR);
    near.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(StandsFor::Nothing, |it| it.1)
}

/// Why the driver at `spot` stops `stop` ahead [m] at a junction.
fn before_a_junction(world: &World, scene: &Scene, spot: Spot, stop: f64) -> StandsFor {
    let granted = scene.reservation(spot).map_or(0.0, |it| it.left().max(0.0));
    let from = scene.viewpoint(spot);
    let ahead = stop_ahead(scene, from, granted, sight(scene, spot.chain, scene.motion(spot).speed));
    if granted > stop || ahead.is_none() {
        return StandsFor::After(before_it(scene, spot));
    }
    let mut survey = Survey::default();
    let applicant = Applicant::at(scene, spot);
    if !surveyed(scene, &applicant, &mut survey) {
        let waiting = not_led_on(scene, &applicant, &survey).map(|it| it.vehicle);
        return StandsFor::After(before_it(scene, spot).into_iter().chain(waiting).collect());
    }
    let waiting = world.waits_at_a_junction(spot);
    let since = waiting.map_or(world.clock().step, |it| it.since);
    let asking = Asking::of(&applicant, since, world.clock());
    let why = match may_pass(scene, &applicant, &survey, asking) {
        Ok(()) => return StandsFor::Nothing,
        Err(PassHindrance::Light) => {
            let light = survey.lights.last().map(|it| scene.network.junctions.lights[it.0.at()].id);
            return light.map_or(StandsFor::Nothing, StandsFor::Light);
        }
        Err(PassHindrance::Sign) => return StandsFor::StopSign,
        Err(PassHindrance::Space) => JunctionHindrance::Space,
        Err(PassHindrance::Roundabout) => JunctionHindrance::Roundabout,
        Err(PassHindrance::Others | PassHindrance::Blocked) => JunctionHindrance::Others,
    };
    let zones = &scene.network.junctions.zones;
    let areas =
        survey.holds.iter().map(|it| zones[it.zone.at()].sides.map(|it| Position::new(it.chain, it.start)));
    let mut others: Vec<VehicleId> = Vec::new();
    for hold in &survey.holds {
        let holders = scene.reservations.order(hold.zone).filter(|(it, _)| it.side != hold.side);
        others.extend(holders.map(|(_, it)| it.vehicle));
        others.extend(scene.reservations.priority(hold.zone, 1 - hold.side).map(|it| it.priority.id));
    }
    others.sort_unstable();
    others.dedup();
    StandsFor::Junction { areas: areas.collect(), why, others }
}

/// Vehicles from other lanes that pass before the vehicle at `spot`, which has a reservation.
fn before_it(scene: &Scene, spot: Spot) -> Vec<VehicleId> {
    let mut others: Vec<VehicleId> = Vec::new();
    if let Some(own) = scene.reservation(spot) {
        others.extend(own.holds.iter().flat_map(|it| earlier(scene, own, it)).map(|it| it.vehicle));
    }
    others.sort_unstable();
    others.dedup();
    others
}
