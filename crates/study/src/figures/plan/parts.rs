//! Parts of a plan that lie far from each other.

use std::collections::HashMap;

use super::bounds::{APART, Bounds};

/// The parts of a plan: the rectangle of each and the indices of its members, the largest part first.
pub(super) fn parts(members: &[Bounds]) -> Vec<(Bounds, Vec<usize>)> {
    let mut groups = Groups((0..members.len()).collect());
    // The first member in each cell.
    let mut cells: HashMap<[i64; 2], usize> = HashMap::new();
    for (index, it) in members.iter().enumerate() {
        let cell = |metres: f64| (metres / APART).floor() as i64;
        for x in cell(it.low[0])..=cell(it.high[0]) + 1 {
            for y in cell(it.low[1])..=cell(it.high[1]) + 1 {
                let first = *cells.entry([x, y]).or_insert(index);
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
}
