//! The pose of a vehicle's body. It is computed only when needed.

use laneweave_models::Manner;
use laneweave_models::lateral::Crossing;
use laneweave_network::{ChainIndex, Network, Point, Pose, Position};

use crate::state::lane::{Counterpart, Entry, Kinematics, LaneChangeState};
use crate::state::previous_lanes::PreviousLanes;
use crate::view::scene::{Scene, Spot};

/// Pose of the centre of the vehicle with the main entry `spot`.
pub(crate) fn pose(scene: &Scene, spot: Spot) -> Pose {
    between(bumpers(scene, spot))
}

/// Pose of the centre of a vehicle, from the middles of its front and rear bumpers.
pub fn between([front, rear]: [Point; 2]) -> Pose {
    Pose { at: rear.towards(&front, 0.5), heading: (front.y - rear.y).atan2(front.x - rear.x) }
}

/// The middles of the front and rear bumpers of the vehicle with the main entry `spot`.
///
/// In a lane change both lie on the path. The rear bumper follows the front one, so that a long vehicle does not swing
/// out.
pub(crate) fn bumpers(scene: &Scene, spot: Spot) -> [Point; 2] {
    let (network, entry) = (scene.network, scene.lanes[spot.chain.at()].entry(spot.index));
    let Entry { motion, lane_change, .. } = &entry;
    match lane_change.counterpart {
        Some(counterpart) => {
            let [own, other] = places_between(&entry, counterpart);
            let own = own.map(|it| on_path(network, spot.chain, lane_change.previous_lanes, it, 0.0));
            let other = other.map(|it| on_path(network, counterpart.chain, PreviousLanes::NONE, it, 0.0));
            bumpers_between(scene, &entry, [own, other])
        }
        None => {
            let [front_offset, rear_offset] = offsets(scene, spot.chain, &entry);
            let at =
                |x: f64, offset: f64| on_path(network, spot.chain, lane_change.previous_lanes, x, offset);
            [at(motion.x, front_offset), at(motion.rear(), rear_offset)]
        }
    }
}

/// Where the front and the rear bumper of a vehicle between two lanes are along the lane of its main entry, and along
/// that of its counterpart [m].
#[inline]
pub(crate) fn places_between(entry: &Entry, counterpart: Counterpart) -> [[f64; 2]; 2] {
    let Entry { motion, lane_change, .. } = entry;
    let [length, counterpart_length] = lengths(motion, lane_change.progress, counterpart.stretch);
    [[motion.x, motion.x - length], [counterpart.x, counterpart.x - counterpart_length]]
}

/// The middles of the front and rear bumpers of a vehicle between two lanes, from the points on these lanes.
#[inline]
pub(crate) fn bumpers_between(scene: &Scene, entry: &Entry, [own, other]: [[Point; 2]; 2]) -> [Point; 2] {
    let [of_front, of_rear] = shares(scene, entry);
    [own[0].towards(&other[0], of_front), own[1].towards(&other[1], of_rear)]
}

/// The middles of the front and rear bumpers of a vehicle that keeps its lane on `chain`, and came there over
/// `previous_lanes`.
pub fn bumpers_in_lane(
    network: &Network,
    chain: ChainIndex,
    previous_lanes: PreviousLanes,
    motion: &Kinematics,
) -> [Point; 2] {
    [motion.x, motion.rear()].map(|it| on_path(network, chain, previous_lanes, it, 0.0))
}

/// The vehicle's length along the lane of its main entry, and along the other lane, where it drives `stretch` metres
/// per metre [m]. It is the true length in the old lane when the change begins, and in the new lane when it ends.
fn lengths(motion: &Kinematics, progress: f32, stretch: f32) -> [f64; 2] {
    let (length, progress, stretch) = (f64::from(motion.length), f64::from(progress), f64::from(stretch));
    let is_across = progress >= 0.5;
    let here = if is_across { progress } else { 1.0 - progress };
    [length * (here + (1.0 - here) / stretch), length * (here * stretch + (1.0 - here))]
}

