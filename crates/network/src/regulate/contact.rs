//! Places of two chains at which vehicles would be near enough to touch, whether they ever meet there or not.

use std::ops::Range;

use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{RTree, RTreeObject};

use crate::chain::{Chain, ChainIndex};
use crate::geometry::{Point, Polyline, crossing};
use crate::junction::Touch;
use crate::network::Network;

/// Length of the longest vehicle, width of the widest one and of a car [m]; contacts are found for these. Ours.
pub(super) const LONGEST_VEHICLE: f64 = 12.0;
pub(super) const LONG_VEHICLE_WIDTH: f64 = 2.55;
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
/// Vehicles at least this far from each other do not touch [m].
const APART: f64 = LONG_VEHICLE_WIDTH + SPACE;
/// Distances are rounded by less than this [m].
const ROUNDED: f64 = 1e-6;
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
    /// Smallest distance between the middles of two vehicles there, of which one may be long [m].
    pub(super) nearest: f64,
    /// The paths lead in one direction, side by side.
    pub(super) is_along: bool,
    /// They are straight lanes of a road there, of one direction or of both.
    pub(super) is_road: bool,
    /// Only long vehicles would touch, with half of the vehicle beyond the ends of a chain.
    pub(super) is_beyond: bool,
}

/// A contact, and which vehicles touch there.
pub(super) type Touching<'a> = (&'a Contact, Touch);

/// A place on a chain, and the place inside of a bend where the middle of the longest vehicle passes.
#[derive(Clone, Copy)]
struct Sample {
    chain: ChainIndex,
    station: f64,
    path: Point,
    inside: Point,
    /// Distance between the two [m].
    sag: f64,
    /// Unit vector of the direction of travel.
    direction: [f64; 2],
    /// The direction stays the same along a vehicle there.
    is_straight: bool,
    /// Half of the vehicle would be beyond the chain's ends.
    is_beyond: bool,
    /// Whether cars, and whether long vehicles, drive there.
    is_open_for: [bool; 2],
}

/// Successive samples of one chain.
struct Block {
    chain: ChainIndex,
    samples: Range<usize>,
    /// Its first and its last place.
    ends: [Point; 2],
    /// Its vehicles are no further than this from the line between these [m].
    breadth: f64,
}

/// The places of a network at which contacts are sought.
struct Search {
    samples: Vec<Sample>,
    blocks: Vec<Block>,
    /// The blocks by where they are.
    tree: RTree<GeomWithData<Rectangle<[f64; 2]>, usize>>,
    /// Number of comparisons of two places.
    comparisons: u64,
}

/// What was found, and the number of comparisons that it took.
pub(super) struct Contacts {
    /// The contacts of each pair of chains that has any, the chain of the smaller index first; in the order of
    /// stations.
    pub(super) of_pairs: Vec<([ChainIndex; 2], Vec<Contact>)>,
    /// Number of comparisons of two places.
    pub(super) comparisons: u64,
}

/// All contacts of `network`.
pub(super) fn contacts(network: &Network) -> Contacts {
    let mut search = Search::new(samples(network));
    let mut of_pairs = Vec::new();
    let mut blocks = 0..0;
    while blocks.end < search.blocks.len() {
        let chain = search.blocks[blocks.end].chain;
        let count = search.blocks[blocks.end..].iter().take_while(|it| it.chain == chain).count();
        blocks = blocks.end..blocks.end + count;
        let mut found: Vec<(ChainIndex, Contact)> = Vec::new();
        blocks.clone().for_each(|block| search.add_contacts(block, &mut found));
        found.sort_by(|(a, one), (b, other)| {
            let [by_here, by_there] = [0, 1].map(|side| one.stations[side].total_cmp(&other.stations[side]));
            a.cmp(b).then(by_here).then(by_there)
        });
        for pair in found.chunk_by(|a, b| a.0 == b.0) {
            of_pairs.push(([chain, pair[0].0], pair.iter().map(|it| it.1).collect()));
        }
    }
    Contacts { of_pairs, comparisons: search.comparisons }
}

impl Search {
    fn new(samples: Vec<Sample>) -> Search {
        let mut blocks = Vec::new();
        let mut start = 0;
        for of_chain in samples.chunk_by(|a, b| a.chain == b.chain) {
            for block in of_chain.chunks(BLOCK) {
                blocks.push(Block::of(block, start));
                start += block.len();
            }
        }
        let rectangle = |it: &Block| rectangle(&samples[it.samples.clone()], 0.0);
        let items = blocks.iter().enumerate().map(|(i, it)| GeomWithData::new(rectangle(it), i)).collect();
        Search { samples, blocks, tree: RTree::bulk_load(items), comparisons: 0 }
    }

    /// Adds the contacts of a block with those of later chains.
    fn add_contacts(&mut self, block: usize, found: &mut Vec<(ChainIndex, Contact)>) {
        let Search { samples, blocks, tree, comparisons } = self;
        let here = &blocks[block];
        let around = rectangle(&samples[here.samples.clone()], APART + 2.0 * SAG_AT_MOST);
        let near = tree.locate_in_envelope_intersecting(around.envelope()).map(|it| it.data);
        let is_near = |it: &usize| blocks[*it].chain > here.chain && here.is_near(&blocks[*it]);
        let mut near: Vec<usize> = near.inspect(|_| *comparisons += 1).filter(is_near).collect();
        near.sort_unstable();
        for one in &samples[here.samples.clone()] {
            for there in near.iter().map(|it| &blocks[*it]) {
                let mut others = samples[there.samples.clone()].iter();
                while let Some(other) = others.next() {
                    *comparisons += 1;
                    let distance = one.path.distance(&other.path) - APART - one.sag.max(there.breadth);
                    if distance < ROUNDED {
                        found.extend(contact(one, other).map(|it| (there.chain, it)));
                    } else if let skipped @ 1.. = ((distance - ROUNDED) / SAMPLE) as usize {
                        // So many of the next ones are not near enough either.
                        others.nth(skipped - 1);
                    }
                }
            }
        }
    }
}

