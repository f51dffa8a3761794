//! Weights of simulated drivers, found again by calibration: from exact observations, and from what a drone sees.

mod drone;
mod exact;
#[cfg(test)]
mod tests;
mod truth;
mod variants;

use laneweave::Fault;
use laneweave::study::mean;

use crate::effort::Effort;
use crate::finding::{Finding, Row, csv_of, table_of};
use drone::{Seen, WEIGHTS};
use variants::{OURS, VARIANTS};

/// Fits to exact observations, to recordings, and those of all variants, for each seed of the effort.
const EXACT: u64 = 80;
const SEEN: u64 = 10;
const VARIED: u64 = 2;
/// Half the width of a 95 % interval in standard errors.
const HALF: f64 = 1.959_964;
/// Shares of intervals that may hold the true value.
const COVERAGE: [f64; 2] = [0.92, 0.975];

/// Finds weights again.
pub(crate) fn recovery(effort: &Effort) -> Result<Finding, Fault> {
    let mut rows = exact_rows(&exact::fits(effort, EXACT * effort.seeds)?);
    let full = variants::fits(effort, SEEN * effort.seeds, &[OURS])?;
    rows.extend(drone_rows(&full.concat()));
    let varied = variants::fits(effort, VARIED * effort.seeds, &VARIANTS)?;
    let text = format!(
        "# Weights of simulated drivers, found again\n\n\
         Conservative drivers on 5 km of a motorway of two lanes at 1,000 veh/h/lane, 10 % trucks, no law to keep to the slow side. The \
         yields of speed and of the route are one on a motorway, so they are one term with the proportion of the true weights.\n\n\
         *Observed exactly*: what each driver saw when it considered lanes, and whether it wanted a change; {} fits. *Seen by a drone*: \
         25 frames per second with errors of 10 cm; desired speeds, waiting, and the phase of decisions are unknown, the threshold is \
         known; {} fits.\n\n{}\n\
         What a fit loses by each thing that no recording shows, in {} recordings: weights as shares of the true ones, with 95 % intervals of the means, \
         and how many intervals of single fits hold the truth. A *plain logit* takes every second without the begin of a change for \
         one without a desire. A *background rate* is the chance of a desire for which nothing in the recording speaks. *Assumed* \
         desired speeds are those that are allowed. The *begin of desires* is in whole seconds; the *moment of decisions* is exact. \
         *Ours* is the full estimator. The prototype had drivers with eleven times the choice noise (σ = .014), so that small errors \
         of what they see mattered less.\n\n{}",
        EXACT * effort.seeds,
        SEEN * effort.seeds,
        table_of(&rows),
        VARIED * effort.seeds,
        variants::table(&varied)
    );
    rows.extend(variants::rows(&varied));
    Ok(Finding {
        text,
        tables: vec![("recovery".into(), csv_of(&rows)), ("recovery_fits".into(), variants::csv(&varied))],
        rows,
        ..Finding::default()
    })
}

fn exact_rows(fits: &[exact::Exact]) -> Vec<Row> {
    let mut rows = vec![Row {
        what: "Observed exactly: desires for a change".into(),
        unit: "",
        value: mean(&fits.iter().map(|it| it.desires as f64).collect::<Vec<f64>>()),
        range: [0.0, f64::INFINITY],
        source: "for information",
    }];
    for (at, name) in exact::TERMS.iter().enumerate() {
        let off = |it: &exact::Exact| (it.fit.estimates[at] - it.truth[at]) / it.fit.standard_errors()[at];
        let off: Vec<f64> = fits.iter().map(off).collect();
        rows.push(Row {
            what: format!("Observed exactly: bias of {name}"),
            unit: "standard errors",
            value: mean(&off),
            range: [-0.5, 0.5],
            source: "an unbiased estimator",
        });
        rows.push(coverage(format!("Observed exactly: 95 % intervals that hold the {name}"), &off, COVERAGE));
    }
    rows
}

fn drone_rows(fits: &[Seen]) -> Vec<Row> {
    let mut rows = Vec::new();
    for (at, name) in WEIGHTS.iter().enumerate() {
        let shares: Vec<f64> = fits.iter().map(|it| it.shares[at]).collect();
        rows.push(Row {
            what: format!("Seen by a drone: weight of {name}, share of the true one"),
            unit: "",
            value: mean(&shares),
            range: [0.8, 1.25],
            source: "ours",
        });
        let off: Vec<f64> = fits.iter().map(|it| it.off(at)).collect();
        let least = [0.88, 1.0];
        rows.push(coverage(format!("Seen by a drone: 95 % intervals that hold the {name}"), &off, least));
    }
    let used = fits.iter().map(|it| it.changes[1] as f64 / it.changes[0].max(1) as f64);
    rows.push(Row {
        what: "Seen by a drone: lane changes that are used".into(),
        unit: "",
        value: mean(&used.collect::<Vec<f64>>()),
        range: [0.5, 1.0],
        source: "ours",
    });
    rows
}

/// The share of intervals that hold the true value, by how many standard errors each estimate is off.
fn coverage(what: String, off: &[f64], range: [f64; 2]) -> Row {
    let held: Vec<f64> = off.iter().map(|it| f64::from(u8::from(it.abs() < HALF))).collect();
    Row { what, unit: "", value: mean(&held), range, source: "95 %, as far as it can be told" }
}
