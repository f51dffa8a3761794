//! Drivers drive on: the kinematics of all vehicles at the end of the step, computed on the snapshot.

use laneweave_models::braking::HARD_BRAKING;
use laneweave_network::ChainIndex;

use crate::driver::accelerate::{Chosen, OpenRoad, behind, cause, with_care};
use crate::driver::plan::{Outbox, Plan, Upkeep, Waiting};
use crate::driver::two_lanes::{behind_both, behind_offside};
use crate::junction::reservations::NO_RESERVATION;
use crate::record::events::DrivingEventKind;
use crate::record::overlap::touch;
use crate::state::clock::Clock;
use crate::state::lane::{DriverState, Kinematics, Lane};
use crate::state::push_tight::push_tight;
use crate::view::scene::{Scene, Spot};

/// Accelerates and moves all vehicles of a lane.
// This is the busiest loop on a motorway; a function of its own has all registers.
#[inline(never)]
pub(crate) fn drive(scene: &Scene, clock: Clock, chain: ChainIndex, plan: &mut Plan, outbox: &mut Outbox) {
    let lane = &scene.lanes[chain.at()];
    let motions = lane.motions();
    if plan.next.capacity() < motions.len() {
        plan.next.reserve_exact(lane.capacity());
    }
    let upcoming = upcoming(scene, chain);
    let road = OpenRoad::on(scene, chain);
    let mut updates = 0;
    for (index, (motion, driver)) in motions.iter().zip(lane.drivers()).enumerate() {
        if let Some(upcoming) = upcoming {
            upcoming.prefetch(index);
        }
        let leader = motions.get(index + 1).filter(|_| driver.only_follows());
        let (acceleration, stretch) = match usual(scene, clock, &road, motion, driver, leader) {
            Some(acceleration) => (acceleration, 1.0),
            None => {
                let spot = Spot { chain, index };
                drive_in_two_lanes(scene, clock, spot, &road, plan)
                    .unwrap_or_else(|| drive_with_care(scene, clock, spot, plan, outbox))
            }
        };
        let (mut next, distance) = moved(motion, acceleration, stretch, clock.dt);
        if next.headway_relaxation != 1.0 {
            let manner = &scene.style_of(driver).manner;
            next.headway_relaxation = manner.relaxed(f64::from(next.headway_relaxation), clock.dt) as f32;
        }
        plan.next.push(next);
        if !driver.is_shadow {
            plan.distance += distance;
            updates += 1;
        }
    }
    outbox.counters.updates += updates;
}

/// The acceleration of a driver who only follows its `leader`, if that is all that it reacts to [m/s²].
#[inline(always)]
fn usual(
    scene: &Scene,
    clock: Clock,
    road: &OpenRoad,
    motion: &Kinematics,
    driver: &DriverState,
    leader: Option<&Kinematics>,
) -> Option<f64> {
    let leader = leader.filter(|it| road.reaches(motion, it.x))?;
    behind(scene, motion, driver, leader, clock.dt)
}

/// The acceleration that the driver at `spot` chooses for the next step [m/s²].
pub(crate) fn acceleration(scene: &Scene, clock: Clock, spot: Spot) -> f64 {
    let (motion, driver) = (scene.motion(spot), scene.driver(spot));
    let leader = scene.motions(spot.chain).get(spot.index + 1).filter(|_| driver.only_follows());
    let road = OpenRoad::on(scene, spot.chain);
    usual(scene, clock, &road, motion, driver, leader)
        .unwrap_or_else(|| with_care(scene, clock, spot).acceleration)
}

/// The lane that the drivers of a neighbouring lane will look at next. `None` where there are few lanes: these stay
/// in the cache.
fn upcoming<'a>(scene: &Scene<'a>, chain: ChainIndex) -> Option<&'a Lane> {
    const FEW: usize = 100;
    scene.lanes.get(chain.at() + 2).filter(|_| scene.lanes.len() > FEW)
}

