//! What a recording can tell before anything is fitted: expected errors of the weights.
//!
//! Changes are rare, so the information about the weights is the number of changes times the covariance of the yields:
//! se = √((n Cov(x))⁻¹). This is what a plain logit would have; waiting, unknown desired speeds and places cost more.

use crate::matrix::{Cholesky, Matrix, add};
use crate::waiting::Design;

/// What is expected of one weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// The name of its term.
    pub name: &'static str,
    /// Its expected standard error; infinite if the term never differs.
    pub standard_error: f64,
    /// How many changes would be needed so that the 95 % interval is a quarter of the prior weight to either side.
    pub changes_for_a_quarter: f64,
}

/// The expected errors of the weights of `design`, whose terms have these names and prior weights, from `changes`
/// changes.
pub fn expected(design: &Design, names: &[&'static str], means: &[f64], changes: usize) -> Vec<Expected> {
    /// Half the width of a 95 % interval in standard errors, and the share of the weight that it may be.
    const HALF: f64 = 1.959_964;
    const QUARTER: f64 = 0.25;
    let spread = inverse_of_covariance(design);
    let each = names.iter().zip(means).zip(spread);
    each.map(|((name, mean), variance)| {
        let error_of_one = variance.sqrt();
        let ratio = HALF * error_of_one / (QUARTER * mean.abs());
        Expected {
            name,
            standard_error: error_of_one / (changes as f64).sqrt(),
            changes_for_a_quarter: (ratio * ratio).ceil(),
        }
    })
    .collect()
}

/// The diagonal of the inverse of the covariance of the terms, over all rows; infinite for terms that never differ.
fn inverse_of_covariance(design: &Design) -> Vec<f64> {
    let (terms, rows) = (design.terms, design.gaps.len());
    let node = design.nodes / 2;
    let mut mean = vec![0.0; terms];
    let mut covariance = Matrix::zeros(terms);
    for row in 0..rows {
        let values = design.row(row, node);
        add(&mut mean, 1.0 / rows as f64, values);
        covariance.add_outer(1.0 / rows as f64, values, values);
    }
    covariance.add_outer(-1.0, &mean, &mean);
    let known: Vec<usize> = (0..terms).filter(|it| covariance[(*it, *it)] > 1e-12).collect();
    let mut variances = vec![f64::INFINITY; terms];
    if let Some(factored) = Cholesky::of(&covariance.part(&known)) {
        let found = factored.inverse();
        known.iter().zip(found.diagonal()).for_each(|(term, variance)| variances[*term] = variance);
    }
    variances
}
