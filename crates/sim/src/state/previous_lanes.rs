//! Previous lanes: on short chains, the rear of a vehicle is still on an earlier chain.

use laneweave_network::{ChainIndex, Network};
use serde::{Deserialize, Serialize};

/// The last two chains that a vehicle left.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PreviousLanes {
    last: u32,
    before: u32,
}

impl PreviousLanes {
    const UNKNOWN: u32 = u32::MAX;

    /// The previous lanes of a vehicle that has just appeared.
    pub const NONE: PreviousLanes =
        PreviousLanes { last: PreviousLanes::UNKNOWN, before: PreviousLanes::UNKNOWN };

    /// The previous lanes of a vehicle that goes on from `chain`.
    pub fn left(self, chain: ChainIndex) -> PreviousLanes {
        PreviousLanes { last: chain.0, before: self.last }
    }

    /// The chain before the present one.
    #[inline]
    pub fn last(self) -> Option<ChainIndex> {
        (self.last != PreviousLanes::UNKNOWN).then_some(ChainIndex(self.last))
    }

    /// The known chains that it came over, the latest first.
    pub fn known(self) -> impl Iterator<Item = ChainIndex> {
        [self.last, self.before].into_iter().take_while(|it| *it != PreviousLanes::UNKNOWN).map(ChainIndex)
    }

    /// The chains before `chain`, the nearest first: the known ones, then each chain that is the only previous one.
    pub(crate) fn back(self, network: &Network, chain: ChainIndex) -> impl Iterator<Item = ChainIndex> + '_ {
        let mut known = [self.last, self.before].into_iter();
        std::iter::successors(Some(chain), move |here| match known.next() {
            Some(index) if index != PreviousLanes::UNKNOWN => Some(ChainIndex(index)),
            _ => {
                if let [only] = network.chain(*here).previous[..] {
                    Some(only)
                } else {
                    None
                }
            }
        })
        .skip(1)
    }
}