/// Drives a vehicle whose driver reacts only to leaders in two lanes. Returns its acceleration [m/s²], and the metres
/// along the chain for a metre driven.
#[inline]
fn drive_in_two_lanes(
    scene: &Scene,
    clock: Clock,
    spot: Spot,
    road: &OpenRoad,
    plan: &mut Plan,
) -> Option<(f64, f64)> {
    let both = behind_both(scene, clock, spot, road);
    let acceleration = both.or_else(|| behind_offside(scene, clock, spot, road))?;
    let (_, distance) = moved(scene.motion(spot), acceleration, 1.0, clock.dt);
    let upkeep = Upkeep {
        index: spot.index as u32,
        distance,
        in_emergency: false,
        reservation_is_over: false,
        per_metre: 0.0,
    };
    push_tight(&mut plan.upkeep, upkeep);
    Some((acceleration, stretch(scene, spot)))
}

/// Drives a vehicle whose driver reacts to more than its leader, or whose braking kinematics decides. Returns its
/// acceleration [m/s²], and the metres along the chain for a metre driven.
#[inline(never)]
fn drive_with_care(
    scene: &Scene,
    clock: Clock,
    spot: Spot,
    plan: &mut Plan,
    outbox: &mut Outbox,
) -> (f64, f64) {
    let driver = scene.driver(spot);
    let chosen = with_care(scene, clock, spot);
    let Chosen { acceleration, by_kinematics, touches, junction, per_metre, .. } = chosen;
    let in_emergency = by_kinematics || (driver.in_emergency && acceleration < 0.0);
    // A shadow counts too: kinematics decides for the vehicle in either lane.
    if by_kinematics && !driver.in_emergency {
        outbox.note(scene, clock, spot, DrivingEventKind::EmergencyBraking);
    }
    if !driver.is_shadow && begins_to_brake_hard(scene.motion(spot), acceleration, clock.dt) {
        outbox.note(scene, clock, spot, DrivingEventKind::HardBraking(cause(scene, spot, &chosen)));
    }
    if touches && let Some(leader) = scene.leader_spot(scene.viewpoint(spot)) {
        touch(scene, spot, leader, clock.time(), &mut outbox.incidents);
    }
    let index = spot.index as u32;
    if !driver.only_follows() || in_emergency {
        let motion = scene.motion(spot);
        let (_, distance) = moved(motion, acceleration, 1.0, clock.dt);
        let slot = scene.lane_change(spot).reservation;
        let reservation_is_over = slot != NO_RESERVATION && scene.reservations.of(slot, motion.id).is_none();
        let per_metre = per_metre as f32;
        push_tight(
            &mut plan.upkeep,
            Upkeep { index, distance, in_emergency, reservation_is_over, per_metre },
        );
    }
    if junction.asks {
        let id = scene.motion(spot).id;
        let since = plan.waited.iter().find(|it| it.id == id).map_or(clock.step, |it| it.since);
        plan.waiting.push(Waiting { index, id, since, is_held: junction.is_held });
    }
    outbox.returns.extend(junction.revokes_from.map(|from| (index, from)));
    (acceleration, stretch(scene, spot))
}

/// Whether a vehicle that accelerates with `acceleration` [m/s²] begins to brake hard.
pub(crate) fn begins_to_brake_hard(motion: &Kinematics, acceleration: f64, dt: f64) -> bool {
    let (next, _) = moved(motion, acceleration, 1.0, dt);
    let is_hard = |it: &Kinematics| f64::from(it.acceleration) < -HARD_BRAKING;
    is_hard(&next) && !is_hard(motion)
}

/// Metres along the chain for a metre driven.
pub(crate) fn stretch(scene: &Scene, spot: Spot) -> f64 {
    if scene.driver(spot).phase.is_between_lanes() { f64::from(scene.lane_change(spot).stretch) } else { 1.0 }
}

/// The kinematics of a vehicle after a step, and the distance driven [m].
#[inline]
pub(crate) fn moved(motion: &Kinematics, acceleration: f64, stretch: f64, dt: f64) -> (Kinematics, f64) {
    let next = motion.speed + acceleration * dt;
    let (speed, distance, acceleration) = if next >= 0.0 {
        (next, 0.5 * (motion.speed + next) * dt, acceleration)
    } else {
        (0.0, -0.5 * motion.speed * motion.speed / acceleration, -motion.speed / dt)
    };
    let x = motion.x + distance * stretch;
    (Kinematics { x, speed, acceleration: acceleration as f32, ..*motion }, distance)
}
