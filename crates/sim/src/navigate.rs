//! Which lanes lead where: for every destination and chain the lane changes still to make, the last place for the
//! next of them, and the way on.

use std::borrow::Cow;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

use laneweave_network::{Chain, ChainIndex, Network, Side};

use crate::place::{Kerb, Place};
use crate::vehicle::Class;
use crate::views::Views;

/// Where a driver goes, as its place in the list of destinations; `None`: it drives on as the road leads.
pub type Destination = Option<u16>;

/// A destination in two bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Goal(u16);

impl Goal {
    const NONE: u16 = u16::MAX;

    /// The destination.
    #[inline]
    pub fn destination(self) -> Destination {
        (self.0 != Goal::NONE).then_some(self.0)
    }
}

impl From<Destination> for Goal {
    fn from(destination: Destination) -> Goal {
        Goal(destination.unwrap_or(Goal::NONE))
    }
}

/// What a chain means on the way to a destination.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Waypoint {
    /// n: fewest lane changes from it to a lane that leads there; [`Waypoint::NO_WAY`] if none does.
    pub changes: u32,
    /// Last place for the next of them, from the chain's start, beyond its end if on a later one [m]; infinite for
    /// n = 0.
    pub last_place: f64,
    /// The chain that it goes on with.
    pub next: Option<ChainIndex>,
    /// Free travel time from its start to the destination [s].
    pub time: f64,
    /// Way from its start to the destination [m].
    pub distance: f64,
    /// Where on it the trip ends [m]; infinite where it goes on to the chain's end.
    pub end: f64,
}

impl Waypoint {
    /// More changes than any road has lanes: there is no way.
    pub const NO_WAY: u32 = 1000;

    const NOWHERE: Waypoint = Waypoint {
        changes: Waypoint::NO_WAY,
        last_place: 0.0,
        next: None,
        time: f64::INFINITY,
        distance: f64::INFINITY,
        end: f64::INFINITY,
    };

    /// The destination can still be reached from `x` on the chain.
    #[inline]
    pub fn leads_on(&self, x: f64) -> bool {
        self.changes < Waypoint::NO_WAY && x <= self.last_place && x <= self.end
    }

    /// What is least on the best way [s].
    fn cost(&self) -> f64 {
        self.time + Navigator::CHANGE_COST * f64::from(self.changes)
    }
}

/// Where on a chain the trips to a destination end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TripEnd {
    /// Along the chain [m].
    pub(crate) station: f64,
    /// For whom.
    pub(crate) goal: Goal,
}

/// The waypoints of all destinations.
#[derive(Clone, Debug)]
pub struct Navigator {
    /// For each view of the roads: for each destination the waypoints by chain; last, those of drivers without one.
    tables: Vec<Vec<Waypoint>>,
    /// Number of tables of each view.
    of_view: usize,
    views: Views,
    /// For each chain where trips end before its end.
    trip_ends: Vec<Vec<TripEnd>>,
}

impl Navigator {
    /// Waypoints that may be planned, ours: 2.4 GB.
    pub(crate) const MOST_WAYPOINTS: usize = 50_000_000;
    /// What a lane change counts for in the choice of a route [s].
    const CHANGE_COST: f64 = 20.0;
    /// Road that is kept for each further change before the last place [m].
    const ROOM_FOR_A_CHANGE: f64 = 40.0;
    /// What a chain counts for beside its time in the choice of a route, if it is avoided [s], ours: no detour in a town is
    /// as long.
    const AVOIDED: f64 = 600.0;
    /// Nobody starts for a place on the same map that is nearer [m], ours.
    const SHORTEST_TRIP: f64 = 100.0;

    /// Plans all routes to the exits of `network`.
    pub fn new(network: &Network) -> Navigator {
        let exits: Vec<Place> = network.exits.iter().cloned().map(Place::Gate).collect();
        Navigator::towards(network, &exits)
    }

    /// Plans all routes to `destinations`, for classes that avoid nothing.
    pub fn towards(network: &Network, destinations: &[Place]) -> Navigator {
        Navigator::with_views(network, destinations, Views::default())
    }

