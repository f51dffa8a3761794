//! Why a lane was changed, as far as the later path shows.

use std::collections::VecDeque;

use laneweave_network::LaneletIndex;

use crate::moves::Moves;

/// Why a lane was changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RecordedChangeKind {
    /// From the old lane the vehicle would have reached its later place with no more changes than from the new one.
    /// The same holds for all continuations from where it was last observed, as far as the map goes.
    Discretionary,
    /// From the old lane it would have needed more changes, or would not have arrived there.
    Route,
    /// It was last observed before routes part: some of the continuations need more changes from the old lane.
    Unknown,
}

impl RecordedChangeKind {
    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            RecordedChangeKind::Discretionary => "discretionary",
            RecordedChangeKind::Route => "route",
            RecordedChangeKind::Unknown => "unknown",
        }
    }
}

/// The routes of a network, by the number of lane changes that they need.
pub(crate) struct Ways<'a> {
    moves: &'a Moves,
    /// For each lanelet its row: lanelets that lie side by side have one number.
    rows: Vec<usize>,
}

/// More changes than any route has: there is no route.
const NEVER: u32 = u32::MAX;

impl<'a> Ways<'a> {
    /// The routes of a network of `count` lanelets.
    pub(crate) fn new(count: usize, moves: &'a Moves) -> Ways<'a> {
        Ways { moves, rows: rows(count, moves) }
    }

    /// Why a vehicle changed from one lanelet to another; afterwards it was last observed on `last`.
    pub(crate) fn kind(
        &self,
        from: LaneletIndex,
        to: LaneletIndex,
        last: LaneletIndex,
    ) -> RecordedChangeKind {
        let (stayed, changed) = (self.changes_to_rows(from), self.changes_to_rows(to));
        let needs_more = |lanelet: LaneletIndex| {
            let row = self.rows[lanelet.at()];
            stayed[row] > changed[row]
        };
        if needs_more(last) {
            return RecordedChangeKind::Route;
        }
        let is_open = self.onward(last).into_iter().any(needs_more);
        if is_open { RecordedChangeKind::Unknown } else { RecordedChangeKind::Discretionary }
    }

    /// For each row the minimum number of changes on a route there from `start`.
    fn changes_to_rows(&self, start: LaneletIndex) -> Vec<u32> {
        let mut changes = vec![NEVER; self.rows.len()];
        changes[start.at()] = 0;
        let mut open = VecDeque::from([(start, 0)]);
        while let Some((lanelet, here)) = open.pop_front() {
            if here > changes[lanelet.at()] {
                continue;
            }
            for next in self.moves.onward(lanelet) {
                if here < changes[next.at()] {
                    changes[next.at()] = here;
                    open.push_front((*next, here));
                }
            }
            for next in self.moves.beside(lanelet).iter().map(|it| it.lanelet) {
                if here + 1 < changes[next.at()] {
                    changes[next.at()] = here + 1;
                    open.push_back((next, here + 1));
                }
            }
        }
        let mut least = vec![NEVER; self.rows.len()];
        for (row, changes) in self.rows.iter().zip(changes) {
            least[*row] = least[*row].min(changes);
        }
        least
    }

    /// `start` itself, and the lanelets that continue it without a change.
    fn onward(&self, start: LaneletIndex) -> Vec<LaneletIndex> {
        reached(self.rows.len(), start, |it, found| found.extend(self.moves.onward(it)))
    }
}

/// For each lanelet the number of its row.
fn rows(count: usize, moves: &Moves) -> Vec<usize> {
    let mut rows = vec![None; count];
    for first in 0..count {
        if rows[first].is_none() {
            let beside = |it: LaneletIndex, found: &mut Vec<LaneletIndex>| {
                found.extend(moves.beside(it).iter().map(|it| it.lanelet));
            };
            let mut open = vec![LaneletIndex(first as u32)];
            while let Some(lanelet) = open.pop() {
                if rows[lanelet.at()].replace(first).is_none() {
                    beside(lanelet, &mut open);
                }
            }
        }
    }
    rows.into_iter().flatten().collect()
}

/// All lanelets that can be reached from `start`; `next` adds the next ones of each.
fn reached(
    count: usize,
    start: LaneletIndex,
    next: impl Fn(LaneletIndex, &mut Vec<LaneletIndex>),
) -> Vec<LaneletIndex> {
    let mut is_reached = vec![false; count];
    let (mut reached, mut open) = (Vec::new(), vec![start]);
    while let Some(lanelet) = open.pop() {
        if !std::mem::replace(&mut is_reached[lanelet.at()], true) {
            reached.push(lanelet);
            next(lanelet, &mut open);
        }
    }
    reached
}
