//! T_h: mean time headway of a lane around a driver, T_h = d̄/v̄.
//!
//! * literal: v̄ floored at 0.5 m/s, T_h capped at 10 s.
//! * repaired: T_h = max(0, d̄ − l − s₀) / max(v̄, 2 m/s). With distance headways T_h is one over the flow, and a
//!   free and a jammed lane of equal flow look alike.

use crate::Reading;

/// Mean state of a lane over the window 100 m back to 200 m ahead, the driver excluded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flow {
    /// d̄: mean distance headway [m]; the window's length where it is empty.
    pub spacing: f64,
    /// v̄: mean speed [m/s].
    pub speed: f64,
    /// l: mean vehicle length [m].
    pub length: f64,
}

/// s₀ in the repaired headway [m].
const JAM_GAP: f64 = 2.0;
/// Floor of v̄ in the literal headway [m/s].
const LITERAL_SLOWEST: f64 = 0.5;
/// Cap of the literal headway [s].
const LITERAL_LONGEST: f64 = 10.0;
/// Floor of v̄ in the repaired headway [m/s].
const REPAIRED_SLOWEST: f64 = 2.0;

impl Flow {
    /// T_h [s].
    #[inline]
    pub fn headway(&self, reading: Reading) -> f64 {
        match reading {
            Reading::Literal => (self.spacing / self.speed.max(LITERAL_SLOWEST)).min(LITERAL_LONGEST),
            Reading::Repaired => {
                (self.spacing - self.length - JAM_GAP).max(0.0) / self.speed.max(REPAIRED_SLOWEST)
            }
        }
    }
}
