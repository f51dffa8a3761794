//! C1, the paper's first claim: on a motorway, the rate of lane changes is like MOBIL's.

use laneweave::Fault;
use laneweave::maps::Law;
use laneweave::study::{Estimate, Estimated, Sheet, estimates};
use laneweave::style::Model;

use crate::experiments::drive::{between, drive, over};
use crate::experiments::effort::Effort;
use crate::experiments::finding::{Finding, Row, cells_of, csv_of, quoted, table_of};
use crate::experiments::seen::Seen;
use crate::experiments::traffic::Traffic;

/// Flows [veh/h per lane].
pub(crate) const FLOWS: [f64; 6] = [300.0, 500.0, 700.0, 1100.0, 1500.0, 1900.0];
/// The ratio is asked for up to this flow.
const UP_TO: f64 = 1500.0;
const LANES: usize = 3;
/// The models, with their names.
const MODELS: [(Option<Model>, &str); 5] = [
    (None, "the paper's model, repaired"),
    (Some(Model::Mobil), "MOBIL"),
    (Some(Model::Lmrs), "LMRS"),
    (Some(Model::ConstantHazard), "constant hazard"),
    (Some(Model::Null), "no incentives"),
];

/// Discretionary changes per vehicle-kilometre.
pub(crate) fn rate(seen: &Seen) -> Option<f64> {
    let veh_km = seen.veh_km();
    (veh_km > 0.0).then(|| seen.counts.discretionary_changes as f64 / veh_km)
}

/// The ratio of two rates.
pub(crate) fn ratio(one: &Seen, other: &Seen) -> Option<f64> {
    let [one, other] = [rate(one)?, rate(other)?];
    (other > 0.0).then_some(one / other)
}

/// The row of the ratio at a `flow` [veh/h per lane] under a `law`.
pub(crate) fn ratio_row(flow: f64, law: Law, value: Option<Estimate>) -> Row {
    let under = match law {
        Law::Germany => ", law of Germany",
        Law::UnitedStates => "",
    };
    Row {
        what: format!(
            "rate of discretionary changes divided by MOBIL's, {flow:.0} veh/h/lane on 3 lanes{under}"
        ),
        unit: "",
        value,
        range: [0.7, 1.4],
        source: "Li, Sun, Zhan, Tomizuka: “similar”; the range is ours",
    }
}

/// Drives all models at all flows, and compares.
pub(crate) fn motorway_rates(effort: &Effort) -> Result<Finding, Fault> {
    let of = |model: Option<Model>, flow: f64| Traffic { model, ..Traffic::on_motorway(LANES, flow) };
    let traffic: Vec<Traffic> =
        MODELS.iter().flat_map(|(model, _)| FLOWS.map(|flow| of(*model, flow))).collect();
    let runs = drive(effort, &traffic)?;
    let by_model: Vec<&[Vec<Seen>]> = runs.chunks(FLOWS.len()).collect();
    let mut csv = String::from("model,flow_veh_h_lane,rate_per_veh_km,half_width,replications\n");
    let mut series = Vec::new();
    for ((_, name), runs) in MODELS.iter().zip(&by_model) {
        let mut points = Vec::new();
        for (flow, runs) in FLOWS.iter().zip(*runs) {
            let Some(it) = over(runs, rate) else { continue };
            csv += &format!("{},{flow},{}\n", quoted(name), cells_of(&it));
            points.push(Estimated { at: *flow, value: it.mean, interval: it.interval() });
        }
        series.push(((*name).to_owned(), points));
    }
    let rows: Vec<Row> = FLOWS
        .iter()
        .zip(by_model[0].iter().zip(by_model[1]))
        .filter(|(flow, _)| **flow <= UP_TO)
        .map(|(flow, (ours, mobil))| ratio_row(*flow, Law::UnitedStates, between(ours, mobil, ratio)))
        .collect();
    let labels = ["Flow [veh/h per lane]", "Discretionary lane changes [1/veh-km]"];
    let figure = estimates(Sheet::Page, "Lane changes on three lanes of a motorway", labels, &series).svg;
    Ok(Finding {
        text: words(&rows, effort),
        tables: vec![("C1".into(), csv), ("C1_ratio".into(), csv_of(&rows))],
        figures: vec![("C1".into(), figure)],
        rows,
    })
}

fn words(rows: &[Row], effort: &Effort) -> String {
    let holds = rows.iter().all(Row::is_inside);
    let verdict = if holds {
        "The claim holds for these drivers: at every flow the ratio is in the range."
    } else {
        "The claim does not hold for these drivers: at some flow the ratio is outside the range."
    };
    format!(
        "# C1: on a motorway the rate of lane changes is like MOBIL's\n\n\
         Three lanes of 5 km, 120 km/h, 10 % trucks, law of the USA, where only slower drivers keep to the slow side. The drivers are the usual mixture (one aggressive \
         to 7.4 conservative ones); for the other models only the decision to change lanes is replaced. {} seeds, the same arriving \
         vehicles for all models; changes between lanes that lead to the same place.\n\n{}\n{verdict}\n",
        effort.seeds,
        table_of(rows)
    )
}
