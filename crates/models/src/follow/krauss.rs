//! The model of Krauss: as fast as is safe behind a leader who brakes comfortably.
//!
//! Krauss (1998), Microscopic Modeling of Traffic Flow, constants from memory, without its random dawdling: models draw
//! no random numbers.
//!
//! v(t + τ) = min(v + aτ, v₀, v_safe),  v_safe = −bτ + √(b²τ² + v_l² + 2b(s − s₀))
//!
//! v_safe solves v_safe = v_l + (s − s₀ − v_l τ) / ((v_safe + v_l)/2b + τ), in which Krauss has v on the right-hand
//! side. As an acceleration: [v(t + τ) − v] / τ. SUMO's drivers adopt the safe speed at once, in one step of theirs:
//! [min(v + a t_a, v₀, v_safe) − v] / t_a.

use serde::{Deserialize, Serialize};

use super::{Ahead, CarFollowing, Pace};

/// The model of Krauss.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Krauss {
    /// a: maximum acceleration [m/s²].
    pub acceleration: f64,
    /// b: comfortable deceleration [m/s²].
    pub deceleration: f64,
    /// τ: reaction time, and time gap kept to the vehicle ahead [s].
    pub time_gap: f64,
    /// s₀: gap kept at standstill [m].
    pub jam_gap: f64,
    /// t_a: time in which the speed is adopted [s]; 0: it is τ.
    pub adaptation: f64,
}

impl Default for Krauss {
    fn default() -> Krauss {
        Krauss { acceleration: 2.6, deceleration: 4.5, time_gap: 1.0, jam_gap: 2.5, adaptation: 0.0 }
    }
}

impl Krauss {
    /// v_safe [m/s].
    fn safe(&self, pace: Pace, ahead: Ahead) -> f64 {
        let reaction = self.deceleration * pace.time_gap(self.time_gap);
        let room = (ahead.gap - self.jam_gap).max(0.0);
        let way = ahead.speed * ahead.speed + 2.0 * self.deceleration * room;
        (reaction * reaction + way).sqrt() - reaction
    }
}

impl CarFollowing for Krauss {
    fn acceleration(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        let time = if self.adaptation > 0.0 { self.adaptation } else { self.time_gap };
        let reachable = (pace.speed + self.acceleration * time).min(pace.desired);
        let safe = ahead.map_or(f64::INFINITY, |ahead| self.safe(pace, ahead));
        (reachable.min(safe) - pace.speed) / time
    }
}
