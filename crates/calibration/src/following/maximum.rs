//! The parameters that explain drivers best: the maximum of a penalised likelihood, by steps of Gauss and Newton.

use rayon::prelude::*;

use super::errors::{Errors, kind};
use super::problem::{Case, PARAMETERS, PRIOR, Parameters, Problem};
use crate::matrix::{Cholesky, Matrix, add, dot};

/// Change of a parameter to both sides over which a slope is taken: the bounds of comfortable braking are steps.
const SHIFT: f64 = 0.02;
/// Most steps, and the gain of log-likelihood below which the search ends.
const STEPS: usize = 60;
const SMALL: f64 = 0.01;
/// Most halvings of one step.
const HALVINGS: i32 = 8;
/// Longest step, in those of Gauss and Newton.
const LONGEST: f64 = 8.0;

/// What one stretch adds to slope and curvature of the log-likelihood.
struct Part {
    driver: usize,
    slope: Parameters,
    /// That of the expected curvature, row after row.
    curvature: [Parameters; PARAMETERS],
}

/// The maximum.
pub(super) struct Maximum {
    pub(super) at: Parameters,
    /// The distribution of errors, if it was estimated as well.
    pub(super) errors: Option<Errors>,
    pub(super) is_converged: bool,
}

/// How sure the parameters at a maximum are.
pub(super) struct Precision {
    /// Their covariance by the sandwich of drivers who are independent of one another (Liang, Zeger 1986), with the
    /// prior as one more observation.
    pub(super) covariance: Matrix,
    /// By how much their variances exceed those of the likelihood alone, since stretches of one driver, and errors of
    /// one stretch, are alike.
    pub(super) excess: Parameters,
    /// By how much the parameters move if a driver counts once more.
    pub(super) moves: Vec<Parameters>,
}

impl Problem<'_> {
    /// The maximum over the `free` parameters from `start` on; the distribution of errors is `known`, or estimated as
    /// well. `None` if nothing is to be explained.
    pub(super) fn maximum(
        &self,
        start: Parameters,
        free: &[usize],
        known: Option<&Errors>,
    ) -> Option<Maximum> {
        let mut own = None;
        let mut at = start;
        for _ in 0..STEPS {
            if known.is_none() {
                own = Some(self.distribution(&at, own.as_ref())?);
            }
            let promised = self.improve(&mut at, free, known.or(own.as_ref())?)?;
            if promised < SMALL {
                return Some(Maximum { at, errors: own, is_converged: true });
            }
        }
        Some(Maximum { at, errors: own, is_converged: false })
    }

    /// Goes a step towards the maximum; returns the gain of log-likelihood that it promised.
    fn improve(&self, at: &mut Parameters, free: &[usize], errors: &Errors) -> Option<f64> {
        let log = self.log(errors, at);
        let (slope, curvature) = self.sums(&self.parts(errors, at), at, free);
        let step = Cholesky::of(&curvature)?.solve(&slope);
        let start = *at;
        let gone = |length: f64| {
            let mut next = start;
            free.iter().zip(&step).for_each(|(at, it)| next[*at] += length * it);
            (self.log(errors, &next), next)
        };
        let shorter = (0..HALVINGS).map(|it| 0.5_f64.powi(it)).find(|it| gone(*it).0 > log);
        let Some(mut length) = shorter else { return Some(0.0) };
        // Weights that change with the parameters make most steps too short.
        while length < LONGEST && gone(2.0 * length).0 > gone(length).0 {
            length *= 2.0;
        }
        *at = gone(length).1;
        Some(0.5 * dot(&step, &slope))
    }

    /// How sure the parameters at a maximum are; `None` if it is none.
    pub(super) fn precision(&self, at: &Parameters, errors: &Errors) -> Option<Precision> {
        let all: [usize; PARAMETERS] = std::array::from_fn(|it| it);
        let parts = self.parts(errors, at);
        let (_, mut curvature) = self.sums(&parts, at, &all);
        let mut by_driver = vec![[0.0; PARAMETERS]; self.drivers];
        for part in &parts {
            curvature.add_outer(-errors.bent(), &part.slope, &part.slope);
            add(&mut by_driver[part.driver], 1.0, &part.slope);
        }
        let inverse = Cholesky::of(&curvature)?.inverse();
        let moves: Vec<Parameters> = by_driver
            .iter()
            .map(|it| {
                let moved = inverse.times(it);
                std::array::from_fn(|at| moved[at])
            })
            .collect();
        let mut covariance = Matrix::zeros(PARAMETERS);
        moves.iter().for_each(|it| covariance.add_outer(1.0, it, it));
        for at in 0..PARAMETERS {
            let column: Vec<f64> = all.iter().map(|row| inverse[(*row, at)]).collect();
            covariance.add_outer(1.0 / (PRIOR * PRIOR), &column, &column);
        }
        let excess = all.map(|at| (covariance[(at, at)] / inverse[(at, at)]).max(1.0));
        Some(Precision { covariance, excess, moves })
    }

    /// What each stretch adds at `parameters`.
    fn parts(&self, errors: &Errors, parameters: &Parameters) -> Vec<Part> {
        let of = |case: &Case| {
            let kind = kind(case.stretch);
            let slopes: [Vec<f64>; PARAMETERS] = std::array::from_fn(|at| {
                let [below, above] = [-SHIFT, SHIFT].map(|shift| {
                    let mut shifted = *parameters;
                    shifted[at] += shift;
                    self.errors(case, &shifted)
                });
                above.iter().zip(&below).map(|(above, below)| (above - below) / (2.0 * SHIFT)).collect()
            });
            let weighed = errors.weighed(kind, &self.errors(case, parameters));
            let solved = slopes.each_ref().map(|it| errors.solved(kind, it));
            let curvature = |row: usize, column: usize| weighed.weight * dot(&solved[row], &slopes[column]);
            Part {
                driver: case.driver,
                slope: slopes.each_ref().map(|it| -dot(&weighed.slope, it)),
                curvature: std::array::from_fn(|row| std::array::from_fn(|column| curvature(row, column))),
            }
        };
        self.cases.par_iter().map(of).collect()
    }

    /// The slope of the penalised log-likelihood, and its expected curvature, of the `free` parameters.
    fn sums(&self, parts: &[Part], parameters: &Parameters, free: &[usize]) -> (Vec<f64>, Matrix) {
        const PRECISION: f64 = 1.0 / (PRIOR * PRIOR);
        let (mut slope, mut curvature) = (vec![0.0; free.len()], Matrix::zeros(free.len()));
        for part in parts {
            for (row, at) in free.iter().enumerate() {
                slope[row] += part.slope[*at];
                for (column, other) in free.iter().enumerate() {
                    curvature[(row, column)] += part.curvature[*at][*other];
                }
            }
        }
        for (row, at) in free.iter().enumerate() {
            slope[row] -= PRECISION * (parameters[*at] - self.prior[*at]);
            curvature[(row, row)] += PRECISION;
        }
        (slope, curvature)
    }
}
