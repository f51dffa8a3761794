//! A fitted number: its error, whether the recordings tell it, and whether it matters.
//!
//! These are two things. A number is *identified* if data have narrowed what was assumed of it: one that is precisely
//! near 0 is. It *matters* if its interval excludes 0: a wide one may.

use crate::held_out::interval;
use crate::waiting::{Assumptions, Design, WaitingFit};

/// A fitted number.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// Its name.
    pub name: &'static str,
    /// The estimate; of one that is not identified beside others that are not, either.
    pub estimate: f64,
    /// Its standard error by the information matrix.
    pub standard_error: f64,
    /// Its 95 % interval: by the bootstrap, or by the standard error if there are no draws.
    pub interval: [f64; 2],
    /// What was assumed before: the mean.
    pub prior: f64,
    /// The standard deviation of that.
    pub prior_deviation: f64,
    /// Whether the recordings tell it: its standard deviation is at most half of the prior's, and the likelihood falls
    /// significantly on both sides within the 95 % interval of the prior about the estimate.
    pub is_identified: bool,
}

/// Half the width of a 95 % interval in standard errors.
pub(crate) const HALF: f64 = 1.959_964;
/// Half of the 95 % point of χ² with one degree of freedom.
pub(crate) const SIGNIFICANT: f64 = 1.920_729;
/// Most of the prior's standard deviation that is left of a number that is identified.
pub(crate) const MOST_LEFT: f64 = 0.5;

impl Fitted {
    /// A number with its standard error and its `draws`, of which it is not yet known whether it is identified.
    pub(crate) fn of(
        name: &'static str,
        (estimate, standard_error): (f64, f64),
        draws: Vec<f64>,
        (prior, prior_deviation): (f64, f64),
    ) -> Fitted {
        let half = HALF * standard_error;
        let interval = match draws.len() {
            0 => [estimate - half, estimate + half],
            _ => interval(draws),
        };
        Fitted { name, estimate, standard_error, interval, prior, prior_deviation, is_identified: false }
    }

    /// Whether its 95 % interval excludes 0.
    pub fn matters(&self) -> bool {
        let [lower, upper] = self.interval;
        lower > 0.0 || upper < 0.0
    }

    /// What drives: the estimate, or the prior if the recordings do not tell it.
    pub fn value(&self) -> f64 {
        if self.is_identified { self.estimate } else { self.prior }
    }

    /// Whether its standard deviation, by the information and by the draws, is at most half of the prior's.
    pub(crate) fn is_narrowed(&self) -> bool {
        let by_draws = (self.interval[1] - self.interval[0]) / (2.0 * HALF);
        self.standard_error.max(by_draws) <= MOST_LEFT * self.prior_deviation
    }

    /// Moves the estimate, and makes the errors wider.
    pub(crate) fn move_by(&mut self, by: f64, wider: f64) {
        let before = self.estimate;
        self.estimate += by;
        self.standard_error *= wider;
        self.interval = self.interval.map(|it| before + by + wider * (it - before));
    }
}

/// Whether the likelihood falls significantly on both sides of parameter `at` of a `fit`, within the 95 % interval of
/// its prior about the estimate, with all else fitted anew. Drivers have no intercepts of their own here.
pub(crate) fn is_closed(design: &Design, assumptions: &Assumptions, fit: &WaitingFit, at: usize) -> bool {
    let weights = vec![1.0; design.drivers.len()];
    let assumptions = assumptions.clone().without_spread(design);
    // The prior of the parameter itself does not count: that closes by itself.
    let log = |value: f64| {
        let held = assumptions.clone().holding(at, value);
        let estimates = design.refit(&held, &weights, &fit.estimates, &fit.covariance);
        let logs = design.log_likelihoods(&estimates, false, &weights);
        logs.iter().sum::<f64>() + held.prior.log_density(&estimates)
    };
    let reach = HALF / assumptions.prior.precisions[at].sqrt();
    let best = log(fit.estimates[at]);
    [-reach, reach].iter().all(|it| best - log(fit.estimates[at] + it) > SIGNIFICANT)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_precisely_near_nothing_is_narrowed_and_does_not_matter() {
        let near = |deviation: f64| Fitted::of("near", (0.01, 0.02), Vec::new(), (0.4, deviation));
        assert!(near(1.0).is_narrowed() && !near(1.0).matters());
        // Half of the prior's standard deviation is the most.
        assert!(near(0.0401).is_narrowed() && !near(0.0399).is_narrowed());
        let wide = Fitted::of("wide", (5.0, 2.0), Vec::new(), (0.4, 1.0));
        assert!(!wide.is_narrowed() && wide.matters());
    }

    #[test]
    fn draws_that_differ_more_than_the_information_says_count() {
        let draws: Vec<f64> = (0..=1000).map(|it| f64::from(it) / 1000.0).collect();
        let number = |deviation: f64| Fitted::of("number", (0.5, 0.01), draws.clone(), (0.0, deviation));
        let [lower, upper] = number(1.0).interval;
        assert!((lower - 0.025).abs() < 1e-9 && (upper - 0.975).abs() < 1e-9);
        // .95 / (2 · 1.96) = .2424.
        assert!(number(0.49).is_narrowed() && !number(0.48).is_narrowed());
    }

    #[test]
    fn what_is_not_identified_drives_at_the_prior() {
        let told = Fitted { is_identified: true, ..Fitted::of("told", (5.0, 0.1), Vec::new(), (0.4, 1.0)) };
        assert_eq!(told.value(), 5.0);
        assert_eq!(Fitted { is_identified: false, ..told }.value(), 0.4);
    }
}
