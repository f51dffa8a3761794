//! A style for unit tests to which the numbers of drivers do not matter.

use laneweave_models::Style;
use laneweave_models::change::{LaneChangeModel, Mcdm};
use laneweave_models::follow::{FollowingModel, Idm};

/// The defaults of all models.
pub(crate) fn some_style() -> Style {
    Style {
        name: "some".into(),
        description: String::new(),
        speed_factor: 1.0,
        follow: FollowingModel::Idm(Idm::default()),
        change: LaneChangeModel::Mcdm(Mcdm::default()),
        safety: Default::default(),
        attention: Default::default(),
        manner: Default::default(),
        yielding: Default::default(),
        guidance: Default::default(),
    }
}
