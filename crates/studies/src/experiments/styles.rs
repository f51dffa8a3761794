//! What the drivers of each style do, each style alone on the road.

use laneweave::Fault;
use laneweave::study::{BarRow, Estimate, Estimated, Sheet, bars};
use laneweave::style::BUILT_IN;

use crate::experiments::drive::drive;
use crate::experiments::effort::Effort;
use crate::experiments::finding::Finding;
use crate::experiments::measures::{MEASURES, Place, csv_of_measures, measured, side_by_side};
use crate::experiments::traffic::{Arriving, Road, Traffic};

/// A place with its name.
type At = (&'static str, fn() -> Traffic);

/// Where the styles drive, each with its name and the demand [veh/h].
const PLACES: [At; 3] = [
    ("Motorway of three lanes at 1,100 veh/h/lane", || Traffic::on_motorway(3, 1100.0)),
    ("Motorway with ramps at 4,000 veh/h", || Traffic {
        road: Road::Own("ramps.osm"),
        demand: Arriving::Total(4000.0),
        ..Traffic::on_motorway(3, 0.0)
    }),
    ("Town with a motorway at 1,500 veh/h", || Traffic {
        road: Road::Own("town.osm"),
        demand: Arriving::Total(1500.0),
        ..Traffic::on_motorway(3, 0.0)
    }),
];

/// Drives every built-in style at every place.
pub(crate) fn styles(effort: &Effort) -> Result<Finding, Fault> {
    let names: Vec<String> = BUILT_IN.iter().map(|it| it.name.to_owned()).collect();
    let mut places = Vec::new();
    for (place, traffic) in PLACES {
        let of = |style: &laneweave::style::BuiltIn| Traffic { styles: vec![(style.name, 1.0)], ..traffic() };
        let runs = drive(effort, &BUILT_IN.iter().map(of).collect::<Vec<_>>())?;
        let values: Vec<Vec<Option<Estimate>>> = runs.iter().map(|it| measured(it)).collect();
        places.push(Place { name: place.to_owned(), kinds: names.clone(), values });
    }
    let tables: String = places
        .iter()
        .map(|it| format!("\n## {}\n\n{}", it.name, side_by_side(&it.kinds, &it.values)))
        .collect();
    let text = format!(
        "# What the drivers of each style do\n\n\
         Every style that comes with laneweave, alone on the road: all drivers have it, 10 % of the vehicles are trucks. Means over {} seeds \
         with 95 % intervals; law of the USA, where only slower drivers keep to the slow side. An accepted gap counts up to 200 m.\n\n\
         {}{tables}",
        effort.seeds,
        words(&places[0].kinds, &places[0].values)
    );
    let figures = vec![("styles".into(), figure(&places[0].kinds, &places[0].values))];
    Ok(Finding {
        text,
        tables: vec![("styles".into(), csv_of_measures("style", &places))],
        figures,
        rows: Vec::new(),
    })
}

/// Lane changes by style and kind.
fn figure(names: &[String], values: &[Vec<Option<Estimate>>]) -> String {
    let estimated = |it: &Option<Estimate>| {
        let it = it.as_ref().filter(|it| it.half_width.is_finite());
        let unknown = laneweave::study::Interval { lower: f64::NAN, upper: f64::NAN };
        let (value, interval) = it.map_or((f64::NAN, unknown), |it| (it.mean, it.interval()));
        Estimated { at: 0.0, value, interval }
    };
    let row = |(name, values): (&String, &Vec<Option<Estimate>>)| BarRow {
        name: name.clone(),
        values: vec![estimated(&values[0])],
    };
    let rows: Vec<BarRow> = names.iter().zip(values).map(row).collect();
    bars(Sheet::Page, ["Discretionary lane changes [1/veh-km]", "Style"], &["discretionary"], &rows).svg
}

/// Who does most and least of what, in words.
fn words(names: &[String], values: &[Vec<Option<Estimate>>]) -> String {
    let sentence = |(place, measure): (usize, &crate::experiments::measures::Measure)| {
        let known = || names.iter().zip(values).filter_map(|(name, it)| Some((name, it[place]?)));
        let most = known().max_by(|a, b| a.1.mean.total_cmp(&b.1.mean))?;
        let least = known().min_by(|a, b| a.1.mean.total_cmp(&b.1.mean))?;
        if most.1.mean == least.1.mean {
            return None;
        }
        let sure = least.1.interval().upper < most.1.interval().lower;
        let sure = if sure { "" } else { ", but their intervals overlap" };
        Some(format!("* {}: most {}, least {}{sure}.\n", measure.name, most.0, least.0))
    };
    let all: String = MEASURES.iter().enumerate().filter_map(sentence).collect();
    format!("On the motorway of three lanes:\n\n{all}")
}
