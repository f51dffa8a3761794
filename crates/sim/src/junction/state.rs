//! What governs the junctions at an instant.

use laneweave_network::Network;
use serde::{Deserialize, Serialize};

use crate::junction::reservations::Reservations;
use crate::junction::signals::Signals;
use crate::state::clock::Clock;
use crate::state::lane::Lane;

/// Who may pass them, and what their lights show.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct JunctionState {
    reservations: Reservations,
    signals: Signals,
}

impl JunctionState {
    /// Nobody may pass those of `network` yet; the lights show what they do at `clock`.
    pub(crate) fn new(network: &Network, clock: Clock) -> JunctionState {
        JunctionState { reservations: Reservations::new(network), signals: Signals::new(network, clock) }
    }

    /// Who may pass.
    #[inline]
    pub(crate) fn reservations(&self) -> &Reservations {
        &self.reservations
    }

    /// The same, to change.
    pub(crate) fn reservations_mut(&mut self) -> &mut Reservations {
        &mut self.reservations
    }

    /// What the lights show.
    #[inline]
    pub(crate) fn signals(&self) -> &Signals {
        &self.signals
    }

    /// The lights show what they show at `clock`, with these vehicles on their detectors.
    pub(crate) fn switch(&mut self, network: &Network, lanes: &[Lane], clock: Clock) {
        self.signals.switch(network, lanes, clock);
    }

    /// Whether it is that of the same network and programs as `other`, at `clock`.
    pub(crate) fn fits(&self, other: &JunctionState, clock: Clock) -> bool {
        let JunctionState { reservations, signals } = self;
        signals.fits(&other.signals, clock) && reservations.fits(&other.reservations, signals.count(), clock)
    }
}
