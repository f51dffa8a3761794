//! Hard braking, and missed turns.

use laneweave::Fault;
use laneweave::maps::Law;
use laneweave::style::Model;

use crate::experiments::drive::{between, drive, drive_all, over};
use crate::experiments::effort::Effort;
use crate::experiments::finding::Row;
use crate::experiments::seen::Seen;
use crate::experiments::traffic::{Arriving, Road, Traffic};

/// The styles that come with laneweave, but the literal ones.
const STYLES: [&str; 10] = [
    "aggressive",
    "altruistic",
    "cautious",
    "conservative",
    "constant-hazard",
    "egoistic",
    "inattentive",
    "lmrs",
    "mobil",
    "mobil-european",
];

pub(super) fn rows(effort: &Effort) -> Result<Vec<Row>, Fault> {
    let on = |name, flow| Traffic {
        road: Road::Own(name),
        demand: Arriving::Total(flow),
        times: [1.0, 600.0],
        ..Traffic::on_motorway(3, 0.0)
    };
    let mut rows = Vec::new();
    for (name, flow) in [("ramps.osm", 3000.0), ("town.osm", 1500.0)] {
        let of = |style| Traffic { styles: vec![(style, 1.0)], law: Law::Germany, ..on(name, flow) };
        let runs = drive(effort, &STYLES.map(of))?;
        let hard = |seen: &Seen| Some(100.0 * seen.counters.hard_brakings as f64 / seen.veh_km());
        let worst = STYLES.iter().zip(&runs).filter_map(|(style, runs)| Some((style, over(runs, hard)?)));
        let Some((style, value)) = worst.max_by(|a, b| a.1.mean.total_cmp(&b.1.mean)) else { continue };
        rows.push(Row {
            what: format!(
                "hard brakings on {name} at {flow:.0} veh/h, law of Germany, of the style with most ({style})"
            ),
            unit: "1/100 veh-km",
            value: Some(value),
            range: [0.0, 0.5],
            source: "ours",
        });
    }
    for flow in [2000.0, 4000.0, 5500.0] {
        let times = [300.0, 900.0];
        let with = |model| Traffic { model, times, ..on("ramps.osm", flow) };
        let [mobil, ours] = &drive_all(effort, [with(Some(Model::Mobil)), with(None)])?;
        let missed =
            |seen: &Seen| 1000.0 * seen.counters.missed_turns as f64 / seen.counts.entered.max(1) as f64;
        rows.push(Row {
            what: format!(
                "missed turns of MOBIL by urgency, less the paper's model's, ramps at {flow:.0} veh/h"
            ),
            unit: "1/1,000 vehicles",
            value: between(mobil, ours, |mobil, ours| Some(missed(mobil) - missed(ours))),
            range: [f64::NEG_INFINITY, 0.0],
            source: "fair comparison; ours",
        });
    }
    Ok(rows)
}
