//! A fit of following: the numbers with their errors, and what the recordings leave open.

use laneweave_models::{Parameter, Style};

use super::episode::Followed;
use super::errors::Errors;
use super::maximum::Precision;
use super::numbers::{JAM_GAP, NUMBERS, with_numbers};
use super::problem::{OWN, PARAMETERS, PRIOR, Parameters, Problem};
use super::score::{FollowingScore, scores};
use super::stretch::{Stretches, length, stretches};
use crate::held_out::Folds;
use crate::observe::{USUAL_LOGS, moments};
use crate::resample::resampled_drivers;

/// A fitted number of a style.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedNumber {
    /// Which one.
    pub parameter: Parameter,
    /// The estimate.
    pub estimate: f64,
    /// Standard error of its logarithm.
    pub log_error: f64,
    /// Its 95 % interval.
    pub interval: [f64; 2],
    /// That of the prior style.
    pub prior: f64,
    /// By how much the log-likelihood falls to half and to twice the estimate, with all else fitted anew, and less by
    /// as much as drivers repeat themselves [nats].
    pub falls: [f64; 2],
    /// Whether the recordings tell it: the standard error is at most half of the prior's standard deviation, and the
    /// likelihood falls significantly on both sides.
    pub is_identified: bool,
    /// What a fitted style has: the estimate, or the prior's number if the recordings do not tell it.
    pub value: f64,
}

/// How drivers of recordings follow.
#[derive(Clone, Debug, PartialEq)]
pub struct FollowingFit {
    /// T, s₀, a and b.
    pub numbers: Vec<FittedNumber>,
    /// The desired speed: the median factor over the drivers.
    pub speed_factor: FittedNumber,
    /// How much of the time gap that it has a driver keeps, as an exponent: 0 if all drivers seek T, 1 if each seeks
    /// its own; with its 95 % interval.
    pub own: f64,
    /// The 95 % interval of `own`.
    pub own_interval: [f64; 2],
    /// Standard deviation of the logarithms of the drivers' own T.
    pub time_gap_spread: f64,
    /// Drivers who show a stretch.
    pub drivers: usize,
    /// Number of stretches.
    pub stretches: usize,
    /// The length of each [s].
    pub length: f64,
    /// How well drivers are predicted who were not seen.
    pub scores: Vec<FollowingScore>,
    /// T, s₀, a and b in each draw of a bootstrap over drivers.
    pub draws: Vec<[f64; 4]>,
    /// Whether the search ended at a maximum.
    pub is_converged: bool,
}

/// Why nothing was fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotFitted {
    /// The prior style follows by another model than IDM or IDM+.
    OtherModel,
    /// Too few drivers were seen following.
    FewDrivers,
}

impl NotFitted {
    /// Why, in words.
    pub fn reason(self) -> &'static str {
        match self {
            NotFitted::OtherModel => {
                "only IDM and IDM+ can be fitted, and the prior style follows by another model"
            }
            NotFitted::FewDrivers => "too few drivers were seen for some seconds behind one leader, or free",
        }
    }
}

/// Half the width of a 95 % interval in standard errors.
const HALF: f64 = 1.959_964;
/// Half of the 95 % point of χ² with one degree of freedom.
const SIGNIFICANT: f64 = 1.920_729;
/// Drivers that a fit needs (ours).
const ENOUGH: usize = 20;

/// Fits the numbers of `style` to `drivers`.
pub(super) fn fit(
    style: &Style,
    drivers: &[Followed],
    folds: &Folds,
    draws: u32,
) -> Result<FollowingFit, NotFitted> {
    let cut = stretches(drivers, length(drivers));
    let problem = Problem::of(style, &cut, |_| true).ok_or(NotFitted::OtherModel)?;
    let seen = cut.iter().filter(|it| !it.all.is_empty()).count();
    if seen < ENOUGH {
        return Err(NotFitted::FewDrivers);
    }
    let all: [usize; PARAMETERS] = std::array::from_fn(|it| it);
    let maximum = problem.maximum(problem.prior, &all, None).ok_or(NotFitted::FewDrivers)?;
    let errors = maximum.errors.as_ref().ok_or(NotFitted::FewDrivers)?;
    let precision = problem.precision(&maximum.at, errors).ok_or(NotFitted::FewDrivers)?;
    let mut numbers: Vec<FittedNumber> =
        (0..NUMBERS.len()).map(|at| number(&problem, &maximum.at, (errors, &precision), at)).collect();
    // What the recordings do not tell is the prior's; the others are what is best beside that.
    let free: Vec<usize> =
        all.into_iter().filter(|it| numbers.get(*it).is_none_or(|it| it.is_identified)).collect();
    let mut start = problem.prior;
    free.iter().for_each(|it| start[*it] = maximum.at[*it]);
    let used = problem.maximum(start, &free, Some(errors)).map_or(start, |it| it.at);
    numbers.iter_mut().zip(used).for_each(|(number, it)| number.value = libm::exp(it));
    let own_error = HALF * precision.covariance[(OWN, OWN)].sqrt();
    Ok(FollowingFit {
        speed_factor: speed_factor(style, &cut, problem.desired),
        own: maximum.at[OWN],
        own_interval: [maximum.at[OWN] - own_error, maximum.at[OWN] + own_error],
        time_gap_spread: time_gap_spread(&cut, &used),
        drivers: seen,
        stretches: problem.cases.len(),
        length: problem.cases.first().map_or(0.0, |it| it.stretch.period * it.stretch.length() as f64),
        scores: scores(style, drivers, &cut, maximum.at, folds),
        draws: redrawn(&used, &free, &precision, (folds.seed, draws)),
        is_converged: maximum.is_converged,
        numbers,
    })
}

