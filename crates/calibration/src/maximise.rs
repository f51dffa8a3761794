//! The maximum of a smooth function by quasi-Newton steps (BFGS: Broyden, Fletcher, Goldfarb, Shanno 1970).

use crate::matrix::{Matrix, add, dot, norm};

/// The search ends where the next step promises less than this gain of log-likelihood: the estimates are then exact to
/// about the root of twice this share of a standard error.
pub(crate) const EXACT: f64 = 1e-9;
pub(crate) const ROUGH: f64 = 1e-4;
/// Most steps.
const STEPS: usize = 400;
/// Most halvings of one step.
const HALVINGS: usize = 40;
/// Share of the promised gain that a step has to bring (Armijo).
const ENOUGH: f64 = 1e-4;

#[derive(Clone, Debug)]
pub(crate) struct Maximum {
    pub(crate) at: Vec<f64>,
    pub(crate) value: f64,
    /// An estimate of the inverse of the negative Hessian.
    pub(crate) inverse: Matrix,
    pub(crate) is_converged: bool,
}

/// Searches the maximum of `evaluate`, which returns the value and the gradient, from `start` on, until a step promises
/// less than `least_gain`. `inverse` is a guess of the inverse of the negative Hessian there.
pub(crate) fn maximise(
    start: Vec<f64>,
    inverse: Matrix,
    least_gain: f64,
    mut evaluate: impl FnMut(&[f64]) -> (f64, Vec<f64>),
) -> Maximum {
    let (value, mut gradient) = evaluate(&start);
    let mut best = Maximum { at: start, value, inverse, is_converged: false };
    for _ in 0..STEPS {
        let mut step = best.inverse.times(&gradient);
        let mut promised = dot(&step, &gradient);
        if promised.is_nan() || promised <= 0.0 {
            // The guess is no longer positive definite: begin again along the gradient.
            best.inverse = Matrix::from_diagonal(&vec![1.0 / norm(&gradient).max(1.0); gradient.len()]);
            step = best.inverse.times(&gradient);
            promised = dot(&step, &gradient);
        }
        if promised < least_gain {
            best.is_converged = true;
            break;
        }
        let Some((length, value, next)) = along(&best, &step, promised, &mut evaluate) else { break };
        step.iter_mut().for_each(|it| *it *= length);
        let fell: Vec<f64> = gradient.iter().zip(&next).map(|(before, after)| before - after).collect();
        update(&mut best.inverse, &step, &fell);
        add(&mut best.at, 1.0, &step);
        (best.value, gradient) = (value, next);
    }
    best
}

/// A point along `step` with enough gain: its share of the step, the value and the gradient there.
fn along(
    best: &Maximum,
    step: &[f64],
    promised: f64,
    evaluate: &mut impl FnMut(&[f64]) -> (f64, Vec<f64>),
) -> Option<(f64, f64, Vec<f64>)> {
    let mut length = 1.0;
    for _ in 0..HALVINGS {
        let mut at = best.at.clone();
        add(&mut at, length, step);
        let (value, gradient) = evaluate(&at);
        if value >= best.value + ENOUGH * length * promised && gradient.iter().all(|it| it.is_finite()) {
            return Some((length, value, gradient));
        }
        length *= 0.5;
    }
    None
}

/// Corrects the guess of the inverse: over the step `moved` the gradient fell by `fell`.
fn update(inverse: &mut Matrix, moved: &[f64], fell: &[f64]) {
    let curvature = dot(moved, fell);
    if curvature <= 1e-12 * norm(moved) * norm(fell) {
        return;
    }
    let turned = inverse.times(fell);
    let scale = (curvature + dot(fell, &turned)) / (curvature * curvature);
    inverse.add_outer(scale, moved, moved);
    inverse.add_outer(-1.0 / curvature, &turned, moved);
    inverse.add_outer(-1.0 / curvature, moved, &turned);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_finds_the_top_of_a_bent_ridge() {
        // The negative of Rosenbrock's function (1960): the maximum is 0 at (1, 1).
        let evaluate = |it: &[f64]| {
            let (x, y) = (it[0], it[1]);
            let off = y - x * x;
            let value = -(1.0 - x) * (1.0 - x) - 100.0 * off * off;
            let gradient = vec![2.0 * (1.0 - x) + 400.0 * x * off, -200.0 * off];
            (value, gradient)
        };
        let maximum = maximise(vec![-1.2, 1.0], Matrix::from_diagonal(&[1e-3; 2]), EXACT, evaluate);
        assert!(maximum.is_converged);
        assert!((maximum.at[0] - 1.0).abs() < 1e-4 && (maximum.at[1] - 1.0).abs() < 1e-4);
        assert!(maximum.value > -1e-9);
    }

    #[test]
    fn a_step_that_gains_next_to_nothing_of_what_it_promised_is_halved() {
        let best = Maximum {
            at: vec![0.0],
            value: 0.0,
            inverse: Matrix::from_diagonal(&[1.0]),
            is_converged: false,
        };
        // It promises 100, and gains a hundredth of a thousandth of that; half of it gains a tenth.
        let mut evaluate = |at: &[f64]| (if at[0] > 0.9 { 1e-3 } else { 10.0 }, vec![0.0]);
        let (length, value, _) = along(&best, &[1.0], 100.0, &mut evaluate).expect("half of it gains");
        assert_eq!((length, value), (0.5, 10.0));
    }

    #[test]
    fn the_inverse_becomes_that_of_the_hessian() {
        // −(x² + 2 y² + xy): the negative Hessian is [[2, 1], [1, 4]].
        let evaluate = |it: &[f64]| {
            let (x, y) = (it[0], it[1]);
            (-(x * x + 2.0 * y * y + x * y), vec![-2.0 * x - y, -4.0 * y - x])
        };
        let maximum = maximise(vec![3.0, -2.0], Matrix::from_diagonal(&[1.0; 2]), EXACT, evaluate);
        let exact = [[4.0, -1.0], [-1.0, 2.0]];
        let off = |row: usize, column: usize| maximum.inverse[(row, column)] - exact[row][column] / 7.0;
        assert!(norm(&[off(0, 0), off(0, 1), off(1, 0), off(1, 1)]) < 1e-3);
    }
}
