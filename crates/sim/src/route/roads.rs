//! The roads, and what those who drive there know of them.

use std::sync::Arc;

use laneweave_models::Style;
use laneweave_network::Network;

use crate::route::class_restrictions::ClassRestrictions;
use crate::route::guidance::Guidance;
use crate::route::navigate::Navigator;
use crate::route::place::Place;
use crate::route::renew::Guided;
use crate::state::clock::Clock;
use crate::state::lane::Lane;
use crate::state::random::Random;
use crate::state::vehicle::Fleet;

/// What a step only reads, but for the ways of those who are guided: roads, drivers and chance.
pub(crate) struct Roads {
    network: Arc<Network>,
    navigator: Navigator,
    /// All different drivers.
    driver_parameters: Vec<Style>,
    random: Random,
    /// Where drivers are guided.
    guidance: Option<Guidance>,
}

impl Roads {
    /// The roads of `network`, with ways to `destinations` for the classes of `fleet`; nobody is guided.
    pub(crate) fn new(
        network: Arc<Network>,
        driver_parameters: Vec<Style>,
        destinations: &[Place],
        fleet: &Fleet,
        random: Random,
    ) -> Roads {
        let restrictions = ClassRestrictions::of(&network, fleet);
        let navigator = Navigator::with_restrictions(&network, destinations, restrictions);
        Roads { network, navigator, driver_parameters, random, guidance: None }
    }

    /// The network.
    #[inline]
    pub(crate) fn network(&self) -> &Network {
        &self.network
    }

    /// The network, for those who need it beyond the world: it never changes.
    pub(crate) fn shared_network(&self) -> Arc<Network> {
        Arc::clone(&self.network)
    }

    /// The ways.
    #[inline]
    pub(crate) fn navigator(&self) -> &Navigator {
        &self.navigator
    }

    /// All different drivers.
    #[inline]
    pub(crate) fn driver_parameters(&self) -> &[Style] {
        &self.driver_parameters
    }

    /// The driver at this place in the table of all different ones.
    #[inline]
    pub(crate) fn style(&self, parameters: u32) -> &Style {
        &self.driver_parameters[parameters as usize]
    }

    /// Each driver becomes the one in its place among `driver_parameters`, of which there are as many.
    pub(crate) fn change_driver_parameters(&mut self, driver_parameters: Vec<Style>) {
        self.driver_parameters = driver_parameters;
    }

    /// The random numbers.
    #[inline]
    pub(crate) fn random(&self) -> Random {
        self.random
    }

    /// Drivers are guided to `destinations` from now on, by measurements every `period` steps.
    ///
    /// # Errors
    /// The greatest number of destinations, if there are more.
    pub(crate) fn guide(&mut self, destinations: &[Place], period: u32) -> Result<(), usize> {
        self.navigator.guide(&self.network, destinations)?;
        self.guidance = Some(Guidance::new(self.navigator.links(), period));
        Ok(())
    }

    /// Guidance to `destinations`, if there is any, goes on at `clock` with the vehicles on these lanes.
    pub(crate) fn go_on_guiding(&mut self, lanes: &[Lane], destinations: &[Place], clock: Clock) {
        let Roads { network, navigator, guidance, .. } = self;
        if let Some(guidance) = guidance {
            guidance.advance(network, navigator, lanes, destinations, clock);
        }
    }

    /// Guidance, and what it has changed.
    pub(crate) fn guided(&self) -> Option<(&Guidance, Guided)> {
        self.guidance.as_ref().map(|it| (it, self.navigator.guided()))
    }

    /// Whether guidance can go on from what it had changed.
    pub(crate) fn accepts(&self, guided: Option<&(Guidance, Guided)>) -> bool {
        let Roads { navigator, guidance, .. } = self;
        match (guided, guidance) {
            (Some((other, guided)), Some(_)) => {
                other.fits(navigator.links().all().len(), navigator.tables()) && navigator.accepts(guided)
            }
            (one, other) => one.is_none() && other.is_none(),
        }
    }

    /// Guidance goes on from what it had changed, which these roads accept.
    pub(crate) fn restore(&mut self, guided: Option<(Guidance, Guided)>) {
        self.guidance = None;
        if let Some((guidance, guided)) = guided {
            self.guidance = Some(guidance);
            self.navigator.go_on(&self.network, guided);
        }
    }
}