/// `style` with the fitted numbers.
pub(super) fn fitted(style: &Style, fit: &FollowingFit) -> Style {
    let numbers = std::array::from_fn(|it| fit.numbers[it].value);
    Style { follow: with_numbers(style.follow, numbers), ..style.clone() }
}

/// One of the numbers at the maximum `at`.
fn number(
    problem: &Problem,
    at: &Parameters,
    (errors, precision): (&Errors, &Precision),
    which: usize,
) -> FittedNumber {
    let log_error = precision.covariance[(which, which)].sqrt();
    let others: Vec<usize> = (0..PARAMETERS).filter(|it| *it != which).collect();
    // Without the prior of the number itself: that closes by itself.
    let log = |at: &Parameters| problem.log(errors, at) + problem.penalty(at, which);
    let best = log(at);
    let falls = [-1.0, 1.0].map(|side| {
        let mut start = *at;
        start[which] += side * std::f64::consts::LN_2;
        let there = problem.maximum(start, &others, Some(errors)).map_or(start, |it| it.at);
        (best - log(&there)) / precision.excess[which]
    });
    let estimate = libm::exp(at[which]);
    let is_identified = log_error <= 0.5 * PRIOR && falls.iter().all(|it| *it > SIGNIFICANT);
    FittedNumber {
        parameter: NUMBERS[which],
        estimate,
        log_error,
        interval: interval(estimate, log_error),
        prior: libm::exp(problem.prior[which]),
        falls,
        is_identified,
        value: estimate,
    }
}

fn interval(estimate: f64, log_error: f64) -> [f64; 2] {
    [-HALF, HALF].map(|it| estimate * libm::exp(it * log_error))
}

/// The median factor of desired speeds, whose logarithms have this distribution over the drivers. Its error is that of
/// a mean of which each driver shows a part (the missing information principle; Louis 1982, J. R. Stat. Soc. B 44,
/// 226).
fn speed_factor(style: &Style, drivers: &[Stretches], distribution: (f64, f64)) -> FittedNumber {
    let (mean, deviation) = distribution;
    let variance = deviation * deviation;
    let told = |it: &Stretches| {
        let (first, second) = moments(it.shown.as_ref()?, distribution);
        Some((1.0 - (second - first * first) / variance).max(0.0))
    };
    let told: f64 = drivers.iter().filter_map(told).sum();
    let log_error = deviation / (told + USUAL_LOGS.1).sqrt();
    let prior_error = USUAL_LOGS.0 / USUAL_LOGS.1.sqrt();
    let estimate = libm::exp(mean);
    let half_or_twice = 0.5 * std::f64::consts::LN_2 * std::f64::consts::LN_2 / (log_error * log_error);
    let is_identified = log_error <= 0.5 * prior_error;
    FittedNumber {
        parameter: Parameter::SpeedFactor,
        estimate,
        log_error,
        interval: interval(estimate, log_error),
        prior: style.speed_factor,
        falls: [half_or_twice; 2],
        is_identified,
        value: if is_identified { estimate } else { style.speed_factor },
    }
}

/// The standard deviation of the logarithms of the time gaps that drivers seek.
fn time_gap_spread(drivers: &[Stretches], at: &Parameters) -> f64 {
    let jam_gap = libm::exp(at[JAM_GAP]);
    let mean = |it: &Stretches| {
        let logs: Vec<f64> = it.all.iter().filter_map(|it| it.time_gap(jam_gap)).map(libm::log).collect();
        (!logs.is_empty()).then(|| logs.iter().sum::<f64>() / logs.len() as f64)
    };
    let means: Vec<f64> = drivers.iter().filter_map(mean).collect();
    let count = means.len().max(1) as f64;
    let mean = means.iter().sum::<f64>() / count;
    let squares: f64 = means.iter().map(|it| (it - mean) * (it - mean)).sum();
    at[OWN].clamp(0.0, 1.0) * (squares / count).sqrt()
}

/// The numbers in each draw of a bootstrap over drivers: one step from the maximum (Hu, Kalbfleisch 2000). Those that
/// are not free stay.
fn redrawn(
    at: &Parameters,
    free: &[usize],
    precision: &Precision,
    (seed, count): (u64, u32),
) -> Vec<[f64; 4]> {
    let draw = |number: u32| {
        let times = resampled_drivers(precision.moves.len(), seed, number);
        let mut drawn = *at;
        for (moved, times) in precision.moves.iter().zip(&times) {
            free.iter().for_each(|it| drawn[*it] += (times - 1.0) * moved[*it]);
        }
        std::array::from_fn(|it| libm::exp(drawn[it]))
    };
    (0..count).map(draw).collect()
}
