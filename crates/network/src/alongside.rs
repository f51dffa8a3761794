//! Lanelets that lie side by side although they share no border: their facing borders were drawn twice, or meet only
//! after a fork. The graph does not know them as neighbours.

use std::collections::HashMap;

use crate::geometry::{Point, Polyline};
use crate::lanelet::{Lanelet, LaneletIndex, Side};
use crate::network::Network;

/// A stretch on which two lanelets of one direction lie side by side without a common border.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alongside {
    /// The lanelet on the left.
    pub left: LaneletIndex,
    /// The lanelet on the right.
    pub right: LaneletIndex,
    /// First and last station of the stretch along the left lanelet's centre line [m].
    pub on_left: [f64; 2],
    /// First and last station of the stretch along the right lanelet's centre line [m].
    pub on_right: [f64; 2],
}

/// Facing borders are at most this far apart [m]. Ours: borders that were drawn twice differ by decimetres; a kerb or
/// a hatched area is wider.
const MAXIMUM_GAP: f64 = 0.75;
/// Lanes side by side overlap by at most this [m]. Ours: lanes of a fork or a merge that overlap by more are one lane
/// there, without a line between them.
const MAXIMUM_OVERLAP: f64 = 0.3;
/// On a shorter stretch, lanes cannot be changed [m]. Ours.
const MINIMUM_STRETCH: f64 = 5.0;
/// Borders of lanes side by side have one direction up to this angle [rad]. Ours: lanes that cross, or part at a
/// fork, do so at larger angles.
const MAXIMUM_ANGLE: f64 = 0.1;
/// Lanes on bridges are at least this far above each other [m].
const MAXIMUM_HEIGHT: f64 = 2.0;
/// Distance between the samples along a border [m].
const SAMPLE: f64 = 1.0;
/// Borders are sampled up to this length [m], so that a few points far apart do not take the time of many. Real
/// lanelets are shorter.
const SAMPLED: f64 = 2000.0;

impl Network {
    /// All stretches on which lanelets lie side by side in the same direction without being neighbours in the graph,
    /// ordered by their lanelets, then along the left one.
    ///
    /// Pure geometry: the right border of one is at most 0.75 m from the left border of the other, or overlaps it by
    /// at most 0.3 m, parallel up to 6°, for at least 5 m. Of a longer border the first 2 km count.
    pub fn alongside(&self) -> Vec<Alongside> {
        let lanelets = &self.lanelets;
        let left_borders = Samples::of(lanelets, Side::Left);
        let all = (0..lanelets.len() as u32).map(LaneletIndex);
        all.flat_map(|left| left_borders.beside(lanelets, left)).collect()
    }
}

/// A point on the right border of a lanelet that faces one on the left border of `right`, by stations along these
/// borders [m].
struct Facing {
    right: LaneletIndex,
    on_left: f64,
    on_right: f64,
}

/// The stretch of successive facing points of a lanelet, if it is long enough on both borders.
fn stretch(lanelets: &[Lanelet], of: LaneletIndex, run: &[Facing]) -> Option<Alongside> {
    let (first, last) = (run.first()?, run.last()?);
    let (left, right) = (&lanelets[of.at()], &lanelets[first.right.at()]);
    let is_long = |from: f64, to: f64| to - from >= MINIMUM_STRETCH;
    if !(is_long(first.on_left, last.on_left) && is_long(first.on_right, last.on_right)) {
        return None;
    }
    let along = |lanelet: &Lanelet, border: &Polyline, from: f64, to: f64| {
        let scale = lanelet.length() / border.length();
        [from * scale, to * scale]
    };
    Some(Alongside {
        left: of,
        right: first.right,
        on_left: along(left, &left.right_border, first.on_left, last.on_left),
        on_right: along(right, &right.left_border, first.on_right, last.on_right),
    })
}

fn are_neighbours(lanelets: &[Lanelet], left: LaneletIndex, right: LaneletIndex) -> bool {
    let (there, here) = (&lanelets[left.at()], &lanelets[right.at()]);
    let to_right = [there.right, there.adjacent_right];
    let to_left = [here.left, here.adjacent_left];
    left == right || to_right.contains(&Some(right)) || to_left.contains(&Some(left))
}

/// A point of a border.
#[derive(Clone, Copy)]
struct Sample {
    of: LaneletIndex,
    /// Along the border [m].
    station: f64,
    at: Point,
    /// Unit vector of the border's direction.
    direction: (f64, f64),
}

fn samples(of: LaneletIndex, border: &Polyline) -> impl Iterator<Item = Sample> {
    let pieces = (border.length() / SAMPLE).ceil().max(1.0) as usize;
    (0..=pieces).map(move |i| border.length() * i as f64 / pieces as f64).take_while(|it| *it <= SAMPLED).map(
        move |station| {
            let heading = border.heading(station);
            Sample { of, station, at: border.at(station), direction: (heading.cos(), heading.sin()) }
        },
    )
}

/// Samples of the borders on one side of all lanelets, in a grid.
struct Samples {
    cells: HashMap<(i64, i64), Vec<Sample>>,
}

impl Samples {
    /// Size of a cell [m]: a sample and the samples that face it lie in one cell or in neighbouring cells.
    const CELL: f64 = 2.0;
    /// Maximum of samples in a cell, so that lanelets drawn on top of each other do not take quadratic time. On real
    /// roads only a few meet.
    const MOST: usize = 64;

    fn of(lanelets: &[Lanelet], side: Side) -> Samples {
        let mut cells: HashMap<_, Vec<Sample>> = HashMap::new();
        for (index, lanelet) in lanelets.iter().enumerate() {
            let border = match side {
                Side::Left => &lanelet.left_border,
                Side::Right => &lanelet.right_border,
            };
            for sample in samples(LaneletIndex(index as u32), border) {
                let cell = cells.entry(Samples::cell(&sample.at)).or_default();
                if cell.len() < Samples::MOST {
                    cell.push(sample);
                }
            }
        }
        Samples { cells }
    }

