//! Parts of a map that lie far from each other.

use std::collections::HashMap;

use laneweave_network::{Lanelet, Point};

/// Lanelets with a smaller distance than about this belong together [m].
const APART: f64 = 150.0;

/// A rectangle of the map [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    pub(super) low: [f64; 2],
    pub(super) high: [f64; 2],
}

impl Bounds {
    const NONE: Bounds = Bounds { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };

    fn of<'a>(points: impl Iterator<Item = &'a Point>) -> Bounds {
        points.fold(Bounds::NONE, |it, point| {
            it.with(Bounds { low: [point.x, point.y], high: [point.x, point.y] })
        })
    }

    /// The rectangle around both.
    pub(super) fn with(self, other: Bounds) -> Bounds {
        Bounds {
            low: [self.low[0].min(other.low[0]), self.low[1].min(other.low[1])],
            high: [self.high[0].max(other.high[0]), self.high[1].max(other.high[1])],
        }
    }

    /// Whether `point` lies inside, or close outside.
    pub(super) fn is_near(&self, point: &Point) -> bool {
        let near =
            |axis: usize, it: f64| self.low[axis] - it < APART / 3.0 && it - self.high[axis] < APART / 3.0;
        near(0, point.x) && near(1, point.y)
    }

    /// Width and height [m].
    pub(super) fn size(&self) -> [f64; 2] {
        [self.high[0] - self.low[0], self.high[1] - self.low[1]]
    }
}

/// The parts of a map: the rectangle of each and the indices of its lanelets, the largest part first.
pub(super) fn parts(lanelets: &[Lanelet]) -> Vec<(Bounds, Vec<usize>)> {
    let bounds: Vec<Bounds> = lanelets
        .iter()
        .map(|it| Bounds::of(it.left_border.points().iter().chain(it.right_border.points())))
        .collect();
    let mut groups = Groups((0..lanelets.len()).collect());
    // The first lanelet in each cell.
    let mut cells: HashMap<[i64; 2], usize> = HashMap::new();
    for (index, it) in bounds.iter().enumerate() {
        let cell = |metres: f64| (metres / APART).floor() as i64;
        for x in cell(it.low[0])..=cell(it.high[0]) + 1 {
            for y in cell(it.low[1])..=cell(it.high[1]) + 1 {
                let first = *cells.entry([x, y]).or_insert(index);
                groups.join(first, index);
            }
        }
    }
    let mut parts: HashMap<usize, (Bounds, Vec<usize>)> = HashMap::new();
    for (index, it) in bounds.iter().enumerate() {
        let (around, members) = parts.entry(groups.leader(index)).or_insert((Bounds::NONE, Vec::new()));
        *around = around.with(*it);
        members.push(index);
    }
    let mut parts: Vec<_> = parts.into_values().collect();
    parts.sort_by_key(|(_, members)| (std::cmp::Reverse(members.len()), members[0]));
    parts
}

/// Union-find: each group member names another member, and the leader names itself.
struct Groups(Vec<usize>);

impl Groups {
    fn leader(&mut self, mut member: usize) -> usize {
        while self.0[member] != member {
            self.0[member] = self.0[self.0[member]];
            member = self.0[member];
        }
        member
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.leader(a), self.leader(b));
        self.0[a.max(b)] = a.min(b);
    }
}
