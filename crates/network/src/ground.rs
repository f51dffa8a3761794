//! The ground: which lanes a rectangle on it touches, and where. Vehicles that do not drive along lanes are seen by
//! this.

use rstar::primitives::{GeomWithData, Rectangle as Box};
use rstar::{AABB, RTree};

use crate::chain::{ChainIndex, Position};
use crate::geometry::Point;
use crate::network::Network;
use crate::rectangle::Rectangle;

/// Half the width of a path along the centre line of a lane [m] (ours). It is a little more than half of the widest
/// vehicle, so that what stands beside the path is not struck; in usual lanes the paths of two neighbours leave less
/// room between them than the narrowest vehicle needs.
const HALF_PATH: [f64; 2] = [1.3, 1.5];
/// What reaches into a lane by less than this does not touch its path [m] (ours).
const TO_BORDER: f64 = 0.2;
/// Stretches of one lane that are no further apart are one [m].
const JOINED: f64 = 0.5;

/// The paths of all lanes.
#[derive(Debug)]
pub struct Ground {
    pieces: RTree<GeomWithData<Box<[f64; 2]>, Piece>>,
}

/// A straight piece of the path along a lane.
#[derive(Clone, Copy, Debug)]
struct Piece {
    chain: ChainIndex,
    /// Station of its start [m].
    start: f64,
    from: Point,
    to: Point,
    half_width: f64,
}

/// A stretch of the path along a lane that a rectangle touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// The lane.
    pub chain: ChainIndex,
    /// First station [m].
    pub from: f64,
    /// Last station [m].
    pub to: f64,
    /// Height of the lane [m].
    pub height: f64,
}

impl Ground {
    /// The ground of `network`.
    pub fn new(network: &Network) -> Ground {
        let chains = (0..network.chains.len() as u32).map(ChainIndex);
        Ground { pieces: RTree::bulk_load(chains.flat_map(|it| pieces(network, it)).collect()) }
    }

    /// The stretches that `rectangle` touches, whatever their heights, in the order of chains and stations.
    pub fn footprints(&self, rectangle: &Rectangle) -> Vec<Footprint> {
        let corners = rectangle.corners();
        let around = AABB::from_points(&corners.map(|it| [it.x, it.y]));
        let near = self.pieces.locate_in_envelope_intersecting(around);
        let mut touched: Vec<Footprint> = near.filter_map(|it| it.data.touched(&corners)).collect();
        touched
            .sort_by(|a, b| (a.chain, a.from).partial_cmp(&(b.chain, b.from)).expect("stations are numbers"));
        touched.dedup_by(|next, last| {
            let is_one = next.chain == last.chain && next.from <= last.to + JOINED;
            if is_one {
                last.to = last.to.max(next.to);
            }
            is_one
        });
        touched
    }
}

/// The pieces of the path along a lane, with the boxes that contain them.
fn pieces(network: &Network, chain: ChainIndex) -> Vec<GeomWithData<Box<[f64; 2]>, Piece>> {
    let centre = &network.chain(chain).centre;
    let mut start = 0.0;
    let mut all = Vec::with_capacity(centre.points().len() - 1);
    for pair in centre.points().windows(2) {
        let [from, to] = [pair[0], pair[1]];
        let (lanelet, along) = network.lanelet_at(Position::new(chain, start));
        let half_width = (0.5 * lanelet.width(along) - TO_BORDER).clamp(HALF_PATH[0], HALF_PATH[1]);
        let low = [from.x.min(to.x) - half_width, from.y.min(to.y) - half_width];
        let high = [from.x.max(to.x) + half_width, from.y.max(to.y) + half_width];
        let piece = Piece { chain, start, from, to, half_width };
        all.push(GeomWithData::new(Box::from_corners(low, high), piece));
        start += from.distance(&to);
    }
    all
}

impl Piece {
    /// The stretch that a rectangle with these corners touches.
    fn touched(&self, corners: &[Point; 4]) -> Option<Footprint> {
        let Piece { chain, start, from, to, half_width } = *self;
        let length = from.distance(&to);
        let (cos, sin) = ((to.x - from.x) / length, (to.y - from.y) / length);
        let local = corners.map(|it| {
            let (dx, dy) = (it.x - from.x, it.y - from.y);
            [dx * cos + dy * sin, dy * cos - dx * sin]
        });
        let mut first = f64::INFINITY;
        let mut last = f64::NEG_INFINITY;
        for (number, [x, y]) in local.iter().enumerate() {
            let [other_x, other_y] = local[(number + 1) % 4];
            // The part of this edge that lies on the path.
            let mut part = [0.0_f64, 1.0_f64];
            for (distance, way) in [(y + half_width, other_y - y), (half_width - y, y - other_y)] {
                // Inside where distance + share * way is not negative.
                if way > 0.0 {
                    part[0] = part[0].max(-distance / way);
                } else if way < 0.0 {
                    part[1] = part[1].min(-distance / way);
                } else if distance < 0.0 {
                    part = [1.0, 0.0];
                }
            }
            if part[0] <= part[1] {
                for x in part.map(|share| x + share * (other_x - x)) {
                    (first, last) = (first.min(x), last.max(x));
                }
            }
        }
        let (first, last) = (first.max(0.0), last.min(length));
        let height = 0.5 * (from.z + to.z);
        (first < last).then_some(Footprint { chain, from: start + first, to: start + last, height })
    }
}

#[cfg(test)]
mod tests;
