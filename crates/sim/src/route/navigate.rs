//! Which lanes lead where. For every destination there is the usual route, that of the free road. Where drivers are
//! guided, there is also the recommended route.
//!
//! A driver's goal names a table of waypoints: that of its destination, with the restriction of its class, in one of
//! three *ways* (variants of the route). While a driver uses a table, its routes stay as they are, and only the times
//! change. A new recommendation is planned in a table that no driver uses.

use std::borrow::Cow;
use std::sync::Arc;

use laneweave_network::{ChainIndex, Classes, Network};

use crate::route::class_restrictions::ClassRestrictions;
use crate::route::closures::Closures;
use crate::route::given_ways::on_any_way;
use crate::route::links::Links;
use crate::route::onward::Onward;
use crate::route::place::Place;
use crate::route::renew_routes::is_planned;
use crate::route::walk::Walk;
use crate::route::waypoint::Waypoint;
use crate::route::ways::{Into, Planner, beside_into};
use crate::state::goal::{Destination, Goal, TripEnd};
use crate::state::vehicle::Class;

/// The waypoints of all destinations, and the lanes that are closed.
///
/// Copies share the routes, until guidance changes those of one of them.
#[derive(Clone, Debug)]
pub struct Navigator {
    pub(super) routes: Arc<Routes>,
    pub(super) closures: Closures,
}

/// The routes to all destinations.
#[derive(Clone, Debug)]
pub(super) struct Routes {
    /// For each class restriction: a table for each destination, with the waypoints by chain, and then that of drivers
    /// without a destination. First all tables of the usual routes, then those of the recommended ones. These are empty
    /// until they are needed.
    pub(super) tables: Vec<Vec<Waypoint>>,
    pub(super) onward: Onward,
    /// Number of tables of each class restriction.
    pub(super) of_restriction: usize,
    /// How many of the last destinations are stops of lines.
    pub(super) stops: usize,
    /// For each destination with a way of its own the number of the same one that is reached over any roads.
    pub(super) on_any_way: Vec<Option<u16>>,
    /// For each table of a usual route, the table with the newest recommendation; empty without guidance.
    pub(super) recommended: Vec<u16>,
    pub(super) links: Links,
    /// Number of measurements of the links.
    pub(super) measurements: u32,
    pub(super) into: Vec<Into>,
    pub(super) restrictions: ClassRestrictions,
    /// For each chain the trip ends on it, before its end.
    pub(super) trip_ends: Vec<Vec<TripEnd>>,
}

impl Navigator {
    /// Upper limit of the waypoints that are planned, ours: 3.2 GB.
    pub(crate) const MOST_WAYPOINTS: usize = 50_000_000;
    /// Ways to one destination: the usual route, and two more. One of these is recommended, while drivers may still use
    /// the other.
    pub(crate) const WAYS: usize = 3;

    /// Plans all routes to the exits of `network`.
    pub fn new(network: &Network) -> Navigator {
        let exits: Vec<Place> = network.exits.iter().cloned().map(Place::Gate).collect();
        Navigator::towards(network, &exits)
    }

    /// Plans all routes to `destinations`, for classes that avoid nothing.
    pub fn towards(network: &Network, destinations: &[Place]) -> Navigator {
        Navigator::with_restrictions(network, destinations, ClassRestrictions::default(), 0)
    }

    /// Plans all routes to `destinations`, for these `classes` with what they may not use or avoid.
    pub fn towards_for(network: &Network, destinations: &[Place], classes: Classes) -> Navigator {
        Navigator::with_restrictions(network, destinations, ClassRestrictions::of(network, classes), 0)
    }

    /// Plans all routes to `destinations`, at most [`Demand::MOST_DESTINATIONS`], for classes with their restrictions.
    pub(crate) fn with_restrictions(
        network: &Network,
        destinations: &[Place],
        restrictions: ClassRestrictions,
        stops: usize,
    ) -> Navigator {
        let mut routes = Routes {
            tables: Vec::new(),
            onward: Onward::default(),
            of_restriction: destinations.len() + 1,
            stops,
            on_any_way: on_any_way(destinations),
            recommended: Vec::new(),
            links: Links::default(),
            measurements: 0,
            into: beside_into(network),
            restrictions,
            trip_ends: vec![Vec::new(); network.chains.len()],
        };
        for restriction in 0..routes.restrictions.count() {
            for place in destinations {
                let planner = routes.planner(network, restriction);
                let mut table = planner.plan(place);
                planner.note_alternatives(&mut table, None);
                routes.end_trips(place, routes.tables.len());
                routes.tables.push(table);
            }
            let table = routes.planner(network, restriction).wander();
            routes.tables.push(table);
        }
        routes.look_onward(network);
        Navigator { routes: Arc::new(routes), closures: Closures::default() }
    }

    /// Whether the route to a destination is planned.
    pub(crate) fn has(&self, destination: Destination) -> bool {
        is_planned(&self.routes.tables, destination)
    }

    /// Number of tables.
    pub(crate) fn tables(&self) -> usize {
        self.routes.tables.len()
    }

