//! Fitted styles as files that the simulator takes.

use laneweave_calibration::Study;
use laneweave_calibration::waiting::Layout;
use laneweave_scenario::Fault;
use toml::{Table, Value};

use super::Observed;
use super::report::{ClassReport, FitReport, Spread, WeightReport};

/// A fitted style.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedStyle {
    /// Its name.
    pub name: String,
    /// Its file.
    pub text: String,
}

/// Durations and desired speeds are taken from a recording that shows at least so many (ours).
const ENOUGH: usize = 10;

/// The classes of drivers, and their styles.
pub(super) fn styles(
    observed: &Observed,
    study: &Study,
    report: &FitReport,
) -> Result<(Vec<ClassReport>, Vec<FittedStyle>), Fault> {
    let one = (vec![1.0], vec![0.0], vec![study.fit.estimates.clone()]);
    let (shares, errors, parameters) = study
        .mixture
        .as_ref()
        .map_or(one, |it| (it.shares.clone(), it.share_errors.clone(), it.parameters.clone()));
    let (mut classes, mut styles) = (Vec::new(), Vec::new());
    let layout = study.layout();
    for (number, parameters) in parameters.iter().enumerate() {
        let name = if shares.len() == 1 { "fitted".to_owned() } else { format!("fitted-{}", number + 1) };
        let (share, half) = (shares[number], 1.959_964 * errors[number]);
        let class = ClassReport {
            style: name.clone(),
            share,
            share_interval: [(share - half).max(0.0), (share + half).min(1.0)],
            theta: -parameters[layout.intercept()] - study.mean_place,
            weights: layout.slopes().map(|it| parameters[it]).collect(),
        };
        let text = text_of(observed, study, report, &class)?;
        classes.push(class);
        styles.push(FittedStyle { name, text });
    }
    Ok((classes, styles))
}

/// The style file of a class.
fn text_of(
    observed: &Observed,
    study: &Study,
    report: &FitReport,
    class: &ClassReport,
) -> Result<String, Fault> {
    let mut table = observed.prior.template.table().clone();
    table.insert("name".into(), Value::String(class.style.clone()));
    let about =
        format!("Fitted to {} lane changes of {} drivers", report.data.events_used, report.data.drivers);
    table.insert("description".into(), Value::String(about));
    if let Some(factors) = enough(report.desired_speed_factors.as_ref()) {
        table.insert("speed_factor".into(), lognormal(factors, 0.5, 2.0));
    }
    let mut change = Table::try_from(&observed.prior.typical.change)
        .map_err(|error| Fault::new(&class.style, error, "report this as a bug"))?;
    set_change(&mut change, observed, report, class);
    table.insert("change".into(), Value::Table(change));
    if let (Some(durations), Some(manner)) =
        (enough(report.durations_s.as_ref()), table.get_mut("manner").and_then(Value::as_table_mut))
    {
        manner.insert("change_duration".into(), lognormal(durations, 1.5, 15.0));
    }
    table.insert("fit".into(), Value::Table(provenance(observed, study, report)));
    let text = toml::to_string_pretty(&table)
        .map_err(|error| Fault::new(&class.style, error, "report this as a bug"))?;
    Ok(format!("{}\n{text}", header(report)))
}

fn enough(spread: Option<&Spread>) -> Option<&Spread> {
    spread.filter(|it| it.count >= ENOUGH)
}

/// A lognormal distribution as a style has it: by the mean and the deviation of the variable itself.
fn lognormal(spread: &Spread, min: f64, max: f64) -> Value {
    let variance = spread.log_deviation * spread.log_deviation;
    let mean = (spread.log_mean + 0.5 * variance).exp();
    let deviation = mean * variance.exp_m1().sqrt();
    let round = |value: f64| Value::Float((value * 1e4).round() / 1e4);
    let pairs = [
        ("distribution", Value::String("lognormal".into())),
        ("mean", round(mean)),
        ("sd", round(deviation.max(1e-4))),
        ("min", Value::Float(min)),
        ("max", Value::Float(max)),
    ];
    Value::Table(pairs.map(|(key, value)| (key.to_owned(), value)).into_iter().collect())
}

