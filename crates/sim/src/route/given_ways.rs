//! Destinations of vehicles whose way is given: the stops of lines, and ends of trips with a way of their own. Drivers
//! keep to that, and who leaves it goes to the same place on any way.

use laneweave_network::ChainIndex;

use crate::route::navigate::Navigator;
use crate::route::place::Place;
use crate::state::goal::Destination;

/// For each destination with a way of its own the number of the same place that is reached over any roads, if it is
/// among them.
pub(super) fn on_any_way(destinations: &[Place]) -> Vec<Option<u16>> {
    destinations.iter().map(|it| same(it, destinations)).collect()
}

fn same(place: &Place, all: &[Place]) -> Option<u16> {
    let Place::Across(section) = place else { return None };
    let is_it = |it: &Place| matches!(it, Place::Across(other) if section.is_on_any_way(other));
    let found = all.iter().position(is_it).map(|it| it as u16);
    found.filter(|it| all[usize::from(*it)] != *place)
}

impl Navigator {
    /// Whether a destination is a stop of a line.
    pub(crate) fn is_stop(&self, destination: Destination) -> bool {
        self.number(destination).is_some_and(|it| it >= self.routes.chosen())
    }

    /// Where on `chain` the place beyond the stop is [m], if `destination` is a stop on it.
    pub(super) fn stop_on(&self, destination: Destination, chain: ChainIndex) -> Option<f64> {
        let is_there = |it: &f64| it.is_finite();
        let stop = self.is_stop(destination).then(|| self.waypoint(destination, chain).end);
        stop.filter(is_there)
    }

    /// The same destination, reached over any roads, if it has a way of its own.
    pub(crate) fn on_any_way(&self, destination: Destination) -> Option<Destination> {
        let number = self.routes.on_any_way[self.number(destination)?]?;
        Some(self.seen_by(self.class_of(destination?), Some(number)))
    }
}
