//! Where a vehicle's body is. Computed when somebody asks.

use laneweave_models::change::moved_share;
use laneweave_network::{ChainIndex, Network, Point, Pose};

use crate::scene::Spot;
use crate::traffic::{Car, Lane, Mind};

/// Largest angle between a vehicle and its lane in a change [rad].
const LARGEST_YAW: f64 = 0.25;

/// Pose of the centre of the vehicle whose main entry is `spot`.
pub fn pose(network: &Network, lanes: &[Lane], spot: Spot) -> Pose {
    let lane = &lanes[spot.chain.at()];
    let (car, mind) = (&lane.cars()[spot.index], &lane.minds()[spot.index]);
    let offset = lateral_offset(network, spot.chain, car, mind);
    let front = on_path(network, spot.chain, mind.came_from, car.x, offset);
    let rear = on_path(network, spot.chain, mind.came_from, car.rear(), offset);
    let along = (front.y - rear.y).atan2(front.x - rear.x);
    Pose { at: rear.towards(&front, 0.5), heading: along + yaw(network, spot.chain, car, mind) }
}

/// How far the vehicle is to the left of the centre of its lane [m].
pub fn lateral_offset(network: &Network, chain: ChainIndex, car: &Car, mind: &Mind) -> f64 {
    let share = moved_share(f64::from(mind.progress));
    if share == 0.0 {
        return 0.0;
    }
    let from_here = if mind.progress < 0.5 { share } else { share - 1.0 };
    mind.side.sign() * from_here * lane_spacing(network, chain, car, mind)
}

/// Distance between the centre lines of the two lanes [m].
fn lane_spacing(network: &Network, chain: ChainIndex, car: &Car, mind: &Mind) -> f64 {
    match mind.twin {
        Some(twin) => {
            let here = network.chain(chain).centre.at(car.x);
            here.distance(&network.chain(twin.chain).centre.at(twin.x))
        }
        None => {
            let (lanelet, along) = network.lanelet_at(chain, car.x);
            lanelet.width(along)
        }
    }
}

/// The angle between the vehicle and its lane.
fn yaw(network: &Network, chain: ChainIndex, car: &Car, mind: &Mind) -> f64 {
    let p = f64::from(mind.progress).clamp(0.0, 1.0);
    if p == 0.0 {
        return 0.0;
    }
    // dy/dx of the quintic over the way that a change takes, some four seconds.
    let slope = 30.0 * p * p * (1.0 - p) * (1.0 - p);
    let way = (4.0 * car.speed).max(1.0);
    let angle = (slope * lane_spacing(network, chain, car, mind) / way).atan();
    mind.side.sign() * angle.min(LARGEST_YAW)
}

/// The point at `x` along the path that came from `previous` onto `chain`, `offset` to the left [m].
fn on_path(network: &Network, chain: ChainIndex, previous: Option<ChainIndex>, x: f64, offset: f64) -> Point {
    match previous {
        Some(previous) if x < 0.0 => {
            let before = network.chain(previous);
            before.centre.beside(before.length + x, offset)
        }
        _ => network.chain(chain).centre.beside(x, offset),
    }
}