/// Writes threshold and weights, in units of the choice noise.
fn set_change(change: &mut Table, observed: &Observed, report: &FitReport, class: &ClassReport) {
    let prior = observed.weights();
    let [speed, comfort, courtesy, keeping] = [0, 1, 2, 3].map(|it| class.weights[it]);
    let route = if prior.speed > 0.0 { speed * prior.route / prior.speed } else { 0.0 };
    let numbers = [("theta", class.theta), ("sigma", 1.0)];
    numbers.into_iter().for_each(|(key, value)| {
        change.insert(key.into(), Value::Float(value));
    });
    change.insert("rule".into(), Value::String("logit".into()));
    // A driver at the last place for a change wants it, whatever else it sees (model.md §9): more than the threshold, a
    // usual choice, and what the other incentives may say against it.
    let usual: f64 = prior.terms().iter().map(|it| it.abs()).sum();
    let scale: f64 = class.weights.iter().map(|it| it.abs()).sum::<f64>() / usual.max(f64::MIN_POSITIVE);
    let urgency = class.theta.max(0.0) + 3.0 + 0.7 * scale.max(1.0);
    let weights = [
        ("speed", speed),
        ("route", route),
        ("comfort", comfort),
        ("courtesy", courtesy),
        ("keeping", keeping),
        ("urgency", urgency),
    ];
    for (name, weight) in weights {
        if let Some(row) = change.get_mut(name).and_then(Value::as_table_mut) {
            row.insert("weight".into(), Value::Float(weight));
        }
    }
    if let Some(row) = change.get_mut("comfort").and_then(Value::as_table_mut) {
        row.insert("beta".into(), Value::Float(report.beta.estimate));
    }
}

/// Where the numbers come from, with their intervals and the draws of the bootstrap.
fn provenance(observed: &Observed, study: &Study, report: &FitReport) -> Table {
    let names = observed.request.recordings.iter().map(|it| {
        let name = it.file_name().unwrap_or_default().to_string_lossy();
        Value::String(name.into_owned())
    });
    let pair = |[lower, upper]: [f64; 2]| Value::Array(vec![Value::Float(lower), Value::Float(upper)]);
    let weights = || report.weights.iter().chain([&report.theta]);
    // As in the style, the threshold is that of a place of the mean rate.
    let offset = |name: &str| if name == "theta" { study.mean_place } else { 0.0 };
    let shifted = |it: &WeightReport| pair(it.interval.map(|end| end - offset(it.name)));
    let intervals = weights().map(|it| (it.name.to_owned(), shifted(it))).collect();
    let layout: Layout = study.layout();
    let parameters: Vec<usize> = layout.slopes().chain([layout.intercept()]).collect();
    let round = |value: f64| Value::Float((value * 1e6).round() / 1e6);
    let value = |it: &Vec<f64>, at: usize| match at == layout.intercept() {
        true => -it[at] - study.mean_place,
        false => it[at],
    };
    let draw = |it: &Vec<f64>| Value::Array(parameters.iter().map(|at| round(value(it, *at))).collect());
    let of = study.weights.iter().map(|it| it.name).chain(["theta"]);
    let strings = |names: &mut dyn Iterator<Item = &str>| {
        Value::Array(names.map(|it| Value::String(it.to_owned())).collect())
    };
    let pairs = [
        ("recordings", Value::Array(names.collect())),
        ("prior", Value::String(observed.request.prior.clone())),
        ("drivers", Value::Integer(report.data.drivers as i64)),
        ("lane_changes", Value::Integer(report.data.events as i64)),
        ("lane_changes_used", Value::Integer(report.data.events_used as i64)),
        ("not_identified", strings(&mut report.data.not_identified.iter().copied())),
        ("intervals", Value::Table(intervals)),
        ("draws_of", strings(&mut of.into_iter())),
        ("draws", Value::Array(study.draws.iter().map(draw).collect())),
    ];
    pairs.map(|(key, value)| (key.to_owned(), value)).into_iter().collect()
}

/// Comments at the begin of the file.
fn header(report: &FitReport) -> String {
    let open = report.data.not_identified.join(", ");
    format!(
        "# A style fitted to recorded drivers. Weights and threshold are in units of the choice noise: sigma = 1.\n\
         # The recordings do not tell: {open}. See their intervals.\n\
         # The threshold is that of a place of the mean rate: no driver knows the places of the recordings.\n\
         # The table [fit] holds 95 % intervals, and draws of a bootstrap over drivers. The simulator reads past it.\n"
    )
}
