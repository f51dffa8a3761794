//! Planning of the routes to one destination. For each chain: the lane changes still to make, the last place for the
//! next one, the next chain, the times of this route and of the best other one, and the turns and lights on both.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use laneweave_network::{Beside, Chain, ChainIndex, Class, Id, Network, Position, Side};

use crate::route::class_restrictions::ClassRestrictions;
use crate::route::disutility::Disutility;
use crate::route::links::Links;
use crate::route::place::Place;
use crate::route::ring_lanes::crossing_time;
use crate::route::waypoint::Waypoint;

/// Stretches from which a change leads into a chain: chain, side and number.
pub(crate) type Into = Vec<(ChainIndex, Side, usize)>;

/// Plans routes on a network for one class restriction.
#[derive(Clone, Copy)]
pub(crate) struct Planner<'a> {
    pub(crate) network: &'a Network,
    /// See [`beside_into`].
    pub(crate) into: &'a [Into],
    pub(crate) links: &'a Links,
    pub(crate) restrictions: &'a ClassRestrictions,
    pub(crate) restriction: usize,
}

impl Planner<'_> {
    /// Road that is kept before the last place for each further change [m].
    const ROOM_FOR_A_CHANGE: f64 = 40.0;
    /// Cost of an avoided chain besides its time in the choice of a route [s], ours: no detour in a town is as long.
    const AVOIDED: f64 = 600.0;
    /// Cost of a missed change, ours: once around the block [s].
    const MISSED: f64 = 120.0;

    /// A class with its restriction.
    pub(super) fn class(&self) -> Class {
        self.restrictions.class(self.restriction)
    }

    /// Whether a route may lead from the end of `chain` to `next`: onto lanes that its class may use, and along others
    /// only for who is on one.
    fn may_follow(&self, chain: ChainIndex, next: ChainIndex) -> bool {
        let is_open = |it: ChainIndex| self.network.chain(it).classes.has(self.class());
        is_open(next) || !is_open(chain)
    }

    /// The chains onto which a route may lead from the end of `chain`.
    pub(crate) fn onward(&self, chain: ChainIndex) -> impl Iterator<Item = ChainIndex> {
        let following = self.network.chain(chain).following.iter().copied();
        following.filter(move |it| self.may_follow(chain, *it))
    }

    /// Time along `chain` from its start to `until` [s].
    fn time(&self, chain: ChainIndex, until: f64) -> f64 {
        if self.links.are_free() {
            free_time(self.network.chain(chain), until)
        } else {
            self.links.time_to(chain, until)
        }
    }

    /// Time from the start of `chain` to the first place for a change over `stretch`, minus the time on the other chain
    /// from its start to there [s].
    fn lag(&self, chain: ChainIndex, stretch: &Beside) -> f64 {
        let place = stretch.start.max(stretch.back(0.0));
        self.time(chain, place) - self.time(stretch.chain, stretch.across(place))
    }

    /// The missed-turn penalty of a change with `room` metres of road [s]: the shorter the road, the more drivers miss
    /// the change.
    fn missed_turn_penalty(room: f64) -> f64 {
        Planner::MISSED * (1.0 - room / Planner::ROOM_FOR_A_CHANGE).max(0.0)
    }

    /// Length of road on which a driver can change from `chain` to `to`, before `last_place` [m].
    fn room_to_change(&self, chain: ChainIndex, to: ChainIndex, last_place: f64) -> f64 {
        let here = self.network.chain(chain);
        let leading =
            Side::BOTH.into_iter().flat_map(|side| here.stretches(side)).filter(|it| it.chain == to);
        let windows = leading.map(|it| self.network.window(here, it, self.class()));
        windows.map(|[start, end]| (end.min(last_place) - start).max(0.0)).sum()
    }

    /// Disutility of `chain` from its start to its end.
    fn disutility(&self, chain: ChainIndex) -> Disutility {
        Disutility::until(self.network, chain, f64::INFINITY)
    }

    /// Cost of `chain` besides its time [s].
    fn delay(&self, chain: ChainIndex) -> f64 {
        let is_avoided = self.restrictions.avoids(self.restriction, chain);
        f64::from(is_avoided) * Planner::AVOIDED + crossing_time(self.network, chain)
    }

    /// The waypoint of `chain` for a driver who goes on to `next`, whose waypoint is `onward`.
    pub(crate) fn before(&self, chain: ChainIndex, next: ChainIndex, onward: &Waypoint) -> Waypoint {
        let length = self.network.chain(chain).length;
        Waypoint {
            changes: onward.changes,
            via: next,
            last_place: length + onward.last_place,
            next: Some(next),
            time: self.time(chain, length) + onward.time,
            distance: length + onward.distance,
            disutility: self.disutility(chain).and(onward.disutility),
            ..Waypoint::NOWHERE
        }
    }

    /// The best waypoints towards `place`. The search goes backwards from it until no waypoint improves. Then it
    /// continues to chains that have a route only if changes may use less road than usual.
    pub(crate) fn plan(&self, place: &Place) -> Vec<Waypoint> {
        let mut search = Search::new(self, place);
        if search.spread(self, Room::Usual) {
            search.reopen();
            search.spread(self, Room::Half);
        }
        let mut table = search.table;
        for index in 0..table.len() {
            if table[index].changes > 0 || table[index].end.is_finite() {
                let onward = self.onward(ChainIndex(index as u32));
                table[index].next =
                    onward.min_by(|a, b| table[a.at()].cost().total_cmp(&table[b.at()].cost()));
            }
        }
        table
    }

    /// The waypoint of a chain on which trips to `place` end.
    fn goal(&self, place: &Place, index: ChainIndex) -> Waypoint {
        let station = place.end_on(index);
        let until = station.unwrap_or(self.network.chain(index).length);
        Waypoint {
            changes: 0,
            via: index,
            last_place: f64::INFINITY,
            next: None,
            time: self.time(index, until) + crossing_time(self.network, index),
            distance: until,
            end: station.unwrap_or(f64::INFINITY),
            disutility: Disutility::until(self.network, index, until),
            ..Waypoint::NOWHERE
        }
    }

    /// The last place for a change within the window of `stretch` [m], with the waypoint `onward` on the other chain.
    /// Road is left for the next change.
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

    /// The waypoint of `chain` for a driver who changes over `stretch` to the chain `to`, whose waypoint is `onward`.
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
            next: self.onward(chain).next(),
            time: onward.time
                + self.lag(chain, stretch)
                + Planner::missed_turn_penalty(self.room_to_change(chain, to, last_place)),
            distance: onward.distance - across,
            disutility: onward.disutility.beyond(Disutility::until(self.network, to, across)),
            ..Waypoint::NOWHERE
        }
    }

    /// Updates the times of `table` towards `place` to the present link times. The routes stay as they are.
    pub(crate) fn retime(&self, table: &mut [Waypoint], place: &Place) {
        for chain in from_the_destination(table) {
            let Waypoint { changes, via, last_place, .. } = table[chain.at()];
            let onward = table[via.at()];
            table[chain.at()].time = if via == chain {
                let until = place.end_on(chain).unwrap_or(self.network.chain(chain).length);
                self.time(chain, until) + crossing_time(self.network, chain)
            } else if changes == onward.changes {
                let it = self.network.chain(chain);
                self.time(chain, it.length) + onward.time + self.delay(chain)
            } else {
                let stretch = stretch_to(self.network.chain(chain), via, last_place);
                let change = |it: &Beside| {
                    self.lag(chain, it)
                        + Planner::missed_turn_penalty(self.room_to_change(chain, via, last_place))
                };
                onward.time + stretch.map_or(0.0, change)
            };
        }
    }

    /// Writes to each chain of `table` the time and disutility of the best other route over its end. This route goes on
    /// by the waypoints of `best`, or else by those of `table`. Of equal times, that with less disutility counts.
    pub(crate) fn note_alternatives(&self, table: &mut [Waypoint], best: Option<&[Waypoint]>) {
        let mut alternatives = vec![(f64::INFINITY, Disutility::default()); table.len()];
        for chain in from_the_destination(table) {
            let it = self.network.chain(chain);
            let Waypoint { changes, via, .. } = table[chain.at()];
            let goes_over_end = via != chain && changes == table[via.at()].changes;
            let onward = self.onward(chain).map(|next| match next {
                next if goes_over_end && next == via => alternatives[next.at()],
                next => {
                    let Waypoint { time, disutility, .. } = best.unwrap_or(table)[next.at()];
                    (time, disutility)
                }
            });
            let best_onward = onward.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            if let Some((time, disutility)) = best_onward {
                let time = self.time(chain, it.length) + self.delay(chain) + time;
                alternatives[chain.at()] = (time, self.disutility(chain).and(disutility));
            }
        }
        for (waypoint, (time, disutility)) in table.iter_mut().zip(alternatives) {
            (waypoint.alternative, waypoint.alternative_disutility) = (time, disutility);
        }
    }
}

