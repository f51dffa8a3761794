//! The ways to one destination: for each chain the lane changes still to make, the last place for the next of them, the way on,
//! and the times of this way and of the best other one, with the turns and lights on them.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use laneweave_network::{Beside, Chain, ChainIndex, Network, Side};
use serde::{Deserialize, Serialize};

use crate::route::effort::Effort;
use crate::route::links::Links;
use crate::route::place::Place;
use crate::route::views::Views;

/// What a chain means on the way to a destination.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Waypoint {
    /// n: fewest lane changes from it to a lane that leads there; [`Waypoint::NO_WAY`] if none does.
    pub changes: u32,
    /// The chain from which on the way was planned: the next one, or the one to change to; itself at the destination.
    via: ChainIndex,
    /// Last place for the next change, from the chain's start, beyond its end if on a later one [m]; infinite for
    /// n = 0.
    pub last_place: f64,
    /// The chain that it goes on with.
    pub next: Option<ChainIndex>,
    /// Travel time from its start to the destination [s].
    pub time: f64,
    /// T_alt: travel time from its start of the best way over its end that is not this one [s]; infinite if there is none.
    pub alternative: f64,
    /// Way from its start to the destination [m].
    pub distance: f64,
    /// Where on it the trip ends [m]; infinite where it goes on to the chain's end.
    pub end: f64,
    /// What the way from its start asks for.
    pub effort: Effort,
    /// What the alternative asks for.
    pub alternative_effort: Effort,
}

impl Waypoint {
    /// The chains that it names.
    pub(crate) fn chains(&self) -> impl Iterator<Item = ChainIndex> {
        [Some(self.via), self.next].into_iter().flatten()
    }

    /// More changes than any road has lanes: there is no way.
    pub const NO_WAY: u32 = 1000;
    /// What a lane change counts for in the choice of a route [s].
    const CHANGE_COST: f64 = 20.0;

    pub(crate) const NOWHERE: Waypoint = Waypoint {
        changes: Waypoint::NO_WAY,
        via: ChainIndex(0),
        last_place: 0.0,
        next: None,
        time: f64::INFINITY,
        alternative: f64::INFINITY,
        distance: f64::INFINITY,
        end: f64::INFINITY,
        effort: Effort { turns: 0, lights: 0 },
        alternative_effort: Effort { turns: 0, lights: 0 },
    };

    /// There is a way.
    #[inline]
    pub fn leads_there(&self) -> bool {
        self.changes < Waypoint::NO_WAY
    }

    /// The destination can still be reached from `x` on the chain.
    #[inline]
    pub fn leads_on(&self, x: f64) -> bool {
        self.leads_there() && x <= self.last_place && x <= self.end
    }

    /// The chain that comes next on the way, if there is one: itself at the destination.
    pub(crate) fn goes_on(&self) -> Option<ChainIndex> {
        self.leads_there().then_some(self.via)
    }

    /// What is least on the best way [s].
    pub(crate) fn cost(&self) -> f64 {
        self.time + Waypoint::CHANGE_COST * f64::from(self.changes)
    }

    /// Both lead the same way over the same chain.
    pub(crate) fn goes_like(&self, other: &Waypoint) -> bool {
        (self.changes, self.via, self.next) == (other.changes, other.via, other.next)
    }
}

/// Stretches from which a change leads into a chain: chain, side and number.
pub(crate) type Into = Vec<(ChainIndex, Side, usize)>;

/// Plans ways on a network as one class sees it.
#[derive(Clone, Copy)]
pub(crate) struct Planner<'a> {
    pub(crate) network: &'a Network,
    /// See [`beside_into`].
    pub(crate) into: &'a [Into],
    pub(crate) links: &'a Links,
    pub(crate) views: &'a Views,
    pub(crate) view: usize,
}