    /// Plans all routes to `destinations`, of which there are [`Demand::MOST_DESTINATIONS`] at most, for classes with their
    /// views of the roads.
    pub(crate) fn with_views(network: &Network, destinations: &[Place], views: Views) -> Navigator {
        let into = beside_into(network);
        let of_view = destinations.len() + 1;
        let mut tables = Vec::new();
        let mut trip_ends = vec![Vec::new(); network.chains.len()];
        for view in 0..views.count() {
            let delay = |chain| if views.avoids(view, chain) { Navigator::AVOIDED } else { 0.0 };
            for place in destinations {
                if let Place::Kerb(Kerb { chain, station, .. }) = place {
                    let goal = Goal(tables.len() as u16);
                    trip_ends[chain.at()].push(TripEnd { station: *station, goal });
                }
                tables.push(plan(network, &into, place, delay));
            }
            tables.push(wander(network));
        }
        Navigator { tables, of_view, views, trip_ends }
    }

    /// A destination as a class sees the way to it.
    pub(crate) fn seen_by(&self, class: Class, destination: Destination) -> Destination {
        let number = usize::from(destination?) % self.of_view;
        Some((self.views.of_class(class) * self.of_view + number) as u16)
    }

    /// The destination's place in the list of destinations, whoever sees it.
    pub fn number(&self, destination: Destination) -> Option<usize> {
        destination.map(|it| usize::from(it) % self.of_view)
    }

    /// The waypoint of `chain`, from its start, on the way to `destination`.
    #[inline]
    pub fn waypoint(&self, destination: Destination, chain: ChainIndex) -> &Waypoint {
        let table = destination.map_or(self.of_view - 1, usize::from);
        &self.tables[table][chain.at()]
    }

    /// The waypoint of `chain` from `x` on: where that is too late for the usual way, of the way round over its end.
    #[inline]
    pub fn waypoint_from(
        &self,
        network: &Network,
        destination: Destination,
        chain: ChainIndex,
        x: f64,
    ) -> Cow<'_, Waypoint> {
        let usual = self.waypoint(destination, chain);
        if usual.leads_on(x) {
            Cow::Borrowed(usual)
        } else {
            Cow::Owned(self.detour(network, destination, chain))
        }
    }

    /// The way to `destination` over the end of `chain`.
    #[inline(never)]
    fn detour(&self, network: &Network, destination: Destination, chain: ChainIndex) -> Waypoint {
        let here = network.chain(chain);
        let onward = here.following.iter().map(|it| (*it, self.waypoint(destination, *it)));
        let best = onward.min_by(|(_, a), (_, b)| a.cost().total_cmp(&b.cost()));
        let possible = best.filter(|(_, it)| it.changes < Waypoint::NO_WAY);
        possible.map_or(Waypoint::NOWHERE, |(next, waypoint)| before(here, next, waypoint))
    }

    /// The destinations that can be reached from `x` on `chain`, with their free travel times [s].
    pub fn reachable(&self, chain: ChainIndex, x: f64) -> impl Iterator<Item = (Destination, f64)> {
        self.reachable_in(0, chain, x)
    }

    fn reachable_in(
        &self,
        view: usize,
        chain: ChainIndex,
        x: f64,
    ) -> impl Iterator<Item = (Destination, f64)> {
        let first = view * self.of_view;
        let tables = self.tables[first..].iter().zip(first..).take(self.of_view - 1);
        tables.filter_map(move |(table, number)| {
            let waypoint = &table[chain.at()];
            waypoint.leads_on(x).then_some((Some(number as u16), waypoint.time))
        })
    }

    /// The reachable destination of least time, for one who was on its way to `before`; of none, to wander.
    pub fn nearest(&self, before: Destination, chain: ChainIndex, x: f64) -> Destination {
        let view = before.map_or(0, |it| usize::from(it) / self.of_view);
        let reachable = self.reachable_in(view, chain, x);
        reachable.min_by(|a, b| a.1.total_cmp(&b.1)).and_then(|(destination, _)| destination)
    }

    /// Whether a destination can be reached from `place`; from a kerb, whether it is worth a trip, too.
    pub(crate) fn leads(&self, network: &Network, place: &Place, destination: u16) -> bool {
        match place {
            Place::Gate(gate) => {
                let waypoint = |chain: &ChainIndex| self.waypoint(Some(destination), *chain);
                gate.chains.iter().any(|chain| waypoint(chain).changes < Waypoint::NO_WAY)
            }
            Place::Kerb(Kerb { chain, station, .. }) => {
                let waypoint = self.waypoint_from(network, Some(destination), *chain, *station);
                let distance = waypoint.distance - station;
                waypoint.changes < Waypoint::NO_WAY && distance >= Navigator::SHORTEST_TRIP
            }
        }
    }

    /// Where on `chain` trips end.
    #[inline]
    pub(crate) fn trip_ends(&self, chain: ChainIndex) -> &[TripEnd] {
        &self.trip_ends[chain.at()]
    }
}

