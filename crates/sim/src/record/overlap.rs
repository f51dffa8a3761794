//! Detection of overlaps. Gaps along lanes, and reservations where lanes meet, keep vehicles apart. This module checks
//! whether they do: it compares the rectangles of vehicles, whatever lanes they are in.

use laneweave_network::{ChainIndex, Nearby, Pose, Position, Side};

use crate::record::incidents::{Incident, IncidentKind};
use crate::state::lane::Kinematics;
use crate::state::vehicle::LONGEST;
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
    let mut spots = [main_entry(scene, one)?, main_entry(scene, other)?];
    spots.sort_by_key(|it| scene.motion(*it).id);
    let [a, b] = spots.map(|it| Rectangle::of(scene, it));
    let depth = a.depth(&b);
    if depth <= TOLERANCE || (a.pose.at.z - b.pose.at.z).abs() > HEIGHT {
        return None;
    }
    Some(Incident {
        kind: if a.closes(&b) { IncidentKind::Collision } else { IncidentKind::Overlap },
        time,
        vehicles: spots.map(|it| scene.motion(it).id),
        driver_parameters: spots.map(|it| scene.driver(it).parameters),
        classes: spots.map(|it| scene.driver(it).class),
        places: spots.map(|it| Position::new(it.chain, scene.motion(it).x)),
        at: a.pose.at.midpoint(&b.pose.at),
        speeds: [a.speed, b.speed],
        depth,
    })
}

/// The main entry of the vehicle whose entry is at `spot`.
fn main_entry(scene: &Scene, spot: Spot) -> Option<Spot> {
    if !scene.driver(spot).is_shadow {
        return Some(spot);
    }
    let counterpart = scene.lane_change(spot).counterpart?;
    let index = scene.lanes[counterpart.chain.at()].find(scene.motion(spot).id, counterpart.x)?;
    Some(Spot { chain: counterpart.chain, index })
}

/// A vehicle as seen from above.
struct Rectangle {
    pose: Pose,
    speed: f64,
    length: f64,
    width: f64,
}

impl Rectangle {
    fn of(scene: &Scene, spot: Spot) -> Rectangle {
        let (Kinematics { length, speed, .. }, class) = (*scene.motion(spot), scene.driver(spot).class);
        Rectangle { pose: pose(scene, spot), speed, length: f64::from(length), width: class.body().width }
    }

    /// Half its extent in the direction (`x`, `y`).
    fn reach(&self, x: f64, y: f64) -> f64 {
        let (sin, cos) = self.pose.heading.sin_cos();
        0.5 * (self.length * (cos * x + sin * y).abs() + self.width * (cos * y - sin * x).abs())
    }

    /// Depth of the intersection of two rectangles, by separating axes; not positive if they are apart.
    fn depth(&self, other: &Rectangle) -> f64 {
        let (dx, dy) = self.to(other);
        let axes = [self, other].into_iter().flat_map(|it| {
            let (sin, cos) = it.pose.heading.sin_cos();
            [(cos, sin), (-sin, cos)]
        });
        axes.map(|(x, y)| self.reach(x, y) + other.reach(x, y) - (dx * x + dy * y).abs())
            .fold(f64::INFINITY, f64::min)
    }

    fn to(&self, other: &Rectangle) -> (f64, f64) {
        (other.pose.at.x - self.pose.at.x, other.pose.at.y - self.pose.at.y)
    }

    /// Whether the centres approach each other.
    fn closes(&self, other: &Rectangle) -> bool {
        let (dx, dy) = self.to(other);
        let velocity = |it: &Rectangle| {
            let (sin, cos) = it.pose.heading.sin_cos();
            (it.speed * cos, it.speed * sin)
        };
        let ((ax, ay), (bx, by)) = (velocity(self), velocity(other));
        dx * (bx - ax) + dy * (by - ay) < 0.0
    }
}
