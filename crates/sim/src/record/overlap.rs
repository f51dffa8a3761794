//! Detection of overlaps. Gaps along lanes, and reservations where lanes meet, keep vehicles apart. This module checks
//! whether they do: it compares the rectangles of vehicles, whatever lanes they are in.

use laneweave_network::{ChainIndex, Nearby, Position, Rectangle, Side};

use crate::record::incidents::{Incident, IncidentKind};
use crate::state::lane::{Kinematics, VehicleId};
use crate::state::vehicle::{Class, LONGEST};
use crate::view::pose::pose;
use crate::view::scene::{Scene, Spot};

/// Rectangles that intersect by less than this do not overlap [m].
const TOLERANCE: f64 = 0.05;
/// Vehicles whose heights differ by more than this do not touch [m].
const HEIGHT: f64 = 2.0;
/// Vehicles further apart along the road than this cannot touch [m].
const REACH: f64 = 30.0;
/// A body at an angle, or in a curve, reaches this much further along a lane [m].
const ASKEW: f64 = 3.0;

/// Records the vehicles on `chain` that intersect each other, or vehicles on other chains near it.
pub(crate) fn overlaps(scene: &Scene, chain: ChainIndex, time: f64, out: &mut Vec<Incident>) {
    in_lane(scene, chain, time, out);
    for nearby in scene.network.junctions.nearby(chain) {
        between_lanes(scene, chain, nearby, time, out);
    }
    for (index, driver) in scene.drivers(chain).iter().enumerate() {
        if !driver.is_shadow && driver.phase.is_between_lanes() {
            beside(scene, Spot { chain, index }, time, out);
        }
    }
}

/// Records a collision of the vehicle at `spot` with the one at `leader`, to which it has no gap, if their rectangles
/// intersect.
pub(crate) fn touch(scene: &Scene, spot: Spot, leader: Spot, time: f64, out: &mut Vec<Incident>) {
    let incident = incident(scene, spot, leader, time);
    out.extend(incident.map(|it| Incident { kind: IncidentKind::Collision, ..it }));
}

/// Compares vehicles one behind the other in a lane.
fn in_lane(scene: &Scene, chain: ChainIndex, time: f64, out: &mut Vec<Incident>) {
    let motions = scene.motions(chain);
    for (index, behind) in motions.iter().enumerate() {
        let ahead =
            motions[index + 1..].iter().zip(index + 1..).take_while(|(it, _)| it.x - LONGEST < behind.x);
        for (_, other) in ahead.filter(|(it, _)| it.rear() < behind.x) {
            out.extend(incident(scene, Spot { chain, index }, Spot { chain, index: other }, time));
        }
    }
}

/// Compares vehicles on two lanes that are close to each other, except those that follow each other from one to the
/// other.
fn between_lanes(scene: &Scene, chain: ChainIndex, nearby: &Nearby, time: f64, out: &mut Vec<Incident>) {
    let others = scene.motions(nearby.chain);
    if others.is_empty() {
        return;
    }
    let there = within(others, nearby.there);
    if there.is_empty() {
        return;
    }
    let motions = scene.motions(chain);
    let [one, other] = [(chain, nearby.chain), (nearby.chain, chain)]
        .map(|(back, on)| scene.network.chain(back).following.contains(&on));
    let is_apart = |here: usize, index: usize| {
        let follows = |on: ChainIndex, index: usize, back: ChainIndex| {
            scene.lane_change_states(on)[index].previous_lanes.last() == Some(back)
                || scene.motions(on)[index].rear() >= 0.0
        };
        let gap = |back: ChainIndex, ahead: &Kinematics, behind: &Kinematics| {
            scene.network.chain(back).length - behind.x + ahead.rear()
        };
        (one && follows(nearby.chain, index, chain) && gap(chain, &others[index], &motions[here]) > 0.0)
            || (other
                && follows(chain, here, nearby.chain)
                && gap(nearby.chain, &motions[here], &others[index]) > 0.0)
    };
    for index in within(motions, nearby.here).filter(|it| reaches(&motions[*it], nearby.here)) {
        let near = there.clone().filter(|it| reaches(&others[*it], nearby.there) && !is_apart(index, *it));
        for other in near {
            out.extend(incident(
                scene,
                Spot { chain, index },
                Spot { chain: nearby.chain, index: other },
                time,
            ));
        }
    }
}

/// Whether a vehicle whose front is on the stretch `fronts` reaches back to where other vehicles are near.
fn reaches(motion: &Kinematics, fronts: [f64; 2]) -> bool {
    motion.rear() <= fronts[1] - LONGEST
}

/// The vehicles whose fronts are on a stretch.
fn within(motions: &[Kinematics], [from, to]: [f64; 2]) -> std::ops::Range<usize> {
    motions.partition_point(|it| it.x < from)..motions.partition_point(|it| it.x <= to)
}

