//! The maximum of a smooth function by quasi-Newton steps (BFGS: Broyden, Fletcher, Goldfarb, Shanno 1970).

use nalgebra::{DMatrix, DVector};

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
    pub(crate) at: DVector<f64>,
    pub(crate) value: f64,
    /// An estimate of the inverse of the negative Hessian.
    pub(crate) inverse: DMatrix<f64>,
    pub(crate) is_converged: bool,
}

/// Searches the maximum of `evaluate`, which returns the value and the gradient, from `start` on, until a step promises
/// less than `least_gain`. `inverse` is a guess of the inverse of the negative Hessian there.
pub(crate) fn maximise(
    start: DVector<f64>,
    inverse: DMatrix<f64>,
    least_gain: f64,
    mut evaluate: impl FnMut(&DVector<f64>) -> (f64, DVector<f64>),
) -> Maximum {
    let (value, mut gradient) = evaluate(&start);
    let mut best = Maximum { at: start, value, inverse, is_converged: false };
    for _ in 0..STEPS {
        let mut step = &best.inverse * &gradient;
        let mut promised = step.dot(&gradient);
        if promised.is_nan() || promised <= 0.0 {
            // The guess is no longer positive definite: begin again along the gradient.
            best.inverse = DMatrix::identity(gradient.len(), gradient.len()) / gradient.norm().max(1.0);
            step = &best.inverse * &gradient;
            promised = step.dot(&gradient);
        }
        if promised < least_gain {
            best.is_converged = true;
            break;
        }
        let Some((length, value, next)) = along(&best, &step, promised, &mut evaluate) else { break };
        let moved = length * &step;
        update(&mut best.inverse, &moved, &(&gradient - &next));
        (best.at, best.value, gradient) = (&best.at + moved, value, next);
    }
    best
}

/// A point along `step` with enough gain: its share of the step, the value and the gradient there.
fn along(
    best: &Maximum,
    step: &DVector<f64>,
    promised: f64,
    evaluate: &mut impl FnMut(&DVector<f64>) -> (f64, DVector<f64>),
) -> Option<(f64, f64, DVector<f64>)> {
    let mut length = 1.0;
    for _ in 0..HALVINGS {
        let (value, gradient) = evaluate(&(&best.at + length * step));
        if value >= best.value + ENOUGH * length * promised && gradient.iter().all(|it| it.is_finite()) {
            return Some((length, value, gradient));
        }
        length *= 0.5;
    }
    None
}

/// Corrects the guess of the inverse: over the step `moved` the gradient fell by `fell`.
fn update(inverse: &mut DMatrix<f64>, moved: &DVector<f64>, fell: &DVector<f64>) {
    let curvature = moved.dot(fell);
    if curvature <= 1e-12 * moved.norm() * fell.norm() {
        return;
    }
    let turned = &*inverse * fell;
    let scale = (curvature + fell.dot(&turned)) / (curvature * curvature);
    inverse.ger(scale, moved, moved, 1.0);
    inverse.ger(-1.0 / curvature, &turned, moved, 1.0);
    inverse.ger(-1.0 / curvature, moved, &turned, 1.0);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_finds_the_top_of_a_bent_ridge() {
        // The negative of Rosenbrock's function (1960): the maximum is 0 at (1, 1).
        let evaluate = |it: &DVector<f64>| {
            let (x, y) = (it[0], it[1]);
            let off = y - x * x;
            let value = -(1.0 - x) * (1.0 - x) - 100.0 * off * off;
            let gradient = DVector::from_vec(vec![2.0 * (1.0 - x) + 400.0 * x * off, -200.0 * off]);
            (value, gradient)
        };
        let start = DVector::from_vec(vec![-1.2, 1.0]);
        let maximum = maximise(start, DMatrix::identity(2, 2) * 1e-3, EXACT, evaluate);
        assert!(maximum.is_converged);
        assert!((maximum.at[0] - 1.0).abs() < 1e-4 && (maximum.at[1] - 1.0).abs() < 1e-4);
        assert!(maximum.value > -1e-9);
    }

    #[test]
    fn the_inverse_becomes_that_of_the_hessian() {
        // −(x² + 2 y² + xy): the negative Hessian is [[2, 1], [1, 4]].
        let evaluate = |it: &DVector<f64>| {
            let (x, y) = (it[0], it[1]);
            (-(x * x + 2.0 * y * y + x * y), DVector::from_vec(vec![-2.0 * x - y, -4.0 * y - x]))
        };
        let maximum = maximise(DVector::from_vec(vec![3.0, -2.0]), DMatrix::identity(2, 2), EXACT, evaluate);
        let exact = DMatrix::from_row_slice(2, 2, &[4.0, -1.0, -1.0, 2.0]) / 7.0;
        assert!((maximum.inverse - exact).norm() < 1e-3);
    }
}
