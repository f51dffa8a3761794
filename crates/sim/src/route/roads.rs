//! The roads, and what those who drive there know of them.

use std::sync::Arc;

use laneweave_models::Style;
use laneweave_network::Network;

use crate::route::guidance::Guidance;
use crate::route::navigate::Navigator;
use crate::route::place::Place;
use crate::route::views::Views;
use crate::state::random::Random;
use crate::state::vehicle::Fleet;

/// What a step only reads, but for the ways of those who are guided: roads, drivers and chance.
pub(crate) struct Roads {
    pub(crate) network: Arc<Network>,
    pub(crate) navigator: Navigator,
    /// All different drivers.
    pub(crate) characters: Vec<Style>,
    /// The draws.
    pub(crate) random: Random,
    /// Where drivers are guided.
    pub(crate) guidance: Option<Guidance>,
}

impl Roads {
    /// The roads of `network`, with ways to `destinations` for the classes of `fleet`; nobody is guided.
    pub(crate) fn new(
        network: Arc<Network>,
        characters: Vec<Style>,
        destinations: &[Place],
        fleet: &Fleet,
        random: Random,
    ) -> Roads {
        let views = Views::of(&network, fleet);
        let navigator = Navigator::with_views(&network, destinations, views);
        Roads { network, navigator, characters, random, guidance: None }
    }
}
