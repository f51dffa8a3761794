//! Statistics of few replications and small counts: intervals at 95 % confidence.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

use serde::{Deserialize, Serialize};

/// Probability that an interval holds the true value.
const CONFIDENCE: f64 = 0.95;
/// Two-sided quantile of the normal distribution at 95 %.
const NORMAL_QUANTILE: f64 = 1.96;

/// Above this number of degrees of freedom, Student's quantile is computed from the normal one, to 10⁻⁹.
const NEARLY_NORMAL: usize = 200;

/// A range of plausible values, in the unit of what it bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Its lower end.
    pub lower: f64,
    /// Its upper end.
    pub upper: f64,
}

/// A mean over independent replications: mean ± half-width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Number of replications.
    pub replications: usize,
    /// Sample mean.
    pub mean: f64,
    /// Sample standard deviation (n − 1); infinite for a single replication.
    pub standard_deviation: f64,
    /// Half of the 95 % confidence interval (Student's t); infinite for a single replication.
    pub half_width: f64,
}

impl Estimate {
    /// The 95 % confidence interval of the mean.
    pub fn interval(&self) -> Interval {
        Interval { lower: self.mean - self.half_width, upper: self.mean + self.half_width }
    }
}

/// The mean of one measure over independent `replications`; `None` without any.
pub fn mean(replications: &[f64]) -> Option<Estimate> {
    let mut moments = Moments::default();
    replications.iter().for_each(|it| moments.add(*it));
    moments.estimate()
}

/// Running sums for the mean and spread of values (Welford, 1962).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Moments {
    count: usize,
    mean: f64,
    /// Σ (x − mean)²
    squares: f64,
}

impl Moments {
    /// Adds a value.
    pub fn add(&mut self, value: f64) {
        self.count += 1;
        let off = value - self.mean;
        self.mean += off / self.count as f64;
        self.squares += off * (value - self.mean);
    }

    /// The mean of the added values, if these are independent; `None` without any.
    pub fn estimate(&self) -> Option<Estimate> {
        let Moments { count: n, mean, squares } = *self;
        if n == 0 {
            return None;
        }
        if n == 1 {
            let unknown = f64::INFINITY;
            return Some(Estimate {
                replications: n,
                mean,
                standard_deviation: unknown,
                half_width: unknown,
            });
        }
        let standard_deviation = (squares / (n - 1) as f64).sqrt();
        let half_width = student_quantile(n - 1) * standard_deviation / (n as f64).sqrt();
        Some(Estimate { replications: n, mean, standard_deviation, half_width })
    }
}

/// Replications needed so that the mean's 95 % interval is ± `relative_error` of the mean, for a measure whose
/// standard deviation is `coefficient_of_variation` of its mean: n = (1.96 cv/ε)², rounded up.
pub fn required_replications(coefficient_of_variation: f64, relative_error: f64) -> u64 {
    let ratio = NORMAL_QUANTILE * coefficient_of_variation / relative_error;
    (ratio * ratio).ceil() as u64
}

/// Exact 95 % interval of the expectation of a Poisson `count` (Garwood, 1936).
pub fn poisson_interval(count: u64) -> Interval {
    let tail = (1.0 - CONFIDENCE) / 2.0;
    // Ten standard deviations reach far beyond either end.
    let reach = 10.0 * ((count + 1) as f64).sqrt();
    let (low, high) = ((count as f64 - reach).max(0.0), count as f64 + reach);
    let lower = match count.checked_sub(1) {
        None => 0.0,
        Some(fewer) => bisect(low, high, |expectation| poisson_at_most(fewer, expectation) > 1.0 - tail),
    };
    let upper = bisect(low, high, |expectation| poisson_at_most(count, expectation) > tail);
    Interval { lower, upper }
}

