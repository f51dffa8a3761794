//! How fast drivers are in bends, as one sees who watches their headings.

use std::collections::BTreeMap;

use laneweave::sim::Vehicle;
use laneweave::{Fault, Phase, Simulation, VehicleId};

use crate::experiments::drive::{each, over, steps};
use crate::experiments::effort::Effort;
use crate::experiments::finding::Row;
use crate::experiments::traffic::{Arriving, Road, Traffic};

/// A heading is compared with that of this time ago [s].
const OVER: f64 = 1.0;
/// Bends up to this radius count as tight, and up to the next as gentle [m].
const TIGHT: f64 = 100.0;
const GENTLE: f64 = 600.0;
/// The lateral acceleration that this share of the samples does not exceed.
const SHARE: f64 = 0.85;
const SOURCE: &str = "2–4 m/s² (IHSDM, m; PsyArXiv kcw2d: 3 most balanced), by style: ours";

pub(super) fn rows(effort: &Effort) -> Result<Vec<Row>, Fault> {
    let styles = [("cautious", [1.5, 3.0]), ("conservative", [2.0, 4.0]), ("aggressive", [2.0, 4.0])];
    let drives = |(style, _)| Traffic {
        road: Road::Own("town.osm"),
        styles: vec![(style, 1.0)],
        demand: Arriving::Total(600.0),
        trucks: 0.0,
        ..Traffic::on_motorway(1, 0.0)
    };
    let runs = each(effort, &styles.map(drives), watch)?;
    let tight = styles.iter().zip(&runs).map(|((style, range), runs)| Row {
        what: format!(
            "lateral acceleration of {style} drivers in bends of up to {TIGHT} m radius (85 % are below)"
        ),
        unit: "m/s²",
        value: over(runs, |it| it[0]),
        range: *range,
        source: SOURCE,
    });
    let gentle = Row {
        what: format!(
            "that of conservative drivers in bends of {TIGHT} to {GENTLE} m, as a share of that in tight ones"
        ),
        unit: "",
        value: over(&runs[1], |[tight, gentle]| Some((*gentle)? / (*tight)?)),
        range: [0.0, 1.0],
        source: "less in gentler curves (Good, Joubert 1977; IHSDM, m)",
    };
    Ok(tight.chain([gentle]).collect())
}

/// The lateral acceleration that most samples do not exceed, in tight bends and in gentle ones [m/s²].
fn watch(simulation: &mut Simulation) -> [Option<f64>; 2] {
    let mut watched = Watched::default();
    steps(simulation, |simulation, _| watched.look(simulation));
    watched.found.map(|mut it| {
        it.sort_by(f64::total_cmp);
        it.get((SHARE * it.len() as f64) as usize).copied()
    })
}

/// Lateral accelerations [m/s²] in tight bends and in gentle ones.
#[derive(Default)]
struct Watched {
    next: f64,
    /// The headings of the vehicles that kept their lanes [rad].
    headings: BTreeMap<VehicleId, f64>,
    found: [Vec<f64>; 2],
}

impl Watched {
    fn look(&mut self, simulation: &Simulation) {
        let time = simulation.time_s();
        if time < self.next {
            return;
        }
        self.next = time + OVER - 0.5 * simulation.step_s();
        let keeps_lane = |it: &Vehicle| it.driver.phase == Phase::Cruises;
        let headings: BTreeMap<VehicleId, f64> =
            simulation.views().filter(keeps_lane).map(|it| (it.id(), it.pose().heading)).collect();
        for vehicle in simulation.views() {
            let pair = self.headings.get(&vehicle.id()).zip(headings.get(&vehicle.id()));
            let Some((before, now)) = pair else { continue };
            let turn = (now - before).sin().abs().asin();
            let radius = vehicle.speed() * OVER / turn;
            let acceleration = vehicle.speed() * turn / OVER;
            if radius < TIGHT {
                self.found[0].push(acceleration);
            } else if radius < GENTLE {
                self.found[1].push(acceleration);
            }
        }
        self.headings = headings;
    }
}
