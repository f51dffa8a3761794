//! The parameters of the hidden process, as one vector.
//!
//! | part | meaning | how it stands in the vector |
//! |---|---|---|
//! | intercept | −θ/σ | as it is |
//! | terms | μ/σ of each term of G | as they are |
//! | background | ε: chance per second of a desire for a side that nothing in the record explains | logit |
//! | giving up | chance per second that who waits gives up | logit |
//! | waiting | chance that a driver already waits when its spell begins | logit |
//! | spread | standard deviation of the drivers' own intercepts | logarithm |
//! | acceptance | intercept and slopes of the logit by which a gap is accepted within a second | as they are |
//! | places | intercepts of places | as they are |

use std::ops::Range;

use super::design::{Design, GAP_TERMS};

/// Number of parameters beside terms and places.
const OTHERS: usize = 6 + GAP_TERMS;

/// Where each parameter stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Number of terms of G.
    pub terms: usize,
    /// Number of places.
    pub strata: usize,
}

impl Layout {
    /// That of `design`.
    pub fn of(design: &Design) -> Layout {
        Layout { terms: design.terms, strata: design.strata }
    }

    /// Number of parameters.
    pub fn count(&self) -> usize {
        OTHERS + self.terms + self.strata
    }

    /// The intercept.
    pub fn intercept(&self) -> usize {
        0
    }

    /// The terms of G.
    pub fn slopes(&self) -> Range<usize> {
        1..1 + self.terms
    }

    /// logit ε.
    pub fn background(&self) -> usize {
        1 + self.terms
    }

    /// The logit of giving up.
    pub fn giving_up(&self) -> usize {
        2 + self.terms
    }

    /// The logit of waiting at the begin.
    pub fn waiting(&self) -> usize {
        3 + self.terms
    }

    /// The logarithm of the spread.
    pub fn spread(&self) -> usize {
        4 + self.terms
    }

    /// Gap acceptance: its intercept and its slopes.
    pub fn acceptance(&self) -> Range<usize> {
        5 + self.terms..6 + GAP_TERMS + self.terms
    }

    /// The intercepts of places.
    pub fn places(&self) -> Range<usize> {
        OTHERS + self.terms..self.count()
    }
}

/// 1/(1 + e^(−x)).
pub fn logistic(x: f64) -> f64 {
    1.0 / (1.0 + libm::exp(-x))
}

/// ln(p/(1 − p)).
pub fn logit(p: f64) -> f64 {
    libm::log(p / (1.0 - p))
}
