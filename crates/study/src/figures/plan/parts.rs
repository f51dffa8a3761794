//! Parts of a plan that lie far from each other.

use std::collections::HashMap;

use super::bounds::{APART, Bounds};

/// The parts of a plan: the rectangle of each and the indices of its members, the largest part first. Members are of
/// one part if they have a cell in common.
pub(super) fn parts(members: &[Bounds]) -> Vec<(Bounds, Vec<usize>)> {
    let mut groups = Groups((0..members.len()).collect());
    let all: Vec<Cells> = members.iter().map(Cells::of).collect();
    // The first member in each cell.
    let mut first_in: HashMap<[i64; 2], usize> = HashMap::new();
    for (index, it) in all.iter().enumerate() {
        if it.are_many() {
            let others = all.iter().enumerate().filter(|(_, other)| it.meet(other));
            others.for_each(|(other, _)| groups.join(other, index));
            continue;
        }
        for x in it.low[0]..=it.high[0] {
            for y in it.low[1]..=it.high[1] {
                let first = *first_in.entry([x, y]).or_insert(index);
                groups.join(first, index);
            }
        }
    }
    let mut parts: HashMap<usize, (Bounds, Vec<usize>)> = HashMap::new();
    for (index, it) in members.iter().enumerate() {
        let (around, of_part) = parts.entry(groups.leader(index)).or_insert((Bounds::NONE, Vec::new()));
        *around = around.with(*it);
        of_part.push(index);
    }
    let mut parts: Vec<_> = parts.into_values().collect();
    parts.sort_by_key(|(_, of_part)| (std::cmp::Reverse(of_part.len()), of_part[0]));
    parts
}

/// The cells of a member: those of its rectangle, and one more ahead along each axis.
struct Cells {
    low: [i64; 2],
    high: [i64; 2],
}

impl Cells {
    fn of(bounds: &Bounds) -> Cells {
        let cell = |metres: f64| (metres / APART).floor() as i64;
        Cells { low: bounds.low.map(cell), high: bounds.high.map(|it| cell(it).saturating_add(1)) }
    }

    /// Whether there are too many to look at each: in a broken map a lanelet may be as long as the Earth is round.
    fn are_many(&self) -> bool {
        const MANY: i64 = 16;
        (0..2).any(|axis| self.high[axis].saturating_sub(self.low[axis]) > MANY)
    }

    fn meet(&self, other: &Cells) -> bool {
        (0..2).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_far_apart_is_two_parts_and_the_larger_one_comes_first() {
        let at = |x: f64| Bounds { low: [x, 0.0], high: [x + 50.0, 10.0] };
        let parts = parts(&[at(0.0), at(2000.0), at(2060.0)]);
        let members: Vec<&[usize]> = parts.iter().map(|it| &it.1[..]).collect();
        assert_eq!(members, [&[1, 2][..], &[0]]);
        assert_eq!(parts[0].0, Bounds { low: [2000.0, 0.0], high: [2110.0, 10.0] });
    }

    #[test]
    fn a_member_as_large_as_the_earth_is_found_at_once_with_all_within_it() {
        let at = |low: [f64; 2], high: [f64; 2]| Bounds { low, high };
        let near = at([0.0, 0.0], [50.0, 10.0]);
        let far = at([-1e300, 1e300], [1e300, 1e300]);
        let parts = parts(&[near, at([-2e7, -2e7], [2e7, 2e7]), far, near]);
        let members: Vec<&[usize]> = parts.iter().map(|it| &it.1[..]).collect();
        assert_eq!(members, [&[0, 1, 3][..], &[2]]);
    }
}
