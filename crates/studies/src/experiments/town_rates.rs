//! C2, the paper's second claim: in a town the rate of lane changes against density follows the recorded one, and that
//! of MOBIL does not.

use laneweave::study::{EdieRow, Estimate, Estimated, Sheet, estimates};
use laneweave::style::Model;
use laneweave::{Fault, LaneChangeKind, Simulation};

use crate::experiments::drive::{each, over, steps};
use crate::experiments::effort::Effort;
use crate::experiments::finding::{Finding, Row, cells_of, csv_of, markdown, quoted, table_of, text_of};
use crate::experiments::traffic::{Arriving, Road, Traffic};

/// Streets of the town in each direction.
const SIZE: usize = 6;
/// Demands, from free traffic to more than the town takes [veh/h].
const DEMANDS: [f64; 5] = [2000.0, 4000.0, 6000.0, 9000.0, 14_000.0];
/// The models, with their names.
const MODELS: [(Option<Model>, &str); 4] = [
    (None, "the paper's model, repaired"),
    (Some(Model::Mobil), "MOBIL"),
    (Some(Model::Lmrs), "LMRS"),
    (Some(Model::ConstantHazard), "constant hazard"),
];
/// Ends of the classes of density [veh/km per lane].
const CLASSES: [f64; 8] = [5.0, 10.0, 15.0, 20.0, 30.0, 45.0, 70.0, 150.0];
/// A class with less traffic in a run has no rate there [veh-km].
const LEAST_KM: f64 = 10.0;
/// The recorded rate on mona_east: 132 to 138 changes on 207 veh-km, with its interval [1/veh-km].
const RECORDED: [f64; 2] = [0.53, 0.76];
const SOURCE: &str = "recorded on mona_east: .64 [.53, .76]";

/// The traffic of a run in boxes: with its discretionary changes, and with all.
struct Town {
    discretionary: Vec<EdieRow>,
    all: Vec<EdieRow>,
    /// All changes per vehicle-kilometre of the whole town.
    whole: Option<f64>,
}

impl Town {
    fn of(simulation: &mut Simulation) -> Town {
        let mut boxes = simulation.boxes();
        steps(simulation, |simulation, _| simulation.show(&mut boxes));
        let end = simulation.time_s();
        let (counts, distance) = (simulation.counts(), simulation.counters().distance);
        let changes = counts.discretionary_changes + counts.route_changes + counts.keeping_changes;
        Town {
            whole: (distance > 0.0).then(|| 1000.0 * changes as f64 / distance),
            discretionary: boxes.with_changes(end, |it| it == LaneChangeKind::Discretionary),
            all: boxes.with_changes(end, |_| true),
        }
    }
}

/// Vehicle-kilometres in a box.
fn km(row: &EdieRow) -> f64 {
    row.flow_veh_per_h * row.exposure_km_h
}

/// Changes per vehicle-kilometre in boxes whose density is in a class; `None` with too little traffic.
fn rate<'a>(boxes: impl IntoIterator<Item = &'a EdieRow>, [from, to]: [f64; 2]) -> Option<f64> {
    let is_in = |it: &&EdieRow| (from..to).contains(&it.density_veh_per_km);
    let (mut changes, mut distance) = (0.0, 0.0);
    for row in boxes.into_iter().filter(is_in) {
        changes += row.changes as f64;
        distance += km(row);
    }
    (distance >= LEAST_KM).then(|| changes / distance)
}

/// Every density.
const ALL: [f64; 2] = [0.0, f64::INFINITY];

/// Slope of changes per vehicle-kilometre against density, by least squares over boxes weighted by their traffic
/// [1/veh-km per veh/km].
fn slope(boxes: &[EdieRow]) -> Option<f64> {
    let driven = || boxes.iter().filter(|it| km(it) > 0.0);
    let weight: f64 = driven().map(km).sum();
    let mean = |of: fn(&EdieRow) -> f64| driven().map(|it| km(it) * of(it)).sum::<f64>() / weight;
    let density = mean(|it| it.density_veh_per_km);
    let rate = mean(|it| it.changes as f64 / km(it));
    let (mut product, mut square) = (0.0, 0.0);
    for row in driven() {
        let off = row.density_veh_per_km - density;
        product += km(row) * off * (row.changes as f64 / km(row) - rate);
        square += km(row) * off * off;
    }
    (square > 0.0).then(|| product / square)
}

/// What was found of a model at one demand [veh/h].
struct AtDemand {
    demand: f64,
    /// Mean density of the boxes [veh/km per lane].
    density: Option<Estimate>,
    /// All changes per vehicle-kilometre: in the boxes, and in the whole town.
    rates: [Option<Estimate>; 2],
}