    /// The tables of the usual routes to a destination.
    pub(crate) fn usual_tables(&self) -> impl DoubleEndedIterator<Item = usize> {
        let of_restriction = self.routes.of_restriction;
        (0..self.routes.usual()).filter(move |it| it % of_restriction < of_restriction - 1)
    }

    /// Whether a driver has more than one route anywhere.
    pub(crate) fn offers_a_choice(&self) -> bool {
        self.routes.tables.iter().flatten().any(|it| it.leads_there() && it.alternative.is_finite())
    }

    /// The tables of all ways to the destination of `table`, with the same class restriction; the usual route first.
    pub(crate) fn ways(&self, table: usize) -> [usize; Navigator::WAYS] {
        let usual = table % self.routes.usual();
        std::array::from_fn(|way| usual + way * self.routes.usual())
    }

    /// The table of the newest recommendation for drivers who use the table `destination`; none if they already use it,
    /// or are not guided.
    #[inline]
    pub(crate) fn recommended(&self, destination: Destination) -> Destination {
        let table = destination.filter(|_| !self.routes.recommended.is_empty())?;
        Some(self.routes.recommended[usize::from(table) % self.routes.usual()]).filter(|it| *it != table)
    }

    /// Whether the table `destination` is that of a usual route.
    pub(crate) fn is_usual(&self, destination: Destination) -> bool {
        destination.is_none_or(|it| usize::from(it) < self.routes.usual())
    }

    #[inline]
    pub(crate) fn links(&self) -> &Links {
        &self.routes.links
    }

    /// Travel time from the start of `chain` to `x` on it [s], as in the waypoints.
    #[inline]
    pub(crate) fn time_to(&self, network: &Network, chain: ChainIndex, x: f64) -> f64 {
        if self.routes.links.are_free() {
            x / network.chain(chain).limit(x)
        } else {
            self.routes.links.time_to(chain, x)
        }
    }

    /// Measured travel time on the next `distance` [m] of the route to `destination`, from `x` on `chain` on [s].
    #[inline(never)]
    pub(crate) fn time_ahead(
        &self,
        network: &Network,
        destination: Destination,
        chain: ChainIndex,
        x: f64,
        distance: f64,
    ) -> f64 {
        let (mut left, mut time) = (distance, 0.0);
        for leg in self.walk(network, destination, chain, -x) {
            let from = if leg.before().is_none() { x } else { 0.0 };
            let here = left.min(network.chain(leg.chain).length - from).max(0.0);
            time += self.routes.links.time_to(leg.chain, from + here)
                - self.routes.links.time_to(leg.chain, from);
            left -= here;
            if left <= 0.0 {
                break;
            }
        }
        time
    }

    /// Whether the routes `one` and `other` are the same from `x` on `chain` on, for at least `distance` [m].
    pub(crate) fn part_beyond(
        &self,
        network: &Network,
        [one, other]: [Destination; 2],
        chain: ChainIndex,
        x: f64,
        distance: f64,
    ) -> bool {
        let [one, other] = [one, other].map(|it| self.walk(network, it, chain, -x).within(distance));
        one.eq(other)
    }

