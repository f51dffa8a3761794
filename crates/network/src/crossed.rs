//! Changes of lanes where the map permits none, but drivers make them: over lines that a map has as solid, and between
//! lanes whose facing borders were drawn twice.

use std::collections::BTreeSet;

use crate::chain::Beside;
use crate::lanelet::{LaneletIndex, Side};
use crate::network::Network;

impl Network {
    /// The same network, in which changes from the first to the second lanelet of each of these pairs are permitted,
    /// too, where the two lie side by side.
    pub fn permitting(mut self, pairs: &BTreeSet<[LaneletIndex; 2]>) -> Network {
        let stretches: Vec<_> = pairs.iter().flat_map(|pair| self.stretches_between(*pair)).collect();
        for (from, side, beside) in stretches {
            let chain = self.start_of(from).chain;
            let all = match side {
                Side::Left => &mut self.chains[chain.at()].left,
                Side::Right => &mut self.chains[chain.at()].right,
            };
            all.push(beside);
            all.sort_by(|a, b| a.start.total_cmp(&b.start));
        }
        self
    }

    /// The stretches on which one lanelet lies beside another, and on which side the other is.
    fn stretches_between(&self, [from, to]: [LaneletIndex; 2]) -> Vec<(LaneletIndex, Side, Beside)> {
        let (here, there) = (self.start_of(from), self.start_of(to));
        let stretch = |on_here: [f64; 2], on_there: [f64; 2]| Beside {
            start: here.x + on_here[0],
            end: here.x + on_here[1],
            chain: there.chain,
            other_start: there.x + on_there[0],
            scale: (on_there[1] - on_there[0]) / (on_here[1] - on_here[0]),
        };
        let [lanelet, other] = [from, to].map(|it| &self.lanelets[it.at()]);
        let neighbour = [(Side::Left, lanelet.adjacent_left), (Side::Right, lanelet.adjacent_right)];
        if let Some((side, _)) = neighbour.into_iter().find(|it| it.1 == Some(to)) {
            let whole = stretch([0.0, lanelet.length()], [0.0, other.length()]);
            return vec![(from, side, whole)];
        }
        let found = self.alongside().into_iter().filter_map(|it| match [it.left, it.right] {
            [left, right] if [left, right] == [from, to] => {
                Some((from, Side::Right, stretch(it.on_left, it.on_right)))
            }
            [left, right] if [right, left] == [from, to] => {
                Some((from, Side::Left, stretch(it.on_right, it.on_left)))
            }
            _ => None,
        });
        found.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Point, Polyline};
    use crate::lanelet::{DrivingSide, Lanelet};

    fn lanelet(id: i64, y: f64, [from, to]: [f64; 2]) -> Lanelet {
        let line = |y: f64| Polyline::new([from, to].map(|x| Point::new(x, y, 0.0))).unwrap();
        Lanelet::alone(id, [line(y + 2.0), line(y - 2.0), line(y)], 30.0)
    }

    #[test]
    fn a_solid_line_that_drivers_cross_can_be_crossed_in_that_direction() {
        let (mut left, mut right) = (lanelet(1, 4.0, [0.0, 100.0]), lanelet(2, 0.0, [0.0, 100.0]));
        (left.adjacent_right, right.adjacent_left) = (Some(LaneletIndex(1)), Some(LaneletIndex(0)));
        let network = Network::new(vec![left, right], DrivingSide::Right).unwrap();
        let pairs = BTreeSet::from([[LaneletIndex(1), LaneletIndex(0)]]);
        let network = network.permitting(&pairs);
        let [left, right] = [0, 1].map(|it| network.start_of(LaneletIndex(it)).chain);
        let beside = network.chain(right).beside(Side::Left, 30.0).unwrap();
        assert_eq!((beside.chain, beside.across(30.0)), (left, 30.0));
        assert!(network.chain(left).beside(Side::Right, 30.0).is_none());
    }

    #[test]
    fn lanes_whose_borders_were_drawn_twice_are_side_by_side_where_they_overlap() {
        let lanes = vec![lanelet(1, 4.2, [20.0, 100.0]), lanelet(2, 0.0, [0.0, 80.0])];
        let network = Network::new(lanes, DrivingSide::Right).unwrap();
        let pairs = BTreeSet::from([[LaneletIndex(0), LaneletIndex(1)], [LaneletIndex(1), LaneletIndex(0)]]);
        let network = network.permitting(&pairs);
        let [left, right] = [0, 1].map(|it| network.start_of(LaneletIndex(it)).chain);
        let beside = network.chain(right).beside(Side::Left, 50.0).unwrap();
        assert_eq!(beside.chain, left);
        assert!((beside.across(50.0) - 30.0).abs() < 0.1);
        assert!(network.chain(left).beside(Side::Right, 30.0).is_some());
        assert!(network.chain(right).beside(Side::Left, 10.0).is_none());
    }
}
