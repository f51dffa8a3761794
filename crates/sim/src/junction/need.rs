//! What reservation a driver needs.

use laneweave_network::{ChainIndex, LightIndex};

use crate::junction::storage_section::StorageSection;
use crate::junction::waiting::ZoneReservation;

/// Room that a vehicle needs beyond the zones beside its length [m] (ours).
pub(crate) const SPARE_SPACE: f64 = 2.0;

/// What reservation a driver needs. Distances are those from its front [m].
#[derive(Clone, Debug)]
pub(crate) struct Survey {
    /// Where it stops without.
    pub(crate) stop: f64,
    /// Lights, with the places where their drivers stop.
    pub(crate) lights: Vec<(LightIndex, f64)>,
    /// It has to stop first, whoever comes.
    pub(crate) has_stop_sign: bool,
    /// Sides of zones.
    pub(crate) holds: Vec<ZoneReservation>,
    /// Where its front has to get for the rear to be out of all zones, and for it to be past all lines that belong to
    /// them.
    pub(crate) extent: f64,
    /// Where it can stand then.
    pub(crate) section: StorageSection,
    /// Where the chain of that begins.
    pub(crate) section_start: f64,
    /// Room that it needs there.
    pub(crate) needed: f64,
    /// Room that there is.
    pub(crate) space: f64,
    /// Room that there would be on an empty road.
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