    /// The walk along the route to `destination`, from `chain` on, which starts `start` ahead [m].
    #[inline]
    pub(crate) fn walk<'a>(
        &'a self,
        network: &'a Network,
        destination: Destination,
        chain: ChainIndex,
        start: f64,
    ) -> Walk<'a> {
        Walk::new(network, &self.routes.onward, self.table(destination), chain, start)
    }

    /// The first table of each class restriction.
    pub(crate) fn restrictions(&self) -> impl Iterator<Item = u16> {
        let of_restriction = self.routes.of_restriction;
        (0..self.routes.restrictions.count()).map(move |it| (it * of_restriction) as u16)
    }

    /// The class restriction of `class`.
    pub(crate) fn restriction_of(&self, class: Class) -> usize {
        self.routes.restrictions.of_class(class)
    }

    /// A destination with the restriction of `class`. Who follows the road has the table of its restriction, too.
    pub(crate) fn seen_by(&self, class: Class, destination: Destination) -> Destination {
        let restriction = self.routes.restrictions.of_class(class);
        let wanders = self.routes.of_restriction - 1;
        let number = destination.map_or(wanders, |it| usize::from(it) % self.routes.of_restriction);
        let table = (restriction * self.routes.of_restriction + number) as u16;
        (number < wanders || restriction > 0).then_some(table)
    }

    /// A class that uses a table.
    pub(crate) fn class_of(&self, table: u16) -> Class {
        self.routes.restrictions.class(self.restriction(table))
    }

    /// The class restriction of a table.
    pub(super) fn restriction(&self, table: u16) -> usize {
        usize::from(table) / self.routes.of_restriction % self.routes.restrictions.count()
    }

    /// The index of the destination in the list of destinations, for any class restriction and way; `None` for who
    /// follows the road.
    pub fn number(&self, destination: Destination) -> Option<usize> {
        let number = usize::from(destination?) % self.routes.of_restriction;
        (number < self.routes.of_restriction - 1).then_some(number)
    }

    /// The chains on the route from the start of `chain` to `destination`, including those after lane changes.
    pub(crate) fn way(
        &self,
        chain: ChainIndex,
        destination: Destination,
    ) -> impl Iterator<Item = ChainIndex> + '_ {
        let next = move |at: &ChainIndex| self.waypoint(destination, *at).goes_on().filter(|it| it != at);
        std::iter::successors(Some(chain), next)
    }

    /// The waypoint of `chain`, from its start, on the route to `destination`.
    #[inline]
    pub fn waypoint(&self, destination: Destination, chain: ChainIndex) -> &Waypoint {
        &self.routes.tables[self.table(destination)][chain.at()]
    }

    /// The table of the drivers who go to `destination`.
    #[inline]
    fn table(&self, destination: Destination) -> usize {
        destination.map_or(self.routes.of_restriction - 1, usize::from)
    }

    /// The chain after `chain` on the route to `destination`.
    #[inline]
    pub(crate) fn next(
        &self,
        network: &Network,
        destination: Destination,
        chain: ChainIndex,
    ) -> Option<ChainIndex> {
        self.routes.onward.next(network, chain, self.table(destination))
    }

    /// Where on `chain` the way to `destination` ends [m], with the trip or at a stop; infinite where it goes on.
    #[inline]
    pub(crate) fn end_of_way(&self, destination: Destination, chain: ChainIndex) -> f64 {
        let goes_on = self.routes.stops == 0 && self.trip_ends(chain).is_empty();
        if goes_on { f64::INFINITY } else { self.waypoint(destination, chain).end }
    }

    /// The waypoint of `chain` from `x` on. Where `x` is too late for the usual route, that of the detour over its end.
    #[inline]
    pub fn waypoint_from(
        &self,
        network: &Network,
        destination: Destination,
        chain: ChainIndex,
        x: f64,
    ) -> Cow<'_, Waypoint> {
        let usual = self.waypoint(destination, chain);
        if usual.leads_on(x) && self.closures.is_empty() {
            return Cow::Borrowed(usual);
        }
        self.unusual_waypoint(network, destination, chain, x, true)
    }

    /// The waypoint where it may be too late for the usual route, if another one may be taken, or where lanelets are
    /// closed.
    #[inline(never)]
    pub(crate) fn unusual_waypoint(
        &self,
        network: &Network,
        destination: Destination,
        chain: ChainIndex,
        x: f64,
        may_take_another: bool,
    ) -> Cow<'_, Waypoint> {
        let usual = self.waypoint(destination, chain);
        let waypoint = if !may_take_another || usual.leads_on(x) {
            Cow::Borrowed(usual)
        } else {
            Cow::Owned(self.detour(network, destination, chain))
        };
        self.around_closures(network, destination, chain, x, waypoint)
    }

    /// The route to `destination` over the end of `chain`.
    #[inline(never)]
    fn detour(&self, network: &Network, destination: Destination, chain: ChainIndex) -> Waypoint {
        let restriction = destination.map_or(0, |it| self.restriction(it));
        let planner = self.routes.planner(network, restriction);
        let onward = planner.onward(chain).map(|it| (it, self.waypoint(destination, it)));
        let best = onward.min_by(|(_, a), (_, b)| a.cost().total_cmp(&b.cost()));
        let possible = best.filter(|(_, it)| it.leads_there());
        possible.map_or(Waypoint::NOWHERE, |(next, waypoint)| planner.before(chain, next, waypoint))
    }

    /// The trip ends on `chain`.
    #[inline]
    pub(crate) fn trip_ends(&self, chain: ChainIndex) -> &[TripEnd] {
        &self.routes.trip_ends[chain.at()]
    }
}

impl Routes {
    /// Stores again the next chain on every route of all tables.
    pub(super) fn look_onward(&mut self, network: &Network) {
        self.onward = Onward::new(network, self.tables.len());
        for (number, table) in self.tables.iter().enumerate() {
            self.onward.take(network, number, table);
        }
    }

    pub(super) fn planner<'a>(&'a self, network: &'a Network, restriction: usize) -> Planner<'a> {
        let Routes { into, links, restrictions, .. } = self;
        Planner { network, into, links, restrictions, restriction }
    }

    /// Records that the trips of drivers who use `table` end at `place`, unless it is a stop of a line.
    pub(super) fn end_trips(&mut self, place: &Place, table: usize) {
        if table % self.of_restriction >= self.chosen() {
            return;
        }
        let goal = Goal::from(Some(table as u16));
        for chain in place.chains() {
            if let Some(station) = place.end_on(*chain) {
                self.trip_ends[chain.at()].push(TripEnd { station, goal });
            }
        }
    }

    /// Number of destinations that drivers choose.
    pub(super) fn chosen(&self) -> usize {
        self.of_restriction - 1 - self.stops
    }

    /// Number of tables of usual routes.
    pub(super) fn usual(&self) -> usize {
        self.restrictions.count() * self.of_restriction
    }
}

#[cfg(test)]
mod tests;