/// Compares a vehicle between two lanes with all vehicles around it, on these two lanes and on the lanes beside them.
fn beside(scene: &Scene, spot: Spot, time: f64, out: &mut Vec<Incident>) {
    let lane = &scene.lanes[spot.chain.at()];
    let (motion, lane_change) = (&lane.motions()[spot.index], &lane.lane_change_states()[spot.index]);
    let own = [Some(Position::new(spot.chain, motion.x)), lane_change.counterpart.map(|it| it.at())];
    let beside = |side, place: Option<Position>| {
        let Position { chain, x } = place?;
        scene.network.chain(chain).beside(side, x).map(|it| Position::new(it.chain, it.across(x)))
    };
    let [left, right] = Side::BOTH.map(|side| own.map(|place| beside(side, place)));
    let places = [own[0], own[1], left[0], left[1], right[0], right[1]];
    for (number, place) in places.iter().enumerate() {
        let Some(Position { chain, x }) = *place else { continue };
        if places[..number].iter().flatten().any(|it| it.chain == chain) {
            continue;
        }
        let motions = scene.motions(chain);
        let rear = x - f64::from(motion.length);
        let is_level = |it: &Kinematics| it.x > rear - ASKEW && it.rear() < x + ASKEW;
        for index in within(motions, [x - REACH, x + REACH]).filter(|it| is_level(&motions[*it])) {
            out.extend(incident(scene, spot, Spot { chain, index }, time));
        }
    }
}

/// The incident between the vehicles of two entries; none if they are one vehicle, or apart.
fn incident(scene: &Scene, one: Spot, other: Spot, time: f64) -> Option<Incident> {
    if scene.motion(one).id == scene.motion(other).id {
        return None;
    }
    let mut parties = [Party::of(scene, one)?, Party::of(scene, other)?];
    parties.sort_by_key(|it| it.id);
    let [a, b] = &parties;
    let depth = a.rectangle.depth(&b.rectangle);
    let [here, there] = [a.rectangle.pose.at, b.rectangle.pose.at];
    if depth <= TOLERANCE || (here.z - there.z).abs() > HEIGHT {
        return None;
    }
    Some(Incident {
        kind: if a.closes(b) { IncidentKind::Collision } else { IncidentKind::Overlap },
        time,
        vehicles: [a.id, b.id],
        driver_parameters: [a.parameters, b.parameters],
        classes: [a.class, b.class],
        places: [a.place, b.place],
        at: here.midpoint(&there),
        speeds: [a.speed, b.speed],
        depth,
    })
}

/// A vehicle that may touch another one.
struct Party {
    id: VehicleId,
    parameters: u32,
    class: Class,
    /// Position of its front bumper.
    place: Position,
    rectangle: Rectangle,
    speed: f64,
}

impl Party {
    /// The vehicle whose entry is at `spot`.
    fn of(scene: &Scene, spot: Spot) -> Option<Party> {
        let (Kinematics { x, id, speed, length, .. }, driver) = (*scene.motion(spot), scene.driver(spot));
        let external = if driver.is_external { scene.externals.of(id) } else { None };
        let on_its_path = |pose, length: f32| Rectangle {
            pose,
            length: f64::from(length),
            width: driver.class.body().width,
        };
        let (place, rectangle, speed) = match external.and_then(|it| Some((it.at, it.body.as_ref()?))) {
            Some((at, body)) => (at, body.rectangle(), body.speed),
            None if !driver.is_shadow => {
                (Position::new(spot.chain, x), on_its_path(pose(scene, spot), length), speed)
            }
            None => {
                let counterpart = scene.lane_change(spot).counterpart.map(|it| it.at());
                let main = main_entry(scene, id, counterpart.or(external.map(|it| it.at))?)?;
                let motion = scene.motion(main);
                let rectangle = on_its_path(pose(scene, main), motion.length);
                (Position::new(main.chain, motion.x), rectangle, motion.speed)
            }
        };
        Some(Party { id, parameters: driver.parameters, class: driver.class, place, rectangle, speed })
    }

    /// Whether the centres approach each other.
    fn closes(&self, other: &Party) -> bool {
        let (dx, dy) = self.rectangle.to(&other.rectangle);
        let velocity = |it: &Party| {
            let (sin, cos) = it.rectangle.pose.heading.sin_cos();
            (it.speed * cos, it.speed * sin)
        };
        let ((ax, ay), (bx, by)) = (velocity(self), velocity(other));
        dx * (bx - ax) + dy * (by - ay) < 0.0
    }
}

/// The main entry of the vehicle `id` at this position.
fn main_entry(scene: &Scene, id: VehicleId, at: Position) -> Option<Spot> {
    Some(Spot { chain: at.chain, index: scene.lanes[at.chain.at()].find(id, at.x)? })
}
