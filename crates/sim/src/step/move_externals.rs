//! Vehicles that users drive are moved, and shown wherever they are. A vehicle that a user drives by poses has its
//! main entry in the lane along which it drives, or in no lane. In all other lanes that it touches, an obstacle stands
//! for it. So does one for a vehicle that crosses a junction without a reservation.

use laneweave_network::{Footprint, Point, Pose, Position, Rectangle, turn};

use crate::junction::state::JunctionState;
use crate::record::log::Log;
use crate::route::roads::Roads;
use crate::state::control::Control;
use crate::state::externals::{Body, External, Kind};
use crate::state::lane::{Counterpart, Entry, VehicleId};
use crate::state::traffic::Traffic;
use crate::step::externals::find;
use crate::step::obstacle::{Moved, obstacle};
use crate::step::relocate::Relocating;
use crate::step::show_rears::{clear_rears, show_rears};
use crate::step::work::Work;
use crate::view::pose::pose;
use crate::view::scene::{Scene, Spot};

/// A vehicle at a larger angle to a lane does not drive along it [rad] (ours).
const MAXIMUM_TURN: f64 = 0.8;
/// An angle to a lane that counts as much against it as a place on its border [rad] (ours).
const TURN: f64 = 0.3;
/// What counts against a lane in which the vehicle was not before, and to which it did not go on (ours).
const OTHER_LANE: f64 = 0.2;
/// Lanes whose heights differ by more than this lie above each other [m].
const LEVEL: f64 = 2.0;

/// Moves the vehicles that users drive by poses, and shows all external vehicles in the lanes that they touch.
pub(crate) fn move_externals(
    roads: &Roads,
    traffic: &mut Traffic,
    junctions: &mut JunctionState,
    log: &mut Log,
    work: &mut Work,
) {
    if traffic.externals().is_empty() {
        return;
    }
    clear_rears(traffic);
    let mut externals = std::mem::take(traffic.externals_mut());
    for external in externals.all_mut().iter_mut().filter(|it| it.kind != Kind::Obstacle) {
        clear_obstacles(traffic, external);
        if let Control::Pose { x, y, heading, speed } = external.control {
            let mut relocating = Relocating { roads, traffic, junctions, log, work };
            take_pose(&mut relocating, external, [x, y, heading], speed);
        } else {
            show_in_junction(roads, traffic, junctions, external);
        }
    }
    externals.all().iter().for_each(|it| limit_speeds(traffic, it));
    *traffic.externals_mut() = externals;
    show_rears(roads.network(), traffic);
}

/// Removes the obstacles that stand for a vehicle.
pub(super) fn clear_obstacles(traffic: &mut Traffic, external: &mut External) {
    for Position { chain, x } in external.obstacles.drain(..) {
        let lane = traffic.lane_mut(chain);
        if let Some(index) = lane.find_obstacle(external.id, x) {
            lane.remove(index);
        }
    }
}

/// Moves a vehicle to the pose that its user gave.
fn take_pose(relocating: &mut Relocating, external: &mut External, [x, y, heading]: [f64; 3], speed: f64) {
    let Some(body) = external.body else { return };
    let Some(mut entry) = lift(relocating.traffic, external.id, external.at, &body) else { return };
    let (roads, dt) = (relocating.roads, relocating.traffic.clock().dt);
    let pose = Pose { at: Point::new(x, y, body.pose.at.z), heading };
    let mut rectangle = Rectangle { pose, ..body.rectangle() };
    let footprints = on_one_level(roads, &mut rectangle);
    let way = body.pose.at.distance(&rectangle.pose.at);
    // What jumps does not drive.
    let before = (way <= Control::FASTEST * dt).then_some(body.rectangle());
    let has_known_speed = external.kind == Kind::Recorded;
    let speed = if has_known_speed { speed } else { speed.min(way / dt) };
    let moved = Moved { rectangle, before, speed, has_known_speed, way };
    settle(relocating, external, &mut entry, &moved, &footprints);
}

/// Shows a vehicle that has `moved`, with the main entry `entry`, in the lanes of its `footprints`.
pub(super) fn settle(
    relocating: &mut Relocating,
    external: &mut External,
    entry: &mut Entry,
    moved: &Moved,
    footprints: &[Footprint],
) {
    let roads = relocating.roads;
    let Moved { rectangle, speed, .. } = *moved;
    let from = external.off_road().is_none().then_some(external.at);
    let best = main_lane(roads, &rectangle, footprints, from);
    let onto = best.map(|it| &footprints[it]);
    relocating.relocate(entry, moved, from, onto);
    if let Some(footprint) = onto {
        external.at = Position::new(footprint.chain, entry.motion.x);
        relocating.traffic.enter(footprint.chain, *entry);
    }
    let Rectangle { pose, length, width } = rectangle;
    external.body = Some(Body { pose, length, width, speed, off_road: onto.is_none().then_some(*entry) });
    for (number, footprint) in footprints.iter().enumerate() {
        if best != Some(number) {
            external.obstacles.push(put_obstacle(roads, relocating.traffic, entry, moved, footprint));
        }
    }
}

/// Lets a vehicle that touches lanes, or is driven by poses, be seen no faster than if it had to stop behind what is
/// ahead of it. It may leave the lane to a side, or drive through others: whoever follows it has to stop for them.
pub(super) fn limit_speeds(traffic: &mut Traffic, external: &External) {
    let main = external.body.as_ref().filter(|it| it.off_road.is_none()).and_then(|_| {
        let index = traffic.lane(external.at.chain).find(external.id, external.at.x)?;
        Some((external.at.chain, index))
    });
    let touched = external.obstacles.iter().filter_map(|it| {
        let index = traffic.lane(it.chain).find_obstacle(external.id, it.x)?;
        Some((it.chain, index))
    });
    for (chain, index) in main.into_iter().chain(touched).collect::<Vec<_>>() {
        let motions = traffic.lane(chain).motions();
        let Some(next) = motions[index + 1..].iter().find(|it| it.id != external.id) else { continue };
        let room = (next.rear() - motions[index].x).max(0.0);
        let fastest = (next.speed * next.speed + 2.0 * Control::HARDEST * room).sqrt();
        let own = traffic.lane_mut(chain).entry_mut(index).0;
        own.speed = own.speed.min(fastest);
    }
}

