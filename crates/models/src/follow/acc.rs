//! Enhanced Intelligent Driver Model, as adaptive cruise control: a cut-in is no reason to panic.
//!
//! Kesting, Treiber, Helbing (2010), Phil. Trans. R. Soc. A 368, 4585, constants from memory: IDM, softened where the
//! constant-acceleration heuristic (CAH) finds the situation harmless. It assumes that nobody changes its acceleration.
//!
//! ã_l = min(a_l, a)
//! a_CAH = v² ã_l / (v_l² − 2s ã_l)           if v_l (v − v_l) ≤ −2s ã_l: the leader stands before the gap is gone
//!         ã_l − Δv² Θ(Δv) / 2s               otherwise
//! a_IDM where a_IDM ≥ a_CAH,  else (1 − c) a_IDM + c [a_CAH + b tanh((a_IDM − a_CAH)/b)]

use serde::{Deserialize, Serialize};

use super::{Ahead, CarFollowing, Idm, Pace};

/// Enhanced Intelligent Driver Model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Acc {
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
    /// c: how far the driver assumes that nobody changes its acceleration, 0 to 1; 0 is IDM.
    pub coolness: f64,
}

impl Default for Acc {
    fn default() -> Acc {
        Acc {
            acceleration: 1.4,
            deceleration: 2.0,
            time_gap: 1.5,
            jam_gap: 2.0,
            exponent: 4.0,
            coolness: 0.99,
        }
    }
}

impl Acc {
    /// The Intelligent Driver Model that is softened.
    pub fn idm(&self) -> Idm {
        let Acc { acceleration, deceleration, time_gap, jam_gap, exponent, coolness: _ } = *self;
        Idm { acceleration, deceleration, time_gap, jam_gap, exponent }
    }

    /// a_CAH [m/s²] of this driver.
    pub fn heuristic(&self, pace: Pace, ahead: Ahead) -> f64 {
        let acceleration = ahead.acceleration.min(self.acceleration);
        constant_acceleration(pace.speed, Ahead { acceleration, ..ahead })
    }
}

/// a_CAH: the largest acceleration [m/s²] with which a driver at `speed` [m/s] does not hit `ahead`, if nobody changes
/// its acceleration (Kesting, Treiber, Helbing 2010, Phil. Trans. R. Soc. A 368, 4585).
pub fn constant_acceleration(speed: f64, ahead: Ahead) -> f64 {
    let (gap, leader) = (ahead.gap.max(Idm::SHORTEST), ahead.acceleration);
    let closing = speed - ahead.speed;
    let reach = ahead.speed * ahead.speed - 2.0 * gap * leader;
    // The reach is 0 behind a leader that stands and stays: there the second line is the limit of the first.
    if ahead.speed * closing <= -2.0 * gap * leader && reach > 0.0 {
        speed * speed * leader / reach
    } else {
        leader - closing.max(0.0) * closing.max(0.0) / (2.0 * gap)
    }
}

impl CarFollowing for Acc {
    fn acceleration(&self, pace: Pace, ahead: Option<Ahead>) -> f64 {
        let usual = self.idm().acceleration(pace, ahead);
        let Some(ahead) = ahead else { return usual };
        let cool = self.heuristic(pace, ahead);
        if usual >= cool {
            return usual;
        }
        let eased = cool + self.deceleration * libm::tanh((usual - cool) / self.deceleration);
        (1.0 - self.coolness) * usual + self.coolness * eased
    }
}
