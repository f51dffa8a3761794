//! Overlaps: vehicles in their lanes are kept apart by their gaps; every vehicle that moves sideways is tested as a
//! rectangle against all around it.

use laneweave_network::{ChainIndex, Pose, Side};

use crate::pose::pose;
use crate::scene::{Scene, Spot};

/// Rectangles that intersect less than this do not overlap [m].
const TOLERANCE: f64 = 0.05;
/// Vehicles further apart along the road than this cannot touch [m].
const REACH: f64 = 30.0;

/// Number of overlaps between a vehicle on `chain` in a change and any other.
pub(crate) fn overlaps(scene: &Scene, chain: ChainIndex) -> u64 {
    let entries = scene.cars(chain).iter().enumerate();
    entries
        .filter(|(_, car)| !car.is_shadow && car.phase.is_between_lanes())
        .map(|(index, _)| overlaps_of(scene, Spot { chain, index }))
        .sum()
}

fn overlaps_of(scene: &Scene, spot: Spot) -> u64 {
    let lane = &scene.lanes[spot.chain.at()];
    let (motion, mind) = (&lane.motions()[spot.index], &lane.minds()[spot.index]);
    let body = Rectangle::of(scene, spot);
    let own = [Some((spot.chain, motion.x)), mind.twin.map(|twin| (twin.chain, twin.x))];
    let beside = |side, place: Option<(ChainIndex, f64)>| {
        let (chain, x) = place?;
        scene.network.chain(chain).beside(side, x).map(|it| (it.chain, it.across(x)))
    };
    let [left, right] = Side::BOTH.map(|side| own.map(|place| beside(side, place)));
    let places = [own[0], own[1], left[0], left[1], right[0], right[1]];
    let mut count = 0;
    for (number, place) in places.iter().enumerate() {
        let Some((chain, x)) = *place else { continue };
        if places[..number].iter().flatten().any(|(earlier, _)| *earlier == chain) {
            continue;
        }
        let motions = scene.motions(chain);
        let from = motions.partition_point(|other| other.x < x - REACH);
        let near = motions.iter().enumerate().skip(from).take_while(|(_, it)| it.x < x + REACH);
        for (index, other) in near {
            let at = Spot { chain, index };
            let other_car = scene.car(at);
            // Of two that move sideways the pair is counted once.
            let is_counted_there = other_car.phase.is_between_lanes() && other.id < motion.id;
            if other.id != motion.id && !other_car.is_shadow && !is_counted_there {
                let other = Rectangle::of(scene, at);
                count += u64::from(body.depth(&other) > TOLERANCE);
            }
        }
    }
    count
}

/// A vehicle seen from above.
struct Rectangle {
    pose: Pose,
    length: f64,
    width: f64,
}

impl Rectangle {
    fn of(scene: &Scene, spot: Spot) -> Rectangle {
        let (length, class) = (scene.motion(spot).length, scene.car(spot).class);
        Rectangle { pose: pose(scene, spot), length: f64::from(length), width: class.body().width }
    }

    /// Half its extent along the direction (`x`, `y`).
    fn reach(&self, x: f64, y: f64) -> f64 {
        let (sin, cos) = self.pose.heading.sin_cos();
        0.5 * (self.length * (cos * x + sin * y).abs() + self.width * (cos * y - sin * x).abs())
    }

    /// How deep two rectangles intersect, by separating axes; not positive where they are apart.
    fn depth(&self, other: &Rectangle) -> f64 {
        let (dx, dy) = (other.pose.at.x - self.pose.at.x, other.pose.at.y - self.pose.at.y);
        let axes = [self, other].into_iter().flat_map(|it| {
            let (sin, cos) = it.pose.heading.sin_cos();
            [(cos, sin), (-sin, cos)]
        });
        axes.map(|(x, y)| self.reach(x, y) + other.reach(x, y) - (dx * x + dy * y).abs())
            .fold(f64::INFINITY, f64::min)
    }
}
