//! Trips within a map begin only as long as its roads can bear it.
//!
//! The throughput of a town has its maximum where a small part of its roads is taken up, and falls to nothing where all is
//! (Geroliminis, Daganzo, 2008): full rings of queues lock, and no driver can open them. At the edge of a map queues keep
//! others out; within it vehicles would start into any gap. So they wait at their kerbs while more is taken up than the
//! town can bear (a switch at its edge, as of Keyvan-Ekbatani and others, 2012).

use laneweave_network::Network;

use crate::traffic::Lane;

/// Share of its roads that vehicles and the least gaps before them may take up (ours, from trials on closed maps: at twice that
/// fewer arrive).
const BEARABLE: f64 = 0.15;
/// Least gap before a vehicle [m].
const LEAST_GAP: f64 = 2.0;

/// Whether the roads of a map are full.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Metering {
    /// Length of all lanes [m].
    length: f64,
    is_full: bool,
}

impl Metering {
    /// Of `network`, on which there is nobody yet.
    pub(crate) fn new(network: &Network) -> Metering {
        Metering { length: network.chains.iter().map(|it| it.length).sum(), is_full: false }
    }

    /// Measures what is taken up.
    pub(crate) fn measure(&mut self, lanes: &[Lane]) {
        let motions = lanes.iter().flat_map(Lane::motions);
        let taken: f64 = motions.map(|it| f64::from(it.length) + LEAST_GAP).sum();
        self.is_full = taken > BEARABLE * self.length;
    }

    /// Whether who would start from a kerb has to wait.
    #[inline]
    pub(crate) fn is_full(&self) -> bool {
        self.is_full
    }
}
