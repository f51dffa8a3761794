//! What governs the junctions at an instant.

use laneweave_network::Network;
use serde::{Deserialize, Serialize};

use crate::junction::passages::Passages;
use crate::junction::signals::Signals;
use crate::state::clock::Clock;

/// Who may pass them, and what their lights show.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct JunctionState {
    pub(crate) passages: Passages,
    pub(crate) signals: Signals,
}

impl JunctionState {
    /// Nobody may pass those of `network` yet; the lights show what they do at `clock`.
    pub(crate) fn new(network: &Network, clock: Clock) -> JunctionState {
        JunctionState { passages: Passages::new(network), signals: Signals::new(network, clock) }
    }

    /// Whether it is that of the same network and programs as `other`, at `clock`.
    pub(crate) fn fits(&self, other: &JunctionState, clock: Clock) -> bool {
        let JunctionState { passages, signals } = self;
        signals.fits(&other.signals, clock) && passages.fits(&other.passages, signals.count(), clock)
    }
}