impl Planner<'_> {
    /// Road that is kept for each further change before the last place [m].
    const ROOM_FOR_A_CHANGE: f64 = 40.0;
    /// What a chain counts for beside its time in the choice of a route, if it is avoided [s], ours: no detour in a town is
    /// as long.
    const AVOIDED: f64 = 600.0;

    /// What missing a change counts for, ours: once round the block [s].
    const MISSED: f64 = 120.0;

    /// Time along `chain` from its start to `until` [s].
    fn time(&self, chain: ChainIndex, until: f64) -> f64 {
        if self.links.are_free() {
            free_time(self.network.chain(chain), until)
        } else {
            self.links.time_to(chain, until)
        }
    }

    /// Time from the start of `chain` to where it can be left over `stretch`, less that from the start of the other one to there [s].
    fn lag(&self, chain: ChainIndex, stretch: &Beside) -> f64 {
        let place = stretch.start.max(stretch.back(0.0));
        self.time(chain, place) - self.time(stretch.chain, stretch.across(place))
    }

    /// What a change counts for in the choice of a route for which there are `room` metres [s]: the shorter the road for it, the more
    /// of those who try will miss it.
    fn hurry(room: f64) -> f64 {
        Planner::MISSED * (1.0 - room / Planner::ROOM_FOR_A_CHANGE).max(0.0)
    }

    /// Road on which a driver can change from `chain` to another one by `last_place` [m].
    fn room_to_change(&self, chain: ChainIndex, to: ChainIndex, last_place: f64) -> f64 {
        let here = self.network.chain(chain);
        let leading =
            Side::BOTH.into_iter().flat_map(|side| here.stretches(side)).filter(|it| it.chain == to);
        let windows = leading.map(|it| self.network.window(here, it, self.view > 0));
        windows.map(|[start, end]| (end.min(last_place) - start).max(0.0)).sum()
    }

    /// What `chain` asks for from its start to its end.
    fn effort(&self, chain: ChainIndex) -> Effort {
        Effort::until(self.network, chain, f64::INFINITY)
    }

    /// What `chain` counts for beside its time [s].
    fn delay(&self, chain: ChainIndex) -> f64 {
        if self.views.avoids(self.view, chain) { Planner::AVOIDED } else { 0.0 }
    }

    /// The waypoint of `chain` for who goes on to `next`, whose waypoint is `onward`.
    pub(crate) fn before(&self, chain: ChainIndex, next: ChainIndex, onward: &Waypoint) -> Waypoint {
        let length = self.network.chain(chain).length;
        Waypoint {
            changes: onward.changes,
            via: next,
            last_place: length + onward.last_place,
            next: Some(next),
            time: self.time(chain, length) + onward.time,
            distance: length + onward.distance,
            effort: self.effort(chain).and(onward.effort),
            ..Waypoint::NOWHERE
        }
    }

    /// Best waypoints towards `place`, spread backwards from it until none improves; then on from those to chains that have no way
    /// unless its changes are made on less road than usual.
    pub(crate) fn plan(&self, place: &Place) -> Vec<Waypoint> {
        let mut search = Search::new(self, place);
        if search.spread(self, Room::Usual) {
            search.reopen();
            search.spread(self, Room::Half);
        }
        let mut table = search.table;
        let chains = &self.network.chains;
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

    /// The waypoint of a chain on which trips to `place` end.
    fn goal(&self, place: &Place, index: ChainIndex) -> Waypoint {
        let (until, end) = match place {
            Place::Gate(_) => (self.network.chain(index).length, f64::INFINITY),
            Place::Kerb(kerb) => (kerb.station, kerb.station),
        };
        Waypoint {
            changes: 0,
            via: index,
            last_place: f64::INFINITY,
            next: None,
            time: self.time(index, until),
            distance: until,
            end,
            effort: Effort::until(self.network, index, until),
            ..Waypoint::NOWHERE
        }
    }

    /// The last place for a change within a window of `stretch` for who has the waypoint `onward` beyond [m]: so that road is left for
    /// the next change.
    fn last_place(stretch: &Beside, [start, end]: [f64; 2], onward: &Waypoint, room: Room) -> f64 {
        let next = onward.last_place.min(onward.end);
        if next == f64::INFINITY {
            return end;
        }
        let latest = stretch.back(next);
        match room {
            Room::Usual => end.min(latest - Planner::ROOM_FOR_A_CHANGE),
            Room::Half => end.min(0.5 * (start + latest)),
        }
    }

    /// The waypoint of `chain` for who changes over `stretch` to the chain `to`, whose waypoint is `onward`.
    fn beside(
        &self,
        chain: ChainIndex,
        to: ChainIndex,
        stretch: &Beside,
        last_place: f64,
        onward: &Waypoint,
    ) -> Waypoint {
        let across = stretch.across(0.0);
        Waypoint {
            changes: onward.changes + 1,
            via: to,
            last_place,
            next: self.network.chain(chain).following.first().copied(),
            time: onward.time
                + self.lag(chain, stretch)
                + Planner::hurry(self.room_to_change(chain, to, last_place)),
            distance: onward.distance - across,
            effort: onward.effort.beyond(Effort::until(self.network, to, across)),
            ..Waypoint::NOWHERE
        }
    }

    /// Gives the ways of `table` towards `place`, which stay as they are, the present link times.
    pub(crate) fn retime(&self, table: &mut [Waypoint], place: &Place) {
        for chain in from_the_destination(table) {
            let Waypoint { changes, via, last_place, .. } = table[chain.at()];
            let onward = table[via.at()];
            table[chain.at()].time = if via == chain {
                match place {
                    Place::Gate(_) => self.time(chain, self.network.chain(chain).length),
                    Place::Kerb(kerb) => self.time(chain, kerb.station),
                }
            } else if changes == onward.changes {
                let it = self.network.chain(chain);
                self.time(chain, it.length) + onward.time + self.delay(chain)
            } else {
                let stretch = stretch_to(self.network.chain(chain), via, last_place);
                let change = |it: &Beside| {
                    self.lag(chain, it) + Planner::hurry(self.room_to_change(chain, via, last_place))
                };
                onward.time + stretch.map_or(0.0, change)
            };
        }
    }

    /// Notes for each chain of `table` the time of the best way over its end that is not the way of the table, and what that
    /// asks for, by the ways of `best`, or else by its own. Of equal times that with less effort counts.
    pub(crate) fn note_alternatives(&self, table: &mut [Waypoint], best: Option<&[Waypoint]>) {
        let mut alternatives = vec![(f64::INFINITY, Effort::default()); table.len()];
        for chain in from_the_destination(table) {
            let it = self.network.chain(chain);
            let Waypoint { changes, via, .. } = table[chain.at()];
            let goes_over_end = via != chain && changes == table[via.at()].changes;
            let onward = it.following.iter().map(|next| match next {
                next if goes_over_end && *next == via => alternatives[next.at()],
                next => {
                    let Waypoint { time, effort, .. } = best.unwrap_or(table)[next.at()];
                    (time, effort)
                }
            });
            let best_onward = onward.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            if let Some((time, effort)) = best_onward {
                let time = self.time(chain, it.length) + self.delay(chain) + time;
                alternatives[chain.at()] = (time, self.effort(chain).and(effort));
            }
        }
        for (waypoint, (time, effort)) in table.iter_mut().zip(alternatives) {
            (waypoint.alternative, waypoint.alternative_effort) = (time, effort);
        }
    }
}

