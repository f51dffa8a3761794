//! Which trips leave drivers the road that they need for their lane changes.

use laneweave_models::lateral::Crossing;
use laneweave_network::{Beside, Chain, Class, Classes, Network, Side};

use crate::route::navigate::Navigator;
use crate::route::place::Place;
use crate::route::waypoint::Waypoint;
use crate::route::ways::Planner;

/// A trip with a route that has too little road for its lane changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LateTrip {
    /// The number of its origin.
    pub origin: usize,
    /// The number of its destination.
    pub destination: usize,
    /// The classes for which this is so.
    pub classes: Classes,
}

/// The trips with too little road for their lane changes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LateTrips {
    /// These trips, by their origins and destinations.
    pub late: Vec<LateTrip>,
    /// For each origin the classes that have other trips.
    pub in_time: Vec<Classes>,
}

/// A lane change at the speed limit takes at least this time [s], ours: of lone drivers who have less for each of
/// several changes, or for one behind an entrance, most miss the turn.
const TIME: f64 = 3.0;
/// How drivers brake for a change that they must make [m/s²]: comfortably.
const BRAKING: f64 = 2.0;

impl Navigator {
    /// The trips from `origins` to the first `destinations` with too little road for their lane changes.
    pub fn late_trips(&self, network: &Network, origins: &[&Place], destinations: usize) -> LateTrips {
        let mut late = Vec::new();
        let mut in_time = vec![Classes::NONE; origins.len()];
        for destination in 0..destinations {
            let tables: Vec<u16> = self.restrictions().map(|first| first + destination as u16).collect();
            let latest: Vec<Vec<f64>> =
                tables.iter().map(|table| self.latest_starts(network, *table)).collect();
            for (origin, place) in origins.iter().enumerate() {
                let number = |class: &Class| self.restriction_of(*class);
                let leads = |it: &Class| self.leads_to(network, place, tables[number(it)]);
                let is_in_time =
                    |it: &Class| self.is_in_time(network, place, tables[number(it)], &latest[number(it)]);
                let led = Class::ALL.into_iter().filter(leads);
                let (early, others): (Vec<Class>, Vec<Class>) = led.partition(is_in_time);
                in_time[origin] = in_time[origin].and(early.into_iter().collect());
                let classes: Classes = others.into_iter().collect();
                late.extend((!classes.is_empty()).then_some(LateTrip { origin, destination, classes }));
            }
        }
        late.sort_unstable_by_key(|it| (it.origin, it.destination));
        LateTrips { late, in_time }
    }

    /// Whether a driver who uses `table` makes its changes from some lane at `place`, also over the end of the lane.
    fn is_in_time(&self, network: &Network, place: &Place, table: u16, latest: &[f64]) -> bool {
        let class = self.class_of(table);
        let mut lanes = place.chains().iter().filter(|it| network.chain(**it).classes.has(class));
        match place {
            Place::Gate(_) => lanes.any(|it| latest[it.at()] >= 0.0),
            Place::Inside(_) | Place::Across(_) => lanes.any(|it| {
                let beyond = network.chain(*it).following.iter().map(|next| latest[next.at()]);
                let over_the_end = network.chain(*it).length + beyond.fold(f64::NEG_INFINITY, f64::max);
                latest[it.at()].max(over_the_end) >= place.end_on(*it).unwrap_or(0.0)
            }),
        }
    }

    /// For each chain the last station from which a driver at the speed limit makes all lane changes of its route by
    /// `table` [m]: infinite where none is left, and minus infinity without a route.
    fn latest_starts(&self, network: &Network, table: u16) -> Vec<f64> {
        let planner = self.routes.planner(network, self.restriction(table));
        let table = &self.routes.tables[usize::from(table)];
        let mut order: Vec<usize> = (0..table.len()).filter(|it| table[*it].leads_there()).collect();
        // Each after the chains to which its route leads.
        order.sort_by(|a, b| {
            let [a, b] = [&table[*a], &table[*b]];
            a.changes.cmp(&b.changes).then(a.time.total_cmp(&b.time))
        });
        let mut latest = vec![f64::NEG_INFINITY; table.len()];
        for at in order {
            let Waypoint { changes, via, end, .. } = table[at];
            let chain = &network.chains[at];
            let straight_on = match table[via.at()].changes {
                _ if via.at() == at => end,
                same if same == changes => chain.length + latest[via.at()],
                _ => f64::NEG_INFINITY,
            };
            let stretches = Side::BOTH.into_iter().flat_map(|side| chain.stretches(side));
            let leading = stretches.filter(|it| table[it.chain.at()].changes < changes);
            let beside = leading.map(|it| planner.latest_start(chain, it, latest[it.chain.at()]));
            latest[at] = beside.fold(straight_on, f64::max);
        }
        latest
    }
}

