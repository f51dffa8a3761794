//! What governs the junctions at an instant.

use laneweave_network::Network;
use serde::{Deserialize, Serialize};

use crate::junction::passages::Passages;
use crate::junction::signals::Signals;
use crate::state::clock::Clock;
use crate::state::lane::Lane;

/// Who may pass them, and what their lights show.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct JunctionState {
    passages: Passages,
    signals: Signals,
}

impl JunctionState {
    /// Nobody may pass those of `network` yet; the lights show what they do at `clock`.
    pub(crate) fn new(network: &Network, clock: Clock) -> JunctionState {
        JunctionState { passages: Passages::new(network), signals: Signals::new(network, clock) }
    }

    /// Who may pass.
    #[inline]
    pub(crate) fn passages(&self) -> &Passages {
        &self.passages
    }

    /// The same, to change.
    pub(crate) fn passages_mut(&mut self) -> &mut Passages {
        &mut self.passages
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
        let JunctionState { passages, signals } = self;
        signals.fits(&other.signals, clock) && passages.fits(&other.passages, signals.count(), clock)
    }
}