/// Offset of the vehicle's centre to the left of the centre of its lane [m].
pub(crate) fn lateral_offset(scene: &Scene, spot: Spot) -> f64 {
    let entry = scene.lanes[spot.chain.at()].entry(spot.index);
    let [front, rear] = offsets(scene, spot.chain, &entry);
    0.5 * (front + rear)
}

/// Offsets of the front and rear bumpers to the left [m].
fn offsets(scene: &Scene, chain: ChainIndex, entry: &Entry) -> [f64; 2] {
    let has_crossed = entry.lane_change.progress >= 0.5;
    let spacing = entry.lane_change.side.sign() * lane_spacing(scene, chain, entry);
    shares(scene, entry).map(|share| if has_crossed { -spacing * share } else { spacing * share })
}

/// Offsets of the front and rear bumpers from the lane of the main entry, as shares of the distance to the other lane.
fn shares(scene: &Scene, entry: &Entry) -> [f64; 2] {
    let Entry { motion, driver, lane_change } = entry;
    let progress = f64::from(lane_change.progress).clamp(0.0, 1.0);
    if progress == 0.0 {
        return [0.0; 2];
    }
    let manner = &scene.style_of(driver).manner;
    let moved = manner.lateral.bumpers(crossing(manner, motion, lane_change), progress);
    if lane_change.progress < 0.5 { moved } else { moved.map(|it| 1.0 - it) }
}

/// The vehicle in its lane change, as plain data for the lateral model.
#[inline]
pub(crate) fn crossing(manner: &Manner, motion: &Kinematics, lane_change: &LaneChangeState) -> Crossing {
    let duration = manner.duration(f64::from(lane_change.urgency));
    Crossing { speed: motion.speed, length: f64::from(motion.length), duration }
}

/// Distance between the centre lines of the two lanes [m].
fn lane_spacing(scene: &Scene, chain: ChainIndex, entry: &Entry) -> f64 {
    let x = entry.motion.x;
    match entry.lane_change.counterpart {
        Some(counterpart) => {
            let here = scene.network.chain(chain).centre.at(x);
            here.distance(&scene.network.chain(counterpart.chain).centre.at(counterpart.x))
        }
        None => {
            let (lanelet, along) = scene.network.lanelet_at(Position::new(chain, x));
            lanelet.width(along)
        }
    }
}

/// The point at `x` along the path over `previous_lanes` onto `chain`, `offset` to the left [m].
fn on_path(
    network: &Network,
    chain: ChainIndex,
    previous_lanes: PreviousLanes,
    x: f64,
    offset: f64,
) -> Point {
    let (mut here, mut x) = (network.chain(chain), x);
    let mut back = previous_lanes.back(network, chain);
    while x < 0.0
        && let Some(previous) = back.next()
    {
        here = network.chain(previous);
        x += here.length;
    }
    here.centre.beside(x, offset)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vehicle_has_the_same_length_in_both_lanes_just_before_and_after_it_crosses() {
        let motion = Kinematics {
            x: 0.0,
            speed: 10.0,
            acceleration: 0.0,
            headway_relaxation: 1.0,
            length: 12.0,
            id: 1,
        };
        for stretch in [0.7, 1.0, 1.3] {
            assert_eq!(lengths(&motion, 0.0, stretch)[0], 12.0, "true in the old lane when it begins");
            assert_eq!(lengths(&motion, 1.0, 1.0 / stretch)[0], 12.0, "true in the new one when it ends");
            let [old, new] = lengths(&motion, 0.499_999, stretch);
            // Its main entry is now in the other lane.
            let [new_after, old_after] = lengths(&motion, 0.5, 1.0 / stretch);
            assert!((old - old_after).abs() < 1e-4 && (new - new_after).abs() < 1e-4, "{stretch}");
        }
    }
}
