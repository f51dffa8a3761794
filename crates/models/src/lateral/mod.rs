//! How a lane change moves a vehicle sideways: how fast the change progresses, and how far across the vehicle is.
//!
//! A lateral model gives the lateral position of a vehicle after a share of the time of its change. The style gives
//! this time ([`crate::Manner::duration`]); a slow vehicle needs more of it, whatever the model ([`Crossing`]).

mod crossing;
mod quintic;

pub use crossing::Crossing;
pub use quintic::{moved_share, peak_lateral_acceleration, peak_lateral_speed};

use serde::{Deserialize, Serialize};

/// A lateral model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LateralModel {
    /// A quintic in time, without lateral speed and acceleration at both ends.
    #[default]
    Quintic,
}

impl LateralModel {
    /// Lateral progress after the share `progress` of the time, both 0…1. At half of the time it is one half: then the
    /// vehicle's centre crosses the line.
    #[inline]
    pub fn moved_share(self, progress: f64) -> f64 {
        match self {
            LateralModel::Quintic => quintic::moved_share(progress),
        }
    }

    /// Lateral progress of the front and of the rear bumper after the share `progress` of the time. Both follow one
    /// path, the rear bumper later, so that a long vehicle does not swing out.
    #[inline]
    pub fn bumpers(self, crossing: Crossing, progress: f64) -> [f64; 2] {
        // Half the vehicle as a share of the distance that the change takes; it fades in and out with the change.
        let half = 0.5 * crossing.length / crossing.way() * 4.0 * progress * (1.0 - progress);
        [progress + half, progress - half].map(|it| self.moved_share(it))
    }
}
