//! Storage sections: where vehicles stand beyond zones.

use laneweave_network::{ChainIndex, Junctions, Network};
use serde::{Deserialize, Serialize};

/// A storage section: a stretch of a chain between two places where drivers may have to stop. A vehicle that stands on
/// one section does not block another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct StorageSection {
    pub(crate) chain: ChainIndex,
    /// Number of such places on the chain before it.
    places: u32,
}

impl StorageSection {
    /// The section at the start of a chain.
    pub(crate) const fn first_of(chain: ChainIndex) -> StorageSection {
        StorageSection { chain, places: 0 }
    }

    /// The section on which `station` [m] of a chain lies.
    pub(crate) fn at(junctions: &Junctions, chain: ChainIndex, station: f64) -> StorageSection {
        let places = &junctions.on(chain).places;
        StorageSection { chain, places: places.partition_point(|it| it.station < station) as u32 }
    }

    /// Whether it continues on the next chain.
    pub(crate) fn is_last(&self, junctions: &Junctions) -> bool {
        self.places as usize == junctions.on(self.chain).places.len()
    }
}

/// Numbers of all storage sections of a network, from 0 on; empty where there are no zones.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Numbers {
    /// For each chain the number of its first section.
    first: Vec<u32>,
    pub(crate) count: usize,
}

impl Numbers {
    pub(crate) fn of(network: &Network) -> Numbers {
        let junctions = &network.junctions;
        if junctions.zones.is_empty() {
            return Numbers::default();
        }
        let mut count = 0;
        let mut number = |chain: u32| {
            let (first, on) = (count, junctions.on(ChainIndex(chain)));
            count += on.places.len() + 1;
            first as u32
        };
        let first = (0..network.chains.len() as u32).map(&mut number).collect();
        Numbers { first, count }
    }

    /// The numbers of this many chains that have no place to stop.
    #[cfg(test)]
    pub(crate) fn of_chains(count: usize) -> Numbers {
        Numbers { first: (0..count as u32).collect(), count }
    }

    /// The number of a storage section, if it has one.
    #[inline]
    pub(crate) fn of_section(&self, section: StorageSection) -> Option<usize> {
        self.first.get(section.chain.at()).map(|first| (first + section.places) as usize)
    }
}
