//! What a fit found, as plain data.

use serde::Serialize;

use super::following::FollowingReport;
use super::gaps::GapReport;
use super::judge::report::Judged;
use super::plan::Plan;
use super::prediction::{HeldOut, Predictive};

/// Durations, gaps and desired speeds are taken from a recording that shows at least so many (ours).
pub(super) const ENOUGH: usize = 10;

/// What a fit found. Fields are added, never renamed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FitReport {
    /// What the recordings are.
    #[serde(flatten)]
    pub data: Plan,
    /// When changes begin: time before the crossing of each recording [s]; none where the paths show it.
    pub leads_s: Vec<Option<f64>>,
    /// How drivers follow.
    pub following: FollowingReport,
    /// Which gaps drivers accept.
    pub gaps: GapReport,
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
    /// The standard deviation of the prior.
    pub prior_deviation: f64,
    /// Whether the recordings tell it: its standard deviation is at most half of the prior's, and the likelihood falls
    /// significantly on both sides.
    pub is_identified: bool,
    /// Whether its interval excludes 0.
    pub matters: bool,
    /// What drives in the fitted style: the prior value, if the recordings do not tell the weight.
    pub value: f64,
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

/// A correction for errors of positions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Correction {
    /// Standard deviation of the errors along each axis [m].
    pub position_error_m: f64,
    /// The weights without the correction.
    pub uncorrected: Vec<WeightReport>,
}

/// The limits of the gap test of a style.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GapLimits {
    /// Smallest gap [m].
    pub min_gap_m: f64,
    /// Smallest time to collision [s].
    pub min_time_to_collision_s: f64,
    /// Hardest braking that a change may force [m/s²].
    pub max_deceleration_mps2: f64,
}

/// A fitted style.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedStyle {
    /// Its name.
    pub name: String,
    /// Its file.
    pub text: String,
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
