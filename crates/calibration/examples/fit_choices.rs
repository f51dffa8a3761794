//! Fits a logit, and a logit in which drivers differ, to a table of choices.
//!
//! `cargo run --example fit_choices -- choices.csv` reads a table with the columns driver, changed (1 or 0), and one
//! for each term, and prints estimates, standard errors and log-likelihoods as JSON. Both have an intercept, which
//! comes first. In the second one each driver has an intercept of its own, normal over the drivers.

use std::collections::BTreeMap;

use laneweave_calibration::waiting::{Assumptions, Design, Driver, Layout, NO_STRATUM, Spell};
use laneweave_calibration::{Choices, Prior};

/// A row of the table.
struct Row {
    driver: u64,
    changed: bool,
    terms: Vec<f64>,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("give the path of a table")?;
    let rows: Vec<Row> = std::fs::read_to_string(path)?.lines().skip(1).map(row).collect::<Result<_, _>>()?;
    let terms = rows.first().ok_or("the table is empty")?.terms.len();
    let fit = logit(&rows, terms).ok_or("the table leaves a weight open")?;
    let errors = fit.standard_errors();
    let (mixed, log_likelihood, spread) = mixed_logit(&rows, terms);
    let text = serde_json::json!({
        "logit": { "estimates": fit.estimates, "standard_errors": errors, "log_likelihood": fit.log_likelihood },
        "mixed": { "estimates": mixed, "spread": spread, "log_likelihood": log_likelihood },
    });
    print(&text)
}

fn print(text: &serde_json::Value) -> Result<(), Box<dyn std::error::Error>> {
    use std::io::Write;
    Ok(writeln!(std::io::stdout(), "{text:#}")?)
}

fn row(line: &str) -> Result<Row, Box<dyn std::error::Error>> {
    let cells: Vec<&str> = line.split(',').collect();
    let [driver, changed, terms @ ..] = &cells[..] else { return Err("a row is too short".into()) };
    let terms = terms.iter().map(|it| it.parse()).collect::<Result<_, _>>()?;
    Ok(Row { driver: driver.parse()?, changed: *changed == "1", terms })
}

fn logit(rows: &[Row], terms: usize) -> Option<laneweave_calibration::Fit> {
    let mut choices = Choices::new(terms + 1);
    for row in rows {
        let with_intercept: Vec<f64> = [1.0].into_iter().chain(row.terms.iter().copied()).collect();
        choices.push([Some(&with_intercept), None], row.changed.then_some(0), 1.0);
    }
    choices.fit(&Prior::none(terms + 1))
}

/// The estimates, the log-likelihood and the spread. Every gap is accepted, nobody waits and nothing is unexplained, so
/// that the hidden process is a logit; every row is a spell of its own.
fn mixed_logit(rows: &[Row], terms: usize) -> (Vec<f64>, f64, f64) {
    let mut design = Design { terms, nodes: 1, ..Design::default() };
    let mut by_driver: BTreeMap<u64, Vec<&Row>> = BTreeMap::new();
    rows.iter().for_each(|it| by_driver.entry(it.driver).or_default().push(it));
    for rows in by_driver.values() {
        let first = design.gaps.len();
        let mut spells = Vec::new();
        for row in rows {
            let seconds = vec![[Some(design.gaps.len() as u32), None]];
            spells.push(Spell { seconds, changed_to: row.changed.then_some(0) });
            design.values.extend(&row.terms);
            design.gaps.push([0.0; 4]);
            design.places.push([NO_STRATUM; 2]);
        }
        design.drivers.push(Driver {
            chances: vec![1.0],
            rows: first..design.gaps.len(),
            phases: vec![spells],
        });
    }
    let layout = Layout::of(&design);
    let (mut prior, mut is_fixed) = (Prior::none(layout.count()), vec![true; layout.count()]);
    for at in [layout.intercept(), layout.spread()].into_iter().chain(layout.slopes()) {
        is_fixed[at] = false;
    }
    prior.means[layout.background()] = -40.0;
    prior.means[layout.waiting()] = -40.0;
    prior.means[layout.acceptance().start] = 40.0;
    prior.means[layout.spread()] = -0.5;
    let assumptions = Assumptions { prior, is_fixed, has_spread: true };
    let fit = design.fit(&assumptions, &vec![1.0; design.drivers.len()]);
    let estimates = [layout.intercept()].into_iter().chain(layout.slopes()).map(|it| fit.estimates[it]);
    (estimates.collect(), fit.log_likelihood, fit.estimates[layout.spread()].exp())
}
