//! Newell's simplified model: a driver does what its leader did, a time τ later and a distance d further back.
//!
//! Newell (2002), Transp. Res. B 36, 195: x(t + τ) = min(x(t) + v₀τ, x_l(t) − d), d the leader's length and s₀. Jams
//! move upstream with d/τ.
//!
//! As an acceleration that is constant over τ and covers that way (ours): v(t + τ) = 2 min(v₀, (s − s₀)/τ) − v, at most
//! v₀, and [v(t + τ) − v] / τ. In steps of τ the printed line comes out exactly where the leader, too, accelerates
//! evenly within steps. In shorter steps, as a driver does not remember what its leader did, it is 2 [(s − s₀)/τ − v] /
//! τ, on the verge of stability.

use serde::{Deserialize, Serialize};

use super::{Ahead, CarFollowing, Pace};

/// Newell's simplified model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Newell {
    /// τ: time by which a driver is behind its leader [s].
    pub time_gap: f64,
    /// s₀: gap kept at standstill [m].
    pub jam_gap: f64,
}

impl Default for Newell {
    /// Ours: with vehicles of 5 m jams move upstream with 16.8 km/h.
    fn default() -> Newell {
        Newell { time_gap: 1.5, jam_gap: 2.0 }
    }
}

impl CarFollowing for Newell {
    fn acceleration(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        let time_gap = pace.time_gap(self.time_gap);
        let mean = ahead.map_or(f64::INFINITY, |ahead| (ahead.gap - self.jam_gap) / time_gap);
        let after = 2.0 * mean.min(pace.desired) - pace.speed;
        (after.min(pace.desired) - pace.speed) / time_gap
    }
}
