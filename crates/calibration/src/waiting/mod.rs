//! Drivers who wait: from recorded begins of changes to the weights of the desire that came before.
//!
//! `second.rs` has the likelihood of one second, `likelihood.rs` that of one driver, and `fit.rs` that of all of them.
//! `predict.rs` has what drivers are predicted to do.

mod design;
mod fit;
mod likelihood;
mod parameters;
mod predict;
mod quadrature;
mod second;

pub use design::{Design, Driver, GAP_TERMS, MOST_NODES, NO_STRATUM, Spell};
pub use fit::{Assumptions, WaitingFit};
pub use parameters::{Layout, logistic, logit};
