//! The capacity of an entry to a roundabout, beside the Highway Capacity Manual.

use std::collections::BTreeMap;

use laneweave::network::{ChainIndex, Position};
use laneweave::study::{Estimate, Estimated, Interval, Sheet, estimates};
use laneweave::{Event, Fault, Id, Simulation, VehicleId};

use crate::experiments::drive::{each, over};
use crate::experiments::effort::Effort;
use crate::experiments::finding::{Finding, Row, cells_of, csv_of, table_of};
use crate::experiments::traffic::{Arriving, Road, Traffic};

/// Flows that circulate before the entry [veh/h].
const CIRCULATING: [f64; 7] = [0.0, 200.0, 400.0, 600.0, 800.0, 1000.0, 1200.0];
/// A demand that keeps each lane of the entry full [veh/h].
const FULL: f64 = 1900.0;
/// The tolerance around the curves of the manual.
const TOLERANCE: f64 = 0.1;
/// Simulated time before anything is measured, and measured time [s].
const TIMES: [f64; 2] = [600.0, 3000.0];

/// Capacity a·e^(−b q) of a lane beside q passenger cars an hour that circulate.
type Curve = (f64, f64);

/// A kind of roundabouts.
struct Kind {
    lanes: usize,
    /// The smallest lanelet ids of entrances and exits, in the order of arms.
    entrances: [&'static str; 4],
    exits: [&'static str; 4],
    /// The curves of its lanes in the manuals of 2010 and 2016 (HCM 6; from memory).
    hcm_2010: &'static [Curve],
    hcm_6: &'static [Curve],
}

const KINDS: [Kind; 2] = [
    Kind {
        lanes: 1,
        entrances: ["8", "16", "24", "32"],
        exits: ["7", "15", "23", "31"],
        hcm_2010: &[(1130.0, 0.001)],
        hcm_6: &[(1380.0, 0.001_02)],
    },
    Kind {
        lanes: 2,
        entrances: ["15", "31", "47", "63"],
        exits: ["13", "29", "45", "61"],
        hcm_2010: &[(1130.0, 0.0007), (1130.0, 0.000_75)],
        hcm_6: &[(1420.0, 0.000_85), (1350.0, 0.000_92)],
    },
];

impl Kind {
    /// Traffic from the second and third arm to the first passes the entry of the fourth, where a queue never ends.
    /// From there equal parts go to the three other arms: lanes are chosen by exits, so one destination fills one lane,
    /// or lets all meet the same stream further on.
    fn traffic(&self, circulating: f64) -> Traffic {
        let [first, second, third, _] = self.exits;
        let [_, from_second, from_third, entry] = self.entrances;
        let passes = |from| ([from, first], 0.5 * circulating.max(1.0));
        let enters = |to| ([entry, to], FULL * self.lanes as f64 / 3.0);
        let entering = [first, second, third].map(enters);
        Traffic {
            road: Road::Roundabout(self.lanes),
            demand: Arriving::Between(
                [from_third, from_second].map(passes).into_iter().chain(entering).collect(),
            ),
            trucks: 0.0,
            times: TIMES,
            ..Traffic::on_motorway(1, 0.0)
        }
    }

    fn name(&self) -> &'static str {
        if self.lanes == 1 { "one lane" } else { "two lanes" }
    }
}

/// The capacity of an entry with these lanes.
fn capacity(curves: &[Curve], circulating: f64) -> f64 {
    curves.iter().map(|(most, slope)| most * (-slope * circulating).exp()).sum()
}

/// The vehicles that passed before the lanes of the entry, and that entered there [veh/h].
fn measure(simulation: &mut Simulation, entry: &str) -> [f64; 2] {
    let network = simulation.network();
    let lanes = network.entrances.iter().filter(|it| it.id == entry).flat_map(|it| &it.chains);
    let first = |chain: &ChainIndex| network.lanelet_at(Position::new(*chain, 0.0)).0.id;
    let entry: Vec<Id> = lanes.map(first).collect();
    let [warmup, measured] = simulation.run_steps();
    let mut is_of_entry: BTreeMap<VehicleId, bool> = BTreeMap::new();
    let mut counts = [0.0; 2];
    for step in 0..warmup + measured {
        for event in simulation.step() {
            match event {
                Event::Entered(it) => {
                    is_of_entry.insert(it.vehicle, entry.contains(&it.lanelet));
                }
                Event::Completed { occurrence, .. } if step >= warmup => {
                    let is_of_entry = is_of_entry.get(&occurrence.vehicle).is_some_and(|it| *it);
                    counts[usize::from(is_of_entry)] += 1.0;
                }
                _ => {}
            }
        }
    }
    counts.map(|it| 3600.0 * it / (f64::from(measured) * simulation.step_s()))
}

/// Measures entries of one and two lanes beside all flows, and compares.
pub(crate) fn roundabouts(effort: &Effort) -> Result<Finding, Fault> {
    let mut csv =
        String::from("lanes,circulating_veh_h,capacity_veh_h,half_width,replications,hcm_2010,hcm_6\n");
    let (mut rows, mut figures) = (Vec::new(), Vec::new());
    for kind in &KINDS {
        let traffic = CIRCULATING.map(|it| kind.traffic(it));
        let runs = each(effort, &traffic, |it| measure(it, kind.entrances[3]))?;
        let mut points = Vec::new();
        for runs in &runs {
            let [circulating, entering] = [0, 1].map(|of| over(runs, |it| Some(it[of])));
            let (Some(circulating), Some(entering)) = (circulating, entering) else { continue };
            let at = circulating.mean;
            let [least, most] = [kind.hcm_2010, kind.hcm_6].map(|it| capacity(it, at));
            csv += &format!("{},{at},{},{least},{most}\n", kind.lanes, cells_of(&entering));
            points.push(Estimated { at, value: entering.mean, interval: entering.interval() });
            rows.push(kind.row(at, entering, [least, most]));
        }
        figures.push((format!("roundabouts_{}", kind.lanes), kind.figure(points)));
    }
    Ok(Finding {
        text: words(&rows, effort),
        tables: vec![("roundabouts".into(), csv), ("roundabouts_range".into(), csv_of(&rows))],
        figures,
        rows,
    })
}

impl Kind {
    fn row(&self, circulating: f64, entering: Estimate, [least, most]: [f64; 2]) -> Row {
        Row {
            what: format!("capacity of an entry of {}, {circulating:.0} veh/h circulate", self.name()),
            unit: "veh/h",
            value: Some(entering),
            range: [(1.0 - TOLERANCE) * least, (1.0 + TOLERANCE) * most],
            source: "HCM 2010 to HCM 6 (m), 10 % more or less",
        }
    }

    fn figure(&self, points: Vec<Estimated>) -> String {
        let curve = |curves: &'static [Curve]| {
            let point = |number: u32| {
                let at = 65.0 * f64::from(number);
                let value = capacity(curves, at);
                Estimated { at, value, interval: Interval { lower: value, upper: value } }
            };
            (0..=20).map(point).collect::<Vec<_>>()
        };
        let series = [
            ("simulated".to_owned(), points),
            ("HCM 2010".to_owned(), curve(self.hcm_2010)),
            ("HCM 6".to_owned(), curve(self.hcm_6)),
        ];
        let labels = ["Circulating flow [veh/h]", "Capacity of the entry [veh/h]"];
        let title = format!("An entry of {} to a roundabout", self.name());
        estimates(Sheet::Page, &title, labels, &series).svg
    }
}

fn words(rows: &[Row], effort: &Effort) -> String {
    format!(
        "# The capacity of roundabouts, beside the Highway Capacity Manual\n\n\
         Cars with the usual drivers on a roundabout of four arms and one or two lanes. At one entry a queue never ends; vehicles from the \
         two arms before it circulate past it, and those that enter go to the three other arms in equal parts. {} seeds.\n\n{}",
        effort.seeds,
        table_of(rows)
    )
}
