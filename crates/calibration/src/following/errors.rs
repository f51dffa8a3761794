//! How wrong predictions of a stretch are: errors of one stretch belong together, and a few are large.
//!
//! The errors of way and speed after each second are one vector with a multivariate t distribution (Lange, Little,
//! Taylor 1989, J. Am. Stat. Assoc. 84, 881): a stretch in which a driver reacts to something else weighs less. Its
//! scales are estimated from the errors themselves; those of drivers who follow, who stand or crawl, and who are free
//! differ.
//!
//! Errors of one stretch are strongly correlated. With all of that correlation the likelihood looks at what a driver
//! does within the first seconds, where recorded speeds are uncertain and drivers react late; the numbers of a model
//! whose driver reacts at once then come out wrong, above all a. So only a part of the correlation is used (a working
//! covariance: Liang, Zeger 1986, Biometrika 73, 13). Estimates of a model that is right are consistent with any such
//! part, and standard errors do not rely on it.

use super::predict::Moved;
use super::stretch::Stretch;
use crate::matrix::{Cholesky, Matrix, dot};

/// ν: the degrees of freedom (ours).
const FREEDOM: f64 = 4.0;
/// Part of the correlation of the errors of one stretch that is used (ours).
const USED: f64 = 0.2;
/// Below this speed at the start of a stretch a driver crawls [m/s] (ours).
const CRAWLS: f64 = 3.0;
/// The kinds of stretches whose errors differ.
const KINDS: usize = 3;
/// Stretches of a kind, for each error, that show its scales; fewer are taken with those of all kinds (ours).
const ENOUGH: usize = 10;
/// Least standard deviation of an error, in metres and metres per second (ours): recordings are not more exact.
const LEAST: f64 = 0.01;

/// The errors of a stretch: by how much a prediction is too far, and too fast.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Off {
    /// The kind of the stretch.
    pub(super) kind: usize,
    pub(super) errors: Vec<f64>,
}

/// By how much a prediction is too far [m] at each look, and then too fast [m/s].
pub(super) fn errors(predicted: &[Moved], stretch: &Stretch) -> Vec<f64> {
    let pairs = || predicted.iter().zip(&stretch.own[1..]);
    let ways = pairs().map(|(predicted, seen)| predicted.way - seen.way);
    ways.chain(pairs().map(|(predicted, seen)| predicted.speed - seen.speed)).collect()
}

/// The kind of a stretch.
pub(super) fn kind(stretch: &Stretch) -> usize {
    match stretch.leader[..] {
        [] => 0,
        _ if stretch.own[0].speed < CRAWLS => 1,
        _ => 2,
    }
}

/// The distributions of the errors of all kinds.
pub(super) struct Errors {
    /// Number of errors of a stretch.
    size: usize,
    kinds: Vec<Scale>,
}

/// The scale matrix of a distribution, factored, and the logarithm of its determinant.
struct Scale {
    factor: Cholesky,
    log_determinant: f64,
}

/// What errors count.
pub(super) struct Weighed {
    /// The inverse of the scale matrix times the errors, times the weight of the stretch.
    pub(super) slope: Vec<f64>,
    /// The weight: 1 or a little more for usual errors, less for large ones.
    pub(super) weight: f64,
    /// The log-likelihood, but for a constant.
    pub(super) log: f64,
}

impl Errors {
    /// Those that `all` show: by a step of expectation and maximisation from `before` on. `None` without any.
    pub(super) fn of(all: &[Off], before: Option<&Errors>) -> Option<Errors> {
        let size = all.first()?.errors.len();
        let of_kind = |kind: usize| {
            let own: Vec<&Off> = all.iter().filter(|it| it.kind == kind).collect();
            let own = if own.len() < ENOUGH * size { all.iter().collect() } else { own };
            Scale::of(size, &own, before)
        };
        Some(Errors { size, kinds: (0..KINDS).map(of_kind).collect::<Option<_>>()? })
    }

    /// ν + p.
    fn all(&self) -> f64 {
        FREEDOM + self.size as f64
    }

    /// Twice the share by which a large error bends the likelihood less: 2/(ν + p).
    pub(super) fn bent(&self) -> f64 {
        2.0 / self.all()
    }

    /// What `errors` of a stretch of this kind count.
    pub(super) fn weighed(&self, kind: usize, errors: &[f64]) -> Weighed {
        let Scale { factor, log_determinant } = &self.kinds[kind];
        let mut slope = factor.solve(errors);
        let square = dot(&slope, errors);
        let all = self.all();
        let weight = all / (FREEDOM + square);
        slope.iter_mut().for_each(|it| *it *= weight);
        let log = -0.5 * log_determinant - 0.5 * all * libm::log1p(square / FREEDOM);
        Weighed { slope, weight, log }
    }

