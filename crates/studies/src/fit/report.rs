//! What a fit found, as plain data.

use laneweave_calibration::observe::Observations;
use laneweave_calibration::{DesireModel, Fitted, PaperGroup, Study};
use laneweave_scenario::Fault;
use serde::Serialize;

use super::accepted::{Accepted, GapLimits};
use super::correct::Correction;
use super::judge::Judged;
use super::plan::Plan;
use super::prediction::{HeldOut, Predictive};
use super::style::{FittedStyle, styles};
use super::{Observed, words};

/// What a fit found. Fields are added, never renamed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FitReport {
    /// What the recordings are.
    #[serde(flatten)]
    pub data: Plan,
    /// When changes begin: time before the crossing of each recording [s]; none where the paths show it.
    pub leads_s: Vec<Option<f64>>,
    /// The fitted weights in units of the choice noise.
    pub weights: Vec<WeightReport>,
    /// θ in units of the choice noise, at a place of the mean intercept.
    pub theta: WeightReport,
    /// The correction of θ and weights for errors of positions, if their size is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub correction: Option<Correction>,
    /// β of comfort.
    pub beta: BetaReport,
    /// The classes of drivers.
    pub classes: Vec<ClassReport>,
    /// How well models predict drivers who were not seen.
    pub held_out: Vec<HeldOut>,
    /// How good predictions of single seconds are.
    pub predictive: Vec<Predictive>,
    /// What the paper's procedure finds, if it was asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub by_paper: Vec<ByPaper>,
    /// The weights if changes begin at another time before the crossing.
    pub by_lead: Vec<WithLead>,
    /// Durations of changes that were seen as a whole [s].
    pub durations_s: Option<Spread>,
    /// Gaps to the new leader and to the new follower when a change begins [m].
    pub lead_gaps_m: Option<Spread>,
    /// The same to the new follower.
    pub lag_gaps_m: Option<Spread>,
    /// The limits of a gap test that accepts nearly all of these gaps, if enough were seen.
    pub gap_limits: Option<GapLimits>,
    /// Time after a change in which drivers make no other one [s].
    pub cooldown_s: f64,
    /// Desired speeds of the drivers who showed them, as factors on what limit and class allow.
    pub desired_speed_factors: Option<Spread>,
    /// Mean and standard deviation of the logarithms of the factors over all drivers: those who were held up count,
    /// too.
    pub desired_speed_logs: [f64; 2],
    /// Other numbers of the process: the chance per second of a change that nothing explains, and of giving up.
    pub background_per_s: f64,
    /// Probability per second that a driver who waits for a gap gives up.
    pub giving_up_per_s: f64,
    /// Standard deviations of the intercepts: of lanes and sides, and of distances before a fork.
    pub place_spread: [f64; 2],
    /// Whether the search ended at a maximum.
    pub is_converged: bool,
    /// What the fit is worth in the world, if that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub judged: Option<Judged>,
    /// The styles.
    #[serde(skip)]
    pub styles: Vec<FittedStyle>,
}

/// A fitted weight.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WeightReport {
    /// Its name.
    pub name: &'static str,
    /// The estimate.
    pub estimate: f64,
    /// Standard error by the information matrix.
    pub standard_error: f64,
    /// The 95 % interval.
    pub interval: [f64; 2],
    /// The prior value.
    pub prior: f64,
    /// Whether the recordings tell it.
    pub is_identified: bool,
}

/// β of comfort by its profile likelihood.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BetaReport {
    /// The value that is used: the prior's, if the recordings do not tell it.
    pub estimate: f64,
    /// The tried values that are not significantly less likely than the best.
    pub interval: [f64; 2],
    /// Whether the recordings tell it.
    pub is_identified: bool,
    /// The values that were tried, and how much less likely they are [nats].
    pub profile: Vec<[f64; 2]>,
}

