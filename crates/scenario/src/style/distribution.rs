//! How a parameter is distributed over the drivers of a style. Drawn by inverse transform, one uniform number each.

use serde::Deserialize;

use laneweave_sim::normal_quantile;

/// A distribution as a style file has it: `{ distribution = "normal", mean = 1.0, sd = 0.1, min = 0.7, max = 1.3 }`.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(tag = "distribution", rename_all = "lowercase", deny_unknown_fields)]
pub enum Distribution {
    /// Normal with mean and standard deviation; what lies beyond `min` and `max` becomes the limit.
    Normal {
        /// Mean before clipping.
        mean: f64,
        /// Standard deviation before clipping.
        sd: f64,
        /// Least value.
        min: Option<f64>,
        /// Largest value.
        max: Option<f64>,
    },
    /// Uniform from `low` to `high`.
    Uniform {
        /// Least value.
        low: f64,
        /// Largest value.
        high: f64,
        /// Least value kept.
        min: Option<f64>,
        /// Largest value kept.
        max: Option<f64>,
    },
    /// Lognormal; mean and standard deviation are those of the variable, not of its logarithm.
    Lognormal {
        /// Mean before clipping.
        mean: f64,
        /// Standard deviation before clipping.
        sd: f64,
        /// Least value.
        min: Option<f64>,
        /// Largest value.
        max: Option<f64>,
    },
}

impl Distribution {
    /// The value below which the share `p` of drivers lies, 0 < p < 1.
    pub fn value(&self, p: f64) -> f64 {
        let value = match *self {
            Distribution::Normal { mean, sd, .. } => mean + sd * normal_quantile(p),
            Distribution::Uniform { low, high, .. } => low + p * (high - low),
            Distribution::Lognormal { mean, sd, .. } => {
                let variance = libm::log1p((sd / mean) * (sd / mean));
                libm::exp(libm::log(mean) - 0.5 * variance + libm::sqrt(variance) * normal_quantile(p))
            }
        };
        let (least, largest) = self.clipping();
        value.max(least).min(largest)
    }

    /// The middle value: half of the drivers lie below.
    pub fn median(&self) -> f64 {
        self.value(0.5)
    }

    /// Least and largest value that can occur.
    pub fn support(&self) -> (f64, f64) {
        let (from, to) = match *self {
            Distribution::Normal { mean, sd: 0.0, .. } | Distribution::Lognormal { mean, sd: 0.0, .. } => {
                (mean, mean)
            }
            Distribution::Normal { .. } => (f64::NEG_INFINITY, f64::INFINITY),
            Distribution::Uniform { low, high, .. } => (low, high),
            Distribution::Lognormal { .. } => (0.0, f64::INFINITY),
        };
        let (least, largest) = self.clipping();
        (from.max(least), to.min(largest))
    }

    /// What does not make sense about its numbers, and the remedy.
    pub fn flaw(&self) -> Option<(String, &'static str)> {
        let (least, largest) = self.clipping();
        let numbers = match *self {
            Distribution::Normal { mean, sd, .. } | Distribution::Lognormal { mean, sd, .. } => [mean, sd],
            Distribution::Uniform { low, high, .. } => [low, high],
        };
        if !numbers.iter().all(|it| it.is_finite()) || least.is_nan() || largest.is_nan() {
            return Some(("a distribution with a number that is not finite".into(), "give finite numbers"));
        }
        if least > largest {
            return Some((format!("min {least} is above max {largest}"), "swap them"));
        }
        match *self {
            Distribution::Normal { sd, .. } | Distribution::Lognormal { sd, .. } if sd < 0.0 => {
                Some((format!("sd is {sd}"), "a standard deviation is not below 0"))
            }
            Distribution::Lognormal { mean, .. } if mean <= 0.0 => {
                Some((format!("mean is {mean}"), "a lognormal variable has a mean above 0"))
            }
            Distribution::Uniform { low, high, .. } if low > high => {
                Some((format!("low {low} is above high {high}"), "swap them"))
            }
            _ => None,
        }
    }

    fn clipping(&self) -> (f64, f64) {
        let (Distribution::Normal { min, max, .. }
        | Distribution::Uniform { min, max, .. }
        | Distribution::Lognormal { min, max, .. }) = *self;
        (min.unwrap_or(f64::NEG_INFINITY), max.unwrap_or(f64::INFINITY))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean and standard deviation over 100,000 equal shares of the drivers.
    fn moments(distribution: Distribution) -> (f64, f64) {
        const N: usize = 100_000;
        let values = || (0..N).map(|i| distribution.value((i as f64 + 0.5) / N as f64));
        let mean = values().sum::<f64>() / N as f64;
        let variance = values().map(|it| (it - mean) * (it - mean)).sum::<f64>() / N as f64;
        (mean, variance.sqrt())
    }

    #[test]
    fn each_distribution_has_the_mean_and_deviation_that_it_names() {
        let (min, max) = (None, None);
        for (distribution, mean, sd) in [
            (Distribution::Normal { mean: 1.12, sd: 0.08, min, max }, 1.12, 0.08),
            (Distribution::Lognormal { mean: 1.2, sd: 0.4, min, max }, 1.2, 0.4),
            (Distribution::Uniform { low: 1.0, high: 4.0, min, max }, 2.5, 3.0 / 12.0_f64.sqrt()),
        ] {
            let (found_mean, found_sd) = moments(distribution);
            assert!((found_mean - mean).abs() < 1e-4, "{distribution:?}: mean {found_mean}");
            assert!((found_sd - sd).abs() < 1e-3, "{distribution:?}: sd {found_sd}");
        }
    }

    #[test]
    fn clipping_moves_the_tails_to_the_limits() {
        let clipped = Distribution::Normal { mean: 1.0, sd: 1.0, min: Some(0.5), max: Some(1.5) };
        assert_eq!((clipped.value(0.01), clipped.value(0.5), clipped.value(0.99)), (0.5, 1.0, 1.5));
        assert_eq!(clipped.support(), (0.5, 1.5));
    }

    #[test]
    fn numbers_that_make_no_distribution_are_told() {
        let (min, max) = (None, None);
        for (distribution, what) in [
            (Distribution::Normal { mean: 1.0, sd: -1.0, min, max }, "sd is -1"),
            (Distribution::Lognormal { mean: 0.0, sd: 1.0, min, max }, "mean is 0"),
            (Distribution::Uniform { low: 2.0, high: 1.0, min, max }, "low 2 is above high 1"),
            (
                Distribution::Normal { mean: 1.0, sd: 1.0, min: Some(2.0), max: Some(1.0) },
                "min 2 is above max 1",
            ),
        ] {
            assert_eq!(distribution.flaw().unwrap().0, what);
        }
        assert!(Distribution::Normal { mean: f64::NAN, sd: 1.0, min, max }.flaw().is_some());
    }
}
