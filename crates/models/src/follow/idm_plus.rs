//! IDM+: the Intelligent Driver Model whose free road and whose leader limit the acceleration one at a time.
//!
//! Schakel, van Arem, Netten (2010), Effects of Cooperative Adaptive Cruise Control on Traffic Flow Stability, IEEE
//! ITSC (from memory); numbers of Schakel, Knoop, van Arem (2012), Transp. Res. Rec. 2316, 47 (LMRS; from memory).
//!
//! a min[1 − (v/v₀)^δ, 1 − (s*/s)²],  s* as in IDM
//!
//! IDM adds both, so that its equilibrium gap grows without bound towards the desired speed: a lane near its desired
//! speed carries less than drivers with that time gap let through. Here the gap that is kept is s₀ + vT at any speed.

use serde::{Deserialize, Serialize};

use super::{Ahead, CarFollowing, Idm, Pace};

/// The Intelligent Driver Model with the least of its two terms.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct IdmPlus {
    /// a: maximum acceleration [m/s²].
    pub acceleration: f64,
    /// b: comfortable deceleration [m/s²].
    pub deceleration: f64,
    /// T: time gap kept to the vehicle ahead [s].
    pub time_gap: f64,
    /// s₀: gap kept at standstill [m].
    pub jam_gap: f64,
    /// δ: how late the acceleration fades as the speed approaches the desired speed.
    pub exponent: f64,
}

impl Default for IdmPlus {
    fn default() -> IdmPlus {
        IdmPlus { acceleration: 1.25, deceleration: 2.09, time_gap: 1.2, jam_gap: 3.0, exponent: 4.0 }
    }
}

impl IdmPlus {
    /// The Intelligent Driver Model that has the same terms, and adds them.
    #[inline]
    pub fn idm(&self) -> Idm {
        let IdmPlus { acceleration, deceleration, time_gap, jam_gap, exponent } = *self;
        Idm { acceleration, deceleration, time_gap, jam_gap, exponent }
    }
}

impl CarFollowing for IdmPlus {
    #[inline]
    fn acceleration(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        let idm = self.idm();
        let free = idm.free(pace.speed / pace.desired);
        let behind = ahead.map_or(free, |ahead| 1.0 - idm.interaction(pace, ahead));
        // Plain comparisons: f64::min takes longer here.
        self.acceleration * if free < behind { free } else { behind }
    }
}