/// Free travel time along `chain` from its start to `until` [s].
fn free_time(chain: &Chain, until: f64) -> f64 {
    let ends = chain.limits.iter().skip(1).map(|it| it.start).chain([chain.length]);
    let pieces = chain.limits.iter().zip(ends).filter(|(limit, _)| limit.start < until);
    pieces.map(|(limit, end)| (end.min(until) - limit.start) / limit.speed).sum()
}

/// The waypoint of `chain` for who goes on to `next`, whose waypoint is `onward`.
fn before(chain: &Chain, next: ChainIndex, onward: &Waypoint) -> Waypoint {
    Waypoint {
        changes: onward.changes,
        last_place: chain.length + onward.last_place,
        next: Some(next),
        time: free_time(chain, chain.length) + onward.time,
        distance: chain.length + onward.distance,
        end: f64::INFINITY,
    }
}

/// Stretches from which a change leads into a chain: chain, side and number.
type Into = Vec<(ChainIndex, Side, usize)>;

/// Best waypoints towards `place`, spread backwards from it until none improves, with a `delay` on each chain [s].
fn plan(network: &Network, into: &[Into], place: &Place, delay: impl Fn(ChainIndex) -> f64) -> Vec<Waypoint> {
    let chains = &network.chains;
    let mut table = vec![Waypoint::NOWHERE; chains.len()];
    let mut ranks = vec![rank(network, &Waypoint::NOWHERE); chains.len()];
    let mut open = BinaryHeap::new();
    for index in place.chains() {
        let chain = network.chain(*index);
        let (until, end) = match place {
            Place::Gate(_) => (chain.length, f64::INFINITY),
            Place::Kerb(kerb) => (kerb.station, kerb.station),
        };
        table[index.at()] = Waypoint {
            changes: 0,
            last_place: f64::INFINITY,
            next: None,
            time: free_time(chain, until),
            distance: until,
            end,
        };
        ranks[index.at()] = rank(network, &table[index.at()]);
        open.push((Reverse(ranks[index.at()]), *index));
    }
    while let Some((Reverse(ranked), index)) = open.pop() {
        let here = table[index.at()];
        if ranked != ranks[index.at()] {
            continue;
        }
        let mut offer = |to: ChainIndex, waypoint: Waypoint| {
            let new = rank(network, &waypoint);
            if new < ranks[to.at()] {
                (table[to.at()], ranks[to.at()]) = (waypoint, new);
                open.push((Reverse(new), to));
            }
        };
        for back in &chains[index.at()].previous {
            let waypoint = before(network.chain(*back), index, &here);
            offer(*back, Waypoint { time: waypoint.time + delay(*back), ..waypoint });
        }
        for (from, side, number) in &into[index.at()] {
            let chain = network.chain(*from);
            let stretch = &chain.stretches(*side)[*number];
            let until = here.last_place.min(here.end) - Navigator::ROOM_FOR_A_CHANGE;
            let last_place =
                if until.is_finite() { stretch.end.min(stretch.back(until)) } else { stretch.end };
            if last_place > stretch.start {
                let across = stretch.across(0.0);
                offer(
                    *from,
                    Waypoint {
                        changes: here.changes + 1,
                        last_place,
                        next: chain.following.first().copied(),
                        time: here.time - across / chains[index.at()].limit(0.0),
                        distance: here.distance - across,
                        end: f64::INFINITY,
                    },
                );
            }
        }
    }
    for index in 0..chains.len() {
        if table[index].changes > 0 || table[index].end.is_finite() {
            let best = chains[index]
                .following
                .iter()
                .min_by(|a, b| table[a.at()].cost().total_cmp(&table[b.at()].cost()));
            table[index].next = best.copied();
        }
    }
    table
}