impl Block {
    /// Successive samples, the first of which has this number.
    fn of(samples: &[Sample], start: usize) -> Block {
        let ends = [samples[0].path, samples[samples.len() - 1].path];
        let breadth = |it: &Sample| it.path.distance_to_segment(ends) + it.sag;
        let breadth = samples.iter().map(breadth).fold(0.0, f64::max);
        Block { chain: samples[0].chain, samples: start..start + samples.len(), ends, breadth }
    }

    /// Whether their vehicles may touch.
    fn is_near(&self, other: &Block) -> bool {
        let far = APART + self.breadth + other.breadth + ROUNDED;
        let are_near = |points: [Point; 2], line| points.iter().any(|it| it.distance_to_segment(line) <= far);
        are_near(self.ends, other.ends)
            || are_near(other.ends, self.ends)
            || crossing(&self.ends, &other.ends).is_some()
    }
}

/// The rectangle that holds the paths of some samples, and `reach` [m] around.
fn rectangle(samples: &[Sample], reach: f64) -> Rectangle<[f64; 2]> {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for Sample { path: Point { x, y, .. }, .. } in samples {
        low = [low[0].min(x - reach), low[1].min(y - reach)];
        high = [high[0].max(x + reach), high[1].max(y + reach)];
    }
    Rectangle::from_corners(low, high)
}

fn samples(network: &Network) -> Vec<Sample> {
    let half = 0.5 * LONGEST_VEHICLE;
    let mut samples = Vec::new();
    let [mut rears, mut fronts, mut insides] = [const { Vec::new() }; 3];
    for (chain, index) in network.chains.iter().zip(0..) {
        let index = ChainIndex(index);
        let directions = Directions::of(&chain.centre);
        let count = (chain.length / SAMPLE).ceil() as usize;
        for number in 0..=count {
            let station = (number as f64 * SAMPLE).min(chain.length);
            let path = chain.centre.at(station);
            along(network, index, station - half, |it| &it.previous, &mut rears);
            along(network, index, station + half, |it| &it.following, &mut fronts);
            insides.clear();
            for middle in rears.iter().flat_map(|rear| fronts.iter().map(|front| rear.midpoint(front))) {
                let share = (SAG_AT_MOST / path.distance(&middle).max(SAG_AT_MOST)).min(1.0);
                let inside = path.towards(&middle, share);
                if insides.iter().all(|it: &Point| it.distance(&inside) > SPACE) {
                    insides.push(inside);
                }
            }
            if insides.is_empty() {
                insides.push(path);
            }
            let is_beyond = station < half || station + half > chain.length;
            let (heading, direction) = directions.at(station);
            let turns = |at: f64| {
                let turn = directions.at(at.clamp(0.0, chain.length)).0 - heading;
                turn != 0.0 && turn.sin().abs() > STRAIGHT
            };
            let is_straight = !turns(station - half) && !turns(station + half);
            let is_open_for = [false, true].map(|is_long| chain.is_open(station, is_long));
            let sample = |inside: &Point| Sample {
                chain: index,
                station,
                path,
                inside: *inside,
                sag: path.distance(inside),
                direction,
                is_straight,
                is_beyond,
                is_open_for,
            };
            samples.extend(insides.iter().map(sample));
        }
    }
    samples
}

/// The directions of the segments of a line.
struct Directions<'a> {
    line: &'a Polyline,
    /// Heading [rad], and unit vector.
    of_segments: Vec<(f64, [f64; 2])>,
}

impl<'a> Directions<'a> {
    fn of(line: &'a Polyline) -> Directions<'a> {
        let direction = |heading: f64| {
            let (sin, cos) = heading.sin_cos();
            (heading, [cos, sin])
        };
        Directions { line, of_segments: line.headings().iter().copied().map(direction).collect() }
    }

    fn at(&self, station: f64) -> (f64, [f64; 2]) {
        self.of_segments[self.line.segment(station).0]
    }
}

/// Finds the `places` at `station` of a chain; beyond its ends, on each path over the chains `next` to it.
fn along(
    network: &Network,
    chain: ChainIndex,
    station: f64,
    next: fn(&Chain) -> &[ChainIndex],
    places: &mut Vec<Point>,
) {
    /// Maximum of chains on the paths over half a vehicle's length; no junction has as many.
    const MOST: usize = 64;
    places.clear();
    let on = network.chain(chain);
    if (0.0..=on.length).contains(&station) {
        places.push(on.centre.at(station));
        return;
    }
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
}

fn contact(here: &Sample, there: &Sample) -> Option<Contact> {
    if (here.path.z - there.path.z).abs() > HEIGHT {
        return None;
    }
    let of_paths = here.path.distance(&there.path);
    let nearest = of_paths.min(here.inside.distance(&there.path)).min(here.path.distance(&there.inside));
    if nearest >= APART {
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
        nearest,
        is_along: is_side_by_side && along > 0.0,
        is_road,
        is_beyond: of_paths >= LONG_VEHICLE_WIDTH + space && (here.is_beyond || there.is_beyond),
    })
}
