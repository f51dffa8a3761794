//! The roads, and what drivers know of them.

use std::sync::{Arc, OnceLock};

use laneweave_models::Style;
use laneweave_network::{Ground, LaneletIndex, Network};

use crate::route::class_restrictions::ClassRestrictions;
use crate::route::closures::Closures;
use crate::route::fitting_speed::Outlook;
use crate::route::guidance::Guidance;
use crate::route::navigate::Navigator;
use crate::route::place::Place;
use crate::route::renew_routes::Guided;
use crate::route::standing::Standing;
use crate::state::clock::Clock;
use crate::state::driver_parameters::DriverParameters;
use crate::state::lane::{DriverState, Lane};
use crate::state::random::Random;

/// What a step only reads, except for the routes of guidance: roads, driver parameters and random numbers. Copies share
/// all of it that is large, until one of them changes it.
#[derive(Clone)]
pub(crate) struct Roads {
    network: Arc<Network>,
    navigator: Navigator,
    driver_parameters: Arc<DriverParameters>,
    random: Random,
    /// Route guidance, if drivers are guided.
    guidance: Option<Guidance>,
    /// The ground, once it is needed.
    ground: Arc<OnceLock<Ground>>,
}

impl Roads {
    /// The roads of `network`, with routes to `destinations`, the last ones of which are `stops`, for classes with
    /// these `restrictions`, without guidance.
    pub(crate) fn new(
        network: Arc<Network>,
        driver_parameters: Vec<Style>,
        (destinations, stops): (&[Place], usize),
        restrictions: ClassRestrictions,
        random: Random,
    ) -> Roads {
        let navigator = Navigator::with_restrictions(&network, destinations, restrictions, stops);
        let driver_parameters = Arc::new(DriverParameters::new(driver_parameters));
        Roads { network, navigator, driver_parameters, random, guidance: None, ground: Arc::default() }
    }

    /// The same roads with the random numbers of another seed.
    pub(crate) fn with_seed(&self, seed: u64) -> Roads {
        Roads { random: Random::new(seed), ..self.clone() }
    }

    #[inline]
    pub(crate) fn network(&self) -> &Network {
        &self.network
    }

    /// The network, shared with users outside the world: it never changes.
    pub(crate) fn shared_network(&self) -> Arc<Network> {
        Arc::clone(&self.network)
    }

    /// The ground, for vehicles that do not drive along lanes.
    pub(crate) fn ground(&self) -> &Ground {
        self.ground.get_or_init(|| Ground::new(&self.network))
    }

    /// The navigator, which has the routes.
    #[inline]
    pub(crate) fn navigator(&self) -> &Navigator {
        &self.navigator
    }

    /// Closes these lanelets to all vehicles, and opens all others.
    pub(crate) fn close(&mut self, closed: Vec<LaneletIndex>) {
        let standing = self.navigator.closures().standing().to_vec();
        self.navigator.close(Closures::of(&self.network, closed, standing));
    }

    /// Lets drivers know what stands in lanes.
    pub(crate) fn note_standing(&mut self, standing: Vec<Standing>) {
        let closed = self.navigator.closures().closed().to_vec();
        self.navigator.close(Closures::of(&self.network, closed, standing));
    }

    /// All sets of driver parameters.
    #[inline]
    pub(crate) fn driver_parameters(&self) -> &[Style] {
        self.driver_parameters.sets()
    }

    /// The driver at this index in the table of driver parameters.
    #[inline]
    pub(crate) fn style(&self, parameters: u32) -> &Style {
        &self.driver_parameters()[parameters as usize]
    }

    /// The road ahead of a driver.
    #[inline]
    pub(crate) fn outlook(&self, driver: &DriverState) -> Outlook<'_> {
        let (network, navigator, style) = (self.network(), self.navigator(), self.style(driver.parameters));
        Outlook { network, navigator, style, class: driver.class, destination: driver.goal.destination() }
    }

    /// All sets of driver parameters, with what users changed in them.
    pub(crate) fn changed_parameters(&self) -> &DriverParameters {
        &self.driver_parameters
    }

    /// The same, mutable. Their number stays the same.
    pub(crate) fn changed_parameters_mut(&mut self) -> &mut DriverParameters {
        Arc::make_mut(&mut self.driver_parameters)
    }

    /// The random numbers.
    #[inline]
    pub(crate) fn random(&self) -> Random {
        self.random
    }

    /// The random numbers of drivers' errors in what they see; `None` if all drivers see everything as it is.
    #[inline]
    pub(crate) fn errors(&self) -> Option<Random> {
        self.driver_parameters.misperceive().then_some(self.random)
    }

    /// Guides drivers to `destinations` from now on, with a measurement every `period` steps.
    ///
    /// # Errors
    /// The greatest number of destinations, if there are more.
    pub(crate) fn guide(&mut self, destinations: &[Place], period: u32) -> Result<(), usize> {
        self.navigator.guide(&self.network, destinations)?;
        self.guidance = Some(Guidance::new(self.navigator.links(), period));
        Ok(())
    }

    /// Continues guidance to `destinations`, if there is any, at `clock` with the vehicles on these lanes.
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

    /// Whether guidance can continue from `guided`.
    pub(crate) fn accepts(&self, guided: Option<&(Guidance, Guided)>) -> bool {
        let Roads { navigator, guidance, .. } = self;
        match (guided, guidance) {
            (Some((other, guided)), Some(_)) => {
                other.fits(navigator.links().all().len(), navigator.tables()) && navigator.accepts(guided)
            }
            (one, other) => one.is_none() && other.is_none(),
        }
    }

    /// Continues guidance from `guided`, which these roads accept.
    pub(crate) fn restore(&mut self, guided: Option<(Guidance, Guided)>) {
        self.guidance = None;
        if let Some((guidance, guided)) = guided {
            self.guidance = Some(guidance);
            self.navigator.go_on(&self.network, guided);
        }
    }
}
