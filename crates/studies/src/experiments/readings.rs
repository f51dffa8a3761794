//! The paper's formulas as printed, beside the repaired ones: one incentive at a time, and all together.

use laneweave::Fault;
use laneweave::study::Estimate;

use crate::experiments::drive::{between, drive};
use crate::experiments::effort::Effort;
use crate::experiments::finding::{Finding, text_of};
use crate::experiments::measures::{MEASURES, Place, csv_of_measures, measured, side_by_side};
use crate::experiments::seen::Seen;
use crate::experiments::traffic::{Arriving, Change, Road, Traffic};

/// The keys of the readings, each with the name of what it reads.
const READ: [(&str, &str); 5] = [
    ("speed literal", "change.speed.reading"),
    ("route literal", "change.route.reading"),
    ("comfort literal", "change.comfort.reading"),
    ("courtesy literal", "change.courtesy.reading"),
    ("return literal", "change.returning.reading"),
];

/// The kinds of drivers, with their changes of the usual styles.
fn kinds() -> Vec<(String, Traffic)> {
    let base = Traffic::on_motorway(3, 1100.0);
    let literal = |key| Change::Named(key, "literal");
    let mut kinds = vec![("repaired".to_owned(), base.clone())];
    for (name, key) in READ {
        kinds.push((name.to_owned(), Traffic { changes: vec![literal(key)], ..base.clone() }));
    }
    let all = READ.iter().map(|(_, key)| literal(key)).collect();
    kinds.push(("all literal".to_owned(), Traffic { changes: all, ..base.clone() }));
    let paper = vec![("paper-aggressive", 1.0), ("paper-conservative", 7.4)];
    kinds.push(("the paper's styles".to_owned(), Traffic { styles: paper, ..base }));
    kinds
}

/// Where they drive, with its name.
fn places() -> [(&'static str, Road, f64); 2] {
    [
        ("Motorway with ramps at 4,000 veh/h", Road::Own("ramps.osm"), 4000.0),
        ("Town of 5 streets in each direction at 4,000 veh/h", Road::Town(5), 4000.0),
    ]
}

/// Drives all readings at all places.
pub(crate) fn readings(effort: &Effort) -> Result<Finding, Fault> {
    let kinds = kinds();
    let names: Vec<String> = kinds.iter().map(|it| it.0.clone()).collect();
    let (mut found, mut text) = (Vec::new(), String::new());
    for (place, road, demand) in places() {
        let at = |(_, it): &(String, Traffic)| Traffic {
            road: road.clone(),
            demand: Arriving::Total(demand),
            times: [300.0, 900.0],
            ..it.clone()
        };
        let runs = drive(effort, &kinds.iter().map(at).collect::<Vec<_>>())?;
        let values: Vec<Vec<Option<Estimate>>> = runs.iter().map(|it| measured(it)).collect();
        let table = side_by_side(&names, &values);
        text += &format!("\n## {place}\n\n{}\n{table}", differences(&names, &runs));
        found.push(Place { name: place.to_owned(), kinds: names.clone(), values });
    }
    let text = format!(
        "# The paper's formulas as printed, beside the repaired ones\n\n\
         The usual drivers in the repaired readings, then with one incentive in the reading as printed, then with all of them; and the paper's \
         styles, which also follow and decide as printed. {} seeds, the same arriving vehicles for all; law of the USA, where only slower drivers keep to the slow side. The \
         thresholds are those of the usual drivers, which were chosen for the repaired readings.\n{text}",
        effort.seeds
    );
    let tables = vec![("readings".into(), csv_of_measures("reading", &found))];
    Ok(Finding { text, tables, figures: Vec::new(), rows: Vec::new() })
}

/// The measures that surely differ from the repaired reading, in words.
fn differences(names: &[String], runs: &[Vec<Seen>]) -> String {
    let Some((repaired, others)) = runs.split_first() else { return String::new() };
    let line = |(name, runs): (&String, &Vec<Seen>)| {
        let differs = |measure: &crate::experiments::measures::Measure| {
            let it = between(runs, repaired, |one, other| Some((measure.of)(one)? - (measure.of)(other)?))?;
            let is_sure = it.half_width.is_finite() && it.mean.abs() > it.half_width;
            is_sure.then(|| format!("{} {}", measure.name, text_of(Some(&it))))
        };
        let all: Vec<String> = MEASURES.iter().filter_map(differs).collect();
        match &all[..] {
            [] => format!("* {name}: nothing differs surely.\n"),
            all => format!("* {name}: {}.\n", all.join("; ")),
        }
    };
    let lines: String = names[1..].iter().zip(others).map(line).collect();
    format!("Differences from the repaired reading, seed by seed, whose 95 % intervals exclude 0:\n\n{lines}")
}
