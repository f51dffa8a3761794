//! Where vehicles on different chains are near enough to touch. The search for overlaps uses this list; it includes
//! places where no rule keeps vehicles apart.

use crate::chain::ChainIndex;

/// Stretches of two chains: a vehicle with its front on one may touch a vehicle with its front on the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearby {
    /// First and last station of a front on the one chain [m].
    pub here: [f64; 2],
    /// The other chain.
    pub chain: ChainIndex,
    /// First and last station of a front there [m].
    pub there: [f64; 2],
}
