//! What a driver can make of a side at most, told from the next vehicles there.
//!
//! Between lanes that lead to the same place nothing that a longer look finds makes a side better: leaders further on
//! only lower its prospect, and a change is never comfortable. Who finds even this gain out of reach need not look.
//! Ours.

use super::situation::RouteView;

/// What bounds the gain of a change between two lanes that lead to the same place for a driver's route.
#[derive(Clone, Copy, Debug)]
pub struct GainBound {
    /// v₀: what the driver desires [m/s].
    pub desired: f64,
    /// Anticipated speeds of the own lane and of the other one, the latter at least as high as a longer look would find
    /// it [m/s].
    pub anticipated_speeds: [f64; 2],
    /// What the two lanes mean for the route.
    pub routes: [RouteView; 2],
    /// Length over which the lanes' speeds differ [m].
    pub section: f64,
    /// Gain for which the driver leaves its route [s].
    pub band: f64,
    /// A: what a change means for the others concerned, see [`super::Courtesy`].
    pub courtesy: f64,
}
