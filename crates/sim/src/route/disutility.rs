//! Route disutility: what a route costs its driver besides time.

use laneweave_network::{ChainIndex, Network, Sign};
use serde::{Deserialize, Serialize};

/// Turns and traffic lights on a route.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Disutility {
    /// Turns.
    pub turns: u16,
    /// Traffic lights.
    pub lights: u16,
}

impl Disutility {
    /// The disutility of `chain` from its start to `station` [m].
    pub(crate) fn until(network: &Network, chain: ChainIndex, station: f64) -> Disutility {
        let turns = network.junctions.turns(chain).iter().filter(|it| **it <= station);
        let stops = network.junctions.on(chain).stops.iter().filter(|it| it.station <= station);
        let lights = stops.filter(|it| matches!(it.sign, Sign::Light(_)));
        Disutility { turns: turns.count() as u16, lights: lights.count() as u16 }
    }

    /// The sum of this and `onward`.
    pub(crate) fn and(self, onward: Disutility) -> Disutility {
        Disutility {
            turns: self.turns.saturating_add(onward.turns),
            lights: self.lights.saturating_add(onward.lights),
        }
    }

    /// What remains of it after `passed`.
    pub(crate) fn beyond(self, passed: Disutility) -> Disutility {
        Disutility {
            turns: self.turns.saturating_sub(passed.turns),
            lights: self.lights.saturating_sub(passed.lights),
        }
    }
}
