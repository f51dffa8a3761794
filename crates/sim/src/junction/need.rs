//! The reservation that a driver needs.

use laneweave_network::{ChainIndex, LightIndex};

use crate::junction::storage_section::StorageSection;
use crate::junction::waiting_priority::ZoneReservation;

/// Storage space that a vehicle needs beyond the zones, in addition to its length [m] (ours).
pub(crate) const SPARE_SPACE: f64 = 2.0;
/// A line belongs to the zones that follow within this distance [m] (ours).
pub(crate) const LINE_TO_ZONE: f64 = 30.0;

/// The reservation that a driver needs. Distances are measured from the front of its vehicle [m].
#[derive(Clone, Debug)]
pub(crate) struct Survey {
    /// Where it stops without a reservation.
    pub(crate) stop: f64,
    /// Lights, with the distances to the places where drivers stop for them.
    pub(crate) lights: Vec<(LightIndex, f64)>,
    /// It has to stop first, even if no other vehicle comes.
    pub(crate) has_stop_sign: bool,
    /// The sides of zones that it needs.
    pub(crate) holds: Vec<ZoneReservation>,
    /// Where its front has to be so that its rear has left all zones, and its front has passed all lines that belong to
    /// them.
    pub(crate) extent: f64,
    /// The storage section where it can stand then.
    pub(crate) section: StorageSection,
    /// Where the chain of this section begins.
    pub(crate) section_start: f64,
    /// Storage space that it needs there.
    pub(crate) needed: f64,
    /// Storage space that is available there.
    pub(crate) space: f64,
    /// Storage space that would be available on an empty road.
    pub(crate) most: f64,
}

impl Default for Survey {
    fn default() -> Survey {
        Survey {
            stop: 0.0,
            lights: Vec::new(),
            has_stop_sign: false,
            holds: Vec::new(),
            extent: 0.0,
            section: StorageSection::first_of(ChainIndex(0)),
            section_start: 0.0,
            needed: 0.0,
            space: 0.0,
            most: 0.0,
        }
    }
}
