//! What a lane discharges at a light.

use std::collections::BTreeMap;

use laneweave::network::ChainIndex;
use laneweave::{Fault, Simulation, VehicleId};

use crate::experiments::drive::{each, over, steps};
use crate::experiments::effort::Effort;
use crate::experiments::finding::Row;
use crate::experiments::traffic::{Arriving, Road, Traffic};

/// Headways count from this vehicle of a queue on, up to the last one below.
const FROM: usize = 4;
const UP_TO: usize = 20;
/// A longer time between two vehicles at the stop line is a red light [s].
const RED: f64 = 10.0;
/// The approach from the west, and the exit straight on: their smallest lanelet ids.
const STRAIGHT_ON: [&str; 2] = ["1", "93"];

pub(super) fn rows(effort: &Effort) -> Result<Vec<Row>, Fault> {
    let queue = Traffic {
        road: Road::Lights,
        demand: Arriving::Between(vec![(STRAIGHT_ON, 3000.0)]),
        trucks: 0.0,
        times: [300.0, 1200.0],
        ..Traffic::on_motorway(1, 0.0)
    };
    let runs = each(effort, &[queue], flow)?;
    Ok(vec![Row {
        what: "discharge of a lane at a light, cars that go straight on, from the 5th of a queue on".into(),
        unit: "veh/h",
        value: runs.first().and_then(|it| over(it, |it| *it)),
        range: [1700.0, 2000.0],
        source: "1,900 pc/h/lane (HCM, m), 2,200 (KHCM 2013); the range is ours",
    }])
}

/// Flow of a lane while its queue discharges [veh/h].
fn flow(simulation: &mut Simulation) -> Option<f64> {
    let lanes = simulation.network().entrances.iter().find(|it| it.id == STRAIGHT_ON[0])?;
    let mut line = StopLine { lanes: lanes.chains.clone(), on: BTreeMap::new(), passed: BTreeMap::new() };
    steps(simulation, |simulation, _| line.see(simulation));
    let headways: Vec<f64> = line.passed.values().flat_map(|it| headways(it)).collect();
    (!headways.is_empty()).then(|| 3600.0 * headways.len() as f64 / headways.iter().sum::<f64>())
}

/// The headways that count, of the times at which vehicles of a lane passed the stop line [s].
fn headways(passed: &[f64]) -> Vec<f64> {
    let (mut place, mut found) = (0, Vec::new());
    for pair in passed.windows(2) {
        let headway = pair[1] - pair[0];
        place = if headway > RED { 0 } else { place + 1 };
        if (FROM..UP_TO).contains(&place) {
            found.push(headway);
        }
    }
    found
}

/// Sees which vehicles pass the stop line at the end of the lanes.
struct StopLine {
    lanes: Vec<ChainIndex>,
    /// The vehicles before it, each with its lane.
    on: BTreeMap<VehicleId, ChainIndex>,
    /// By lane, the times at which vehicles passed [s].
    passed: BTreeMap<ChainIndex, Vec<f64>>,
}

impl StopLine {
    fn see(&mut self, simulation: &Simulation) {
        let before = simulation.views().filter(|it| self.lanes.contains(&it.spot.chain));
        let now: BTreeMap<VehicleId, ChainIndex> = before.map(|it| (it.id(), it.spot.chain)).collect();
        for (_, lane) in self.on.iter().filter(|(id, _)| !now.contains_key(id)) {
            self.passed.entry(*lane).or_default().push(simulation.time_s());
        }
        self.on = now;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headways_count_from_the_fifth_vehicle_of_a_queue_on() {
        let mut passed: Vec<f64> = (0..7).map(|it| 2.0 * f64::from(it)).collect();
        passed.extend([50.0, 52.0, 54.0]);
        assert_eq!(headways(&passed), [2.0, 2.0, 2.0]);
        assert!(headways(&[]).is_empty());
    }
}
