//! Weights of simulated drivers, found again by calibration: from exact observations, and from what a drone sees.

mod corrected;
mod drone;
mod exact;
mod settings;
mod shares;
#[cfg(test)]
mod tests;
mod truth;
mod variants;
mod weights;

use laneweave::Fault;
use laneweave::study::mean;

use crate::experiments::effort::Effort;
use crate::experiments::finding::{Finding, Row, csv_of, table_of};
use settings::Setting;
use shares::Share;
use variants::{OURS, VARIANTS};
use weights::{Seen, WEIGHTS};

/// For each seed of the effort: fits to exact observations, to recordings, those of all variants, those that are
/// corrected, those to two styles, and shares of styles.
const EXACT: u64 = 80;
const SEEN: u64 = 10;
const VARIED: u64 = 2;
const CORRECTED: u64 = 4;
const MIXED: u64 = 2;
const SHARED: u64 = 2;
/// Half the width of a 95 % interval in standard errors.
const HALF: f64 = 1.959_964;
/// Shares of intervals that may hold the true value.
const COVERAGE: [f64; 2] = [0.92, 0.975];
/// A share is found if it is off by no more.
const OFF: f64 = 0.03;

/// Finds weights again.
pub(crate) fn recovery(effort: &Effort) -> Result<Finding, Fault> {
    let exact = exact_rows(&exact::fits(effort, EXACT * effort.seeds)?);
    let (seen, of_variants) = (seen_rows(effort)?, varied(effort)?);
    let text = format!(
        "# Weights of simulated drivers, found again\n\n{ABOUT}\n\n{}\n{ABOUT_VARIANTS}\n\n{}",
        table_of(&[&exact[..], &seen].concat()),
        of_variants.iter().map(|it| it.text.as_str()).collect::<String>(),
    );
    let mut tables: Vec<(String, String)> = of_variants.iter().map(|it| it.table.clone()).collect();
    let rows = [exact, seen, of_variants.into_iter().flat_map(|it| it.rows).collect()].concat();
    tables.insert(0, ("recovery".into(), csv_of(&rows)));
    Ok(Finding { text, tables, rows, ..Finding::default() })
}

const ABOUT: &str = "Conservative drivers on 5 km of a motorway of two lanes at 1,000 veh/h/lane, 10 % trucks, no wish to keep to the slow \
    side. The yields of speed and of the route are one on a motorway, so they are one term with the proportion of the true weights.\n\n\
    *Observed exactly*: what each driver saw when it considered lanes, and whether it wanted a change. *Seen by a drone*: 25 frames per \
    second with errors of 10 cm; desired speeds, waiting, and the phase of decisions are unknown, the threshold is known. *With choice \
    noise*: σ = .014 and θ = 8 σ, as the drivers of the prototype had them, eleven times those of our styles. *Two styles*: one \
    aggressive driver for 7.4 conservative ones, whose weights are fitted. *Corrected*: by simulation-extrapolation, for errors of 10 cm. \
    *Shares*: of two styles with known weights among 400 drivers who are seen for about 500 s. Intervals are those of a bootstrap over \
    blocks of time.";

const ABOUT_VARIANTS: &str = "What a fit loses by each thing that no recording shows: weights as shares of the true ones, with 95 % intervals \
    of the means, and how many intervals of single fits hold the truth. A *plain logit* takes every second without the begin of a change \
    for one without a desire. A *background rate* is the chance of a desire for which nothing in the recording speaks. *Assumed* desired \
    speeds are those that are allowed. The *begin of desires* is in whole seconds; the *moment of decisions* is exact. *Ours* is the full \
    estimator.";

