//! Lists that exist from step to step, and grow by small amounts.

/// Adds to a list that exists from step to step. If the capacity doubled, much of the memory would be unused.
#[inline]
pub(crate) fn push_tight<T>(list: &mut Vec<T>, item: T) {
    if list.len() == list.capacity() {
        list.reserve_exact(4 + list.len() / 8);
    }
    list.push(item);
}