/// Road that is kept for the next change.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Room {
    /// What is usual.
    Usual,
    /// Half of what there is.
    Half,
}

/// A search for the best ways, backwards from a destination.
struct Search {
    table: Vec<Waypoint>,
    ranks: Vec<Rank>,
    open: BinaryHeap<(Reverse<Rank>, ChainIndex)>,
    /// Chains whose ways stay as they are.
    is_settled: Vec<bool>,
}

impl Search {
    fn new(planner: &Planner, place: &Place) -> Search {
        let chains = planner.network.chains.len();
        let mut search = Search {
            table: vec![Waypoint::NOWHERE; chains],
            ranks: vec![rank(planner.network, &Waypoint::NOWHERE); chains],
            open: BinaryHeap::new(),
            is_settled: vec![false; chains],
        };
        for index in place.chains() {
            search.offer(planner.network, *index, planner.goal(place, *index));
        }
        search
    }

    /// Takes a waypoint of a chain if it is better than the one known.
    fn offer(&mut self, network: &Network, to: ChainIndex, waypoint: Waypoint) {
        let new = rank(network, &waypoint);
        if new < self.ranks[to.at()] && !self.is_settled[to.at()] {
            (self.table[to.at()], self.ranks[to.at()]) = (waypoint, new);
            self.open.push((Reverse(new), to));
        }
    }