/// Of two waypoints of a chain the one with the lower rank is better: less cost [µs, so that equal ways count as equal], then
/// a later last place [mm], then what goes on to the lanelet of the smaller id, however the chains are stored.
fn rank(network: &Network, waypoint: &Waypoint) -> (i64, i64, i64) {
    let next = waypoint.next.map_or(i64::MIN, |it| network.lanelet_at(it, 0.0).0.id);
    ((waypoint.cost() * 1e6).round() as i64, -(waypoint.last_place * 1e3).round() as i64, next)
}

/// For each chain the stretches from which a change leads into it.
fn beside_into(network: &Network) -> Vec<Into> {
    let mut into = vec![Vec::new(); network.chains.len()];
    for (index, chain) in network.chains.iter().enumerate() {
        for side in Side::BOTH {
            for (number, stretch) in chain.stretches(side).iter().enumerate() {
                into[stretch.chain.at()].push((ChainIndex(index as u32), side, number));
            }
        }
    }
    into
}

/// For drivers without a destination: on along the first following chain; out of lanes that end.
fn wander(network: &Network) -> Vec<Waypoint> {
    let on = |chain: &Chain| Waypoint {
        changes: 0,
        last_place: f64::INFINITY,
        next: chain.following.first().copied(),
        time: 0.0,
        distance: f64::INFINITY,
        end: f64::INFINITY,
    };
    let mut table: Vec<Waypoint> = network.chains.iter().map(on).collect();
    for index in &network.lane_drops {
        let chain = network.chain(*index);
        let ends = |side: Side| chain.stretches(side).last().map(|it| it.end);
        let last_place = Side::BOTH.into_iter().filter_map(ends).reduce(f64::max).unwrap_or(chain.length);
        table[index.at()] = Waypoint { changes: 1, last_place, ..table[index.at()] };
    }
    table
}

#[cfg(test)]
mod tests {
    use laneweave_network::{DrivingSide, Lanelet, LaneletIndex, Point, Polyline};

    use super::*;

    /// A lane to the east between two stations [m], followed by `following`.
    fn lanelet(id: i64, [from, to]: [f64; 2], following: &[u32]) -> Lanelet {
        let line = Polyline::new([from, to].map(|x| Point::new(x, 0.0, 0.0))).unwrap();
        let mut lanelet = Lanelet::alone(id, [line.clone(), line.clone(), line], 10.0);
        lanelet.following = following.iter().map(|it| LaneletIndex(*it)).collect();
        lanelet
    }

    #[test]
    fn of_two_equal_ways_drivers_go_that_of_the_smaller_lanelet_id_however_chains_are_stored() {
        let network = |[one, other]: [i64; 2]| {
            let (first, last) = (lanelet(1, [0.0, 100.0], &[1, 2]), lanelet(9, [200.0, 300.0], &[]));
            let between = [one, other].map(|id| lanelet(id, [100.0, 200.0], &[3]));
            let [one, other] = between;
            Network::new(vec![first, one, other, last], DrivingSide::Right).unwrap()
        };
        for ids in [[4, 5], [5, 4]] {
            for network in [network(ids), network(ids).with_chains_reversed()] {
                let start = network.entrances[0].chains[0];
                let waypoint = *Navigator::new(&network).waypoint(Some(0), start);
                assert_eq!(network.lanelet_at(waypoint.next.unwrap(), 0.0).0.id, 4);
                assert_eq!((waypoint.time, waypoint.distance, waypoint.changes), (30.0, 300.0, 0));
            }
        }
    }
}
