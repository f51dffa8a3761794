//! Conflict zones: where two chains cross, merge, or run so close in a bend that a long vehicle needs both.

use rstar::primitives::GeomWithData;
use rstar::{AABB, RTree};
use serde::{Deserialize, Serialize};

use super::kinship::{Kinship, Meeting};
use crate::build::Network;
use crate::chain::{Chain, ChainIndex};
use crate::geometry::Point;

/// A zone's place in [`super::Junctions::zones`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct ZoneIndex(pub u32);

impl ZoneIndex {
    /// The place as an index.
    #[inline]
    pub fn at(self) -> usize {
        self.0 as usize
    }
}

/// A stretch of one chain and a stretch of another on which vehicles would touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zone {
    /// What makes it one.
    pub kind: ZoneKind,
    /// The two stretches.
    pub sides: [Reach; 2],
    /// The side that goes first.
    pub precedence: Precedence,
}

/// What makes a zone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ZoneKind {
    /// The chains cross or touch.
    Crossing,
    /// They lead into one: who goes second follows. Stations of the place from which on they are one, along each side's
    /// chain, or beyond its end [m].
    Merging([f64; 2]),
    /// They pass so close by each other that a long vehicle takes up both.
    Tight,
}

/// A stretch of a chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// The chain.
    pub chain: ChainIndex,
    /// First station at which a vehicle's front is in the way [m].
    pub start: f64,
    /// Station that its rear has to have passed to be out of the way [m].
    pub end: f64,
}

/// Who goes first where both could.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precedence {
    /// Who came first.
    #[default]
    Arrival,
    /// The side of this number, 0 or 1; the other gives way.
    Side(u8),
    /// Who comes from the right, which is the side of this number, unless the other has waited long.
    FromTheRight(u8),
}

/// Length and width of the largest vehicle [m], and the width of a car; zones are made for these. Ours.
const LARGEST_VEHICLE: [f64; 2] = [12.0, 2.55];
const CAR_WIDTH: f64 = 1.85;
/// Space between vehicles that pass each other [m]. Ours.
const SPACE: f64 = 0.15;
/// Distance of the samples along a chain [m].
const SAMPLE: f64 = 0.5;
/// Successive samples that are looked around together: about as far as others are near.
const BLOCK: usize = 16;
/// Vehicles on levels further apart do not touch [m].
const HEIGHT: f64 = 2.5;
/// Contacts further apart along a chain than this belong to different zones [m].
const APART: f64 = 6.0;

/// A place on a chain, and the place inside of a bend that the middle of the largest vehicle passes.
#[derive(Clone, Copy)]
struct Sample {
    chain: ChainIndex,
    station: f64,
    path: Point,
    inside: Point,
    /// Half of the vehicle would be beyond the chain's ends.
    is_beyond: bool,
}

/// Two places at which vehicles would touch.
#[derive(Clone, Copy)]
struct Contact {
    stations: [f64; 2],
    /// Cars would, too.
    of_cars: bool,
    /// Only long vehicles would, which are half beyond the ends of a chain.
    is_beyond: bool,
}

/// All zones of a network, ordered by their chains.
pub(super) fn zones(network: &Network, kinship: &Kinship) -> Vec<Zone> {
    let samples = samples(network);
    let tree = RTree::bulk_load(
        samples.iter().enumerate().map(|(i, it)| GeomWithData::new([it.path.x, it.path.y], i)).collect(),
    );
    let mut zones = Vec::new();
    let mut from = 0;
    while from < samples.len() {
        let chain = samples[from].chain;
        let to = from + samples[from..].partition_point(|it| it.chain == chain);
        let mut found: Vec<(ChainIndex, Contact)> = Vec::new();
        for block in samples[from..to].chunks(BLOCK) {
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
            let contacts: Vec<Contact> = pair.iter().map(|it| it.1).collect();
            zones.extend(zones_of(kinship, [chain, pair[0].0], contacts));
        }
        from = to;
    }
    zones
}

