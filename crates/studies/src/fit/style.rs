//! Fitted styles as files that the simulator takes.

use laneweave_calibration::Study;
use laneweave_calibration::following::FollowingFit;
use laneweave_calibration::observe::PLAIN;
use laneweave_calibration::waiting::Layout;
use laneweave_models::Parameter;
use laneweave_models::change::IncentiveName;
use laneweave_scenario::Fault;
use laneweave_study::middle_95;
use toml::{Table, Value};

use super::Observed;
use super::following::own_time_gaps;
use super::report::{ClassReport, ENOUGH, FitReport, FittedStyle, Spread, WeightReport};

/// The name of the fitted style; those of several classes have a number, too: `fitted-1`.
pub const FITTED: &str = "fitted";

/// Critical gaps of drivers lie within these [m]: those that a style may have, and no less than a fit tells apart.
const CRITICAL_GAPS: [f64; 2] = [0.5, 50.0];

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
        let name = if shares.len() == 1 { FITTED.to_owned() } else { format!("{FITTED}-{}", number + 1) };
        let (share, half) = (shares[number], 1.959_964 * errors[number]);
        let class = ClassReport {
            style: name.clone(),
            share,
            share_interval: [(share - half).max(0.0), (share + half).min(1.0)],
            theta: -parameters[layout.intercept()] - study.mean_place,
            weights: layout.slopes().map(|it| parameters[it]).collect(),
        };
        let text = text_of(observed, study, report, (number, &class))?;
        classes.push(class);
        styles.push(FittedStyle { name, text });
    }
    Ok((classes, styles))
}

/// The style file of a class with its number.
fn text_of(
    observed: &Observed,
    study: &Study,
    report: &FitReport,
    (number, class): (usize, &ClassReport),
) -> Result<String, Fault> {
    let mut table = observed.prior.template.table().clone();
    table.insert("name".into(), Value::String(class.style.clone()));
    let about =
        format!("Fitted to {} lane changes of {} drivers", report.data.events_used, report.data.drivers);
    table.insert("description".into(), Value::String(about));
    if enough(report.desired_speed_factors.as_ref()).is_some() {
        table.insert("speed_factor".into(), lognormal(report.desired_speed_logs, [0.5, 2.0]));
    }
    if let Ok(following) = &observed.following {
        set_following(&mut table, following);
    }
    let mut change =
        Table::try_from(&observed.prior.typical.change).map_err(|error| Fault::bug(&class.style, error))?;
    set_change(&mut change, observed, report, class);
    table.insert("change".into(), Value::Table(change));
    if let Some(durations) = enough(report.durations_s.as_ref()) {
        set(
            &mut table,
            "manner",
            "change_duration",
            lognormal([durations.log_mean, durations.log_deviation], [1.5, 15.0]),
        );
    }
    set(&mut table, "manner", "calm", Value::Float((report.cooldown_s * 100.0).round() / 100.0));
    if let Some(limits) = report.gap_limits {
        let numbers = [
            ("min_time_to_collision", limits.min_time_to_collision_s),
            ("max_deceleration", limits.max_deceleration_mps2),
        ];
        numbers.into_iter().for_each(|(key, it)| set(&mut table, "safety", key, Value::Float(it)));
    }
    for (logs, it) in report.gaps.critical.iter().filter_map(|it| it.logs().zip(Some(it))) {
        let key = it.name.key().trim_start_matches("safety.");
        set(&mut table, "safety", key, lognormal(logs, CRITICAL_GAPS));
    }
    table.insert("fit".into(), Value::Table(provenance(observed, study, report, number)));
    let text = toml::to_string_pretty(&table).map_err(|error| Fault::bug(&class.style, error))?;
    Ok(format!("{}\n{text}", header(report)))
}

