//! The parts of a graph whose members are linked, directly or through others.

/// The parts of a graph of so many members, each in order. `near` are the members to which one is linked.
pub(super) fn components<N: IntoIterator<Item = usize>>(
    count: usize,
    near: impl Fn(usize) -> N,
) -> Vec<Vec<usize>> {
    let mut is_known = vec![false; count];
    let mut found = Vec::new();
    for first in 0..count {
        let (mut members, mut open) = (Vec::new(), vec![first]);
        while let Some(at) = open.pop() {
            if !std::mem::replace(&mut is_known[at], true) {
                members.push(at);
                open.extend(near(at));
            }
        }
        if !members.is_empty() {
            members.sort_unstable();
            found.push(members);
        }
    }
    found
}