    /// Looks on from all chains that have a way, whose ways stay as they are.
    fn reopen(&mut self) {
        self.is_settled = self.table.iter().map(Waypoint::leads_there).collect();
        let settled = (0..).map(ChainIndex).zip(&self.is_settled).filter(|it| *it.1);
        self.open = settled.map(|(index, _)| (Reverse(self.ranks[index.at()]), index)).collect();
    }

    /// Spreads until no waypoint improves. Returns whether there were changes for which there is less road than usual.
    fn spread(&mut self, planner: &Planner, room: Room) -> bool {
        let Planner { network, into, .. } = *planner;
        let mut are_short = false;
        while let Some((Reverse(ranked), index)) = self.open.pop() {
            let here = self.table[index.at()];
            if ranked != self.ranks[index.at()] {
                continue;
            }
            let ahead = changed_to(&self.table, index);
            for back in &network.chain(index).previous {
                let waypoint = planner.before(*back, index, &here);
                let time = waypoint.time + planner.delay(*back);
                self.offer(network, *back, Waypoint { time, ..waypoint });
            }
            for stretches in into[index.at()].chunk_by(|a, b| a.0 == b.0) {
                let from = stretches[0].0;
                if ahead.contains(&from) {
                    continue;
                }
                // Whichever stretch one takes, it leads to the same: the last that still does is the last chance.
                let chain = network.chain(from);
                let last = stretches.iter().rev().find_map(|(_, side, number)| {
                    let stretch = &chain.stretches(*side)[*number];
                    let window = network.window(chain, stretch, planner.view > 0);
                    let last_place = Planner::last_place(stretch, window, &here, room);
                    are_short |= last_place <= window[0] && window[0] < window[1];
                    (last_place > window[0]).then_some((stretch, last_place))
                });
                if let Some((stretch, last_place)) = last {
                    let waypoint = planner.beside(from, index, stretch, last_place, &here);
                    self.offer(network, from, waypoint);
                }
            }
        }
        are_short
    }
}

/// The chains to which a driver changes from `chain`, one after the other: nobody changes back to where it comes from, to overtake a
/// jam.
fn changed_to(table: &[Waypoint], chain: ChainIndex) -> Vec<ChainIndex> {
    let next = |at: &ChainIndex| {
        let Waypoint { changes, via, .. } = table[at.at()];
        (changes > table[via.at()].changes).then_some(via)
    };
    std::iter::successors(next(&chain), next).collect()
}

/// The chains of `table` that have a way, each after the one that it goes on with.
fn from_the_destination(table: &[Waypoint]) -> Vec<ChainIndex> {
    let mut order = Vec::with_capacity(table.len());
    let mut is_known: Vec<bool> = table.iter().map(|it| !it.leads_there()).collect();
    let mut way = Vec::new();
    for start in 0..table.len() {
        let mut at = start;
        while !is_known[at] {
            is_known[at] = true;
            way.push(ChainIndex(at as u32));
            at = table[at].via.at();
        }
        order.extend(way.drain(..).rev());
    }
    order
}

/// The stretch of `chain` over which who has to change by `last_place` changes to the chain `to`.
pub(crate) fn stretch_to(chain: &Chain, to: ChainIndex, last_place: f64) -> Option<&Beside> {
    let all = Side::BOTH.into_iter().flat_map(|side| chain.stretches(side));
    let mut leading = all.filter(|it| it.chain == to);
    leading.find(|it| it.start < last_place && last_place <= it.end)
}