/// A class of drivers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ClassReport {
    /// The name of its style.
    pub style: String,
    /// Its share of the drivers, with its 95 % interval, given the classes.
    pub share: f64,
    /// The interval.
    pub share_interval: [f64; 2],
    /// Its θ, at a place of the mean rate.
    pub theta: f64,
    /// Its weights, in the order of all weights but the route's.
    pub weights: Vec<f64>,
}

/// What the paper's procedure finds of one group of vehicles.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ByPaper {
    /// `aggressive` or `conservative`.
    pub group: &'static str,
    /// Vehicles that are used, each once.
    pub vehicles: usize,
    /// Of them, those that changed lanes.
    pub changed: usize,
    /// β; none without a maximum.
    pub beta: Option<f64>,
    /// Weights of the terms, speed with the route, with their standard errors; none without a
    /// maximum.
    pub weights: Vec<[f64; 2]>,
}

/// The names of the terms of the paper's procedure.
pub(super) fn by_paper_terms() -> Vec<&'static str> {
    // β changes no name.
    DesireModel::Mcdm { beta: 0.0 }.terms()
}

impl ByPaper {
    pub(super) fn of(group: &PaperGroup) -> ByPaper {
        let weights = |fit: &laneweave_calibration::Fit| {
            let pairs = fit.estimates.iter().zip(fit.standard_errors());
            pairs.map(|(estimate, error)| [*estimate, error]).collect()
        };
        let weights = group.fit.as_ref().map_or(Vec::new(), weights);
        let PaperGroup { name, vehicles, changed, beta, .. } = group;
        ByPaper { group: name, vehicles: *vehicles, changed: *changed, beta: *beta, weights }
    }
}

/// The weights if all changes begin so long before the crossing.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WithLead {
    /// That time [s].
    pub lead_s: f64,
    /// Lane changes that are used then.
    pub events_used: usize,
    /// The weights, with errors by the information matrix.
    pub weights: Vec<WeightReport>,
}

impl WithLead {
    pub(super) fn of(lead_s: f64, observations: &Observations, weights: &[Fitted]) -> WithLead {
        let weights = weights.iter().map(weight).collect();
        WithLead { lead_s, events_used: observations.used().count(), weights }
    }
}

/// How a quantity is spread.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// Number of values.
    pub count: usize,
    /// A quarter of the values is less.
    pub lower_quartile: f64,
    /// The median.
    pub median: f64,
    /// A quarter is more.
    pub upper_quartile: f64,
    /// Mean of the logarithms.
    pub log_mean: f64,
    /// Standard deviation of the logarithms.
    pub log_deviation: f64,
}

impl Spread {
    /// Of `values`, all above 0; `None` without any.
    pub(super) fn of(mut values: Vec<f64>) -> Option<Spread> {
        values.retain(|it| *it > 0.0 && it.is_finite());
        values.sort_by(f64::total_cmp);
        let count = values.len();
        let quantile = |share: f64| values.get(((count as f64 - 1.0) * share).round() as usize).copied();
        let (lower_quartile, median, upper_quartile) = (quantile(0.25)?, quantile(0.5)?, quantile(0.75)?);
        let logs = || values.iter().map(|it| it.ln());
        let log_mean = logs().sum::<f64>() / count as f64;
        let squares: f64 = logs().map(|it| (it - log_mean) * (it - log_mean)).sum();
        let log_deviation = (squares / count as f64).sqrt();
        Some(Spread { count, lower_quartile, median, upper_quartile, log_mean, log_deviation })
    }
}

