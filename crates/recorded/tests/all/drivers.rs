//! A driver for tests.

use laneweave_models::change::{LaneChangeModel, Mcdm, Safety};
use laneweave_models::follow::{FollowingModel, Idm};
use laneweave_models::yielding::Yielding;
use laneweave_models::{Attention, Guidance, Manner, Style};

/// A driver who keeps to the limit, with the usual numbers of all models.
pub(crate) fn usual() -> Style {
    Style {
        name: "usual".into(),
        description: String::new(),
        speed_factor: 1.0,
        follow: FollowingModel::Idm(Idm::default()),
        change: LaneChangeModel::Mcdm(Mcdm::default()),
        safety: Safety::default(),
        attention: Attention::default(),
        manner: Manner::default(),
        yielding: Yielding::default(),
        guidance: Guidance::default(),
    }
}