/// All from where somebody could touch a vehicle at one of these samples.
fn around(block: &[Sample]) -> AABB<[f64; 2]> {
    let reach = LARGEST_VEHICLE[1] + SPACE + 2.0 * SAG_AT_MOST;
    let corners = block
        .iter()
        .flat_map(|Sample { path: Point { x, y, .. }, .. }| [[x - reach, y - reach], [x + reach, y + reach]]);
    AABB::from_points(&corners.collect::<Vec<_>>())
}

/// The largest vehicle's middle is taken to be no further inside of a bend than this [m].
const SAG_AT_MOST: f64 = 2.0;

fn samples(network: &Network) -> Vec<Sample> {
    let half = 0.5 * LARGEST_VEHICLE[0];
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
            let sample = |inside| Sample { chain: index, station, path, inside, is_beyond };
            samples.extend(insides.into_iter().map(sample));
        }
    }
    samples
}

/// The places at `station` of a chain, beyond its ends on each way that goes on over the chains `next` to it.
fn along(
    network: &Network,
    chain: ChainIndex,
    station: f64,
    next: fn(&Chain) -> &[ChainIndex],
) -> Vec<Point> {
    /// More chains than there are on the ways over half a vehicle's length at any junction.
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
    let touching = LARGEST_VEHICLE[1] + SPACE;
    (nearest < touching).then_some(Contact {
        stations: [here.station, there.station],
        of_cars: of_paths < CAR_WIDTH + SPACE,
        is_beyond: of_paths >= touching && (here.is_beyond || there.is_beyond),
    })
}

/// The zones of two chains with these contacts, which are in the order of the first one's stations.
fn zones_of(kinship: &Kinship, pair: [ChainIndex; 2], mut contacts: Vec<Contact>) -> Vec<Zone> {
    contacts.retain(|it| !kinship.is_one_behind_the_other(pair, it.stations));
    let mut groups: Vec<Vec<Contact>> = Vec::new();
    let (beyond, usual): (Vec<Contact>, Vec<Contact>) = contacts.into_iter().partition(|it| it.is_beyond);
    for contact in usual.into_iter().chain(beyond) {
        let fits = |group: &&mut Vec<Contact>| {
            group
                .iter()
                .rev()
                .take(32)
                .any(|it| (0..2).all(|side| (it.stations[side] - contact.stations[side]).abs() <= APART))
        };
        match groups.iter_mut().find(fits) {
            // Cars would wait for nothing in a crossing that is longer for the sake of long vehicles beyond it.
            Some(group) if contact.is_beyond && group.iter().any(|it| it.of_cars) => {}
            Some(group) => group.push(contact),
            None => groups.push(vec![contact]),
        }
    }
    groups.iter().filter_map(|group| zone_of(kinship, pair, group)).collect()
}

fn zone_of(kinship: &Kinship, pair: [ChainIndex; 2], group: &[Contact]) -> Option<Zone> {
    let bounds = [0, 1].map(|side| {
        let stations = group.iter().map(|it| it.stations[side]);
        let low = stations.clone().fold(f64::INFINITY, f64::min);
        [low - SAMPLE, stations.fold(0.0, f64::max) + SAMPLE]
    });
    let starts = bounds.map(|it| it[0]);
    let ends = bounds.map(|it| it[1]);
    let of_cars = group.iter().any(|it| it.of_cars);
    let kind = match kinship.meeting(pair, starts, ends) {
        Meeting::Forks => return None,
        Meeting::Merges(stations) => ZoneKind::Merging(stations),
        Meeting::Crosses if of_cars => ZoneKind::Crossing,
        Meeting::Crosses => ZoneKind::Tight,
    };
    let reach = |side: usize| Reach { chain: pair[side], start: starts[side].max(0.0), end: ends[side] };
    Some(Zone { kind, sides: [reach(0), reach(1)], precedence: Precedence::Arrival })
}