/// Road that is kept for the next change.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Room {
    /// The usual length.
    Usual,
    /// Half of the available road.
    Half,
}

/// A search for the best routes, backwards from a destination.
struct Search<'a> {
    place: &'a Place,
    table: Vec<Waypoint>,
    ranks: Vec<Rank>,
    open: BinaryHeap<(Reverse<Rank>, ChainIndex)>,
    /// Chains whose routes stay as they are.
    is_settled: Vec<bool>,
}

impl<'a> Search<'a> {
    fn new(planner: &Planner, place: &'a Place) -> Search<'a> {
        let chains = planner.network.chains.len();
        let mut search = Search {
            place,
            table: vec![Waypoint::NOWHERE; chains],
            ranks: vec![rank(planner.network, &Waypoint::NOWHERE); chains],
            open: BinaryHeap::new(),
            is_settled: vec![false; chains],
        };
        for index in
            place.chains().iter().filter(|it| planner.network.chain(**it).classes.has(planner.class()))
        {
            search.offer(planner.network, *index, planner.goal(place, *index));
        }
        search
    }

    /// Replaces the waypoint of a chain if `waypoint` is better, and does not lead back to this chain: a change past a
    /// jam counts as a gain of time, and so would each round of a circle over it.
    fn offer(&mut self, network: &Network, to: ChainIndex, waypoint: Waypoint) {
        let new = rank(network, &waypoint);
        let is_better = new < self.ranks[to.at()] && !self.is_settled[to.at()];
        if is_better
            && self.place.is_reached_over(to)
            && (waypoint.via == to || !self.leads_to(to, waypoint.via))
        {
            (self.table[to.at()], self.ranks[to.at()]) = (waypoint, new);
            self.open.push((Reverse(new), to));
        }
    }

    /// Whether the route from `from` leads over `chain`.
    fn leads_to(&self, chain: ChainIndex, from: ChainIndex) -> bool {
        let next = |at: &ChainIndex| Some(self.table[at.at()].via).filter(|it| it != at);
        std::iter::successors(Some(from), next).any(|it| it == chain)
    }

    /// Reopens all chains that have a route. Their routes stay as they are.
    fn reopen(&mut self) {
        self.is_settled = self.table.iter().map(Waypoint::leads_there).collect();
        let settled = (0..).map(ChainIndex).zip(&self.is_settled).filter(|it| *it.1);
        self.open = settled.map(|(index, _)| (Reverse(self.ranks[index.at()]), index)).collect();
    }

    /// Continues until no waypoint improves. Returns whether some changes had less road than usual.
    fn spread(&mut self, planner: &Planner, room: Room) -> bool {
        let Planner { network, into, .. } = *planner;
        let mut are_short = false;
        while let Some((Reverse(ranked), index)) = self.open.pop() {
            let here = self.table[index.at()];
            if ranked != self.ranks[index.at()] {
                continue;
            }
            let previous = network.chain(index).previous.iter();
            for back in previous.filter(|back| planner.may_follow(**back, index)) {
                let waypoint = planner.before(*back, index, &here);
                let time = waypoint.time + planner.delay(*back);
                self.offer(network, *back, Waypoint { time, ..waypoint });
            }
            for stretches in into[index.at()].chunk_by(|a, b| a.0 == b.0) {
                let from = stretches[0].0;
                // All stretches lead to the same chain. The last usable one is the last chance.
                let chain = network.chain(from);
                let last = stretches.iter().rev().find_map(|(_, side, number)| {
                    let stretch = &chain.stretches(*side)[*number];
                    let window = network.window(chain, stretch, planner.class());
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

/// The chains of `table` that have a route, each after the next chain of its route.
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

/// The stretch of `chain` for a change to the chain `to` by `last_place`.
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
type Rank = (i64, i64, Option<Id>);

/// The rank of a waypoint: of two waypoints of a chain, that with the lower rank is better. It has less cost [µs, so
/// that equal routes count as equal], then a later last place [mm], then the next lanelet with the smaller id. It does
/// not depend on how chains are stored.
fn rank(network: &Network, waypoint: &Waypoint) -> Rank {
    let next = waypoint.next.map(|it| network.lanelet_at(Position::new(it, 0.0)).0.id);
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

#[cfg(test)]
pub(crate) mod tests;
