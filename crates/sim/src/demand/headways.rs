//! Headway distributions: the times between successive arrivals in a lane (May 1990, Traffic Flow Fundamentals, chapter
//! 2; Cowan 1975).
//!
//! Every distribution keeps the mean headway t̄, which is one over the rate. Two more parameters shape it: a minimum
//! headway in seconds, which does not depend on the rate, and a spread relative to the mean.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::state::gamma;
use crate::state::normal;

/// A headway distribution.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Headways {
    /// Negative exponential, for vehicles that arrive independently: S = e^(−t/t̄).
    #[default]
    Exponential,
    /// Shifted exponential: S = e^(−(t − a)/(t̄ − a)) from a on.
    Shifted {
        /// a: minimum headway [s].
        minimum: f64,
    },
    /// Erlang: the sum of k exponential stages, S = e^(−kt/t̄) Σ_{j<k} (kt/t̄)ʲ/j!.
    Erlang {
        /// k: number of stages.
        stages: u32,
    },
    /// Pearson III: a + a gamma variable of shape K = ((t̄ − a)/sd)² and mean t̄ − a.
    PearsonIii {
        /// a: minimum headway [s].
        minimum: f64,
        /// sd/t̄: standard deviation relative to the mean.
        variation: f64,
    },
    /// Lognormal: σ² = ln(1 + (sd/t̄)²), μ = ln t̄ − σ²/2.
    Lognormal {
        /// sd/t̄: standard deviation relative to the mean.
        variation: f64,
    },
    /// Cowan's M3: followers have the headway Δ, free drivers a longer one, S = φ e^(−λ(t − Δ)), λ = φq/(1 − Δq).
    CowanM3 {
        /// Δ: headway of followers [s].
        minimum: f64,
        /// φ: share of free drivers.
        free: f64,
    },
}

/// Why a headway distribution is impossible.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum HeadwayError {
    /// The minimum headway leaves no spread.
    #[error("the shortest headway is {minimum} s, where the mean is {mean:.2} s: it must be shorter")]
    Minimum {
        /// a or Δ [s].
        minimum: f64,
        /// Mean headway of a lane [s].
        mean: f64,
    },
    /// A parameter is out of its range.
    #[error("the {key} of the headways is {value}: it must lie between {least} and {most}")]
    Parameter {
        /// Its name in this type.
        key: &'static str,
        /// Its value.
        value: f64,
        /// Its least value.
        least: f64,
        /// Its largest value.
        most: f64,
    },
}

impl Headways {
    /// Least and largest minimum headway [s].
    const MINIMA: [f64; 2] = [0.0, 3600.0];
    /// Least and largest standard deviation relative to the mean.
    const VARIATIONS: [f64; 2] = [0.05, 5.0];
    /// Fewest and most stages.
    const STAGES: [f64; 2] = [1.0, 400.0];
    /// Least and largest share of free drivers.
    const FREE: [f64; 2] = [0.01, 1.0];

    /// Minimum headway [s].
    pub fn minimum(&self) -> f64 {
        match *self {
            Headways::Exponential | Headways::Erlang { .. } | Headways::Lognormal { .. } => 0.0,
            Headways::Shifted { minimum }
            | Headways::PearsonIii { minimum, .. }
            | Headways::CowanM3 { minimum, .. } => minimum,
        }
    }

    /// Checks that the distribution is possible at rates up to `rate` [1/s].
    ///
    /// # Errors
    /// The reason why it is impossible.
    pub fn check(&self, rate: f64) -> Result<(), HeadwayError> {
        let parameters = match *self {
            Headways::Exponential | Headways::Shifted { .. } => None,
            Headways::Erlang { stages } => Some(("stages", f64::from(stages), Headways::STAGES)),
            Headways::PearsonIii { variation, .. } | Headways::Lognormal { variation } => {
                Some(("variation", variation, Headways::VARIATIONS))
            }
            Headways::CowanM3 { free, .. } => Some(("free", free, Headways::FREE)),
        };
        let minimum = ("minimum", self.minimum(), Headways::MINIMA);
        for (key, value, [least, most]) in std::iter::once(minimum).chain(parameters) {
            if !(least..=most).contains(&value) {
                return Err(HeadwayError::Parameter { key, value, least, most });
            }
        }
        let (minimum, mean) = (self.minimum(), 1.0 / rate);
        if minimum > 0.0 && minimum >= mean {
            return Err(HeadwayError::Minimum { minimum, mean });
        }
        Ok(())
    }

    /// The headway [s] that is exceeded with probability `u`, 0 < u < 1, at the arrival rate `rate` [1/s].
    pub fn exceeded(&self, u: f64, rate: f64) -> f64 {
        let mean = 1.0 / rate;
        match *self {
            Headways::Exponential => -libm::log(u) / rate,
            Headways::Shifted { minimum } => minimum - (mean - minimum) * libm::log(u),
            Headways::Erlang { stages } => {
                let k = f64::from(stages);
                gamma::exceeded(k, u) * mean / k
            }
            Headways::PearsonIii { minimum, variation } => {
                let shape = shape(mean, minimum, variation);
                minimum + gamma::exceeded(shape, u) * (mean - minimum) / shape
            }
            Headways::Lognormal { variation } => {
                let (mu, sigma) = lognormal(mean, variation);
                libm::exp(mu - sigma * normal::quantile(u))
            }
            Headways::CowanM3 { minimum, free } => {
                let beyond = if u < free { -libm::log(u / free) } else { 0.0 };
                minimum + beyond * (mean - minimum) / free
            }
        }
    }

    /// S(t): probability that a headway is longer than `t` [s] at the arrival rate `rate` [1/s].
    pub fn survival(&self, t: f64, rate: f64) -> f64 {
        let mean = 1.0 / rate;
        if t < self.minimum() || t <= 0.0 {
            return 1.0;
        }
        match *self {
            Headways::Exponential => libm::exp(-t * rate),
            Headways::Shifted { minimum } => libm::exp(-(t - minimum) / (mean - minimum)),
            Headways::Erlang { stages } => {
                let k = f64::from(stages);
                gamma::survival(k, k * t / mean)
            }
            Headways::PearsonIii { minimum, variation } => {
                let shape = shape(mean, minimum, variation);
                gamma::survival(shape, shape * (t - minimum) / (mean - minimum))
            }
            Headways::Lognormal { variation } => {
                let (mu, sigma) = lognormal(mean, variation);
                0.5 * libm::erfc((libm::log(t) - mu) / (sigma * core::f64::consts::SQRT_2))
            }
            Headways::CowanM3 { minimum, free } => free * libm::exp(-free * (t - minimum) / (mean - minimum)),
        }
    }
}

/// K = ((t̄ − a)/sd)². Without the square, a common misprint, the spread would be different.
fn shape(mean: f64, minimum: f64, variation: f64) -> f64 {
    let ratio = (mean - minimum) / (variation * mean);
    ratio * ratio
}

/// μ and σ of the logarithm.
fn lognormal(mean: f64, variation: f64) -> (f64, f64) {
    let variance = libm::log1p(variation * variation);
    (libm::log(mean) - 0.5 * variance, libm::sqrt(variance))
}
