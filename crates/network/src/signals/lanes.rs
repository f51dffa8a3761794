//! The lanes before lights, and the ways beyond them.

use std::collections::BTreeMap;

use crate::chain::{ChainIndex, Position};
use crate::geometry::Point;
use crate::junction::{Junctions, LightIndex, Sign, Touch, ZoneIndex};
use crate::network::Network;

/// Zones further beyond a light, or beyond the last zone, belong to another junction [m]. Ours.
const REACH: f64 = 80.0;
const NEXT: f64 = 25.0;
/// The direction of a lane is taken this far before its line [m].
const BEFORE: f64 = 3.0;
/// A line this close to the start of a chain holds up the lane that forks there [m]. Ours.
const AT_THE_FORK: f64 = 5.0;

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
    /// The chains on it.
    pub(super) chains: Vec<ChainIndex>,
    /// A place on it that no other way from the same lane passes, if there is one.
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

    /// The lane of the drivers who stop at `stop`, with the ways from there on.
    fn before(network: &Network, junctions: &Junctions, light: LightIndex, stop: Position) -> Lane {
        let centre = &network.chain(stop.chain).centre;
        let (point, heading) = (centre.at(stop.x), centre.heading((stop.x - BEFORE).max(0.0)));
        let (ways, clearance) = ways(network, junctions, stop);
        Lane { light, stop, point, heading, ways, clearance }
    }
}

/// The lanes before lights, in the order of chains. Where a lane forks into several at their lines, it is one lane.
pub(super) fn lanes(network: &Network, junctions: &Junctions) -> Vec<Lane> {
    let mut lanes: Vec<Lane> = Vec::new();
    let mut forks: BTreeMap<(LightIndex, ChainIndex), usize> = BTreeMap::new();
    for (chain, index) in junctions.chains.iter().zip(0..) {
        for stop in &chain.stops {
            let Sign::Light(light) = stop.sign else { continue };
            let mut lane =
                Lane::before(network, junctions, light, Position::new(ChainIndex(index), stop.station));
            let previous = &network.chains[index as usize].previous;
            if let ([fork], true) = (&previous[..], stop.station < AT_THE_FORK) {
                if let Some(known) = forks.get(&(light, *fork)) {
                    lanes[*known].clearance = lanes[*known].clearance.max(lane.clearance);
                    lanes[*known].ways.extend(lane.ways);
                    continue;
                }
                lane.stop = Position::new(*fork, network.chain(*fork).length);
                forks.insert((light, *fork), lanes.len());
            }
            lanes.push(lane);
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
    /// It has not forked yet.
    is_whole: bool,
}

/// The ways beyond a `stop`, and the clearance.
fn ways(network: &Network, junctions: &Junctions, stop: Position) -> (Vec<Way>, f64) {
    let (mut ways, mut clearance) = (Vec::new(), 0.0_f64);
    let way = Way { zones: Vec::new(), chains: Vec::new(), via: stop, end: stop, length: 0.0 };
    let (chain, from) = (stop.chain, stop.x);
    let mut open = vec![Open { way, chain, from, base: -from, reached: NEXT, is_whole: true }];
    while let Some(Open { mut way, chain, from, base, mut reached, is_whole }) = open.pop() {
        way.chains.push(chain);
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
            let forks = following.len() > 1;
            let on = |next: &ChainIndex| {
                let via = if is_whole && forks { Position::new(*next, 0.0) } else { way.via };
                let (way, base) = (Way { via, ..way.clone() }, base + length);
                Open { way, chain: *next, from: 0.0, base, reached, is_whole: is_whole && !forks }
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