/// GEH statistic of a `modelled` against a `counted` hourly flow [veh/h]: √(2 (m − c)² / (m + c)); below 5 is a
/// good fit by common practice. Two empty flows agree: 0.
pub fn geh(modelled: f64, counted: f64) -> f64 {
    if modelled == counted {
        return 0.0;
    }
    let difference = modelled - counted;
    (2.0 * difference * difference / (modelled + counted)).sqrt()
}

/// t with P(|T| ≤ t) = 95 % for Student's distribution.
fn student_quantile(degrees_of_freedom: usize) -> f64 {
    if degrees_of_freedom > NEARLY_NORMAL {
        return nearly_normal_quantile(degrees_of_freedom);
    }
    let angle = bisect(0.0, FRAC_PI_2, |angle| student_within(degrees_of_freedom, angle) < CONFIDENCE);
    (degrees_of_freedom as f64).sqrt() * libm::tan(angle)
}

/// The same for many degrees of freedom ν, as a series in 1/ν (Abramowitz and Stegun, 26.7.5).
fn nearly_normal_quantile(degrees_of_freedom: usize) -> f64 {
    /// The quantile of the normal distribution at 97.5 %.
    const X: f64 = 1.959_963_984_540_054;
    const X2: f64 = X * X;
    /// The coefficients of 1, 1/ν, 1/ν² and 1/ν³.
    const TERMS: [f64; 4] = [
        X,
        X * (X2 + 1.0) / 4.0,
        X * ((5.0 * X2 + 16.0) * X2 + 3.0) / 96.0,
        X * (((3.0 * X2 + 19.0) * X2 + 17.0) * X2 - 15.0) / 384.0,
    ];
    let share = 1.0 / degrees_of_freedom as f64;
    TERMS.iter().rev().fold(0.0, |sum, term| sum * share + term)
}

/// P(|T| ≤ √ν tan θ) for ν degrees of freedom: a finite series in cos² θ
/// (Abramowitz and Stegun, 26.7.3 and 26.7.4).
fn student_within(degrees_of_freedom: usize, angle: f64) -> f64 {
    let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
    let odd = degrees_of_freedom % 2 == 1;
    let mut term = if odd { cosine } else { 1.0 };
    let mut sum = 0.0;
    // The exponent of the cosine rises by two, up to ν − 2; terms this small no longer count.
    for exponent in (usize::from(odd)..degrees_of_freedom.saturating_sub(1)).step_by(2) {
        sum += term;
        term *= cosine * cosine * (exponent + 1) as f64 / (exponent + 2) as f64;
        if term < f64::EPSILON * sum / degrees_of_freedom as f64 {
            break;
        }
    }
    if odd { FRAC_2_PI * (angle + sine * sum) } else { sine * sum }
}

/// P(X ≤ count) for a Poisson variable, summed outwards from its largest term.
fn poisson_at_most(count: u64, expectation: f64) -> f64 {
    if expectation <= 0.0 {
        return 1.0;
    }
    let peak = count.min(expectation as u64);
    let k = peak as f64;
    let largest = libm::exp(k * libm::log(expectation) - expectation - libm::lgamma(k + 1.0));
    let counts = |term: &f64| *term > f64::EPSILON * 1e-3;
    let ratios = |term: &mut f64, ratio: f64| {
        *term *= ratio;
        Some(*term)
    };
    let below = (1..=peak).rev().map(|k| k as f64 / expectation).scan(1.0, ratios).take_while(counts);
    let above = (peak + 1..=count).map(|k| expectation / k as f64).scan(1.0, ratios).take_while(counts);
    largest * (1.0 + below.sum::<f64>() + above.sum::<f64>())
}

