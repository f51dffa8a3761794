//! What the lanelets carry: density, speed, flow and lane changes of about the last minute.

use laneweave::network::Network;
use laneweave::{Columns, Simulation};

/// What was seen a time ago counts e times less after this time [s].
const MEMORY: f64 = 60.0;
/// Time between two looks [s].
const INTERVAL: f64 = 1.0;
/// Lanelets on which less was seen than this are not reported [s].
const LEAST: f64 = 0.05;

/// The sums of each lanelet, after Edie (1963), in which older looks count less.
#[derive(Clone, Debug)]
pub(super) struct Lanes {
    lengths: Vec<f64>,
    sums: Vec<Sums>,
    /// Time that was looked at [s].
    time: f64,
    columns: Columns,
}

#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    /// Time that vehicles spent [s].
    time: f64,
    /// Distance that they drove [m].
    distance: f64,
    /// Changes to another lane.
    changes: f64,
}

impl Lanes {
    /// Nothing was seen yet.
    pub(super) fn of(network: &Network) -> Lanes {
        let lengths: Vec<f64> = network.lanelets.iter().map(|it| it.length()).collect();
        let sums = vec![Sums::default(); lengths.len()];
        Lanes { lengths, sums, time: 0.0, columns: Columns::default() }
    }

    /// Looks at the traffic once a second.
    pub(super) fn look(&mut self, simulation: &Simulation) {
        if !simulation.clock().begins_a_second() {
            return;
        }
        let less = (-INTERVAL / MEMORY).exp();
        self.time = self.time * less + INTERVAL;
        for Sums { time, distance, changes } in &mut self.sums {
            *time *= less;
            *distance *= less;
            *changes *= less;
        }
        simulation.columns(&mut self.columns);
        for (lanelet, speed) in self.columns.lanelet.iter().zip(&self.columns.speed_mps) {
            let sums = &mut self.sums[*lanelet as usize];
            sums.time += INTERVAL;
            sums.distance += INTERVAL * speed;
        }
    }

    /// A vehicle has left the lanelet for another lane.
    pub(super) fn changed(&mut self, lanelet: usize) {
        self.sums[lanelet].changes += 1.0;
    }

    /// A row for each lanelet on which somebody was: its index, density [veh/km], speed [km/h], flow [veh/h] and lane
    /// changes [1/(km h)].
    pub(super) fn rows(&self) -> Vec<(usize, f64, Option<f64>, f64, f64)> {
        if self.time <= 0.0 {
            return Vec::new();
        }
        let seen = self.sums.iter().zip(&self.lengths).enumerate();
        seen.filter(|(_, (it, _))| it.time > LEAST || it.changes > LEAST)
            .map(|(index, (it, length))| {
                let extent = self.time * length;
                let speed = (it.time > LEAST).then(|| round(it.distance / it.time * 3.6));
                let density = round(it.time / extent * 1000.0);
                let flow = round(it.distance / extent * 3600.0);
                (index, density, speed, flow, round(it.changes / extent * 3.6e6))
            })
            .collect()
    }
}

fn round(value: f64) -> f64 {
    (value * 10.0).round() / 10.0
}