    fn cell(at: &Point) -> (i64, i64) {
        ((at.x / Samples::CELL).floor() as i64, (at.y / Samples::CELL).floor() as i64)
    }

    /// The stretches on which lanelets lie to the right of this one.
    fn beside(&self, lanelets: &[Lanelet], left: LaneletIndex) -> Vec<Alongside> {
        let mut facing: Vec<Facing> = Vec::new();
        for sample in samples(left, &lanelets[left.at()].right_border) {
            let others = self.facing(&sample).filter(|it| !are_neighbours(lanelets, left, it.of));
            facing.extend(others.map(|it| Facing {
                right: it.of,
                on_left: sample.station,
                on_right: it.station,
            }));
        }
        facing.sort_by(|a, b| a.right.cmp(&b.right).then(a.on_left.total_cmp(&b.on_left)));
        let runs = facing.chunk_by(|a, b| a.right == b.right && b.on_left - a.on_left < 2.5 * SAMPLE);
        runs.filter_map(|run| stretch(lanelets, left, run)).collect()
    }

    /// Samples opposite of `sample`, which lies on a right border: those on borders beside it in its direction.
    fn facing<'a>(&'a self, sample: &'a Sample) -> impl Iterator<Item = &'a Sample> {
        let (column, row) = Samples::cell(&sample.at);
        let cells = (-1..=1).flat_map(move |dx| (-1..=1).map(move |dy| (column + dx, row + dy)));
        cells.filter_map(|cell| self.cells.get(&cell)).flatten().filter(|other| {
            let (dx, dy) = (other.at.x - sample.at.x, other.at.y - sample.at.y);
            let (cos, sin) = sample.direction;
            let (ahead, aside) = (dx * cos + dy * sin, dy * cos - dx * sin);
            let (c, s) = other.direction;
            let (turn, towards) = (cos * s - sin * c, cos * c + sin * s);
            ahead.abs() <= 0.5 * SAMPLE
                && (-MAXIMUM_GAP..=MAXIMUM_OVERLAP).contains(&aside)
                && towards > 0.0
                && turn.abs() <= MAXIMUM_ANGLE.sin()
                && (other.at.z - sample.at.z).abs() <= MAXIMUM_HEIGHT
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanelet::DrivingSide;

    fn line(points: [(f64, f64); 2]) -> Polyline {
        Polyline::new(points.map(|(x, y)| Point::new(x, y, 0.0))).unwrap()
    }

    /// A lanelet 4 m wide to the right of the line `from` → `to`.
    fn lanelet(id: i64, from: (f64, f64), to: (f64, f64)) -> Lanelet {
        let left_border = line([from, to]);
        let shifted = |station: f64| left_border.beside(station, -4.0);
        let right_border = Polyline::new([shifted(0.0), shifted(left_border.length())]).unwrap();
        let centre = Polyline::between(&left_border, &right_border).unwrap();
        Lanelet::alone(id, [left_border, right_border, centre], 30.0)
    }

    fn found(lanelets: Vec<Lanelet>) -> Vec<Alongside> {
        Network::new(lanelets, DrivingSide::Right).unwrap().alongside()
    }

    #[test]
    fn lanes_with_a_border_drawn_twice_lie_side_by_side() {
        let upper = lanelet(1, (0.0, 4.0), (100.0, 4.0));
        for gap in [-0.25, 0.0, 0.7] {
            let lower = lanelet(2, (40.0, -gap), (80.0, -gap));
            let pairs = found(vec![lower, upper.clone()]);
            assert_eq!(
                pairs,
                [Alongside {
                    left: LaneletIndex(1),
                    right: LaneletIndex(0),
                    on_left: [40.0, 80.0],
                    on_right: [0.0, 40.0]
                }]
            );
        }
    }

    #[test]
    fn lanes_that_keep_apart_oppose_or_cross_each_other_do_not() {
        let upper = lanelet(1, (0.0, 4.0), (100.0, 4.0));
        for (from, to) in [
            ((0.0, -0.8), (100.0, -0.8)),
            ((0.0, 0.4), (100.0, 0.4)),
            ((100.0, -4.0), (0.0, -4.0)),
            ((40.0, 6.0), (60.0, -6.0)),
            ((0.0, 4.0), (100.0, 4.0)),
            ((97.0, 0.0), (150.0, 0.0)),
        ] {
            assert_eq!(found(vec![upper.clone(), lanelet(2, from, to)]), [], "{from:?} to {to:?}");
        }
    }

    #[test]
    fn neighbours_in_the_graph_are_not_named_again() {
        let mut upper = lanelet(1, (0.0, 4.0), (100.0, 4.0));
        let lower = lanelet(2, (0.0, 0.0), (100.0, 0.0));
        assert_eq!(found(vec![upper.clone(), lower.clone()]).len(), 1);
        upper.adjacent_right = Some(LaneletIndex(1));
        assert_eq!(found(vec![upper, lower]), []);
    }

    #[test]
    fn lanes_on_a_bridge_are_not_beside_those_below() {
        let upper = lanelet(1, (0.0, 4.0), (100.0, 4.0));
        let mut lower = lanelet(2, (0.0, 0.0), (100.0, 0.0));
        let raised = lower.left_border.points().iter().map(|it| Point::new(it.x, it.y, 6.0));
        lower.left_border = Polyline::new(raised).unwrap();
        assert_eq!(found(vec![upper, lower]), []);
    }
}