/// The point between `low` and `high` up to which `is_below` holds.
fn bisect(mut low: f64, mut high: f64, is_below: impl Fn(f64) -> bool) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if is_below(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn assert_near(value: f64, expected: f64, tolerance: f64) {
        assert!((value - expected).abs() <= tolerance, "{value} instead of {expected}");
    }

    #[test]
    fn the_t_quantiles_are_those_of_the_printed_table() {
        let table = [(1, 12.706205), (2, 4.302653), (3, 3.182446), (4, 2.776445), (9, 2.262157)];
        for (degrees_of_freedom, expected) in table {
            assert_near(student_quantile(degrees_of_freedom), expected, 1e-6);
        }
        assert_near(student_quantile(30), 2.042272, 1e-6);
        assert_near(student_quantile(1_000_000), 1.959966, 1e-6);
    }

    #[test]
    fn with_many_degrees_of_freedom_the_quantile_from_the_normal_one_is_the_same() {
        let both = |it: usize| (nearly_normal_quantile(it), student_quantile(it));
        let (near, exact) = both(NEARLY_NORMAL);
        assert_near(near, exact, 2e-9);
        let (near, exact) = both(NEARLY_NORMAL - 1);
        assert_near(near, exact, 2e-9);
    }

    #[test]
    fn a_mean_of_five_replications_has_the_half_width_of_the_textbook() {
        // s = √2.5, t₄ = 2.776445: 2.776445 √(2.5/5).
        let estimate = mean(&[1.0, 2.0, 3.0, 4.0, 5.0]).unwrap();
        assert_eq!((estimate.replications, estimate.mean), (5, 3.0));
        assert_eq!(estimate.standard_deviation, 2.5_f64.sqrt());
        assert_near(estimate.half_width, 1.963243, 1e-6);
        assert_near(estimate.interval().lower, 1.036757, 1e-6);
        assert_near(estimate.interval().upper, 4.963243, 1e-6);
    }

    #[test]
    fn a_single_replication_says_nothing_of_its_error() {
        assert_eq!(mean(&[]), None);
        let estimate = mean(&[7.0]).unwrap();
        assert_eq!((estimate.mean, estimate.half_width), (7.0, f64::INFINITY));
    }

    #[test]
    fn a_variation_of_ten_percent_needs_sixteen_replications_for_five_percent() {
        assert_eq!(required_replications(0.1, 0.05), 16);
        assert_eq!(required_replications(0.1, 0.01), 385);
        assert_eq!(required_replications(0.0, 0.05), 0);
    }

    #[test]
    fn fifty_changes_on_half_a_kilometre_in_ten_minutes_are_445_to_791_per_km_and_hour() {
        let exposure_km_h = 0.5 / 6.0;
        let Interval { lower, upper } = poisson_interval(50);
        assert_near(50.0 / exposure_km_h, 600.0, 1e-9);
        assert_eq!((lower / exposure_km_h).round(), 445.0);
        assert_eq!((upper / exposure_km_h).round(), 791.0);
        assert_near(lower, 37.110_964, 1e-6);
        assert_near(upper, 65.918_767, 1e-6);
    }

    #[test]
    fn no_event_still_allows_an_expectation_of_3_7() {
        // −ln .025
        let Interval { lower, upper } = poisson_interval(0);
        assert_eq!(lower, 0.0);
        assert_near(upper, 3.688879, 1e-6);
    }

    #[test]
    fn the_interval_of_a_large_count_approaches_the_normal_one() {
        let Interval { lower, upper } = poisson_interval(1_000_000);
        assert_near(lower, 998_041.0, 1.0);
        assert_near(upper, 1_001_962.0, 1.0);
    }

    #[test]
    fn geh_of_900_against_1000_is_3_24() {
        assert_near(geh(900.0, 1000.0), 3.244428, 1e-6);
        assert_eq!(geh(0.0, 0.0), 0.0);
    }

    proptest! {
        #[test]
        fn the_tails_beyond_an_interval_hold_a_fortieth_each(count in 1_u64..3000) {
            let Interval { lower, upper } = poisson_interval(count);
            prop_assert!((poisson_at_most(count - 1, lower) - 0.975).abs() < 1e-9);
            prop_assert!((poisson_at_most(count, upper) - 0.025).abs() < 1e-9);
        }
    }
}
