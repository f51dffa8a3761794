//! Lists that are kept from step to step, and grow by little.

/// Adds to a list that is kept from step to step: doubling would leave much of its memory unused.
#[inline]
pub(crate) fn push_tight<T>(list: &mut Vec<T>, item: T) {
    if list.len() == list.capacity() {
        list.reserve_exact(4 + list.len() / 8);
    }
    list.push(item);
}
