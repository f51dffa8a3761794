//! Places of two chains at which vehicles would be near enough to touch, whether they ever meet there or not.

use rstar::primitives::GeomWithData;
use rstar::{AABB, RTree};

use crate::chain::{Chain, ChainIndex};
use crate::geometry::Point;
use crate::junction::Touch;
use crate::network::Network;

/// Length of the longest vehicle, width of the widest one and of a car [m]; contacts are found for these. Ours.
pub(super) const LONGEST_VEHICLE: f64 = 12.0;
const LONG_VEHICLE_WIDTH: f64 = 2.55;
const CAR_WIDTH: f64 = 1.85;
/// Space between vehicles whose paths cross at an angle, or bend: there their corners swing out [m]. Ours.
const SPACE: f64 = 0.15;
/// Paths lead side by side where their directions differ by at most this [rad]. Ours.
const SIDE_BY_SIDE: f64 = 0.2;
/// Paths are straight lanes of a road where their directions differ by at most this, and change by at most this along
/// a vehicle [rad]. Vehicles pass each other there without space between. Ours.
const STRAIGHT: f64 = 0.04;
/// Distance of the samples along a chain [m].
pub(super) const SAMPLE: f64 = 0.5;
/// Number of successive samples with one common search for others: about as far as others are near.
const BLOCK: usize = 16;
/// Vehicles on levels further apart do not touch [m].
const HEIGHT: f64 = 2.5;
/// In a bend, the middle of the longest vehicle is assumed to be at most this far inside [m].
const SAG_AT_MOST: f64 = 2.0;

/// Two places at which vehicles would be near each other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact {
    /// On the one chain and on the other [m].
    pub(super) stations: [f64; 2],
    /// Which vehicles would touch; `None` if all have space beside each other, or if cars do and no long vehicle
    /// comes there.
    pub(super) touch: Option<Touch>,
    /// The paths lead in one direction, side by side.
    pub(super) is_along: bool,
    /// They are straight lanes of a road there, of one direction or of both.
    pub(super) is_road: bool,
    /// Only long vehicles would touch, with half of the vehicle beyond the ends of a chain.
    pub(super) is_beyond: bool,
}

/// A place on a chain, and the place inside of a bend where the middle of the longest vehicle passes.
#[derive(Clone, Copy)]
struct Sample {
    chain: ChainIndex,
    station: f64,
    path: Point,
    inside: Point,
    /// Unit vector of the direction of travel.
    direction: [f64; 2],
    /// The direction stays the same along a vehicle there.
    is_straight: bool,
    /// Half of the vehicle would be beyond the chain's ends.
    is_beyond: bool,
    /// Whether cars, and whether long vehicles, drive there.
    is_open_for: [bool; 2],
}

/// The contacts of each pair of chains that has any, the chain of the smaller index first; in the order of stations.
pub(super) fn contacts(network: &Network) -> Vec<([ChainIndex; 2], Vec<Contact>)> {
    let samples = samples(network);
    let tree = RTree::bulk_load(
        samples.iter().enumerate().map(|(i, it)| GeomWithData::new([it.path.x, it.path.y], i)).collect(),
    );
    let mut all = Vec::new();
    for of_chain in samples.chunk_by(|a, b| a.chain == b.chain) {
        let chain = of_chain[0].chain;
        let mut found: Vec<(ChainIndex, Contact)> = Vec::new();
        for block in of_chain.chunks(BLOCK) {
            let near = tree.locate_in_envelope(around(block)).map(|it| &samples[it.data]);
            let later: Vec<&Sample> = near.filter(|it| it.chain > chain).collect();
            for here in block {
                found.extend(later.iter().filter_map(|there| Some((there.chain, contact(here, there)?))));
            }
        }
        found.sort_by(|(a, one), (b, other)| {
            let [by_here, by_there] = [0, 1].map(|side| one.stations[side].total_cmp(&other.stations[side]));
            a.cmp(b).then(by_here).then(by_there)
        });
        for pair in found.chunk_by(|a, b| a.0 == b.0) {
            all.push(([chain, pair[0].0], pair.iter().map(|it| it.1).collect()));
        }
    }
    all
}

/// All places from which a vehicle could touch a vehicle at one of these samples.
fn around(block: &[Sample]) -> AABB<[f64; 2]> {
    let reach = LONG_VEHICLE_WIDTH + SPACE + 2.0 * SAG_AT_MOST;
    let corners = block
        .iter()
        .flat_map(|Sample { path: Point { x, y, .. }, .. }| [[x - reach, y - reach], [x + reach, y + reach]]);
    AABB::from_points(&corners.collect::<Vec<_>>())
}

