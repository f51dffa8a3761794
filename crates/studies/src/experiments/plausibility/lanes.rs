//! Which lanes drivers use where the law wants them on the slow side.

use laneweave::Fault;
use laneweave::maps::Law;

use crate::experiments::drive::{drive_all, over};
use crate::experiments::effort::Effort;
use crate::experiments::finding::Row;
use crate::experiments::seen::Seen;
use crate::experiments::traffic::Traffic;

const SOURCE: &str = "direction: Duret, Ahn, Buisson 2012; Wagner, Nagel, Wolf 1997; the numbers are ours";

pub(super) fn rows(effort: &Effort) -> Result<Vec<Row>, Fault> {
    let at = |flow| Traffic { law: Law::Germany, ..Traffic::on_motorway(3, flow) };
    let [few, many] = &drive_all(effort, [at(300.0), at(1900.0)])?;
    // Lanes of a motorway without ramps are chains, numbered from the slow side.
    let share = |seen: &Seen, lane: usize| {
        let all: f64 = seen.metres_by_lane.iter().sum();
        Some(100.0 * seen.metres_by_lane.get(lane)? / all)
    };
    let row = |what: &str, runs: &[Seen], lane, range| Row {
        what: what.into(),
        unit: "%",
        value: over(runs, |it| share(it, lane)),
        range,
        source: SOURCE,
    };
    Ok(vec![
        row("share of the right of three lanes at 300 veh/h/lane, law of Germany", few, 0, [35.0, 80.0]),
        row("share of the left lane there", few, 2, [0.0, 15.0]),
        row("share of the right lane at 1,900 veh/h/lane", many, 0, [26.0, 40.0]),
        row("share of the left lane there", many, 2, [26.0, 42.0]),
    ])
}
