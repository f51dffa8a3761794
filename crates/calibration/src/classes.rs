//! Classes of drivers: a mixture of styles, by expectation and maximisation (Dempster, Laird, Rubin 1977).
//!
//! Drivers are never sorted by how often they changed lanes: that is what the styles have to explain. Each class has
//! its own threshold and weights, accepts gaps and gives up in its own way. Places and all else are those of the fit
//! with one class.

use rayon::prelude::*;

use crate::resample::folds;
use crate::waiting::{Assumptions, Design, GAP_TERMS, Layout, WaitingFit};

/// A mixture of classes.
#[derive(Clone, Debug, PartialEq)]
pub struct Mixture {
    /// For each class its share, in decreasing order.
    pub shares: Vec<f64>,
    /// Standard errors of the shares, given the classes.
    pub share_errors: Vec<f64>,
    /// For each class all parameters.
    pub parameters: Vec<Vec<f64>>,
    /// Log-likelihood of all drivers.
    pub log_likelihood: f64,
}

/// Steps of the algorithm, and the gain of log-likelihood below which it ends.
const STEPS: usize = 60;
const LEAST_GAIN: f64 = 1e-4;
/// Distance between the thresholds of the classes at the begin.
const APART: f64 = 1.5;

impl Mixture {
    /// Fits `count` classes, from a `fit` with one class on; each driver counts as often as `weights` says.
    pub fn fit(
        design: &Design,
        assumptions: &Assumptions,
        fit: &WaitingFit,
        count: usize,
        weights: &[f64],
    ) -> Mixture {
        let layout = fit.layout;
        let middle = 0.5 * (count as f64 - 1.0);
        let start = |class: usize| {
            let mut parameters = fit.estimates.clone();
            parameters[layout.intercept()] += APART * (class as f64 - middle);
            parameters
        };
        let own = own_of_classes(assumptions, layout, &fit.estimates);
        let mut now = Mixture::of_known(design, assumptions, (0..count).map(start).collect(), weights);
        for _ in 0..STEPS {
            let chances = now.chances(design, assumptions, weights);
            let refit = |class: usize| {
                let weights: Vec<f64> =
                    chances.iter().zip(weights).map(|(it, weight)| it[class] * weight).collect();
                design.refit(&own, &weights, &now.parameters[class], &fit.covariance)
            };
            let parameters: Vec<Vec<f64>> = (0..count).into_par_iter().map(refit).collect();
            let next = Mixture::of_known(design, assumptions, parameters, weights);
            let gain = next.log_likelihood - now.log_likelihood;
            now = next;
            if gain < LEAST_GAIN {
                break;
            }
        }
        now.sorted()
    }

    /// The classes in the draws of a bootstrap: `draws` has how often each driver counts in each. A driver keeps the
    /// chances that it belongs to each class, and the parameters take one step.
    pub(crate) fn redrawn(
        &self,
        design: &Design,
        assumptions: &Assumptions,
        fit: &WaitingFit,
        draws: &[Vec<f64>],
    ) -> Vec<Vec<Vec<f64>>> {
        let own = own_of_classes(assumptions, fit.layout, &fit.estimates);
        let chances = self.chances(design, assumptions, &vec![1.0; design.drivers.len()]);
        let of_class = |(class, parameters): (usize, &Vec<f64>)| {
            let weights: Vec<f64> = chances.iter().map(|it| it[class]).collect();
            design.redrawn(&own, &weights, (parameters, None), draws)
        };
        self.parameters.iter().enumerate().map(of_class).collect()
    }

    /// The shares of classes with known `parameters`.
    pub fn of_known(
        design: &Design,
        assumptions: &Assumptions,
        parameters: Vec<Vec<f64>>,
        weights: &[f64],
    ) -> Mixture {
        let logs = logs(design, assumptions, &parameters, weights);
        let all: f64 = weights.iter().sum();
        let mut shares = vec![1.0 / parameters.len() as f64; parameters.len()];
        let mut before = f64::NEG_INFINITY;
        loop {
            let (mut sums, mut log_likelihood) = (vec![0.0; shares.len()], 0.0);
            for (driver, weight) in weights.iter().enumerate().filter(|it| *it.1 > 0.0) {
                let (chances, log) = posterior(&logs, &shares, driver);
                log_likelihood += weight * log;
                sums.iter_mut().zip(chances).for_each(|(sum, it)| *sum += weight * it);
            }
            shares = sums.iter().map(|it| it / all).collect();
            if log_likelihood - before < 1e-9 * log_likelihood.abs().max(1.0) {
                let share_errors = share_errors(&logs, &shares, weights);
                return Mixture { shares, share_errors, parameters, log_likelihood };
            }
            before = log_likelihood;
        }
    }

    /// For each driver the chances that it belongs to each class.
    pub fn chances(&self, design: &Design, assumptions: &Assumptions, weights: &[f64]) -> Vec<Vec<f64>> {
        let logs = logs(design, assumptions, &self.parameters, weights);
        (0..weights.len()).map(|driver| posterior(&logs, &self.shares, driver).0).collect()
    }