fn samples(network: &Network) -> Vec<Sample> {
    let half = 0.5 * LONGEST_VEHICLE;
    let mut samples = Vec::new();
    for (chain, index) in network.chains.iter().zip(0..) {
        let index = ChainIndex(index);
        let count = (chain.length / SAMPLE).ceil() as usize;
        for number in 0..=count {
            let station = (number as f64 * SAMPLE).min(chain.length);
            let path = chain.centre.at(station);
            let mut insides: Vec<Point> = Vec::new();
            for rear in along(network, index, station - half, |it| &it.previous) {
                for front in along(network, index, station + half, |it| &it.following) {
                    let middle = rear.midpoint(&front);
                    let share = (SAG_AT_MOST / path.distance(&middle).max(SAG_AT_MOST)).min(1.0);
                    let inside = path.towards(&middle, share);
                    if insides.iter().all(|it| it.distance(&inside) > SPACE) {
                        insides.push(inside);
                    }
                }
            }
            if insides.is_empty() {
                insides.push(path);
            }
            let is_beyond = station < half || station + half > chain.length;
            let heading = chain.centre.heading(station);
            let (sin, cos) = heading.sin_cos();
            let turns = |at: f64| {
                let turn = chain.centre.heading(at.clamp(0.0, chain.length)) - heading;
                turn.sin().abs() > STRAIGHT
            };
            let is_straight = !turns(station - half) && !turns(station + half);
            let is_open_for = [false, true].map(|is_long| chain.is_open(station, is_long));
            let direction = [cos, sin];
            let sample = |inside| Sample {
                chain: index,
                station,
                path,
                inside,
                direction,
                is_straight,
                is_beyond,
                is_open_for,
            };
            samples.extend(insides.into_iter().map(sample));
        }
    }
    samples
}

/// The places at `station` of a chain; beyond its ends, on each path over the chains `next` to it.
fn along(
    network: &Network,
    chain: ChainIndex,
    station: f64,
    next: fn(&Chain) -> &[ChainIndex],
) -> Vec<Point> {
    /// Maximum of chains on the paths over half a vehicle's length; no junction has as many.
    const MOST: usize = 64;
    let mut places = Vec::new();
    let mut open = vec![(chain, station)];
    for _ in 0..MOST {
        let Some((index, station)) = open.pop() else { break };
        let chain = network.chain(index);
        if (0.0..=chain.length).contains(&station) {
            places.push(chain.centre.at(station));
        } else {
            let beyond = |it: &ChainIndex| {
                let length = network.chain(*it).length;
                (*it, if station < 0.0 { station + length } else { station - chain.length })
            };
            open.extend(next(chain).iter().map(beyond));
        }
    }
    places
}

fn contact(here: &Sample, there: &Sample) -> Option<Contact> {
    if (here.path.z - there.path.z).abs() > HEIGHT {
        return None;
    }
    let of_paths = here.path.distance(&there.path);
    let nearest = of_paths.min(here.inside.distance(&there.path)).min(here.path.distance(&there.inside));
    if nearest >= LONG_VEHICLE_WIDTH + SPACE {
        return None;
    }
    let ([ax, ay], [bx, by]) = (here.direction, there.direction);
    let (along, across) = (ax * bx + ay * by, ax * by - ay * bx);
    let is_side_by_side = across.abs() <= SIDE_BY_SIDE.sin();
    let is_road = here.is_straight && there.is_straight && across.abs() <= STRAIGHT;
    let space = if is_road { 0.0 } else { SPACE };
    let touches = |[one, other]: [bool; 2]| {
        let width = |is_long| if is_long { LONG_VEHICLE_WIDTH } else { CAR_WIDTH };
        let distance = if one || other { nearest } else { of_paths };
        let is_there = here.is_open_for[usize::from(one)] && there.is_open_for[usize::from(other)];
        is_there && distance < 0.5 * (width(one) + width(other)) + space
    };
    let touch = if touches([false; 2]) {
        Some(Touch::Any)
    } else if touches([true, false]) || touches([false, true]) {
        Some(Touch::OneLong)
    } else {
        touches([true; 2]).then_some(Touch::BothLong)
    };
    Some(Contact {
        stations: [here.station, there.station],
        touch,
        is_along: is_side_by_side && along > 0.0,
        is_road,
        is_beyond: of_paths >= LONG_VEHICLE_WIDTH + space && (here.is_beyond || there.is_beyond),
    })
}