/// Writes how drivers follow: numbers that all have, and time gaps that differ if they do.
fn set_following(table: &mut Table, following: &FollowingFit) {
    for it in &following.numbers {
        let key = it.parameter.key().trim_start_matches("follow.");
        set(table, "follow", key, Value::Float((it.value * 1e4).round() / 1e4));
    }
    if let Some(logs) = own_time_gaps(following) {
        set(table, "follow", "time_gap", lognormal(logs, [0.3, 4.0]));
    }
}

/// Sets a key of a section.
fn set(table: &mut Table, section: &str, key: &str, value: Value) {
    let section = table.entry(section.to_owned()).or_insert_with(|| Value::Table(Table::new()));
    if let Some(section) = section.as_table_mut() {
        section.insert(key.into(), value);
    }
}

fn enough(spread: Option<&Spread>) -> Option<&Spread> {
    spread.filter(|it| it.count >= ENOUGH)
}

/// A lognormal distribution as a style has it, by the mean and the deviation of the variable itself, from those of its
/// logarithm.
fn lognormal([log_mean, log_deviation]: [f64; 2], [min, max]: [f64; 2]) -> Value {
    let variance = log_deviation * log_deviation;
    let mean = (log_mean + 0.5 * variance).exp();
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
    change.insert("rule".into(), Value::String("logit".into()));
    change.insert("sigma".into(), Value::Float(1.0));
    let beta = (Parameter::ComfortBeta, report.beta.estimate);
    for (parameter, value) in numbers(observed, class.theta, &class.weights).into_iter().chain([beta]) {
        insert(change, parameter.key().trim_start_matches("change."), value);
    }
}

/// Puts a number at a path of keys, if its outer ones are there.
fn insert(table: &mut Table, path: &str, value: f64) {
    match path.split_once('.') {
        None => {
            table.insert(path.into(), Value::Float(value));
        }
        Some((key, rest)) => {
            if let Some(inner) = table.get_mut(key).and_then(Value::as_table_mut) {
                insert(inner, rest, value);
            }
        }
    }
}

/// The fitted numbers of a lane-change model; `weights` are those of its terms.
fn numbers(observed: &Observed, theta: f64, weights: &[f64]) -> Vec<(Parameter, f64)> {
    use IncentiveName::{Comfort, Courtesy, Route, Speed, Urgency};
    let prior = observed.weights();
    let [speed, comfort, courtesy] = [0, 1, 2].map(|it| weights[it]);
    let route = if prior.speed > 0.0 { speed * prior.route / prior.speed } else { 0.0 };
    // A driver at the last place for a change wants it, whatever else it sees (model.md §9): more than the threshold, a
    // usual choice, and what the other incentives may say against it.
    let usual: f64 = prior.terms().iter().map(|it| it.abs()).sum();
    let scale: f64 = weights.iter().map(|it| it.abs()).sum::<f64>() / usual.max(f64::MIN_POSITIVE);
    let urgency = theta.max(0.0) + 3.0 + 0.7 * scale.max(1.0);
    let known = [(Speed, speed), (Route, route), (Comfort, comfort), (Courtesy, courtesy)];
    let plain = PLAIN.into_iter().zip(weights[3..].iter().copied());
    let weights = known.into_iter().chain(plain).chain([(Urgency, urgency)]);
    let weights = weights.map(|(name, weight)| (Parameter::Weight(name), weight));
    [(Parameter::Theta, theta)].into_iter().chain(weights).collect()
}

/// The fitted numbers in each draw of the bootstrap, of class number `class`.
fn draws(observed: &Observed, study: &Study, class: usize) -> Vec<Vec<(Parameter, f64)>> {
    let layout: Layout = study.layout();
    let all = if study.mixture.is_some() { &study.class_draws[class] } else { &study.draws };
    let numbers_of = |it: &Vec<f64>| {
        let weights: Vec<f64> = layout.slopes().map(|at| it[at]).collect();
        numbers(observed, -it[layout.intercept()] - study.mean_place, &weights)
    };
    let following = observed.following.as_ref().map_or(&[][..], |it| &it.draws);
    let mut draws: Vec<Vec<(Parameter, f64)>> = all.iter().map(numbers_of).collect();
    for (draw, following) in draws.iter_mut().zip(following) {
        draw.extend(following_numbers(observed, following));
    }
    draws
}

