//! How recorded drivers follow, as plain data.

use laneweave_calibration::following::{FittedNumber, FollowingFit, FollowingScore, NotFitted, Wrong};
use laneweave_models::{Parameter, Style};
use serde::Serialize;

/// How recorded drivers follow. Fields are added, never renamed.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct FollowingReport {
    /// Why nothing was fitted, so that the prior style's numbers stay; none if something was.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub not_fitted: Option<&'static str>,
    /// Drivers who were seen following, or free, without anything else to react to.
    pub drivers: usize,
    /// The time of that [s].
    pub seconds: f64,
    /// The length of the stretches into which it is cut [s].
    pub stretch_s: f64,
    /// T, s₀, a and b of the car-following model, and the median speed factor.
    pub numbers: Vec<FollowingNumber>,
    /// How much of the time gap that it has a driver keeps: 0 if all seek the same one, 1 if each seeks its own.
    pub own_share: f64,
    /// The 95 % interval of that.
    pub own_share_interval: [f64; 2],
    /// Standard deviation of the logarithms of the drivers' own time gaps.
    pub time_gap_spread: f64,
    /// How well drivers are predicted who were not seen.
    pub predictions: Vec<FollowingPrediction>,
    /// Whether the search ended at a maximum.
    pub is_converged: bool,
}

/// A fitted number.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FollowingNumber {
    /// Its key in a style.
    pub name: Parameter,
    /// The estimate.
    pub estimate: f64,
    /// The 95 % interval.
    pub interval: [f64; 2],
    /// The prior style's number.
    pub prior: f64,
    /// Whether the recordings tell it.
    pub is_identified: bool,
    /// What the fitted style has: the prior's number where the recordings do not tell it.
    pub value: f64,
}

/// Mean errors of predictions of held-out drivers after some time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FollowingPrediction {
    /// That time [s].
    pub after_s: f64,
    /// Number of predictions.
    pub predictions: usize,
    /// By the numbers that were fitted to other drivers.
    pub fitted: Off,
    /// By the prior style.
    pub prior: Off,
    /// By a constant speed.
    pub constant_speed: Off,
    /// By how much less the distance is off by the fitted numbers than by a constant speed [m], with the 95 % interval.
    pub over_constant_m: f64,
    /// The interval.
    pub over_constant_interval: [f64; 2],
    /// The fitted numbers are `better`, `worse`, or `not distinguishable`.
    pub fitted_is: &'static str,
}

/// A mean error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Off {
    /// Of the distance along the lane [m].
    pub distance_m: f64,
    /// Of the speed [m/s].
    pub speed_mps: f64,
}

impl From<Wrong> for Off {
    fn from(Wrong { distance, speed }: Wrong) -> Off {
        Off { distance_m: distance, speed_mps: speed }
    }
}

impl FollowingReport {
    pub(super) fn of(following: &Result<FollowingFit, NotFitted>) -> FollowingReport {
        let fit = match following {
            Ok(fit) => fit,
            Err(why) => {
                return FollowingReport { not_fitted: Some(why.reason()), ..FollowingReport::default() };
            }
        };
        FollowingReport {
            not_fitted: None,
            drivers: fit.drivers,
            seconds: (fit.stretches as f64 * fit.length).round(),
            stretch_s: fit.length,
            numbers: fit.numbers.iter().chain([&fit.speed_factor]).map(FollowingNumber::of).collect(),
            own_share: fit.own,
            own_share_interval: fit.own_interval,
            time_gap_spread: fit.time_gap_spread,
            predictions: fit.scores.iter().map(FollowingPrediction::of).collect(),
            is_converged: fit.is_converged,
        }
    }

    /// What is known of the drivers' own time gaps, in words.
    pub(super) fn own(&self) -> String {
        let [lower, upper] = self.own_share_interval;
        format!(
            "Drivers keep {:.2} ({lower:.2} to {upper:.2}) of their own time gap; \
             these differ by {:.2} (standard deviation of logarithms).",
            self.own_share, self.time_gap_spread
        )
    }
}

impl FollowingNumber {
    fn of(it: &FittedNumber) -> FollowingNumber {
        let FittedNumber { parameter, estimate, interval, prior, is_identified, value, .. } = *it;
        FollowingNumber { name: parameter, estimate, interval, prior, is_identified, value }
    }
}

impl FollowingPrediction {
    fn of(it: &FollowingScore) -> FollowingPrediction {
        FollowingPrediction {
            after_s: it.after,
            predictions: it.count,
            fitted: it.fitted.into(),
            prior: it.prior.into(),
            constant_speed: it.constant.into(),
            over_constant_m: it.over_constant.estimate,
            over_constant_interval: it.over_constant.interval,
            fitted_is: it.over_constant.verdict(),
        }
    }
}

/// The typical style with the fitted numbers, if there are any.
pub(super) fn with_following(typical: &Style, following: &Result<FollowingFit, NotFitted>) -> Style {
    following.as_ref().map_or_else(|_| typical.clone(), |it| it.fitted(typical))
}

/// The logarithms of the drivers' own time gaps, mean and standard deviation, if these differ.
pub(super) fn own_time_gaps(fit: &FollowingFit) -> Option<[f64; 2]> {
    /// Smallest standard deviation that a style shows (ours).
    const LEAST: f64 = 0.02;
    let differ = fit.own_interval[0] > 0.0 && fit.time_gap_spread > LEAST;
    differ.then(|| [fit.numbers[0].value.ln(), fit.time_gap_spread])
}