    /// The log-likelihood of the drivers with weights.
    fn log_likelihood_of(&self, design: &Design, assumptions: &Assumptions, weights: &[f64]) -> f64 {
        let logs = logs(design, assumptions, &self.parameters, weights);
        let of = |(driver, weight): (usize, &f64)| weight * posterior(&logs, &self.shares, driver).1;
        weights.iter().enumerate().filter(|it| *it.1 > 0.0).map(of).sum()
    }

    fn sorted(self) -> Mixture {
        let mut order: Vec<usize> = (0..self.shares.len()).collect();
        order.sort_by(|a, b| self.shares[*b].total_cmp(&self.shares[*a]));
        Mixture {
            shares: order.iter().map(|it| self.shares[*it]).collect(),
            share_errors: order.iter().map(|it| self.share_errors[*it]).collect(),
            parameters: order.iter().map(|it| self.parameters[*it].clone()).collect(),
            log_likelihood: self.log_likelihood,
        }
    }
}

/// Whether two classes are told from one: their criterion BIC is less, and they predict held-out drivers better.
pub fn are_two(
    design: &Design,
    assumptions: &Assumptions,
    fit: &WaitingFit,
    mixture: &Mixture,
    seed: u64,
) -> bool {
    let drivers = design.drivers.len();
    // A threshold, a chance to give up, gap acceptance with its intercept, and a share.
    let weights = fit.layout.slopes().filter(|it| !assumptions.is_fixed[*it]).count();
    let parameters = weights + GAP_TERMS + 4;
    let more = parameters as f64 * libm::log(drivers as f64);
    if 2.0 * (mixture.log_likelihood - fit.log_likelihood) <= more {
        return false;
    }
    const PARTS: usize = 3;
    let folds = folds(drivers, PARTS, seed, 0);
    let gain = |part: usize| {
        let seen: Vec<f64> = folds.iter().map(|it| if *it == part { 0.0 } else { 1.0 }).collect();
        let held_out: Vec<f64> = seen.iter().map(|it| 1.0 - it).collect();
        let one = design.fit_from(assumptions, &seen, Some(fit));
        let two = Mixture::fit(design, assumptions, &one, 2, &seen);
        let by_one: f64 =
            design.log_likelihoods(&one.estimates, assumptions.has_spread, &held_out).iter().sum();
        two.log_likelihood_of(design, assumptions, &held_out) - by_one
    };
    (0..PARTS).map(gain).sum::<f64>() > 0.0
}

/// The assumptions about the parameters that each class has for itself: the others keep their `estimates`.
fn own_of_classes(assumptions: &Assumptions, layout: Layout, estimates: &[f64]) -> Assumptions {
    let mut own = assumptions.clone();
    let is_own = |at: usize| {
        let alone = [layout.intercept(), layout.giving_up()];
        alone.contains(&at) || layout.slopes().contains(&at) || layout.acceptance().contains(&at)
    };
    for (at, estimate) in estimates.iter().enumerate().filter(|it| !is_own(it.0)) {
        own.is_fixed[at] = true;
        own.prior.means[at] = *estimate;
    }
    own
}

/// By class, the log-likelihoods of all drivers.
fn logs(
    design: &Design,
    assumptions: &Assumptions,
    parameters: &[Vec<f64>],
    weights: &[f64],
) -> Vec<Vec<f64>> {
    parameters.iter().map(|it| design.log_likelihoods(it, assumptions.has_spread, weights)).collect()
}

/// The chances that a driver belongs to each class, and its log-likelihood.
fn posterior(logs: &[Vec<f64>], shares: &[f64], driver: usize) -> (Vec<f64>, f64) {
    let each =
        || logs.iter().zip(shares).map(|(log, share)| log[driver] + libm::log(share.max(f64::MIN_POSITIVE)));
    let largest = each().fold(f64::NEG_INFINITY, f64::max);
    let sum: f64 = each().map(|it| libm::exp(it - largest)).sum();
    (each().map(|it| libm::exp(it - largest) / sum).collect(), largest + libm::log(sum))
}

/// Standard errors of the shares: by the information Σ ((L_c − L)/L)², of each share against the others.
fn share_errors(logs: &[Vec<f64>], shares: &[f64], weights: &[f64]) -> Vec<f64> {
    let of = |class: usize| {
        let mut information = 0.0;
        for (driver, weight) in weights.iter().enumerate().filter(|it| *it.1 > 0.0) {
            let chance = posterior(logs, shares, driver).0[class];
            let (share, rest) = (shares[class], 1.0 - shares[class]);
            if share > 0.0 && rest > 0.0 {
                let slope = chance / share - (1.0 - chance) / rest;
                information += weight * slope * slope;
            }
        }
        if information > 0.0 { 1.0 / information.sqrt() } else { f64::INFINITY }
    };
    (0..shares.len()).map(of).collect()
}