/// What is found of drivers whom a drone sees.
fn seen_rows(effort: &Effort) -> Result<Vec<Row>, Fault> {
    let plain = |setting: &Setting, count: u64| {
        let fits = variants::fits(setting, effort, count * effort.seeds, &[OURS])?;
        Ok::<Vec<Row>, Fault>(drone_rows(setting.name, &fits.concat()))
    };
    let mut rows = plain(&Setting::motorway(), SEEN)?;
    let noisy = Setting::noisy();
    let pairs = corrected::fits(&noisy, effort, CORRECTED * effort.seeds)?;
    rows.extend(drone_rows(noisy.name, &pairs.iter().map(|it| it.plain).collect::<Vec<Seen>>()));
    let name = format!("{}, corrected", noisy.name);
    rows.extend(drone_rows(&name, &pairs.iter().map(|it| it.corrected).collect::<Vec<Seen>>()));
    rows.extend(plain(&Setting::mixed(), MIXED)?);
    rows.extend(plain(&Setting::town(), MIXED)?);
    rows.extend(share_rows(&shares::shares(effort, SHARED * effort.seeds)?));
    Ok(rows)
}

/// What variants of the estimator find.
struct Varied {
    text: String,
    table: (String, String),
    rows: Vec<Row>,
}

fn varied(effort: &Effort) -> Result<[Varied; 2], Fault> {
    let of = |setting: Setting, file: &str| {
        let fits = variants::fits(&setting, effort, VARIED * effort.seeds, &VARIANTS)?;
        Ok::<Varied, Fault>(Varied {
            text: format!("{}, {} recordings:\n\n{}\n", setting.name, fits.len(), variants::table(&fits)),
            table: (file.to_owned(), variants::csv(&fits)),
            rows: variants::rows(setting.name, &fits),
        })
    };
    Ok([of(Setting::noisy(), "recovery_fits_with_noise")?, of(Setting::motorway(), "recovery_fits")?])
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

fn drone_rows(setting: &str, fits: &[Seen]) -> Vec<Row> {
    let mut rows = Vec::new();
    for (at, name) in WEIGHTS.iter().enumerate() {
        let shares: Vec<f64> = fits.iter().map(|it| it.shares[at]).collect();
        rows.push(Row {
            what: format!("Seen by a drone, {setting}: weight of {name}, share of the true one"),
            unit: "",
            value: mean(&shares),
            range: [0.8, 1.25],
            source: "ours",
        });
        let off: Vec<f64> = fits.iter().map(|it| it.off(at)).collect();
        let least = [0.88, 1.0];
        let what = format!("Seen by a drone, {setting}: 95 % intervals that hold the {name}");
        rows.push(coverage(what, &off, least));
    }
    let used = fits.iter().map(|it| it.changes[1] as f64 / it.changes[0].max(1) as f64);
    rows.push(Row {
        what: format!("Seen by a drone, {setting}: lane changes that are used"),
        unit: "",
        value: mean(&used.collect::<Vec<f64>>()),
        range: [0.5, 1.0],
        source: "ours",
    });
    rows
}

fn share_rows(found: &[Share]) -> Vec<Row> {
    let all = |of: fn(&Share) -> f64| found.iter().map(of).collect::<Vec<f64>>();
    let row = |what: String, unit: &'static str, values: Vec<f64>, range: [f64; 2]| Row {
        what,
        unit,
        value: mean(&values),
        range,
        source: "ours",
    };
    let any = [f64::NEG_INFINITY, f64::INFINITY];
    let is_found = |it: &Share| f64::from(u8::from((it.found - it.truth).abs() <= OFF));
    vec![
        row("Shares: time for which a driver is seen".into(), "s", all(|it| it.seconds), any),
        row("Shares: aggressive drivers, too many".into(), "", all(|it| it.found - it.truth), [-OFF, OFF]),
        row(
            format!("Shares: fits that are off by {OFF} at most"),
            "",
            found.iter().map(is_found).collect(),
            [0.9, 1.0],
        ),
    ]
}

/// The share of intervals that hold the true value, by how many standard errors each estimate is off.
fn coverage(what: String, off: &[f64], range: [f64; 2]) -> Row {
    let held: Vec<f64> = off.iter().map(|it| f64::from(u8::from(it.abs() < HALF))).collect();
    Row { what, unit: "", value: mean(&held), range, source: "95 %, as far as it can be told" }
}
