//! The flows of the queues of some drivers, each computed once: many lights and lanes of a map have the same queue.

use std::cell::RefCell;
use std::collections::BTreeMap;

use laneweave_models::Style;
use laneweave_network::{Phase, Program, RoadLaw};
use laneweave_sim::{Fleet, PerimeterControl};

use super::side_by_side;
use super::stream::Mixture;

/// The queues of drivers, each style with its weight, in the vehicles of a fleet.
pub(crate) struct Queues {
    drivers: Vec<(Style, f64)>,
    fleet: Fleet,
    law: RoadLaw,
    /// Flows of lanes [veh/s], by limit [m/s] and curvature [1/m].
    streams: Known,
    /// Vehicles that pass in a green, by its length [s] and the limit [m/s].
    greens: Known,
    /// Flows of lanes side by side [veh/s], by their number and limit [m/s].
    beside: Known,
    /// Length that vehicles take up while they drive a metre [m s], by the limit [m/s].
    taken: Known,
}

impl Queues {
    pub(crate) fn new(drivers: &[(Style, f64)], fleet: Fleet, law: RoadLaw) -> Queues {
        let [streams, greens, beside, taken] = [(); 4].map(|()| Known::default());
        Queues { drivers: drivers.to_vec(), fleet, law, streams, greens, beside, taken }
    }

    /// The vehicles and drivers under a limit [m/s], in a bend of this curvature [1/m]; 0: on a straight lane.
    pub(super) fn mixture(&self, limit: f64, curvature: f64) -> Mixture<'_> {
        Mixture::new(limit, &self.drivers, &self.fleet, &self.law).in_bend(curvature)
    }

    /// The capacity of a single lane without a light, if it is alone [veh/s].
    pub(crate) fn stream(&self, limit: f64, curvature: f64) -> f64 {
        self.streams.get([limit, curvature], || self.mixture(limit, curvature).stream())
    }

    /// Flow through a light with a queue before it [veh/s].
    pub(super) fn through(&self, program: &Program, limit: f64) -> f64 {
        if program.phases.is_empty() {
            return self.stream(limit, 0.0);
        }
        let pass = |it: &Phase| self.pass_at_green(it.to - it.from, limit);
        program.phases.iter().map(pass).sum::<f64>() / program.cycle
    }

    /// Vehicles of a queue that pass in a green [s], interpolated between greens that are computed.
    fn pass_at_green(&self, green: f64, limit: f64) -> f64 {
        /// Between greens that are computed [s].
        const BETWEEN: f64 = 5.0;
        let before = (green / BETWEEN).floor() * BETWEEN;
        let pass =
            |green: f64| self.greens.get([green, limit], || self.mixture(limit, 0.0).pass_at_green(green));
        let [less, more] = [before, before + BETWEEN].map(pass);
        less + (more - less) * (green - before) / BETWEEN
    }

    /// Mean length that a vehicle takes up in a town under a limit [m/s], times the time in which it drives one metre
    /// [m s].
    pub(super) fn taken_on_a_metre(&self, limit: f64) -> f64 {
        let taken = |length: f64, desired: f64| PerimeterControl::taken_by(length) / desired;
        self.taken.get([limit, 0.0], || self.mixture(limit, 0.0).mean_of(taken))
    }

    /// The share of the capacity of so many `lanes` side by side under `limit` [m/s] that lane changes leave.
    pub(super) fn left(&self, lanes: usize, limit: f64) -> f64 {
        if lanes < 2 {
            return 1.0;
        }
        let alone = lanes as f64 * self.stream(limit, 0.0);
        let left = || {
            let flow = side_by_side::flow(lanes, limit, &self.drivers, &self.fleet, &self.law);
            flow.map_or(1.0, |it| (it / alone).min(1.0))
        };
        self.beside.get([lanes as f64, limit], left)
    }
}

/// What was computed, by two numbers.
#[derive(Default)]
struct Known(RefCell<BTreeMap<[u64; 2], f64>>);

impl Known {
    /// The value for `key`; computed if there is none.
    fn get(&self, key: [f64; 2], compute: impl FnOnce() -> f64) -> f64 {
        let bits = key.map(f64::to_bits);
        if let Some(known) = self.0.borrow().get(&bits) {
            return *known;
        }
        let new = compute();
        self.0.borrow_mut().insert(bits, new);
        new
    }
}

#[cfg(test)]
mod tests {
    use laneweave_generate::{Grid, grid};

    use super::super::lights::Equivalents;
    use super::super::{Roads, lanes};
    use super::*;
    use crate::scenario::{Origin, Prepared, Scenario, prepare_on};

    /// A grid with so many streets in each direction, ready to run with a demand that is given.
    fn prepared(streets: usize) -> Prepared {
        let wanted = Grid { rows: streets, columns: streets, ..Grid::default() };
        let map = grid(&wanted).unwrap().build().unwrap();
        let mut scenario = Scenario::of_map("grid.osm".into());
        scenario.demand.vehicles_per_hour = Some(1000.0);
        prepare_on(map, &scenario, &Origin::default()).unwrap()
    }

    #[test]
    fn a_larger_town_has_no_more_queues() {
        let counts = [2, 4].map(|streets| {
            let Prepared { world, .. } = prepared(streets);
            let queues =
                Queues::new(&[(world.driver_parameters()[0].clone(), 1.0)], Fleet::default(), RoadLaw::FREE);
            let (network, assignment) = (world.network(), &world.assignment([0.0, 1.0]));
            let equivalents = &Equivalents::default();
            lanes::loads(&Roads { network, assignment, queues: &queues, equivalents });
            [&queues.streams, &queues.greens, &queues.beside].map(|it| it.0.borrow().len())
        });
        // Greens of five seconds each up to the longest.
        let [small, large] = counts;
        assert!(small[1] > 0 && large[1] <= 24 && [large[0], large[2]] == [small[0], small[2]], "{counts:?}");
    }

    #[test]
    fn nothing_is_estimated_before_somebody_asks() {
        let prepared = prepared(1);
        assert_eq!(format!("{:?}", prepared.conditions.capacity), "LazyLock(<uninit>)");
        assert!(prepared.conditions.capacity.veh_h > 0.0);
    }
}
