//! Measures of a run, for tables in which kinds of traffic stand side by side.

use laneweave::study::Estimate;

use crate::experiments::drive::over;
use crate::experiments::finding::{cells_of, markdown, quoted, text_of};
use crate::experiments::seen::Seen;

/// What was measured at one place.
pub(crate) struct Place {
    pub(crate) name: String,
    /// The kinds of traffic there.
    pub(crate) kinds: Vec<String>,
    /// By kind, all measures.
    pub(crate) values: Vec<Vec<Option<Estimate>>>,
}

/// A measure of a run.
pub(crate) struct Measure {
    /// Its column in CSV.
    pub(crate) column: &'static str,
    /// Its name with its unit.
    pub(crate) name: &'static str,
    /// Its value.
    pub(crate) of: fn(&Seen) -> Option<f64>,
}

const fn measure(column: &'static str, name: &'static str, of: fn(&Seen) -> Option<f64>) -> Measure {
    Measure { column, name, of }
}

/// All measures.
pub(crate) const MEASURES: [Measure; 14] = [
    measure("discretionary_per_veh_km", "discretionary changes [1/veh-km]", |it| {
        per_km(it, it.counts.discretionary_changes)
    }),
    measure("route_per_veh_km", "route-driven changes [1/veh-km]", |it| per_km(it, it.counts.route_changes)),
    measure("keeping_per_veh_km", "changes to the slow side [1/veh-km]", |it| {
        per_km(it, it.counts.keeping_changes)
    }),
    measure("gain_mps", "mean gain of discretionary changes [m/s]", |it| {
        it.gains.estimate().map(|it| it.mean)
    }),
    measure("gaining", "discretionary changes with a gain [%]", |it| {
        Some(100.0 * f64::from(it.gaining) / it.gains.estimate()?.replications as f64)
    }),
    measure("mean_speed_kmh", "mean speed [km/h]", |it| {
        let speeds = it.speeds.iter().flatten();
        let (sum, count) = speeds.fold((0.0, 0), |(sum, count), it| (sum + it.0, count + it.1));
        (count > 0).then(|| 3.6 * sum / f64::from(count))
    }),
    measure("time_gap_s", "mean time gap when following at about 100 km/h [s]", |it| {
        let (mut sum, mut count) = (0.0, 0.0);
        for it in it.time_gaps.values().filter_map(|it| it.estimate()) {
            sum += it.mean * it.replications as f64;
            count += it.replications as f64;
        }
        (count > 0.0).then(|| sum / count)
    }),
    measure("lead_gap_m", "median accepted lead gap [m]", |it| median(&it.gaps[0])),
    measure("lag_gap_m", "median accepted lag gap [m]", |it| median(&it.gaps[1])),
    measure("duration_s", "mean duration of a discretionary change [s]", |it| {
        let all = &it.durations[0];
        (!all.is_empty()).then(|| all.iter().sum::<f64>() / all.len() as f64)
    }),
    measure("courtesy", "drivers who make room, per driver who waits for a gap [%]", Seen::courtesy),
    measure("hard_brakings", "hard brakings [1/100 veh-km]", |it| {
        per_km(it, it.counters.hard_brakings).map(|it| 100.0 * it)
    }),
    measure("missed_turns", "missed turns [1/1,000 vehicles]", |it| {
        per_thousand(it, it.counters.missed_turns)
    }),
    measure("left_routes", "route changes [1/1,000 vehicles]", |it| {
        per_thousand(it, it.counters.route_changes)
    }),
];

fn per_km(seen: &Seen, count: u64) -> Option<f64> {
    let km = seen.veh_km();
    (km > 0.0).then(|| count as f64 / km)
}

fn per_thousand(seen: &Seen, count: u64) -> Option<f64> {
    (seen.counts.entered > 0).then(|| 1000.0 * count as f64 / seen.counts.entered as f64)
}

/// The median; `None` of nothing.
pub(crate) fn median(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied()
}

/// All measures over the seeds.
pub(crate) fn measured(runs: &[Seen]) -> Vec<Option<Estimate>> {
    MEASURES.iter().map(|it| over(runs, it.of)).collect()
}

/// A Markdown table: a row for each measure, a column for each kind of traffic.
pub(crate) fn side_by_side(names: &[String], values: &[Vec<Option<Estimate>>]) -> String {
    let header: Vec<&str> = ["measure"].into_iter().chain(names.iter().map(String::as_str)).collect();
    let row = |(place, measure): (usize, &Measure)| {
        let cells = values.iter().map(|it| match &it[place] {
            None => "–".into(),
            some => text_of(some.as_ref()),
        });
        [measure.name.to_owned()].into_iter().chain(cells).collect()
    };
    let rows: Vec<Vec<String>> = MEASURES.iter().enumerate().map(row).collect();
    markdown(&header, &rows)
}

/// The same as CSV: a row for each kind of traffic and measure; the column of the names is called `kind`.
pub(crate) fn csv_of_measures(kind: &str, places: &[Place]) -> String {
    let mut csv = format!("place,{kind},measure,mean,half_width,replications\n");
    for Place { name: place, kinds: names, values } in places {
        for (name, values) in names.iter().zip(values) {
            for (measure, it) in MEASURES.iter().zip(values) {
                let Some(it) = it else { continue };
                let value = cells_of(it);
                csv += &format!("{},{},{},{value}\n", quoted(place), quoted(name), measure.column);
            }
        }
    }
    csv
}