impl FitReport {
    pub(super) fn of(observed: &Observed, study: &Study) -> Result<FitReport, Fault> {
        let observations = &observed.observations;
        let layout = study.layout();
        let logistic = laneweave_calibration::waiting::logistic;
        let parameter = |at: usize| study.fit.estimates[at];
        let accepted = Accepted::of(observations);
        let gaps = |all: &[[f64; 3]]| Spread::of(all.iter().map(|it| it[0]).collect());
        let durations = observations.changes.iter().filter_map(|it| it.duration).collect();
        let factors = observations.drivers.iter().filter(|it| it.desired.is_shown);
        let mut report = FitReport {
            data: observed.plan(),
            leads_s: observations.recordings.iter().map(|it| it.lead).collect(),
            weights: weights(observed, study),
            theta: weight(&study.theta),
            correction: None,
            beta: BetaReport {
                estimate: study.beta.beta,
                interval: study.beta.interval,
                is_identified: study.beta.is_identified,
                profile: study.beta.profile.iter().map(|(beta, log)| [*beta, *log]).collect(),
            },
            classes: Vec::new(),
            held_out: study.compared.iter().map(|it| HeldOut::of(it, observations)).collect(),
            predictive: study.compared.iter().map(|it| Predictive::of(&it.candidate)).collect(),
            by_paper: Vec::new(),
            by_lead: Vec::new(),
            durations_s: Spread::of(durations),
            lead_gaps_m: gaps(&accepted.lead),
            lag_gaps_m: gaps(&accepted.lag),
            gap_limits: accepted.limits(&observed.prior.typical),
            cooldown_s: observations.recordings.iter().map(|it| it.cooldown).fold(f64::INFINITY, f64::min),
            desired_speed_factors: Spread::of(factors.map(|it| it.desired.mean()).collect()),
            desired_speed_logs: desired_logs(observations),
            background_per_s: logistic(parameter(layout.background())),
            giving_up_per_s: logistic(parameter(layout.giving_up())),
            place_spread: [study.spread.lanes, study.spread.distances],
            is_converged: study.fit.is_converged,
            judged: None,
            styles: Vec::new(),
        };
        report.data.not_identified = not_identified(study);
        (report.classes, report.styles) = styles(observed, study, &report)?;
        Ok(report)
    }

    /// The report in words.
    pub fn to_text(&self) -> String {
        words::text_of(self)
    }
}

/// Mean and standard deviation of the logarithms of desired speeds over the drivers of all recordings.
fn desired_logs(observations: &Observations) -> [f64; 2] {
    let mut drivers = vec![0.0; observations.recordings.len()];
    observations.drivers.iter().for_each(|it| drivers[it.recording as usize] += 1.0);
    let all = drivers.iter().sum::<f64>().max(1.0);
    let of = |moment: fn([f64; 2]) -> f64| {
        let each = observations.recordings.iter().zip(&drivers);
        each.map(|(it, count)| count * moment(it.desired_logs)).sum::<f64>() / all
    };
    let mean = of(|[mean, _]| mean);
    let square = of(|[mean, deviation]| mean * mean + deviation * deviation);
    [mean, (square - mean * mean).max(0.0).sqrt()]
}

fn weight(it: &Fitted) -> WeightReport {
    WeightReport {
        name: it.name,
        estimate: it.estimate,
        standard_error: it.standard_error,
        interval: it.interval,
        prior: it.prior,
        is_identified: it.is_identified,
    }
}

/// The weights; that of the route has the prior's proportion to that of speed.
pub(super) fn weights(observed: &Observed, study: &Study) -> Vec<WeightReport> {
    let mut weights: Vec<WeightReport> = study.weights.iter().map(weight).collect();
    let prior = observed.weights();
    let ratio = if prior.speed > 0.0 { prior.route / prior.speed } else { 0.0 };
    let speed = weights[0].clone();
    weights.insert(
        1,
        WeightReport {
            name: "route",
            estimate: ratio * speed.estimate,
            standard_error: ratio * speed.standard_error,
            interval: speed.interval.map(|it| ratio * it),
            prior: prior.route,
            is_identified: false,
        },
    );
    weights
}

/// The names of what the recordings do not tell.
fn not_identified(study: &Study) -> Vec<&'static str> {
    let weights = study.weights.iter().filter(|it| !it.is_identified && it.name != "keeping");
    let beta = (!study.beta.is_identified).then_some("beta");
    let classes = study.mixture.is_none().then_some("classes");
    let always = ["route", "alpha"].into_iter();
    always.chain(weights.map(|it| it.name)).chain(beta).chain(classes).collect()
}