/// The fitted numbers of following that are the same for all drivers, from T, s₀, a and b of a draw.
fn following_numbers(observed: &Observed, drawn: &[f64; 4]) -> Vec<(Parameter, f64)> {
    let Ok(following) = &observed.following else { return Vec::new() };
    let differs = own_time_gaps(following).is_some();
    let each = following.numbers.iter().map(|it| it.parameter).zip(*drawn);
    each.filter(|it| !(differs && it.0 == Parameter::TimeGap)).collect()
}

/// Where the numbers come from, with their intervals and the draws of the bootstrap.
fn provenance(observed: &Observed, study: &Study, report: &FitReport, class: usize) -> Table {
    let names = observed.request.recordings.iter().map(|it| {
        let name = it.file_name().unwrap_or_default().to_string_lossy();
        Value::String(name.into_owned())
    });
    let round = |value: f64| Value::Float((value * 1e6).round() / 1e6);
    let draws = draws(observed, study, class);
    let mut of = numbers(observed, 0.0, &vec![0.0; study.weights.len()]);
    of.extend(following_numbers(observed, &[0.0; 4]));
    let draw = |it: &Vec<(Parameter, f64)>| Value::Array(it.iter().map(|it| round(it.1)).collect());
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
        ("intervals", Value::Table(intervals(study, report, &draws))),
        ("draws_of", strings(&mut of.iter().map(|it| it.0.key()))),
        ("draws", Value::Array(draws.iter().map(draw).collect())),
    ];
    pairs.map(|(key, value)| (key.to_owned(), value)).into_iter().collect()
}

/// The 95 % intervals of the fitted numbers; those of several classes are known by their draws alone.
fn intervals(study: &Study, report: &FitReport, draws: &[Vec<(Parameter, f64)>]) -> Table {
    let pair = |[lower, upper]: [f64; 2]| Value::Array(vec![Value::Float(lower), Value::Float(upper)]);
    if study.mixture.is_none() {
        // As in the style, the threshold is that of a place of the mean rate.
        let offset = |name: &str| if name == "theta" { study.mean_place } else { 0.0 };
        let shifted = |it: &WeightReport| pair(it.interval.map(|end| end - offset(it.name)));
        let all = report.weights.iter().chain([&report.theta]);
        let following =
            report.following.numbers.iter().map(|it| (it.name.key().to_owned(), pair(it.interval)));
        let gaps = report.gaps.critical.iter().map(|it| (it.name.key().to_owned(), pair(it.median_interval)));
        return all.map(|it| (it.name.to_owned(), shifted(it))).chain(following).chain(gaps).collect();
    }
    let Some(first) = draws.first() else { return Table::new() };
    let of = |at: usize| {
        let all: Vec<f64> = draws.iter().map(|it| it[at].1).collect();
        pair(middle_95(&all).unwrap_or([f64::NEG_INFINITY, f64::INFINITY]))
    };
    // `theta` of `change.theta`, `speed` of `change.speed.weight`.
    let name = |key: &str| key.split('.').nth(1).unwrap_or(key).to_owned();
    first.iter().enumerate().map(|(at, (parameter, _))| (name(parameter.key()), of(at))).collect()
}

/// Comments at the begin of the file.
fn header(report: &FitReport) -> String {
    let open = report.data.not_identified.join(", ");
    format!(
        "# A style fitted to recorded drivers. Weights and threshold are in units of the choice noise: sigma = 1.\n\
         # The recordings do not tell: {open}. See their intervals.\n\
         # The threshold is that of a place of the mean rate: no driver knows the places of the recordings.\n\
         # The table [fit] holds 95 % intervals, and draws of a bootstrap over drivers.\n\
         # `laneweave run --draw-parameters` uses them.\n"
    )
}