impl Planner<'_> {
    /// The last station on `chain` from which a driver at the speed limit can change over `stretch`, at this speed or
    /// as slowly as it can be done, and be on the other chain by the station `onward` there [m].
    fn latest_start(&self, chain: &Chain, stretch: &Beside, onward: f64) -> f64 {
        let [start, end] = self.network.window(chain, stretch, self.class());
        let by = end.min(stretch.back(onward));
        let speed = chain.limit(start.max(0.0));
        let length = self.class().body().length;
        let road = Crossing { speed: 0.0, length, duration: TIME }.least_way();
        let slow = road / TIME;
        let to_slow_down = (speed * speed - slow * slow).max(0.0) / (2.0 * BRAKING);
        let ways = [(speed * TIME, 0.0), (road, to_slow_down)];
        let possible = ways.into_iter().filter(|(road, _)| by - start >= *road);
        possible.map(|(road, before)| by - road - before).fold(f64::NEG_INFINITY, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use laneweave_network::{DrivingSide, Lanelet, LaneletIndex};

    use super::*;
    use crate::route::ways::tests::lanelet;

    /// Two lanes at 10 m/s, each with an entrance and an exit, with changes between them from 300 m on,
    /// over so many metres.
    fn window(length: f64) -> Network {
        let beside = |it: Lanelet, left, right| Lanelet { left, right, ..it };
        let index = |it| Some(LaneletIndex(it));
        let all = vec![
            lanelet(1, [0.0, 300.0], &[1]),
            beside(lanelet(2, [300.0, 300.0 + length], &[2]), index(4), None),
            lanelet(3, [300.0 + length, 900.0], &[]),
            lanelet(4, [0.0, 300.0], &[4]),
            beside(lanelet(5, [300.0, 300.0 + length], &[5]), None, index(1)),
            lanelet(6, [300.0 + length, 900.0], &[]),
        ];
        Network::new(all, DrivingSide::Right).unwrap()
    }

    #[test]
    fn a_driver_needs_3_s_for_a_change_or_12_m_after_slowing_down() {
        let latest = |length: f64| {
            let network = window(length);
            let navigator = Navigator::new(&network);
            let starts = network.entrances.iter().map(|it| it.chains[0].at());
            let across = network.exits.iter().position(|it| it.id == 6).unwrap();
            let all = navigator.latest_starts(&network, across as u16);
            starts.map(|it| all[it]).fold(f64::INFINITY, f64::min)
        };
        // In 40 m at 10 m/s: from 10 m into the window on.
        assert_eq!(latest(40.0), 310.0);
        // In 20 m: from 10 to 4 m/s at 2 m/s² within 21 m, and 12 m.
        assert_eq!(latest(20.0), 320.0 - 12.0 - 21.0);
        assert_eq!(latest(11.9), f64::NEG_INFINITY);
        let [short, long] = [11.9, 12.0].map(|length| {
            let network = window(length);
            let origins: Vec<Place> = network.entrances.iter().cloned().map(Place::Gate).collect();
            Navigator::new(&network).late_trips(&network, &origins.iter().collect::<Vec<_>>(), 2)
        });
        let [cars, trucks] = [&short, &long].map(|late| {
            let of = |class| late.late.iter().filter(|it| it.classes.has(class)).count();
            [Class::Car, Class::Truck].map(of)
        });
        // A truck has the table of a car here, as nobody may drive elsewhere than others.
        assert_eq!((cars, trucks), ([2, 2], [0, 0]));
        assert_eq!(short.in_time, [Classes::ALL; 2], "each has its own exit");
    }
}