/// What was found of one model.
struct OfModel {
    name: &'static str,
    by_demand: Vec<AtDemand>,
    /// By class of density: discretionary and all changes.
    by_density: Vec<(f64, Option<Estimate>, Option<Estimate>)>,
    slope: Option<Estimate>,
}

impl OfModel {
    /// Of runs by demand, and by seed.
    fn of(name: &'static str, runs: &[Vec<Town>]) -> OfModel {
        let mean_density = |it: &Town| {
            let size: f64 = it.all.iter().map(|it| it.exposure_km_h).sum();
            let vehicles = |it: &EdieRow| it.density_veh_per_km * it.exposure_km_h;
            (size > 0.0).then(|| it.all.iter().map(vehicles).sum::<f64>() / size)
        };
        let by_demand = DEMANDS.iter().zip(runs);
        let by_demand = by_demand.map(|(demand, runs)| AtDemand {
            demand: *demand,
            density: over(runs, mean_density),
            rates: [over(runs, |it| rate(&it.all, ALL)), over(runs, |it| it.whole)],
        });
        // The traffic of a seed at all demands.
        let seeds: Vec<Town> = (0..runs.first().map_or(0, Vec::len))
            .map(|seed| {
                let pooled = |boxes: fn(&Town) -> &[EdieRow]| {
                    runs.iter().flat_map(|it| boxes(&it[seed])).copied().collect()
                };
                Town { discretionary: pooled(|it| &it.discretionary), all: pooled(|it| &it.all), whole: None }
            })
            .collect();
        let classes = [0.0].into_iter().chain(CLASSES).zip(CLASSES);
        let by_density = classes.map(|(from, to)| {
            let of = |boxes: fn(&Town) -> &[EdieRow]| over(&seeds, |it| rate(boxes(it), [from, to]));
            (0.5 * (from + to), of(|it| &it.discretionary), of(|it| &it.all))
        });
        OfModel {
            name,
            by_demand: by_demand.collect(),
            by_density: by_density.collect(),
            slope: over(&seeds, |it| slope(&it.all)),
        }
    }
}

/// Simulates every model at every demand.
pub(crate) fn town_rates(effort: &Effort) -> Result<Finding, Fault> {
    let of = |model: Option<Model>, demand: f64| Traffic {
        road: Road::Town(SIZE),
        model,
        demand: Arriving::Total(demand),
        times: [600.0, 900.0],
        ..Traffic::on_motorway(1, 0.0)
    };
    let traffic: Vec<Traffic> =
        MODELS.iter().flat_map(|(model, _)| DEMANDS.map(|demand| of(*model, demand))).collect();
    let runs = each(effort, &traffic, Town::of)?;
    let models = MODELS.iter().zip(runs.chunks(DEMANDS.len()));
    let models: Vec<OfModel> = models.map(|((_, name), runs)| OfModel::of(name, runs)).collect();
    let rows: Vec<Row> = models.iter().flat_map(rows_of).collect();
    let points = |all: bool| -> Vec<(String, Vec<Estimated>)> {
        let of = |it: &OfModel| {
            let points = it.by_density.iter().filter_map(|(at, discretionary, of_all)| {
                let it = if all { of_all } else { discretionary }.as_ref()?;
                Some(Estimated { at: *at, value: it.mean, interval: it.interval() })
            });
            (it.name.to_owned(), points.collect())
        };
        models.iter().map(of).collect()
    };
    let figure = |what: &str, all: bool| {
        let labels = ["Density [veh/km per lane]", "Lane changes [1/veh-km]"];
        estimates(Sheet::Page, what, labels, &points(all)).svg
    };
    Ok(Finding {
        text: words(&models, &rows, effort),
        tables: vec![
            ("C2".into(), csv_by_density(&models)),
            ("C2_demand".into(), csv_by_demand(&models)),
            ("C2_level".into(), csv_of(&rows)),
        ],
        figures: vec![
            ("C2_all".into(), figure("All lane changes in a town", true)),
            ("C2_discretionary".into(), figure("Discretionary lane changes in a town", false)),
        ],
        rows,
    })
}

/// Where rates are measured, in words.
const WHERE: [&str; 2] = ["in the boxes", "in the whole town"];

/// The level of a model beside the recorded one, in the lightest and in the heaviest traffic.
fn rows_of(model: &OfModel) -> Vec<Row> {
    let ends = [model.by_demand.first(), model.by_demand.last()].into_iter().flatten();
    let row = |it: &AtDemand, place: usize| Row {
        what: format!("all lane changes at {:.0} veh/h {}, {}", it.demand, WHERE[place], model.name),
        unit: "1/veh-km",
        value: it.rates[place],
        range: RECORDED,
        source: SOURCE,
    };
    ends.flat_map(|it| [row(it, 0), row(it, 1)]).collect()
}

