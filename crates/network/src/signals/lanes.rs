//! The lanes before lights, and the ways beyond them.

use crate::chain::{ChainIndex, Position};
use crate::geometry::Point;
use crate::junction::{Junctions, LightIndex, Sign, Touch, ZoneIndex};
use crate::network::Network;

/// Zones further beyond a light, or beyond the last zone, belong to another junction [m]. Ours.
const REACH: f64 = 80.0;
const NEXT: f64 = 25.0;
/// The direction of a lane is taken this far before its line [m].
const BEFORE: f64 = 3.0;

/// A lane that leads to a light.
pub(super) struct Lane {
    pub(super) light: LightIndex,
    /// Where its drivers stop.
    pub(super) stop: Position,
    pub(super) point: Point,
    /// Its direction there [rad].
    pub(super) heading: f64,
    /// The ways beyond it.
    pub(super) ways: Vec<Way>,
    /// Longest path from the stop line to the end of the last zone [m].
    pub(super) clearance: f64,
}

/// A way through a junction.
#[derive(Clone)]
pub(super) struct Way {
    /// The zones on it, each with its side.
    pub(super) zones: Vec<(ZoneIndex, u8)>,
    /// The first place beyond the line that other ways from there do not pass.
    pub(super) via: Position,
    /// The place where it ends.
    pub(super) end: Position,
    /// Its length from the line [m].
    pub(super) length: f64,
}

impl Lane {
    /// The zones that its drivers reach, each with its side. A zone may come several times.
    pub(super) fn zones(&self) -> impl Iterator<Item = (ZoneIndex, u8)> {
        self.ways.iter().flat_map(|it| it.zones.iter().copied())
    }
}

/// The lanes before lights, in the order of chains.
pub(super) fn lanes(network: &Network, junctions: &Junctions) -> Vec<Lane> {
    let mut lanes = Vec::new();
    for (chain, index) in junctions.chains.iter().zip(0..) {
        for stop in &chain.stops {
            if let Sign::Light(light) = stop.sign {
                let stop = Position::new(ChainIndex(index), stop.station);
                let centre = &network.chain(stop.chain).centre;
                let (point, heading) = (centre.at(stop.x), centre.heading((stop.x - BEFORE).max(0.0)));
                let (ways, clearance) = ways(network, junctions, stop);
                lanes.push(Lane { light, stop, point, heading, ways, clearance });
            }
        }
    }
    lanes
}

/// A way that is being followed.
struct Open {
    way: Way,
    chain: ChainIndex,
    /// Station there from which on it is followed [m].
    from: f64,
    /// Distance from the stop to the chain's start, and to the end of the last zone [m].
    base: f64,
    reached: f64,
}

/// The ways beyond a `stop`, and the clearance.
fn ways(network: &Network, junctions: &Junctions, stop: Position) -> (Vec<Way>, f64) {
    let (mut ways, mut clearance) = (Vec::new(), 0.0_f64);
    let way = Way { zones: Vec::new(), via: stop, end: stop, length: 0.0 };
    let mut open = vec![Open { way, chain: stop.chain, from: stop.x, base: -stop.x, reached: NEXT }];
    while let Some(Open { mut way, chain, from, base, mut reached }) = open.pop() {
        for crossing in &junctions.on(chain).crossings {
            let reach = junctions.reach(*crossing);
            let is_ahead = reach.end > from && base + reach.start < (reached + NEXT).min(REACH);
            if is_ahead && junctions.zones[crossing.zone.at()].touch == Touch::Any {
                way.zones.push((crossing.zone, crossing.side));
                reached = reached.max(base + reach.end);
                clearance = clearance.max(base + reach.end);
            }
        }
        let length = network.chain(chain).length;
        let following = &network.chain(chain).following;
        if base + length < (reached + NEXT).min(REACH) && !following.is_empty() {
            let on = |next: &ChainIndex| {
                let via = if way.via.chain == stop.chain { Position::new(*next, 0.0) } else { way.via };
                let way = Way { via, ..way.clone() };
                Open { way, chain: *next, from: 0.0, base: base + length, reached }
            };
            open.extend(following.iter().map(on));
        } else {
            let end = (reached - base).clamp(0.0, length);
            (way.end, way.length) = (Position::new(chain, end), base + end);
            ways.push(way);
        }
    }
    (ways, clearance)
}