    /// The inverse of the scale matrix of this kind times `values`.
    pub(super) fn solved(&self, kind: usize, values: &[f64]) -> Vec<f64> {
        self.kinds[kind].factor.solve(values)
    }
}

impl Scale {
    /// That of `all`, each with the weight that it has `before`.
    fn of(size: usize, all: &[&Off], before: Option<&Errors>) -> Option<Scale> {
        let (mut sum, count) = (Matrix::zeros(size), all.len() as f64);
        for Off { kind, errors } in all {
            let weight = before.map_or(1.0, |it| it.weighed(*kind, errors).weight);
            sum.add_outer(weight, errors, errors);
        }
        let mut scale = Matrix::zeros(size);
        for row in 0..size {
            (0..size).for_each(|column| scale[(row, column)] = USED * sum[(row, column)] / count);
            scale[(row, row)] = sum[(row, row)] / count + LEAST * LEAST;
        }
        let factor = Cholesky::of(&scale)?;
        let log_determinant = factor.log_determinant();
        Some(Scale { factor, log_determinant })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Number of errors.
    const SIZE: usize = 16;

    /// As many vectors as there are errors, each with one error of its own and one that all have.
    fn toy() -> Vec<Off> {
        let errors = |at: usize| (0..SIZE).map(|it| if it == at { 3.0 } else { 1.0 }).collect();
        let own = |at: usize| Off { kind: 2, errors: errors(at) };
        (0..SIZE).map(own).collect()
    }

    #[test]
    fn errors_are_whitened_by_a_fifth_of_their_correlation() {
        let errors = Errors::of(&toy(), None).unwrap();
        // Variances (9 + 15)/16 = 1.5, covariances (6 + 14)/16 = 1.25, of which a fifth is .25.
        let variance = 1.5 + LEAST * LEAST;
        let ones = errors.solved(2, &[1.0; SIZE]);
        let exact = 1.0 / (variance + 15.0 * 0.25);
        assert!(ones.iter().all(|it| (it - exact).abs() < 1e-12), "{ones:?}");
        let mut contrast = [0.0; SIZE];
        (contrast[0], contrast[1]) = (1.0, -1.0);
        let solved = errors.solved(2, &contrast);
        assert!((solved[0] - 1.0 / (variance - 0.25)).abs() < 1e-12, "{solved:?}");
    }

    #[test]
    fn large_errors_weigh_less() {
        let errors = Errors::of(&toy(), None).unwrap();
        let exact = 1.0 / (1.5 + LEAST * LEAST + 15.0 * 0.25);
        let weighed = errors.weighed(2, &[2.0; SIZE]);
        assert!((weighed.weight - 20.0 / (4.0 + 64.0 * exact)).abs() < 1e-12);
        assert!((weighed.slope[0] - weighed.weight * 2.0 * exact).abs() < 1e-12);
        assert!(errors.weighed(2, &[20.0; SIZE]).weight < 0.02);
        // The slope is that of the log-likelihood.
        let log = |it: f64| errors.weighed(2, &[it; SIZE]).log;
        let slope = (log(2.0 + 1e-5) - log(2.0 - 1e-5)) / 2e-5;
        assert!((slope + weighed.slope.iter().sum::<f64>()).abs() < 1e-6);
    }

    #[test]
    fn a_kind_of_which_enough_was_seen_has_errors_of_its_own() {
        let many: Vec<Off> = (0..ENOUGH).flat_map(|_| toy()).collect();
        let doubled = |it: &Off| Off { kind: 0, errors: it.errors.iter().map(|it| 2.0 * it).collect() };
        let all: Vec<Off> = many.iter().map(doubled).chain(many.clone()).collect();
        let [errors, alone] = [&all, &many].map(|it| Errors::of(it, None).unwrap());
        let of = |errors: &Errors, kind| errors.solved(kind, &[1.0; SIZE])[0];
        assert_eq!(of(&errors, 2), of(&alone, 2));
        // Twice the errors have four times the variance.
        assert!((of(&errors, 2) / of(&errors, 0) - 4.0).abs() < 1e-3);
    }

    #[test]
    fn a_kind_of_which_little_was_seen_has_the_errors_of_all() {
        let errors = Errors::of(&toy(), None).unwrap();
        assert_eq!(errors.solved(0, &[1.0; SIZE]), errors.solved(2, &[1.0; SIZE]));
        assert!(Errors::of(&[], None).is_none());
    }
}
