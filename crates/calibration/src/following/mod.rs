//! How drivers follow: the numbers of the car-following model that explain recorded drivers.
//!
//! `look.rs` notes about once a second what every driver sees and whether it only follows; `episode.rs` finds the times
//! in which it has one leader, or none, and `stretch.rs` cuts these into stretches of equal length. `predict.rs`
//! simulates a driver through a stretch, and `errors.rs` says how much the errors of such a prediction count.
//! `problem.rs` and `maximum.rs` find the numbers that explain all stretches best, `fit.rs` says how sure they are, and
//! `score.rs` how well they predict drivers who were not seen.

mod episode;
mod errors;
mod fit;
mod look;
mod maximum;
mod numbers;
mod predict;
mod problem;
mod score;
mod stretch;
#[cfg(test)]
mod tests;

use laneweave_models::Style;
use laneweave_recorded::ReplayError;
use laneweave_recordings::Matched;
use laneweave_sim::Navigator;

use crate::held_out::Folds;

pub use fit::{FittedNumber, FollowingFit, NotFitted};
pub use score::{FollowingScore, Wrong};

/// Drivers of recordings, as far as they follow or are free.
#[derive(Clone, Debug, Default)]
pub struct Followers {
    drivers: Vec<episode::Followed>,
}

impl Followers {
    /// Adds the drivers of the recording of `matched`, as drivers of `style` see their road.
    ///
    /// # Errors
    /// If the style's numbers make no sense for a driver.
    pub fn add(
        &mut self,
        matched: &Matched<'_>,
        navigator: &Navigator,
        style: &Style,
    ) -> Result<(), ReplayError> {
        self.drivers.extend(episode::followed(matched, navigator, style)?);
        Ok(())
    }

    /// The numbers of the car-following model of `style` that explain these drivers best: near those of the style as
    /// far as nothing is seen. With `draws` of a bootstrap over drivers, who are held out as `folds` says.
    ///
    /// # Errors
    /// If the model cannot be fitted, or too few drivers were seen.
    pub fn fit(&self, style: &Style, folds: &Folds, draws: u32) -> Result<FollowingFit, NotFitted> {
        fit::fit(style, &self.drivers, folds, draws)
    }
}

impl FollowingFit {
    /// `style` with the fitted numbers of its car-following model.
    pub fn fitted(&self, style: &Style) -> Style {
        fit::fitted(style, self)
    }
}
