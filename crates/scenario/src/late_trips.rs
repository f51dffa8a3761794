//! Trips with too little road for the lane changes of their route, in words.

use laneweave_network::{Class, Classes, Id, Network};
use laneweave_sim::{LateTrip, Navigator, Place, Places, World};
use serde::Serialize;

use crate::remarks::{Remark, remark};
use crate::scenario::Demand;

/// A trip with too little road for its lane changes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Late {
    /// The id of its entrance.
    pub from: Id,
    /// The id of its exit.
    pub to: Id,
    /// The classes of vehicles for which this is so.
    pub classes: Vec<&'static str>,
}

impl Late {
    /// So many waypoints of a class restriction are planned at a time: 260 MB.
    const WAYPOINTS_AT_ONCE: usize = 4_000_000;

    /// Those of the usual classes between `places`: those that the default demand has, since there are no others, and
    /// those that it leaves out.
    pub fn between(network: &Network, places: &Places) -> [Vec<Late>; 2] {
        let Places { origins, destinations } = places;
        let usual = Demand::default().classes();
        let of_usual = |classes: Classes| classes.iter().filter(|it| usual.has(*it)).collect::<Classes>();
        let all: Vec<&Place> = origins.iter().collect();
        let (mut late, mut has_others) = (Vec::new(), false);
        let at_once = (Late::WAYPOINTS_AT_ONCE / network.chains.len().max(1)).max(1);
        for part in destinations.chunks(at_once) {
            let navigator = Navigator::towards_for(network, part, usual);
            let found = navigator.late_trips(network, &all, part.len());
            let named =
                |it: &LateTrip| Late::of(of_usual(it.classes), &origins[it.origin], &part[it.destination]);
            late.extend(found.late.iter().filter_map(named));
            has_others |= found.in_time.into_iter().any(|it| !of_usual(it).is_empty());
        }
        if has_others { [Vec::new(), late] } else { [late, Vec::new()] }
    }

    /// A trip of some `classes` between these places, if there are any.
    fn of(classes: Classes, from: &Place, to: &Place) -> Option<Late> {
        let names = classes.iter().map(|class| class.body().name).collect();
        (!classes.is_empty()).then(|| Late { from: from.id(), to: to.id(), classes: names })
    }

    /// Its name: with the classes, if it does not concern cars.
    fn name(&self) -> String {
        let Late { from, to, classes } = self;
        let is_of_all = classes.contains(&Class::Car.body().name);
        if is_of_all {
            format!("{from} to {to}")
        } else {
            format!("{from} to {to} by {}", classes.join(" and "))
        }
    }
}

/// The remarks on trips with too little road: on those that the demand has, and on those that it leaves out.
pub fn on_late_trips([driven, left_out]: &[Vec<Late>; 2]) -> [Option<Remark>; 2] {
    let driven = too_little_road(driven).and_then(|it| {
        let what = format!("{it}: the demand has them, and their drivers may miss a turn and hold others up");
        remark(what, "leave them out of the demand, or let drivers change lanes on a longer stretch")
    });
    let left_out = too_little_road(left_out).and_then(|it| {
        let what = format!("{it}: the demand leaves them out, unless it names them");
        let remedy =
            "name them in demand.od to have them all the same, or let drivers change lanes on a longer stretch";
        remark(what, remedy)
    });
    [driven, left_out]
}

/// The remarks on such trips of the demand of `world`.
pub(crate) fn on_late_trips_of(world: &World) -> [Option<Remark>; 2] {
    let demand = world.demand();
    let named = world.late_trips().map(|trips| {
        let late = |it: &LateTrip| {
            Late::of(it.classes, &demand.origins[it.origin].place, &demand.destinations[it.destination])
        };
        trips.iter().filter_map(late).collect()
    });
    on_late_trips(&named)
}

/// What is wrong with `trips`, the first of which are named; `None` without trips.
fn too_little_road(trips: &[Late]) -> Option<String> {
    const SHOWN: usize = 5;
    let first: Vec<String> = trips.iter().take(SHOWN).map(Late::name).collect();
    let more = if trips.len() > SHOWN { ", …" } else { "" };
    let plural = if trips.len() == 1 { "trip" } else { "trips" };
    let named = || format!("{} {plural} ({}{more})", trips.len(), first.join(", "));
    (!trips.is_empty()).then(|| format!("there is too little road for the lane changes of {}", named()))
}
