//! Choices that were observed exactly: in each epoch a driver stays, or begins to want a change to one side.
//!
//! Multinomial logit (McFadden 1974): with η = Σ β x of a side, P(side) = e^η/(1 + Σ e^η); staying has η = 0. Where
//! there is one side only, this is the logit of the paper, h = 1/(1 + e^(−η)), with η = (G − θ)/σ. The logarithm of the
//! likelihood is concave, so Newton's steps find its maximum.

use crate::matrix::{Cholesky, Matrix, add, dot};
use crate::prior::Prior;

/// Observed choices, as numbers only.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Choices {
    /// Number of terms of a side.
    pub width: usize,
    /// The terms of all sides, one after the other.
    pub terms: Vec<f64>,
    /// Every time that a driver chose.
    pub epochs: Vec<Epoch>,
}

/// One epoch of a driver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Epoch {
    /// For each side its number among the sides; `None` where the driver may not change.
    pub sides: [Option<u32>; 2],
    /// The side that was chosen: 0 or 1; `None`: the driver stayed.
    pub chosen: Option<usize>,
    /// How often it counts.
    pub weight: f64,
}

/// What a fit gives.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The most likely weights, one for each term.
    pub estimates: Vec<f64>,
    /// Their covariance: the inverse of the information, with that of the prior.
    pub covariance: Matrix,
    /// Logarithm of the likelihood at the estimates, without the prior.
    pub log_likelihood: f64,
    /// Whether the maximum was found.
    pub is_converged: bool,
}

impl Fit {
    /// Standard errors of the estimates.
    pub fn standard_errors(&self) -> Vec<f64> {
        self.covariance.diagonal().map(f64::sqrt).collect()
    }
}

/// Most Newton steps, and the promised gain below which no further one is made.
const STEPS: usize = 100;
const LEAST_GAIN: f64 = 1e-12;

impl Choices {
    /// Choices between sides with `width` terms.
    pub fn new(width: usize) -> Choices {
        Choices { width, ..Choices::default() }
    }

    /// Adds an epoch with the terms of its sides.
    pub fn push(&mut self, sides: [Option<&[f64]>; 2], chosen: Option<usize>, weight: f64) {
        let sides = sides.map(|it| {
            it.map(|terms| {
                let number = (self.terms.len() / self.width.max(1)) as u32;
                self.terms.extend_from_slice(terms);
                number
            })
        });
        self.epochs.push(Epoch { sides, chosen, weight });
    }

    fn terms(&self, side: u32) -> &[f64] {
        let from = side as usize * self.width;
        &self.terms[from..from + self.width]
    }

    /// Chances of the two sides in an epoch.
    pub fn chances(&self, epoch: &Epoch, estimates: &[f64]) -> [f64; 2] {
        let utilities =
            epoch.sides.map(|it| it.map_or(f64::NEG_INFINITY, |it| dot(self.terms(it), estimates)));
        let largest = utilities[0].max(utilities[1]).max(0.0);
        let [first, second] = utilities.map(|it| libm::exp(it - largest));
        let all = libm::exp(-largest) + first + second;
        [first / all, second / all]
    }

    /// The maximum of likelihood and `prior`.
    ///
    /// `None` if the data leave a combination of parameters open of which the prior says nothing.
    pub fn fit(&self, prior: &Prior) -> Option<Fit> {
        let mut at = prior.means.clone();
        let mut now = self.look(&at, prior);
        let mut is_converged = false;
        for _ in 0..STEPS {
            let step = Cholesky::of(&now.information)?.solve(&now.gradient);
            let promised = dot(&step, &now.gradient);
            if promised < LEAST_GAIN {
                is_converged = true;
                break;
            }
            let mut length = 1.0;
            (at, now) = loop {
                let mut there = at.clone();
                add(&mut there, length, &step);
                let next = self.look(&there, prior);
                if next.value >= now.value || length < 1e-9 {
                    break (there, next);
                }
                length *= 0.5;
            };
        }
        let covariance = Cholesky::of(&now.information)?.inverse();
        let log_likelihood = now.value - prior.log_density(&at);
        Some(Fit { estimates: at, covariance, log_likelihood, is_converged })
    }

