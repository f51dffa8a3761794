//! Gain bound: the largest gain that a side can bring, computed from the next vehicles there.
//!
//! Between lanes that lead to the same place, a longer look never makes a side better: leaders further ahead only
//! lower its anticipated speed, and the comfort of a change is never positive. A driver that cannot reach even this
//! gain need not look. Ours.

use super::situation::RouteView;

/// What bounds the gain of a change between two lanes that lead to the same place for a driver's route.
#[derive(Clone, Copy, Debug)]
pub struct GainBound {
    /// v₀: the desired speed [m/s].
    pub desired: f64,
    /// Anticipated speeds of the own lane and of the other lane [m/s]; the latter is at least as high as a longer
    /// look would find it.
    pub anticipated_speeds: [f64; 2],
    /// What the two lanes mean for the route.
    pub routes: [RouteView; 2],
    /// Length over which the lanes' speeds differ [m].
    pub section: f64,
    /// Gain for which the driver leaves its route [s].
    pub band: f64,
    /// A: what a change means for the others concerned, see [`super::Courtesy`].
    pub courtesy: f64,
    /// Y of keeping to the slow side, see [`super::Keeping`].
    pub slow_side: f64,
}
