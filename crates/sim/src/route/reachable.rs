//! Which destinations can be reached from where.

use laneweave_network::{ChainIndex, Classes, Network};

use crate::route::navigate::Navigator;
use crate::route::place::{InnerPlace, Place};
use crate::state::goal::Destination;

impl Navigator {
    /// No trip inside the map is shorter than this [m], ours.
    const SHORTEST_TRIP: f64 = 100.0;

    /// The destinations that can be reached from `x` on `chain`, with their free travel times [s].
    pub fn reachable(&self, chain: ChainIndex, x: f64) -> impl Iterator<Item = (Destination, f64)> {
        self.reachable_in(0, chain, x)
    }

    fn reachable_in(
        &self,
        restriction: usize,
        chain: ChainIndex,
        x: f64,
    ) -> impl Iterator<Item = (Destination, f64)> {
        let first = restriction * self.routes.of_restriction;
        let tables = self.routes.tables[first..].iter().zip(first..).take(self.routes.chosen());
        tables.filter_map(move |(table, number)| {
            let waypoint = &table[chain.at()];
            waypoint.leads_on(x).then_some((Some(number as u16), waypoint.time))
        })
    }

    /// The destination of least time that can be reached from `x` on `chain`, also over its end, for a driver with the
    /// old destination `before`: the same one, if that has a way of its own which the driver has left. `None` if there
    /// is none: the driver then follows the road.
    pub fn nearest(&self, network: &Network, before: Destination, chain: ChainIndex, x: f64) -> Destination {
        let leads = |it: &Destination| self.waypoint_from(network, *it, chain, x).leads_on(x);
        if let Some(same) = self.on_any_way(before).filter(leads) {
            return same;
        }
        let first = before.map_or(0, |it| self.restriction(it)) * self.routes.of_restriction;
        let all = (first..first + self.routes.chosen()).map(|it| Some(it as u16));
        let reachable = all.filter_map(|it| {
            let waypoint = self.waypoint_from(network, it, chain, x);
            waypoint.leads_on(x).then_some((it, waypoint.time))
        });
        reachable.min_by(|a, b| a.1.total_cmp(&b.1)).and_then(|(destination, _)| destination)
    }

    /// The destination of least time to which the usual route leads from `x` on `chain`, for a driver with the old
    /// destination `before`.
    pub(crate) fn nearest_in_lane(&self, before: Destination, chain: ChainIndex, x: f64) -> Destination {
        let leads = |it: &Destination| self.waypoint(*it, chain).leads_on(x);
        if let Some(same) = self.on_any_way(before).filter(leads) {
            return same;
        }
        let restriction = before.map_or(0, |it| self.restriction(it));
        let reachable = self.reachable_in(restriction, chain, x);
        reachable.min_by(|a, b| a.1.total_cmp(&b.1)).and_then(|(destination, _)| destination)
    }

    /// Whether any of these `classes` can reach the destination with this number from `place`.
    pub(crate) fn leads(&self, network: &Network, place: &Place, number: u16, classes: Classes) -> bool {
        let table = |class| self.seen_by(class, Some(number));
        classes.iter().filter_map(table).any(|it| self.leads_to(network, place, it))
    }

    /// Whether the destination with this table can be reached from `place`, by who may be there. From a trip end inside
    /// the map, it must also be far enough.
    pub(crate) fn leads_to(&self, network: &Network, place: &Place, destination: u16) -> bool {
        let class = self.class_of(destination);
        let may_start = |it: &&ChainIndex| network.chain(**it).classes.has(class);
        match place {
            _ if !place.chains().iter().any(|it| may_start(&it)) => false,
            Place::Gate(gate) => {
                let waypoint = |chain: &ChainIndex| self.waypoint(Some(destination), *chain);
                gate.chains.iter().filter(may_start).any(|chain| waypoint(chain).leads_there())
            }
            Place::Inside(InnerPlace { chain, station, .. }) => {
                let waypoint = self.waypoint_from(network, Some(destination), *chain, *station);
                let distance = waypoint.distance - station;
                waypoint.leads_there() && distance >= Navigator::SHORTEST_TRIP
            }
            Place::Across(section) => section.lanes().filter(|it| may_start(&&it.chain)).any(|it| {
                let waypoint = self.waypoint_from(network, Some(destination), it.chain, it.x);
                waypoint.leads_there() && waypoint.leads_on(it.x)
            }),
        }
    }
}