fn csv_by_density(models: &[OfModel]) -> String {
    let mut csv = String::from("model,density_veh_km_lane,changes,rate_per_veh_km,half_width,replications\n");
    for model in models {
        for (at, discretionary, all) in &model.by_density {
            for (kind, it) in [("discretionary", discretionary), ("all", all)] {
                let Some(it) = it else { continue };
                csv += &format!("{},{at},{kind},{}\n", quoted(model.name), cells_of(it));
            }
        }
    }
    csv
}

fn csv_by_demand(models: &[OfModel]) -> String {
    let mut csv = String::from(
        "model,demand_veh_h,density_veh_km_lane,where,rate_per_veh_km,half_width,replications\n",
    );
    for model in models {
        for AtDemand { demand, density, rates } in &model.by_demand {
            for (place, it) in WHERE.iter().zip(rates) {
                let (Some(density), Some(it)) = (density, it) else { continue };
                let (name, density) = (quoted(model.name), density.mean);
                csv += &format!("{name},{demand},{density},{place},{}\n", cells_of(it));
            }
        }
    }
    csv
}

/// The rates by demand and model, in the boxes or in the whole town.
fn table_by_demand(models: &[OfModel], place: usize) -> String {
    let row = |at: usize| {
        let density = text_of(models[0].by_demand[at].density.as_ref());
        let rates = models.iter().map(|it| text_of(it.by_demand[at].rates[place].as_ref()));
        [format!("{:.0}", DEMANDS[at]), density].into_iter().chain(rates).collect()
    };
    let rows: Vec<Vec<String>> = (0..DEMANDS.len()).map(row).collect();
    let names: Vec<&str> = models.iter().map(|it| it.name).collect();
    let header = [&["demand [veh/h]", "density of the first model [veh/km per lane]"], &names[..]].concat();
    markdown(&header, &rows)
}

fn words(models: &[OfModel], rows: &[Row], effort: &Effort) -> String {
    let sentence = |it: &OfModel| {
        let direction = match &it.slope {
            Some(slope) if slope.interval().lower > 0.0 => "rises with density",
            Some(slope) if slope.interval().upper < 0.0 => "falls with density",
            _ => "neither rises nor falls surely with density",
        };
        // In thousandths, so that the digits count.
        let slope =
            it.slope.map(|it| Estimate { mean: 1e3 * it.mean, half_width: 1e3 * it.half_width, ..it });
        format!(
            "* {}: the rate {direction}: slope {} · 10⁻³ 1/veh-km per veh/km.\n",
            it.name,
            text_of(slope.as_ref())
        )
    };
    let slopes: String = models.iter().map(sentence).collect();
    let tables: Vec<String> = (0..2)
        .map(|it| {
            format!(
                "All lane changes per vehicle-kilometre {}:\n\n{}\n",
                WHERE[it],
                table_by_demand(models, it)
            )
        })
        .collect();
    format!(
        "# C2: in a town the rate of lane changes follows the recorded one\n\n\
         A town of {SIZE} streets in each direction (`laneweave generate town --size {SIZE}`), 10 % trucks, {} seeds, law of the USA, where only slower drivers keep to the slow \
         side. Densities and flows are measured in boxes of all lanes side by side and a minute, by Edie's definitions. A box has at least 200 m of \
         lanes, so most boxes are on streets of two lanes; the whole town has many streets of one lane, on which nobody changes lanes.\n\n\
         {}Against the density of the boxes at all demands:\n\n{slopes}\n\
         Beside the recorded rate, which has no density of its own: mona_east is one road at one time, so only the level can be compared, and the \
         claim that the curve follows the recorded one cannot be decided with it.\n\n{}\n{}",
        effort.seeds,
        tables.concat(),
        table_of(rows),
        verdict(rows)
    )
}

/// What the levels say, in words.
fn verdict(rows: &[Row]) -> String {
    let sentence = |place: &&str| {
        let inside = |name: &str| {
            rows.iter().any(|it| it.what.ends_with(&format!("{place}, {name}")) && it.is_inside())
        };
        let found = match (inside(MODELS[0].1), inside(MODELS[1].1)) {
            (true, true) => {
                "both the paper's model and MOBIL reach the recorded level at one of these demands: the level does not separate them"
            }
            (true, false) => {
                "the paper's model reaches the recorded level at one of these demands, and MOBIL does not"
            }
            (false, true) => {
                "MOBIL reaches the recorded level at one of these demands, and the paper's model does not"
            }
            (false, false) => "neither the paper's model nor MOBIL has the recorded level at these demands",
        };
        format!("Measured {place}, {found}.\n")
    };
    let [boxes, town] = [0, 1].map(|it| sentence(&WHERE[it]));
    let warning = if rows.iter().any(|it| it.what.ends_with(MODELS[3].1) && it.is_inside()) {
        "A constant hazard reaches that level, too, so the level alone is no evidence for reasons.\n"
    } else {
        ""
    };
    format!("{boxes}{town}{warning}")
}
