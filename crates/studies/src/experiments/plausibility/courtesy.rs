//! Courtesy: how often drivers make room for those who wait for a gap.

use laneweave::Fault;

use crate::experiments::drive::{between, drive_all};
use crate::experiments::effort::Effort;
use crate::experiments::finding::Row;
use crate::experiments::traffic::{Arriving, Road, Traffic};

pub(super) fn rows(effort: &Effort) -> Result<Vec<Row>, Fault> {
    let among = |style| Traffic {
        road: Road::Own("ramps.osm"),
        styles: vec![(style, 1.0)],
        demand: Arriving::Total(4000.0),
        ..Traffic::on_motorway(3, 0.0)
    };
    let [altruistic, egoistic] = &drive_all(effort, ["altruistic", "egoistic"].map(among))?;
    Ok(vec![Row {
        what: "courtesy received before ramps (drivers who make room, per driver who waits), altruistic less egoistic".into(),
        unit: "points",
        value: between(altruistic, egoistic, |more, less| Some(more.courtesy()? - less.courtesy()?)),
        range: [0.0, f64::INFINITY],
        source: "direction only; ours",
    }])
}
