//! Calibration: recorded traffic in, driving styles with their uncertainty out.
//!
//! [`observe`] turns a matched recording into what every driver saw on both sides, second by second, and the change
//! that began. A [`DesireModel`] picks the terms of G, which gives a design: numbers only. [`waiting`] has the
//! likelihood of the hidden process free → wants → changes, with its gradient; `choice.rs` has that of choices which
//! were observed exactly.
//!
//! [`following`] fits how drivers follow: the numbers of their car-following model. [`gaps`] fits which gaps they
//! accept.
//!
//! `study.rs` puts a fit of lane changes together: spreads of priors (`place_spread.rs`), the profile of β (`beta.rs`),
//! bootstrap, what is identified (`fitted.rs`), classes (`classes.rs`), held-out drivers (`held_out.rs`) and what is
//! supposed of them (`split.rs`). Gradients are added up in chunks of fixed size, so that
//! the number of threads changes nothing.

mod beta;
mod choice;
mod classes;
mod correction;
mod desire_model;
mod extrapolation;
mod fitted;
pub mod following;
pub mod gaps;
mod held_out;
mod matrix;
mod maximise;
pub mod measures;
pub mod observe;
mod paper;
mod place_spread;
mod plan;
mod prior;
mod resample;
mod return_rate;
mod split;
mod study;
pub mod waiting;

pub use beta::BetaProfile;
pub use choice::{Choices, Epoch, Fit, sampling_correction};
pub use classes::{Mixture, are_two};
pub use desire_model::{DesireModel, assumptions};
pub use extrapolation::{Estimate, MULTIPLES, extrapolated};
pub use fitted::Fitted;
pub use held_out::{Candidate, Difference, Folds};
pub use matrix::Matrix;
pub use paper::{PaperGroup, by_paper};
pub use place_spread::{PlaceSpread, effect};
pub use plan::{Expected, expected};
pub use prior::Prior;
pub use resample::resampled;
pub use return_rate::{Attempt, ReturnRate, return_rate};
pub use split::{Splits, Supposed};
pub use study::{Asked, Classes, Compared, PriorWeights, Study};
