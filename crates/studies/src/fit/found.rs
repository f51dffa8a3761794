//! From a study to the report of its fit.

use laneweave_calibration::gaps::{GapFit, Wishes};
use laneweave_calibration::observe::Observations;
use laneweave_calibration::{DesireModel, Fitted, PaperGroup, Study};
use laneweave_scenario::Fault;

use super::Observed;
use super::accepted::{Accepted, with_limits};
use super::following::FollowingReport;
use super::gaps::GapReport;
use super::plan::Plan;
use super::prediction::{HeldOut, Predictive};
use super::report::{BetaReport, ByPaper, FitReport, Spread, WeightReport, WithLead};
use super::style::styles;

impl FitReport {
    pub(super) fn of(observed: &Observed, study: &Study) -> Result<FitReport, Fault> {
        let observations = &observed.observations;
        let layout = study.layout();
        let logistic = laneweave_calibration::waiting::logistic;
        let parameter = |at: usize| study.fit.estimates[at];
        let accepted = Accepted::of(observations);
        let gap_limits = accepted.limits(&observed.prior.typical);
        let style = with_limits(&observed.prior.typical, gap_limits.as_ref());
        let asked = observed.asked();
        let wishes = Wishes::of_study(observations, study, &asked);
        let gap_fit = GapFit::of(&wishes, &style, &asked.folds);
        let gaps = |all: &[[f64; 3]]| Spread::of(all.iter().map(|it| it[0]).collect());
        let durations = observations.changes.iter().filter_map(|it| it.duration).collect();
        let factors = observations.drivers.iter().filter(|it| it.desired.is_shown);
        let mut report = FitReport {
            data: observed.plan(),
            leads_s: observations.recordings.iter().map(|it| it.lead).collect(),
            following: FollowingReport::of(&observed.following),
            gaps: GapReport::of(&gap_fit, &observed.sources.braking_behind()),
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
            gap_limits,
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
        report.data.not_identified = not_identified(study, &report.data);
        (report.classes, report.styles) = styles(observed, study, &report)?;
        Ok(report)
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
        prior_deviation: it.prior_deviation,
        is_identified: it.is_identified,
        matters: it.matters(),
        value: it.value(),
    }
}

/// The weights; that of the route has the prior's proportion to that of speed, and is not told from it.
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
            prior_deviation: ratio * speed.prior_deviation,
            is_identified: false,
            matters: false,
            value: ratio * speed.value,
        },
    );
    weights
}

/// The names of what the recordings do not tell. A wish for the slow side that nobody has, since the law does not want
/// it, is not among them.
fn not_identified(study: &Study, plan: &Plan) -> Vec<&'static str> {
    let never_differs =
        |name: &str| plan.expected.iter().any(|it| it.name == name && it.standard_error.is_none());
    let is_hidden = |it: &Fitted| it.name == "keeping" && never_differs(it.name);
    let is_open = |it: &&Fitted| !it.is_identified && !is_hidden(it);
    let weights = study.weights.iter().chain([&study.theta]).filter(is_open);
    let beta = (!study.beta.is_identified).then_some("beta");
    let classes = study.mixture.is_none().then_some("classes");
    let always = ["route", "alpha"].into_iter();
    always.chain(weights.map(|it| it.name)).chain(beta).chain(classes).collect()
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

impl WithLead {
    pub(super) fn of(lead_s: f64, observations: &Observations, weights: &[Fitted]) -> WithLead {
        let weights = weights.iter().map(weight).collect();
        WithLead { lead_s, events_used: observations.used().count(), weights }
    }
}
