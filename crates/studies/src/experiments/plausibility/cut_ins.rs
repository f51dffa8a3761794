//! Cut-ins before ramps, as a drone sees them, beside recorded ones.

use laneweave::Fault;
use laneweave::maps::Law;
use laneweave::recordings::{CutIn, Drone, Matched, clean, cut_ins, lane_changes};

use crate::cut_ins::{CutInsAt, cut_ins_by_speed};
use crate::experiments::drive::{each, over};
use crate::experiments::effort::Effort;
use crate::experiments::finding::{Row, markdown};
use crate::experiments::traffic::{Arriving, Road, Traffic};

/// Frames per second and errors of positions [m], as of the recording.
const FRAMES: f64 = 5.0;
const NOISE: f64 = 0.1;

/// Cut-ins of MONA's recording of an eastern road in Munich, as `laneweave check` finds them. Quantiles as in
/// [`CutInsAt`].
struct Recorded {
    from_kmh: f64,
    gap_m: [f64; 3],
    headway_s: [f64; 3],
    inverse_ttc_per_s: [f64; 3],
    cut_ins: usize,
}

/// At low, middle and high speeds. Of so few the outer quantiles say little.
const RECORDED: [Recorded; 3] = [
    Recorded {
        from_kmh: 0.0,
        gap_m: [1.4, 2.1, 9.8],
        headway_s: [0.25, 0.63, 2.42],
        inverse_ttc_per_s: [0.071, 0.061, 0.0],
        cut_ins: 11,
    },
    Recorded {
        from_kmh: 30.0,
        gap_m: [2.7, 5.3, 17.4],
        headway_s: [0.24, 0.51, 1.49],
        inverse_ttc_per_s: [1.944, 0.312, 0.019],
        cut_ins: 34,
    },
    Recorded {
        from_kmh: 60.0,
        gap_m: [5.3, 8.5, 28.8],
        headway_s: [0.31, 0.50, 1.53],
        inverse_ttc_per_s: [0.211, 0.189, 0.019],
        cut_ins: 14,
    },
];

const MONA: &str = "MONA, an eastern road in Munich: 59 cut-ins; the range is its 95 % interval (bootstrap)";

/// What is measured of a seed's cut-ins, and what was recorded.
pub(super) struct CutIns {
    pub(super) rows: Vec<Row>,
    /// The quantiles beside the recorded ones, as Markdown.
    pub(super) table: String,
}

pub(super) fn cut_ins_beside_recorded(effort: &Effort) -> Result<CutIns, Fault> {
    let ramps = Traffic {
        road: Road::Own("ramps.osm"),
        law: Law::Germany,
        demand: Arriving::Total(4500.0),
        ..Traffic::on_motorway(3, 0.0)
    };
    let runs: Vec<Vec<CutIn>> = each(effort, &[ramps], |simulation| {
        let [warmup_steps, steps] = simulation.run_steps();
        (0..warmup_steps).for_each(|_| simulation.advance());
        let mut watch = simulation.drone_watch();
        for _ in 0..steps {
            simulation.show(&mut watch);
            simulation.advance();
        }
        let drone = Drone { noise: NOISE, seed: 1, ..Drone::exact(FRAMES) };
        let recording = clean(drone.observe(&watch.into_recording())).0;
        let matched = Matched::new(simulation.network(), &recording);
        cut_ins(&matched, &lane_changes(&matched))
    })?
    .remove(0);
    let by_speed: Vec<Vec<CutInsAt>> = runs.iter().map(|it| cut_ins_by_speed(it)).collect();
    Ok(CutIns { rows: rows(&by_speed), table: table(&cut_ins_by_speed(&runs.concat())) })
}

/// The values of the class of speed from `from` [km/h] on.
fn at(classes: &[CutInsAt], from: f64) -> Option<&CutInsAt> {
    classes.iter().find(|it| it.speed_from_kmh == from)
}

fn rows(runs: &[Vec<CutInsAt>]) -> Vec<Row> {
    let mut rows = Vec::new();
    for (from, name, [gap, headway, closing]) in [
        (30.0, "30 to 60 km/h", [[12.7, 26.6], [0.11, 0.66], [0.163, 2.74]]),
        (60.0, "60 to 90 km/h", [[19.2, 41.5], [0.27, 1.12], [0.057, 0.217]]),
    ] {
        let row = |what: &str, unit, range, of: fn(&CutInsAt) -> Option<f64>| Row {
            what: format!("{what}, followers at {name}"),
            unit,
            value: over(runs, |it| of(at(it, from)?)),
            range,
            source: MONA,
        };
        rows.push(row("gap of a cut-in, median", "m", gap, |it| Some(it.gap_m?[2])));
        rows.push(row("headway that 5 % of cut-ins are below", "s", headway, |it| Some(it.headway_s?[1])));
        rows.push(row("1/TTC that 5 % of cut-ins are above", "1/s", closing, |it| {
            Some(it.inverse_ttc_per_s?[1])
        }));
    }
    let share = |it: &Vec<CutInsAt>| {
        let [short, all] = [|it: &CutInsAt| it.ttc_below_3s, |it: &CutInsAt| it.cut_ins]
            .map(|of| it.iter().map(of).sum::<usize>());
        (all > 0).then(|| 100.0 * short as f64 / all as f64)
    };
    rows.push(Row {
        what: "cut-ins with a time to collision below 3 s".into(),
        unit: "%",
        value: over(runs, share),
        range: [0.4, 11.7],
        source: "MONA, the same road: 2 of 59; the range is its 95 % interval (Clopper, Pearson)",
    });
    rows
}

fn table(simulated: &[CutInsAt]) -> String {
    let three = |values: [f64; 3], digits: usize| values.map(|it| format!("{it:.digits$}")).join(", ");
    let cells = RECORDED.iter().flat_map(|recorded| {
        let it = at(simulated, recorded.from_kmh);
        let from = recorded.from_kmh;
        let row = |what: &str, recorded: [f64; 3], values: Option<[f64; 3]>, digits| {
            let values = values.map_or("–".into(), |it| three(it, digits));
            vec![format!("{from:.0} to {:.0}", from + 30.0), what.into(), three(recorded, digits), values]
        };
        let count = it.map_or(0, |it| it.cut_ins);
        [
            vec![
                format!("{from:.0} to {:.0}", from + 30.0),
                "cut-ins".into(),
                recorded.cut_ins.to_string(),
                count.to_string(),
            ],
            row("gap [m]", recorded.gap_m, it.and_then(|it| it.gap_m), 1),
            row("headway [s]", recorded.headway_s, it.and_then(|it| it.headway_s), 2),
            row("1/TTC [1/s]", recorded.inverse_ttc_per_s, it.and_then(|it| it.inverse_ttc_per_s), 3),
        ]
    });
    let cells: Vec<Vec<String>> = cells.collect();
    let header = ["speed [km/h]", "beyond which 1, 5 and 50 % are", "recorded", "simulated"];
    markdown(&header, &cells)
}
