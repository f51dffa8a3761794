//! How many elements share another one: what is drawn or linked for each of them would grow with the square of the
//! file.

use std::hash::Hash;

use hashbrown::HashMap;

/// No more elements than this share one.
pub(super) const MAXIMUM_SHARING: u32 = 32;

/// Who shares what, by a key.
pub(super) struct Sharing<K>(HashMap<K, u32>);

impl<K> Default for Sharing<K> {
    fn default() -> Sharing<K> {
        Sharing(HashMap::new())
    }
}

impl<K: Eq + Hash> Sharing<K> {
    /// Whether one more may share what has this `key`.
    pub(super) fn admits(&mut self, key: K) -> bool {
        let count = self.0.entry(key).or_default();
        *count += 1;
        *count <= MAXIMUM_SHARING
    }
}
