//! C3, the paper's third claim: in congestion the number of lane changes rises sharply with the weight of the route.

use laneweave::Fault;
use laneweave::study::{Estimate, Estimated, Sheet, estimates, mean};

use crate::experiments::drive::{between, drive, over};
use crate::experiments::effort::Effort;
use crate::experiments::finding::{Finding, Row, cells_of, csv_of, markdown, text_of};
use crate::experiments::seen::Seen;
use crate::experiments::traffic::{Arriving, Change, Road, Traffic};

/// Streets of the town in each direction.
const SIZE: usize = 5;
/// Demands [veh/h], with their names.
const DEMANDS: [(&str, f64); 3] = [("free", 2000.0), ("dense", 5000.0), ("jammed", 9000.0)];
/// Factors on the weight of the route.
const FACTORS: [f64; 6] = [0.0, 0.5, 1.0, 2.0, 4.0, 8.0];
/// The places of ×1 and ×4 among them.
const USUAL: usize = 2;
const STRONG: usize = 4;
/// The readings of the route yield.
const READINGS: [&str; 3] = ["repaired", "separate", "literal"];
/// A rise is sharp if ×4 brings at least so many times the changes of ×1. Ours.
const SHARP: f64 = 1.5;

/// A count per vehicle, with its name.
struct Measure {
    name: &'static str,
    of: fn(&Seen) -> f64,
}

/// What is counted.
const MEASURES: [Measure; 4] = [
    Measure { name: "lane changes", of: |it| discretionary(it) + route_driven(it) + keeping(it) },
    Measure { name: "discretionary lane changes", of: discretionary },
    Measure { name: "route-driven lane changes", of: route_driven },
    Measure { name: "route changes", of: |it| it.counters.route_changes as f64 },
];

fn discretionary(seen: &Seen) -> f64 {
    seen.counts.discretionary_changes as f64
}

fn route_driven(seen: &Seen) -> f64 {
    seen.counts.route_changes as f64
}

fn keeping(seen: &Seen) -> f64 {
    seen.counts.keeping_changes as f64
}

impl Measure {
    /// Per vehicle-kilometre.
    fn per_km(&self, seen: &Seen) -> Option<f64> {
        let km = seen.veh_km();
        (km > 0.0).then(|| (self.of)(seen) / km)
    }
}

/// The runs of one reading at one demand: by factor, and by seed.
struct Case<'a> {
    reading: &'static str,
    name: &'static str,
    demand: f64,
    runs: &'a [Vec<Seen>],
}

impl Case<'_> {
    /// Slope of a measure against the factor on the weight, seed by seed [1/veh-km].
    fn slope(&self, measure: &Measure) -> Option<Estimate> {
        let seeds = self.runs.iter().map(Vec::len).min().unwrap_or(0);
        let of_seed = |seed: usize| {
            let points = FACTORS.iter().zip(self.runs);
            let points: Option<Vec<(f64, f64)>> =
                points.map(|(factor, runs)| Some((*factor, measure.per_km(&runs[seed])?))).collect();
            Some(line(&points?))
        };
        mean(&(0..seeds).filter_map(of_seed).collect::<Vec<f64>>())
    }

    /// How many times the lane changes of the usual weight there are with four times that weight.
    fn rise(&self) -> Option<Estimate> {
        between(&self.runs[USUAL], &self.runs[STRONG], |usual, strong| {
            let [usual, strong] = [usual, strong].map(|it| MEASURES[0].per_km(it));
            usual.filter(|it| *it > 0.0).and_then(|it| Some(strong? / it))
        })
    }

    /// Of what ×4 brings beyond ×1, the part of the discretionary and of the route-driven changes [1/veh-km].
    fn parts(&self) -> [Option<Estimate>; 2] {
        [1, 2].map(|place| {
            between(&self.runs[USUAL], &self.runs[STRONG], |usual, strong| {
                Some(MEASURES[place].per_km(strong)? - MEASURES[place].per_km(usual)?)
            })
        })
    }

    fn is_sharp(&self) -> bool {
        self.rise().is_some_and(|it| it.interval().lower > 1.0 && it.mean >= SHARP)
    }

    fn words(&self) -> String {
        let [discretionary, route_driven] = self.parts();
        let rise = self.rise();
        let direction = match &rise {
            Some(_) if self.is_sharp() => "rise sharply",
            Some(it) if it.interval().lower > 1.0 => "rise",
            Some(it) if it.interval().upper < 1.0 => "fall",
            _ => "neither rise nor fall surely",
        };
        format!(
            "* {} ({:.0} veh/h), {}: lane changes {direction}. ×4 has {} times the changes of ×1. Of the difference, {} 1/veh-km are \
             discretionary (speed), {} route-driven (route choice).\n",
            self.name,
            self.demand,
            self.reading,
            text_of(rise.as_ref()),
            text_of(discretionary.as_ref()),
            text_of(route_driven.as_ref())
        )
    }
}

/// Slope of the line through points by least squares.
fn line(points: &[(f64, f64)]) -> f64 {
    let count = points.len() as f64;
    let x = points.iter().map(|it| it.0).sum::<f64>() / count;
    let y = points.iter().map(|it| it.1).sum::<f64>() / count;
    let product: f64 = points.iter().map(|it| (it.0 - x) * (it.1 - y)).sum();
    product / points.iter().map(|it| (it.0 - x) * (it.0 - x)).sum::<f64>()
}

