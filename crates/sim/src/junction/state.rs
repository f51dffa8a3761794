//! What controls the junctions at one instant.

use laneweave_network::{InPlan, LightIndex, LightState, Network};
use serde::{Deserialize, Serialize};

use crate::junction::reservations::Reservations;
use crate::junction::signals::Signals;
use crate::state::clock::Clock;
use crate::state::lane::Lane;

/// Reservations and signals.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct JunctionState {
    reservations: Reservations,
    signals: Signals,
}

impl JunctionState {
    /// No reservations on `network` yet; the lights show their states at `clock`.
    pub(crate) fn new(network: &Network, clock: Clock) -> JunctionState {
        JunctionState { reservations: Reservations::new(network), signals: Signals::new(network, clock) }
    }

    #[inline]
    pub(crate) fn reservations(&self) -> &Reservations {
        &self.reservations
    }

    /// The reservations, mutable.
    pub(crate) fn reservations_mut(&mut self) -> &mut Reservations {
        &mut self.reservations
    }

    #[inline]
    pub(crate) fn signals(&self) -> &Signals {
        &self.signals
    }

    /// Updates the lights at `clock`, with these vehicles on their detectors.
    pub(crate) fn switch(&mut self, network: &Network, lanes: &[Lane], clock: Clock) {
        self.signals.switch(network, lanes, clock);
    }

    /// Makes a light show a state from `clock` on, whatever its program says; `None`: it follows its program again.
    pub(crate) fn set_light(
        &mut self,
        network: &Network,
        light: LightIndex,
        shows: Option<LightState>,
        clock: Clock,
    ) {
        self.signals.set(network, light, shows, clock);
    }

    /// Gives the plan of a light, with cycles of this length [s], another offset [s].
    pub(crate) fn set_offset(&mut self, plan: InPlan, cycle: f64, offset: f64) {
        self.signals.set_offset(plan, cycle, offset);
    }

    /// Whether it has the same network and programs as `other`, at `clock`.
    pub(crate) fn fits(&self, other: &JunctionState, clock: Clock) -> bool {
        let JunctionState { reservations, signals } = self;
        signals.fits(&other.signals, clock) && reservations.fits(&other.reservations, signals.count(), clock)
    }
}
