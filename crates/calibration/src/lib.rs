//! Calibration: recorded traffic in, driving styles with their uncertainty out.

mod choice;
mod classes;
mod correction;
mod desire_model;
mod extrapolation;
mod held_out;
mod maximise;
pub mod measures;
pub mod observe;
mod paper;
mod place_spread;
mod plan;
mod prior;
mod resample;
mod return_rate;
mod study;
pub mod waiting;

pub use choice::{Choices, Epoch, Fit, sampling_correction};
pub use classes::{Mixture, are_two};
pub use desire_model::{DesireModel, assumptions};
pub use extrapolation::{Estimate, MULTIPLES, extrapolated};
pub use held_out::{Candidate, Difference, Folds};
pub use paper::{PaperGroup, by_paper};
pub use place_spread::{PlaceSpread, effect};
pub use plan::{Expected, expected};
pub use prior::Prior;
pub use resample::resampled;
pub use return_rate::{Attempt, ReturnRate, return_rate};
pub use study::{Asked, BetaProfile, Classes, Compared, Fitted, PriorWeights, Study};
