//! How fast traffic is: the free branch of the fundamental diagram.

use laneweave::Fault;
use laneweave::generate::Motorway;

use crate::experiments::drive::{drive_all, over};
use crate::experiments::effort::Effort;
use crate::experiments::finding::Row;
use crate::experiments::seen::Seen;
use crate::experiments::traffic::{Road, Traffic};

/// The limit, at which the free speed is that of the source [km/h].
const FREE: f64 = 113.0;
/// Flows [veh/h per lane], and the speeds that go with them [km/h].
const SPEEDS: [(f64, [f64; 2]); 4] =
    [(700.0, [108.0, 114.0]), (1100.0, [107.0, 113.0]), (1500.0, [103.0, 112.0]), (2000.0, [88.0, 98.0])];
const SOURCE: &str = "HCM with a free speed of 113 km/h and 2 pc a truck (m); the ranges are ours";

pub(super) fn rows(effort: &Effort) -> Result<Vec<Row>, Fault> {
    let road = Motorway { lanes: 3, speed_limit_kmh: FREE, ..Motorway::default() };
    let at = |flow| Traffic { road: Road::Motorway(road.clone()), ..Traffic::on_motorway(3, flow) };
    let runs = drive_all(effort, SPEEDS.map(|(flow, _)| at(flow)))?;
    let row = |((flow, range), runs): ((f64, [f64; 2]), &Vec<Seen>)| Row {
        what: format!("mean speed at {flow:.0} veh/h/lane on 3 lanes, limit {FREE} km/h"),
        unit: "km/h",
        value: over(runs, mean_speed),
        range,
        source: SOURCE,
    };
    Ok(SPEEDS.into_iter().zip(&runs).map(row).collect())
}

/// Mean speed [km/h] of all vehicles at all times.
fn mean_speed(seen: &Seen) -> Option<f64> {
    let (sum, count) =
        seen.speeds.iter().flatten().fold((0.0, 0), |(sum, count), it| (sum + it.0, count + it.1));
    (count > 0).then(|| 3.6 * sum / f64::from(count))
}
