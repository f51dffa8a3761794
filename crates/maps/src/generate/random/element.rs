//! Elements: what a road is made of, each from one cross-section to others.

use super::hazard::Hazard;
use super::mouth::Mouth;
use super::stretch::Pen;

/// What an element has become.
pub(super) struct Built {
    /// Where roads go on: the road itself first, then those that part from it or come to it.
    pub(super) mouths: Vec<Mouth>,
    /// What is hard about it, if anything is.
    pub(super) hazard: Option<Hazard>,
}

/// Draws an element from a cross-section onwards, if it can begin at such a one.
pub(super) type Builder = fn(&mut Pen, &Mouth) -> Option<Built>;

impl Built {
    /// A road that goes on.
    pub(super) fn road(mouth: Mouth, hazard: Hazard) -> Built {
        Built { mouths: vec![mouth], hazard: Some(hazard) }
    }
}
