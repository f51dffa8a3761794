//! The model of Gipps: no faster than drivers like to accelerate, nor than they can stop behind the leader.
//!
//! Gipps (1981), Transp. Res. B 15, 105, constants from memory. b and b̂ are decelerations here, positive.
//!
//! v(t + τ) = min( v + 2.5 aτ (1 − v/v₀) √(0.025 + v/v₀),  −bτ + √(b²τ² + b [2(s − s₀) − vτ + v_l²/b̂]) )
//!
//! As an acceleration: [v(t + τ) − v] / τ. Where the root would be of a negative number, which the paper leaves open,
//! it is 0.

use serde::{Deserialize, Serialize};

use super::{Ahead, CarFollowing, Pace};

/// The model of Gipps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Gipps {
    /// a: maximum acceleration [m/s²].
    pub acceleration: f64,
    /// b: hardest braking that the driver wishes to undertake [m/s²].
    pub deceleration: f64,
    /// b̂: hardest braking that it expects of its leader [m/s²].
    pub leader_deceleration: f64,
    /// τ: reaction time; the driver adds a margin of half of it [s].
    pub reaction_time: f64,
    /// s₀: gap kept at standstill [m].
    pub jam_gap: f64,
}

impl Default for Gipps {
    /// Gipps gives vehicle and gap together, 6.5 m: 2 m with a car of 4.5 m.
    fn default() -> Gipps {
        Gipps {
            acceleration: 1.7,
            deceleration: 3.4,
            leader_deceleration: 3.2,
            reaction_time: 2.0 / 3.0,
            jam_gap: 2.0,
        }
    }
}

impl Gipps {
    /// The speed [m/s] that a driver would reach within τ on a free road.
    fn free(&self, pace: Pace) -> f64 {
        let share = pace.speed / pace.desired;
        let gained = 2.5 * self.acceleration * self.reaction_time * (1.0 - share) * (0.025 + share).sqrt();
        pace.speed + gained
    }

    /// The speed [m/s] after τ from which the driver can stop behind `ahead`; negative where it should already stand.
    fn safe(&self, pace: Pace, ahead: Ahead) -> f64 {
        let time = pace.time_gap(self.reaction_time);
        let reaction = self.deceleration * time;
        let way = 2.0 * (ahead.gap - self.jam_gap) - pace.speed * time
            + ahead.speed * ahead.speed / self.leader_deceleration;
        (reaction * reaction + self.deceleration * way).max(0.0).sqrt() - reaction
    }
}

impl CarFollowing for Gipps {
    fn acceleration(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        let safe = ahead.map_or(f64::INFINITY, |ahead| self.safe(pace, ahead));
        (self.free(pace).min(safe) - pace.speed) / self.reaction_time
    }
}