/// Free travel time along `chain` from its start to `until` [s].
pub(crate) fn free_time(chain: &Chain, until: f64) -> f64 {
    let ends = chain.limits.iter().skip(1).map(|it| it.start).chain([chain.length]);
    let pieces = chain.limits.iter().zip(ends).filter(|(limit, _)| limit.start < until);
    pieces.map(|(limit, end)| (end.min(until) - limit.start) / limit.speed).sum()
}

/// See [`rank`].
type Rank = (i64, i64, i64);

/// Of two waypoints of a chain the one with the lower rank is better: less cost [µs, so that equal ways count as equal], then
/// a later last place [mm], then what goes on to the lanelet of the smaller id, however the chains are stored.
fn rank(network: &Network, waypoint: &Waypoint) -> Rank {
    let next = waypoint.next.map_or(i64::MIN, |it| network.lanelet_at(it, 0.0).0.id);
    ((waypoint.cost() * 1e6).round() as i64, -(waypoint.last_place * 1e3).round() as i64, next)
}

/// For each chain the stretches from which a change leads into it.
pub(crate) fn beside_into(network: &Network) -> Vec<Into> {
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
pub(crate) fn wander(network: &Network) -> Vec<Waypoint> {
    let on = |chain: &Chain| Waypoint {
        changes: 0,
        last_place: f64::INFINITY,
        next: chain.following.first().copied(),
        time: 0.0,
        ..Waypoint::NOWHERE
    };
    let mut table: Vec<Waypoint> = network.chains.iter().map(on).collect();
    for index in &network.lane_drops {
        let chain = network.chain(*index);
        let until = chain.driven_until(true);
        let ends = |side: Side| chain.stretches(side).last().map(|it| it.end.min(until));
        let last_place = Side::BOTH.into_iter().filter_map(ends).reduce(f64::max).unwrap_or(chain.length);
        table[index.at()] = Waypoint { changes: 1, last_place, ..table[index.at()] };
    }
    table
}

#[cfg(test)]
pub(crate) mod tests {
    use laneweave_network::{DrivingSide, Lanelet, LaneletIndex, Point, Polyline};

    use super::*;
    use crate::route::place::Kerb;

    /// A lane to the east between two stations [m] at 10 m/s, followed by `following`.
    pub(crate) fn lanelet(id: i64, [from, to]: [f64; 2], following: &[u32]) -> Lanelet {
        let line = Polyline::new([from, to].map(|x| Point::new(x, 0.0, 0.0))).unwrap();
        let mut lanelet = Lanelet::alone(id, [line.clone(), line.clone(), line], 10.0);
        lanelet.following = following.iter().map(|it| LaneletIndex(*it)).collect();
        lanelet
    }

    /// A road of 100 m that forks into one of 200 m and one of 400 m, which meet before the last 100 m.
    fn fork() -> Network {
        let all = vec![
            lanelet(1, [0.0, 100.0], &[1, 2]),
            lanelet(2, [100.0, 300.0], &[3]),
            lanelet(3, [100.0, 500.0], &[3]),
            lanelet(4, [300.0, 400.0], &[]),
        ];
        Network::new(all, DrivingSide::Right).unwrap()
    }

    fn chain(network: &Network, id: i64) -> ChainIndex {
        let chains = (0..network.chains.len() as u32).map(ChainIndex);
        chains.into_iter().find(|it| network.lanelet_at(*it, 0.0).0.id == id).unwrap()
    }

    /// The way over the fork, its time and that of the other one, when the chain of a lanelet takes another time than the free one.
    fn way(kept: bool, slow: Option<(i64, f64)>) -> (i64, f64, f64) {
        let network = fork();
        let into = beside_into(&network);
        let views = Views::default();
        let mut links = Links::of(&network);
        let free = Planner { network: &network, into: &into, links: &links, views: &views, view: 0 };
        let place = Place::Gate(network.exits[0].clone());
        let mut table = free.plan(&place);
        let times: Vec<f64> = (0..network.chains.len() as u32)
            .map(ChainIndex)
            .map(|it| {
                let usual = free.time(it, network.chain(it).length);
                slow.filter(|(id, _)| chain(&network, *id) == it).map_or(usual, |(_, time)| time)
            })
            .collect();
        links.take(times.into_iter());
        let planner = Planner { network: &network, into: &into, links: &links, views: &views, view: 0 };
        let mut best = planner.plan(&place);
        planner.note_alternatives(&mut best, None);
        planner.retime(&mut table, &place);
        planner.note_alternatives(&mut table, Some(&best));
        let Waypoint { next, time, alternative, .. } =
            (if kept { table } else { best })[chain(&network, 1).at()];
        (network.lanelet_at(next.unwrap(), 0.0).0.id, time, alternative)
    }

    #[test]
    fn the_alternative_is_the_best_way_over_the_end_of_the_lane_that_is_not_the_own_one() {
        assert_eq!(way(true, None), (2, 40.0, 60.0));
        assert_eq!(way(false, None), (2, 40.0, 60.0));
    }

    /// A lane of 1,000 m, and one on its left from 300 m on.
    fn two_lanes() -> Network {
        let beside = |it: Lanelet, left, right| Lanelet { left, right, ..it };
        let index = |it| Some(LaneletIndex(it));
        let all = vec![
            lanelet(1, [0.0, 300.0], &[1]),
            beside(lanelet(2, [300.0, 600.0], &[2]), index(3), None),
            beside(lanelet(3, [600.0, 1000.0], &[]), index(4), None),
            beside(lanelet(4, [300.0, 600.0], &[4]), None, index(1)),
            beside(lanelet(5, [600.0, 1000.0], &[]), None, index(2)),
        ];
        Network::new(all, DrivingSide::Right).unwrap()
    }

    #[test]
    fn nobody_changes_lanes_and_back_wherever_there_is_a_jam() {
        let network = two_lanes();
        let into = beside_into(&network);
        let views = Views::default();
        let [long, short] = [1, 4].map(|id| chain(&network, id));
        let kerb = Kerb { id: 3, chain: long, station: 950.0 };
        for jammed in 0..5 {
            let mut links = Links::of(&network);
            let times: Vec<f64> = (0..5).map(|it| if it == jammed { 900.0 } else { 30.0 }).collect();
            links.take(times.into_iter());
            let planner = Planner { network: &network, into: &into, links: &links, views: &views, view: 0 };
            let table = planner.plan(&Place::Kerb(kerb));
            let [here, there] = [long, short].map(|it| table[it.at()]);
            assert_eq!((here.changes, here.via), (0, long), "{jammed}");
            assert_eq!((there.changes, there.via), (1, long), "{jammed}");
            // Who comes from the start of the long lane is not there before who starts where the short one does.
            assert!(here.time > there.time, "{jammed}: {} {}", here.time, there.time);
            let mut timed = table.clone();
            planner.retime(&mut timed, &Place::Kerb(kerb));
            assert_eq!(timed[short.at()].time, there.time, "{jammed}");
        }
    }

    #[test]
    fn a_change_counts_as_a_detour_the_more_the_less_road_there_is_for_it() {
        let counted = [0.0, 10.0, 30.0, 40.0, 90.0].map(Planner::hurry);
        assert_eq!(counted, [120.0, 90.0, 30.0, 0.0, 0.0]);
    }

    #[test]
    fn with_new_link_times_a_way_is_kept_with_its_new_time_and_the_best_one_is_another() {
        assert_eq!(way(true, Some((2, 100.0))), (2, 120.0, 60.0));
        assert_eq!(way(false, Some((2, 100.0))), (3, 60.0, 120.0));
        assert_eq!(way(true, Some((1, 50.0))), (2, 80.0, 100.0));
    }
}
