//! Lanes that have work to do. Most of the many short lanes of a town are empty at any time.

use laneweave_network::ChainIndex;
use serde::{Deserialize, Serialize};

/// The lanes that have vehicles, or had some in the last step.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Busy {
    /// A bit for each lane.
    marks: Vec<u64>,
    /// The lanes of the present step.
    chosen: Vec<u32>,
    /// The marks have changed since they were chosen.
    has_changed: bool,
}

impl Busy {
    /// No busy lane among `count` lanes.
    pub(crate) fn none_of(count: usize) -> Busy {
        Busy { marks: vec![0; count.div_ceil(64)], chosen: Vec::new(), has_changed: false }
    }

    /// Whether it has this many lanes.
    pub(crate) fn is_of(&self, count: usize) -> bool {
        let Busy { marks, chosen, has_changed: _ } = self;
        let last = marks.last().map_or(0, |it| marks.len() * 64 - it.leading_zeros() as usize);
        marks.len() == count.div_ceil(64) && last <= count && chosen.iter().all(|it| (*it as usize) < count)
    }

    /// Notes that a vehicle comes onto `chain`.
    #[inline]
    pub(crate) fn note(&mut self, chain: ChainIndex) {
        let (word, bit) = self.mark(chain);
        let has_changed = *word & bit == 0;
        *word |= bit;
        self.has_changed |= has_changed;
    }

    /// Notes that `chain` had no vehicle to move.
    #[inline]
    pub(crate) fn forget(&mut self, chain: ChainIndex) {
        let (word, bit) = self.mark(chain);
        *word &= !bit;
        self.has_changed = true;
    }

    fn mark(&mut self, chain: ChainIndex) -> (&mut u64, u64) {
        (&mut self.marks[chain.at() / 64], 1 << (chain.at() % 64))
    }

    /// The lanes to move in this step, in order. It does not read the lanes themselves: other threads have just written
    /// to them.
    pub(crate) fn chosen(&mut self) -> &[u32] {
        if std::mem::take(&mut self.has_changed) {
            self.chosen.clear();
            for (word, first) in self.marks.iter().zip((0..).step_by(64)) {
                let mut left = *word;
                while left != 0 {
                    self.chosen.push(first + left.trailing_zeros());
                    left &= left - 1;
                }
            }
        }
        &self.chosen
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lanes_are_chosen_in_order_until_they_are_forgotten() {
        let mut busy = Busy::none_of(130);
        [129, 0, 64, 0].into_iter().for_each(|it| busy.note(ChainIndex(it)));
        assert_eq!(busy.chosen(), [0, 64, 129]);
        assert_eq!(busy.chosen(), [0, 64, 129]);
        [0, 129].into_iter().for_each(|it| busy.forget(ChainIndex(it)));
        busy.note(ChainIndex(1));
        assert_eq!(busy.chosen(), [1, 64]);
        [64, 1].into_iter().for_each(|it| busy.forget(ChainIndex(it)));
        assert_eq!(busy.chosen(), [0_u32; 0]);
    }
}
