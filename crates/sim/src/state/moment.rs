//! The instant at which drivers decide.

use laneweave_network::Side;

use crate::state::clock::Clock;
use crate::state::random::Random;

/// What decisions need besides the scene.
#[derive(Clone, Copy)]
pub(crate) struct Moment {
    pub(crate) clock: Clock,
    pub(crate) random: Random,
    pub(crate) overtaking: Side,
}
