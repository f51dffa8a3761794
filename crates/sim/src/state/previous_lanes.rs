//! Previous lanes: on short chains, the rear of a vehicle is still on an earlier chain.

use laneweave_network::{ChainIndex, Network};
use serde::{Deserialize, Serialize};

/// The last three chains that a vehicle left, the latest first, in three bytes each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PreviousLanes([[u8; 3]; PreviousLanes::KNOWN]);

impl PreviousLanes {
    /// So many chains are known.
    pub(crate) const KNOWN: usize = 3;

    /// No network has so many chains: a map of 2 GiB has some millions of lanelets.
    const UNKNOWN: [u8; 3] = [u8::MAX; 3];

    /// The previous lanes of a vehicle that has just appeared.
    pub const NONE: PreviousLanes = PreviousLanes([PreviousLanes::UNKNOWN; PreviousLanes::KNOWN]);

    /// The previous lanes of a vehicle that goes on from `chain`.
    pub fn left(self, chain: ChainIndex) -> PreviousLanes {
        let [low, middle, high, _] = chain.0.to_le_bytes();
        let PreviousLanes([last, before, _]) = self;
        PreviousLanes([[low, middle, high], last, before])
    }

    /// The chain before the present one.
    #[inline]
    pub fn last(self) -> Option<ChainIndex> {
        chain(self.0[0])
    }

    /// Whether a vehicle on `chain` came there `over` these chains, the nearest first, as far as is known.
    #[inline]
    pub(crate) fn came_over(self, network: &Network, chain: ChainIndex, over: &[ChainIndex]) -> bool {
        let mut back = self.back(network, chain);
        over.iter().enumerate().all(|(count, it)| match back.next() {
            Some(chain) => chain == *it,
            // What came before the last three chains is not known.
            None => count >= PreviousLanes::KNOWN,
        })
    }

    /// The known chains that it came over, the latest first.
    pub fn known(self) -> impl Iterator<Item = ChainIndex> {
        self.0.into_iter().map_while(chain)
    }

    /// The chains before `chain`, the nearest first: the known ones, then each chain that is the only previous one.
    pub(crate) fn back(self, network: &Network, chain: ChainIndex) -> impl Iterator<Item = ChainIndex> + '_ {
        let mut known = self.known();
        std::iter::successors(Some(chain), move |here| {
            known.next().or_else(|| match network.chain(*here).previous[..] {
                [only] => Some(only),
                _ => None,
            })
        })
        .skip(1)
    }
}

#[inline]
fn chain(bytes: [u8; 3]) -> Option<ChainIndex> {
    let [low, middle, high] = bytes;
    (bytes != PreviousLanes::UNKNOWN).then(|| ChainIndex(u32::from_le_bytes([low, middle, high, 0])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_three_chains_are_known() {
        let mut lanes = PreviousLanes::NONE;
        assert_eq!((lanes.last(), lanes.known().count()), (None, 0));
        for left in [7, 70_000, 16_000_000, 3] {
            lanes = lanes.left(ChainIndex(left));
            assert_eq!(lanes.last(), Some(ChainIndex(left)));
        }
        let known: Vec<ChainIndex> = lanes.known().collect();
        assert_eq!(known, [3, 16_000_000, 70_000].map(ChainIndex));
    }
}
