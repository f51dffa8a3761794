//! The destinations of the trips that start at an origin.

use laneweave_network::Network;

use crate::demand::{Demand, Origin, Trips};
use crate::route::in_time::{LateTrip, LateTrips};
use crate::route::navigate::Navigator;
use crate::route::place::Place;
use crate::state::goal::Destination;

/// The trips of `demand` with too little road for their lane changes.
pub(super) fn late_trips(network: &Network, navigator: &Navigator, demand: &Demand) -> LateTrips {
    let origins: Vec<&Place> = demand.origins.iter().map(|it| &it.place).collect();
    navigator.late_trips(network, &origins, demand.exits().len())
}

/// For each class restriction the destinations of trips from an origin, which has a number among all, with cumulated
/// weights: those with road enough, or all if nobody of the demand has one.
pub(super) fn destinations(
    network: &Network,
    navigator: &Navigator,
    (demand, number): (&Demand, usize),
    late: &[LateTrip],
) -> Vec<Vec<(Destination, f64)>> {
    let origin = &demand.origins[number];
    let first = late.partition_point(|it| it.origin < number);
    let count = late[first..].iter().take_while(|it| it.origin == number).count();
    let late = if origin.trips == Trips::InTime { &late[first..first + count] } else { &[] };
    let without = |late: &[LateTrip]| -> Vec<_> {
        navigator.restrictions().map(|it| from(network, navigator, origin, it, late)).collect()
    };
    let in_time = without(late);
    let leads = |it| !in_time[navigator.restriction_of(it)].is_empty();
    if demand.fleet.classes().iter().any(leads) { in_time } else { without(&[]) }
}

/// The destinations, from the table `first` on, that can be reached from an origin, with cumulated weights, without
/// trips that are `late`.
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
    let leads = |table: u16| navigator.leads_to(network, &origin.place, table) && !is_late(table);
    let weighted = (first..).zip(&origin.weights).filter(|(table, weight)| **weight > 0.0 && leads(*table));
    let mut sum = 0.0;
    weighted
        .map(|(table, weight)| {
            sum += weight;
            (Some(table), sum)
        })
        .collect()
}
