//! Elements: the parts of a road, each from one cross-section to others.

use super::hazard::Hazard;
use super::mouth::Mouth;
use super::stretch::Pen;

/// The result of an element.
pub(super) struct Built {
    /// The roads that continue: the road itself first, then those that part from it or join it.
    pub(super) mouths: Vec<Mouth>,
    /// Its difficulty, if it has one.
    pub(super) hazard: Option<Hazard>,
}

/// Draws an element from a cross-section onwards, if it can begin there.
pub(super) type Builder = fn(&mut Pen, &Mouth) -> Option<Built>;

impl Built {
    /// A road that continues.
    pub(super) fn road(mouth: Mouth, hazard: Hazard) -> Built {
        Built { mouths: vec![mouth], hazard: Some(hazard) }
    }
}