    fn look(&self, at: &[f64], prior: &Prior) -> Look {
        let mut look = Look {
            value: prior.log_density(at),
            gradient: vec![0.0; self.width],
            information: Matrix::from_diagonal(&prior.precisions),
        };
        prior.add_gradient(at, &mut look.gradient);
        let mut mean = vec![0.0; self.width];
        for epoch in &self.epochs {
            let chances = self.chances(epoch, at);
            let stays = 1.0 - chances[0] - chances[1];
            let chance = epoch.chosen.map_or(stays, |it| chances[it]);
            look.value += epoch.weight * libm::log(chance.max(f64::MIN_POSITIVE));
            mean.fill(0.0);
            for (side, p) in epoch.sides.into_iter().zip(chances) {
                let Some(terms) = side.map(|it| self.terms(it)) else { continue };
                add(&mut mean, p, terms);
                look.information.add_outer(epoch.weight * p, terms, terms);
            }
            look.information.add_outer(-epoch.weight, &mean, &mean);
            let chosen = epoch.chosen.and_then(|it| epoch.sides[it]).map(|it| self.terms(it));
            for (row, slope) in look.gradient.iter_mut().enumerate() {
                *slope += epoch.weight * (chosen.map_or(0.0, |it| it[row]) - mean[row]);
            }
        }
        look
    }
}

/// Value, gradient and information at some estimates.
struct Look {
    value: f64,
    gradient: Vec<f64>,
    information: Matrix,
}

/// What has to be added to the intercept of a logit if of those who stayed only some were sampled: ln[((1 − τ)/τ)(ȳ/(1
/// − ȳ))] is subtracted from the estimate, with the share τ of changes among all epochs, and ȳ among the sampled ones
/// (King, Zeng 2001). Returns that number.
pub fn sampling_correction(share: f64, sampled_share: f64) -> f64 {
    libm::log((1.0 - share) / share * sampled_share / (1.0 - sampled_share))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_change_in_a_hundred_sampled_to_one_half_is_corrected_by_4_595() {
        assert!((sampling_correction(0.01, 0.5) - 4.595120).abs() < 1e-6);
    }

    #[test]
    fn without_terms_but_an_intercept_the_share_comes_back() {
        let mut choices = Choices::new(1);
        for number in 0..1000 {
            choices.push([Some(&[1.0]), None], (number < 100).then_some(0), 1.0);
        }
        let fit = choices.fit(&Prior::none(1)).unwrap();
        assert!(fit.is_converged);
        assert!((fit.estimates[0] - libm::log(0.1 / 0.9)).abs() < 1e-10);
        // 1000 observations with base .1.
        assert!((fit.log_likelihood + 325.082973).abs() < 1e-6);
        assert!((fit.standard_errors()[0] - 1.0 / 90.0_f64.sqrt()).abs() < 1e-9);
    }

    #[test]
    fn a_term_that_never_differs_is_left_open_without_a_prior_and_keeps_the_prior_with_one() {
        let mut choices = Choices::new(2);
        for number in 0..100 {
            choices.push([Some(&[1.0, 0.0]), None], (number < 30).then_some(0), 1.0);
        }
        assert_eq!(choices.fit(&Prior::none(2)), None);
        let prior = Prior { means: vec![0.0, 1.72], precisions: vec![0.0, 0.25] };
        let fit = choices.fit(&prior).unwrap();
        assert_eq!(fit.estimates[1], 1.72);
        assert!((fit.standard_errors()[1] - 2.0).abs() < 1e-12);
    }

    #[test]
    fn the_misprinted_cost_would_reward_ever_larger_weights() {
        // −y ln h − (1 − y) ln h is least at h = 1: no maximum. With 1 − h it has one.
        let cost = |h: f64, y: f64| -y * libm::log(h) - (1.0 - y) * libm::log(1.0 - h);
        assert!((cost(0.8, 1.0) - 0.223144).abs() < 1e-6);
        assert!((cost(0.8, 0.0) - 1.609438).abs() < 1e-6);
        let misprinted = |w: f64| {
            let h = 1.0 / (1.0 + libm::exp(-w));
            [1.0, 0.0].iter().map(|y| -y * libm::log(h) - (1.0 - y) * libm::log(h)).sum::<f64>()
        };
        assert!(misprinted(5.0) < misprinted(1.0) && misprinted(50.0) < misprinted(5.0));
        let mut choices = Choices::new(1);
        choices.push([Some(&[1.0]), None], Some(0), 1.0);
        choices.push([Some(&[1.0]), None], None, 1.0);
        assert!(choices.fit(&Prior::none(1)).unwrap().estimates[0].abs() < 1e-12);
    }
}