/// Drives all weights at all demands in all readings, and compares.
pub(crate) fn route_weights(effort: &Effort) -> Result<Finding, Fault> {
    let mut traffic = Vec::new();
    for reading in READINGS {
        for (_, demand) in DEMANDS {
            traffic.extend(FACTORS.map(|factor| Traffic {
                road: Road::Town(SIZE),
                demand: Arriving::Total(demand),
                changes: vec![
                    Change::Named("change.route.reading", reading),
                    Change::Times("change.route.weight", factor),
                ],
                times: [600.0, 900.0],
                ..Traffic::on_motorway(1, 0.0)
            }));
        }
    }
    let runs = drive(effort, &traffic)?;
    let kinds = READINGS.iter().flat_map(|reading| DEMANDS.map(|(name, demand)| (*reading, name, demand)));
    let cases: Vec<Case> = kinds
        .zip(runs.chunks(FACTORS.len()))
        .map(|((reading, name, demand), runs)| Case { reading, name, demand, runs })
        .collect();
    let rows: Vec<Row> = cases.iter().filter(|it| it.name == "jammed").map(row).collect();
    let figures = READINGS.iter().map(|it| (format!("C3_{it}"), figure(&cases, it))).collect();
    Ok(Finding {
        text: words(&cases, effort),
        tables: vec![
            ("C3".into(), csv(&cases)),
            ("C3_slopes".into(), csv_of_slopes(&cases)),
            ("C3_rise".into(), csv_of(&rows)),
        ],
        figures,
        rows,
    })
}

fn row(case: &Case) -> Row {
    Row {
        what: format!(
            "lane changes with four times the weight of the route ÷ the usual, jammed, {}",
            case.reading
        ),
        unit: "",
        value: case.rise(),
        range: [SHARP, f64::INFINITY],
        source: "Li, Sun, Zhan, Tomizuka: “rises sharply”; the range is ours",
    }
}

/// Lane changes against the factor, by demand, and route changes.
fn figure(cases: &[Case], reading: &str) -> String {
    let of = |case: &Case, measure: &Measure| -> Vec<Estimated> {
        let points = FACTORS.iter().zip(case.runs);
        let points = points.filter_map(|(at, runs)| {
            let it = over(runs, |it| measure.per_km(it))?;
            Some(Estimated { at: *at, value: it.mean, interval: it.interval() })
        });
        points.collect()
    };
    let mut series = Vec::new();
    for case in cases.iter().filter(|it| it.reading == reading) {
        for measure in &MEASURES[1..3] {
            series.push((format!("{}, {}", measure.name, case.name), of(case, measure)));
        }
    }
    let labels = ["Factor on the weight of the route", "Lane changes [1/veh-km]"];
    estimates(
        Sheet::Page,
        &format!("Lane changes against the weight of the route, {reading}"),
        labels,
        &series,
    )
    .svg
}

fn csv(cases: &[Case]) -> String {
    let mut csv =
        String::from("reading,demand,demand_veh_h,factor,measure,per_veh_km,half_width,replications\n");
    for Case { reading, name, demand, runs } in cases {
        for (factor, runs) in FACTORS.iter().zip(*runs) {
            for measure in &MEASURES {
                let Some(it) = over(runs, |it| measure.per_km(it)) else { continue };
                let value = cells_of(&it);
                csv += &format!("{reading},{name},{demand},{factor},{},{value}\n", measure.name);
            }
        }
    }
    csv
}

fn csv_of_slopes(cases: &[Case]) -> String {
    let mut csv = String::from("reading,demand,measure,slope_per_veh_km,half_width,replications\n");
    for case in cases {
        for measure in &MEASURES {
            let Some(it) = case.slope(measure) else { continue };
            let value = cells_of(&it);
            csv += &format!("{},{},{},{value}\n", case.reading, case.name, measure.name);
        }
    }
    csv
}

fn words(cases: &[Case], effort: &Effort) -> String {
    let slopes: Vec<Vec<String>> = cases
        .iter()
        .map(|case| {
            let slopes = MEASURES.iter().map(|it| text_of(case.slope(it).as_ref()));
            let place = [case.reading.to_owned(), format!("{}, {:.0} veh/h", case.name, case.demand)];
            place.into_iter().chain(slopes).collect()
        })
        .collect();
    let names = MEASURES.map(|it| it.name);
    let header = [&["reading", "demand"], &names[..]].concat();
    let sentences: String = cases.iter().map(Case::words).collect();
    let verdict = |reading: &str| {
        let sharp =
            |name: &str| cases.iter().any(|it| it.reading == reading && it.name == name && it.is_sharp());
        let holds = match (sharp("jammed"), sharp("free")) {
            (true, false) => "holds: the rise is sharp in congestion, and not in free traffic",
            (true, true) => "holds in part: the rise is sharp in congestion, but in free traffic, too",
            (false, _) => "does not hold: the rise in congestion is not sharp",
        };
        format!("In the {reading} reading the paper's sentence {holds}.\n")
    };
    let verdicts: String = READINGS.iter().map(|it| verdict(it)).collect();
    format!(
        "# C3: in congestion the number of lane changes rises sharply with the weight of the route\n\n\
         A town of {SIZE} streets in each direction (`laneweave generate town --size {SIZE}`), the usual drivers, 10 % trucks, {} seeds; the \
         weight of the route is that of each style times 0, 0.5, 1, 2, 4 and 8. Sharp means that ×4 has at least {SHARP} times the changes of ×1, \
         with an interval above 1; that is ours.\n\n{verdicts}\n{sentences}\n\
         Slopes of counts per vehicle-kilometre against the factor:\n\n{}",
        effort.seeds,
        markdown(&header, &slopes)
    )
}
