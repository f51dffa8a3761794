//! The destinations of the trips that start at an origin.

use laneweave_network::Network;

use crate::demand::{Demand, Origin, Trips};
use crate::route::in_time::LateTrip;
use crate::route::navigate::Navigator;
use crate::route::place::Place;
use crate::state::goal::Destination;

/// The trips of `demand` with too little road for their lane changes, in order.
pub(crate) fn late_trips(network: &Network, navigator: &Navigator, demand: &Demand) -> Vec<LateTrip> {
    let origins: Vec<&Place> = demand.origins.iter().map(|it| &it.place).collect();
    navigator.late_trips(network, &origins, demand.exits().len())
}

/// For each class restriction the destinations of trips from an origin, which has a number among all, with cumulated
/// weights.
pub(super) fn destinations(
    network: &Network,
    navigator: &Navigator,
    (origin, number): (&Origin, usize),
    late: &[LateTrip],
) -> Vec<Vec<(Destination, f64)>> {
    let first = late.partition_point(|it| it.origin < number);
    let late = late[first..].iter().take_while(|it| it.origin == number);
    let late: Vec<LateTrip> = late.filter(|_| origin.trips == Trips::InTime).copied().collect();
    navigator.restrictions().map(|it| from(network, navigator, origin, it, &late)).collect()
}

/// The destinations, from the table `first` on, that can be reached from an origin, with cumulated weights: those with
/// road enough, or all if there are none.
fn from(
    network: &Network,
    navigator: &Navigator,
    origin: &Origin,
    first: u16,
    late: &[LateTrip],
) -> Vec<(Destination, f64)> {
    let class = navigator.class_of(first);
    let is_late = |table: u16| {
        let found = late.binary_search_by_key(&usize::from(table - first), |it| it.destination);
        found.is_ok_and(|it| late[it].classes.has(class))
    };
    let leads = (first..)
        .zip(&origin.weights)
        .filter(|(table, weight)| **weight > 0.0 && navigator.leads_to(network, &origin.place, *table));
    let leads: Vec<(u16, f64)> = leads.map(|(table, weight)| (table, *weight)).collect();
    let are_all_late = leads.iter().all(|it| is_late(it.0));
    let mut sum = 0.0;
    let chosen = leads.into_iter().filter(|it| are_all_late || !is_late(it.0));
    chosen
        .map(|(table, weight)| {
            sum += weight;
            (Some(table), sum)
        })
        .collect()
}
