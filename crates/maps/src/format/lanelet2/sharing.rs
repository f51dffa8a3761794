//! A limit on how many elements share another one: the work for them would grow quadratically with the file.

use std::hash::Hash;

use hashbrown::HashMap;

/// Maximum of elements that share one.
pub(super) const MAXIMUM_SHARING: u32 = 32;

/// The number of users of each key.
pub(super) struct Sharing<K>(HashMap<K, u32>);

impl<K> Default for Sharing<K> {
    fn default() -> Sharing<K> {
        Sharing(HashMap::new())
    }
}

impl<K: Eq + Hash> Sharing<K> {
    /// Whether one more element may share the element with this `key`.
    pub(super) fn admits(&mut self, key: K) -> bool {
        let count = self.0.entry(key).or_default();
        *count += 1;
        *count <= MAXIMUM_SHARING
    }
}
