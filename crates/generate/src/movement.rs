//! Which lane of a junction leads to which.

use std::ops::Range;

use super::compass::{Compass, Turn};

/// A path over a junction, from a lane that arrives onto one that leaves; lanes count from the left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Movement {
    /// The arm from which it comes.
    pub(super) from: Compass,
    pub(super) lane: usize,
    /// The arm to which it goes.
    pub(super) to: Compass,
    pub(super) onto: usize,
}

/// Number of lanes that arrive on an arm of a junction, and that leave on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Lanes {
    pub(super) arriving: usize,
    pub(super) leaving: usize,
}

/// The usual movements at a junction with these arms, in the order of [`Compass::ALL`].
///
/// The leftmost lane leads left, the rightmost one right, each onto the lane on the same side of the other road. All
/// lanes lead straight on, side by side, except the left one of three and lanes without a continuation. If no lane
/// leads straight on, all lanes turn. There are no U-turns.
pub(super) fn usual(arms: &[Lanes; 4]) -> Vec<Movement> {
    let mut movements = Vec::new();
    for from in Compass::ALL {
        let arriving = arms[from as usize].arriving;
        let heading = from.opposite();
        let leaving = |wanted: Turn| -> Option<(Compass, usize)> {
            let to = Compass::ALL.into_iter().find(|it| heading.turn(*it) == wanted)?;
            Some((to, arms[to as usize].leaving)).filter(|(_, lanes)| *lanes > 0)
        };
        let ways = [Turn::Left, Turn::Straight, Turn::Right].map(leaving);
        let there = ways.map(|it| it.map(|(_, lanes)| lanes));
        for (way, lanes) in ways.into_iter().zip(lanes_of(arriving, there)) {
            let Some((to, leaving)) = way else { continue };
            // Counted from the right, except for turns to the left.
            let is_left = heading.turn(to) == Turn::Left;
            movements.extend(lanes.filter_map(|lane| {
                let onto = if is_left { lane } else { (lane + leaving).checked_sub(arriving)? };
                (onto < leaving).then_some(Movement { from, lane, to, onto })
            }));
        }
    }
    movements
}

/// Which of `arriving` lanes lead left, straight on, and right, given the number of lanes that leave in each
/// direction.
fn lanes_of(arriving: usize, [left, straight, right]: [Option<usize>; 3]) -> [Range<usize>; 3] {
    let all = 0..arriving;
    if straight.is_some() {
        let first = usize::from(arriving >= 3 && left.is_some());
        return [0..1.min(arriving), first..arriving, arriving.saturating_sub(1)..arriving];
    }
    match (left, right) {
        (Some(_), Some(_)) => {
            let to_left = arriving.div_ceil(2);
            [0..to_left, 0..0, to_left.min(arriving.saturating_sub(1))..arriving]
        }
        _ => [all.clone(), 0..0, all],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where lanes from the west lead, to the left, straight on and to the right: pairs of lanes.
    fn from_west(arriving: usize, leaving: [usize; 3]) -> [Vec<(usize, usize)>; 3] {
        let mut arms = [Lanes::default(); 4];
        arms[Compass::West as usize].arriving = arriving;
        for (arm, leaving) in [Compass::North, Compass::East, Compass::South].into_iter().zip(leaving) {
            arms[arm as usize].leaving = leaving;
        }
        let found = usual(&arms);
        [Compass::North, Compass::East, Compass::South]
            .map(|arm| found.iter().filter(|it| it.to == arm).map(|it| (it.lane, it.onto)).collect())
    }

    #[test]
    fn a_single_lane_leads_everywhere() {
        assert_eq!(from_west(1, [1; 3]), [[(0, 0)], [(0, 0)], [(0, 0)]]);
        assert_eq!(from_west(1, [2; 3]), [[(0, 0)], [(0, 1)], [(0, 1)]]);
        assert_eq!(from_west(1, [1, 0, 1]), [vec![(0, 0)], vec![], vec![(0, 0)]]);
    }

    #[test]
    fn the_left_lane_leads_left_and_the_right_lane_right() {
        assert_eq!(from_west(2, [2; 3]), [vec![(0, 0)], vec![(0, 0), (1, 1)], vec![(1, 1)]]);
        assert_eq!(from_west(3, [3; 3]), [vec![(0, 0)], vec![(1, 1), (2, 2)], vec![(2, 2)]]);
        assert_eq!(from_west(2, [1, 2, 1]), [vec![(0, 0)], vec![(0, 0), (1, 1)], vec![(1, 0)]]);
    }

    #[test]
    fn a_lane_that_does_not_go_on_only_turns() {
        assert_eq!(from_west(2, [1; 3]), [vec![(0, 0)], vec![(1, 0)], vec![(1, 0)]]);
    }

    #[test]
    fn where_nothing_leads_straight_on_all_lanes_turn() {
        assert_eq!(from_west(2, [2, 0, 2]), [vec![(0, 0)], vec![], vec![(1, 1)]]);
        assert_eq!(from_west(2, [2, 0, 0]), [vec![(0, 0), (1, 1)], vec![], vec![]]);
        assert_eq!(from_west(3, [3, 0, 3]), [vec![(0, 0), (1, 1)], vec![], vec![(2, 2)]]);
    }
}