/// Takes the main entry of a vehicle out of its lane, if it is in one.
fn lift(traffic: &mut Traffic, id: VehicleId, at: Position, body: &Body) -> Option<Entry> {
    if body.off_road.is_some() {
        return body.off_road;
    }
    let index = traffic.lane(at.chain).find(id, at.x)?;
    traffic.leave();
    Some(traffic.lane_mut(at.chain).remove(index))
}

/// The stretches of lanes that `rectangle` touches, on the level nearest to its height. Its height becomes theirs.
pub(super) fn on_one_level(roads: &Roads, rectangle: &mut Rectangle) -> Vec<Footprint> {
    let mut footprints = roads.ground().footprints(rectangle);
    let above = |it: &Footprint| (it.height - rectangle.pose.at.z).abs();
    let nearest = footprints.iter().min_by(|a, b| above(a).total_cmp(&above(b))).map(|it| it.height);
    if let Some(height) = nearest {
        footprints.retain(|it| (it.height - height).abs() <= LEVEL);
        rectangle.pose.at.z = height;
    }
    footprints
}

/// The footprint in the lane along which a vehicle drives: the middle of its front is in it. The vehicle was at `from`
/// before, if it was in a lane.
pub(super) fn main_lane(
    roads: &Roads,
    rectangle: &Rectangle,
    footprints: &[Footprint],
    from: Option<Position>,
) -> Option<usize> {
    let network = roads.network();
    let front = rectangle.ends()[0];
    let cost = |it: &Footprint| {
        let chain = network.chain(it.chain);
        let (foot, heading) = (chain.centre.at(it.to), chain.centre.heading(it.to));
        let (dx, dy) = (front.x - foot.x, front.y - foot.y);
        let (sin, cos) = heading.sin_cos();
        let (beyond, aside) = (dx * cos + dy * sin, dy * cos - dx * sin);
        let turn = turn(heading, rectangle.pose.heading);
        let (lanelet, along) = network.lanelet_at(Position::new(it.chain, it.to));
        let half_width = 0.5 * lanelet.width(along);
        let square = |it: f64| it * it;
        let is_new = from.is_none_or(|from| {
            from.chain != it.chain && !network.chain(from.chain).following.contains(&it.chain)
        });
        let price = if is_new { OTHER_LANE } else { 0.0 };
        (turn.abs() <= MAXIMUM_TURN && aside.abs() <= half_width)
            .then(|| square(aside / half_width) + square(turn / TURN) + square(beyond) + price)
    };
    let costs = footprints.iter().enumerate().filter_map(|(number, it)| Some((number, cost(it)?)));
    costs.min_by(|a, b| a.1.total_cmp(&b.1)).map(|it| it.0)
}

/// Shows a vehicle on its way across a conflict area without a reservation in all lanes that it touches. Other drivers
/// do not expect it there.
fn show_in_junction(
    roads: &Roads,
    traffic: &mut Traffic,
    junctions: &JunctionState,
    external: &mut External,
) {
    let network = roads.network();
    let Some(spot) = find(network, traffic, external) else { return };
    let scene = Scene::of(roads, traffic, junctions);
    if !crosses_without_reservation(&scene, spot) {
        return;
    }
    let entry = traffic.lane(spot.chain).entry(spot.index);
    let (length, width) = (f64::from(entry.motion.length), entry.driver.class.body().width);
    let mut rectangle = Rectangle { pose: pose(&scene, spot), length, width };
    let counterpart = entry.lane_change.counterpart.map(|it: Counterpart| it.chain);
    let mut behind = entry.lane_change.previous_lanes.known();
    let own = [Some(spot.chain), counterpart, behind.next(), behind.next(), behind.next()];
    let speed = entry.motion.speed;
    let moved = Moved { rectangle, before: None, speed, has_known_speed: false, way: 0.0 };
    for footprint in on_one_level(roads, &mut rectangle) {
        if !own.contains(&Some(footprint.chain)) {
            external.obstacles.push(put_obstacle(roads, traffic, &entry, &moved, &footprint));
        }
    }
}

/// Whether the vehicle at `spot` is on a conflict area for which it has no reservation.
fn crosses_without_reservation(scene: &Scene, spot: Spot) -> bool {
    let junctions = &scene.network.junctions;
    let motion = scene.motion(spot);
    let reservation = scene.reservation(spot);
    junctions.on(spot.chain).crossings.iter().any(|it| {
        let reach = junctions.reach(*it);
        let is_held = || reservation.is_some_and(|own| own.holds.iter().any(|hold| hold.zone == it.zone));
        reach.start < motion.x && motion.rear() < reach.end && !is_held()
    })
}

/// Puts an obstacle for the vehicle of `entry` where it touches another lane. Returns where it is.
pub(super) fn put_obstacle(
    roads: &Roads,
    traffic: &mut Traffic,
    entry: &Entry,
    moved: &Moved,
    footprint: &Footprint,
) -> Position {
    let obstacle = obstacle(roads.network(), entry, moved, footprint, traffic.clock().dt);
    traffic.insert(footprint.chain, obstacle);
    Position::new(footprint.chain, obstacle.motion.x)
}
