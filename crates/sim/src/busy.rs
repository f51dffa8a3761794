//! Lanes in which there is something to do: of the many short ones of a town most are empty at any time.

use laneweave_network::ChainIndex;

use crate::traffic::Lane;

/// The lanes that have vehicles, or had some in the last step.
#[derive(Debug)]
pub(crate) struct Busy {
    /// A bit for each lane.
    marks: Vec<u64>,
    /// Those of the present step.
    chosen: Vec<u32>,
}

impl Busy {
    /// None of `count` lanes.
    pub(crate) fn none_of(count: usize) -> Busy {
        Busy { marks: vec![0; count.div_ceil(64)], chosen: Vec::new() }
    }

    /// A vehicle comes onto `chain`.
    #[inline]
    pub(crate) fn note(&mut self, chain: ChainIndex) {
        self.marks[chain.at() / 64] |= 1 << (chain.at() % 64);
    }

    /// Chooses the lanes that are to be moved in this step, in order. Who has left a lane is forgotten there in the step after.
    pub(crate) fn choose(&mut self, lanes: &[Lane]) -> &[u32] {
        self.chosen.clear();
        for (word, first) in self.marks.iter_mut().zip((0..).step_by(64)) {
            let mut left = *word;
            while left != 0 {
                let bit = left.trailing_zeros();
                left &= left - 1;
                self.chosen.push(first + bit);
                if lanes[(first + bit) as usize].motions().is_empty() {
                    *word &= !(1 << bit);
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
    fn a_lane_is_chosen_once_more_after_it_is_empty() {
        let lanes = vec![Lane::default(); 130];
        let mut busy = Busy::none_of(lanes.len());
        [129, 0, 64, 0].into_iter().for_each(|it| busy.note(ChainIndex(it)));
        assert_eq!(busy.choose(&lanes), [0, 64, 129]);
        busy.note(ChainIndex(64));
        assert_eq!(busy.choose(&lanes), [64]);
        assert_eq!(busy.choose(&lanes), [0_u32; 0]);
    }
}
