//! Attention: a driver is concentrated or inattentive, and changes between these two states.
//!
//! The paper has it in words ("regular inattention", "fatigue and driver distraction"): inattentive drivers consider
//! lanes every 2 s instead of 1 s, use what they saw then, and give comfort more weight. The form is ours: a Markov
//! process of two states. A driver stays in each state for an exponentially distributed time.

use serde::{Deserialize, Serialize};

use crate::change::SIGHT;

/// How a driver attends to the lanes, and how long it stays concentrated.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Attention {
    /// τ_d: time between two considerations of a concentrated driver [s].
    pub epoch: f64,
    /// Mean time that it stays concentrated [s]; 0: it is always inattentive, if it is ever inattentive.
    pub concentrated_for: f64,
    /// Mean time that it stays inattentive [s]; 0: it is never inattentive.
    pub inattentive_for: f64,
    /// How it attends while inattentive.
    pub inattentive: Alertness,
}

/// How a driver attends to the lanes for now.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Alertness {
    /// τ_d: time between two considerations [s].
    pub epoch: f64,
    /// How far ahead it sees what a lane is like [m], at most [`SIGHT`].
    pub sight: f64,
    /// How many times as much comfort weighs.
    pub comfort: f64,
}

/// Which of the two states a driver is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Concentration {
    /// It attends to the road.
    Concentrated,
    /// It attends to something else.
    Inattentive,
}

impl Default for Attention {
    /// Always concentrated. τ_d is the paper's.
    fn default() -> Attention {
        Attention {
            epoch: 1.0,
            concentrated_for: 60.0,
            inattentive_for: 0.0,
            inattentive: Alertness::default(),
        }
    }
}

impl Default for Alertness {
    /// Of an inattentive driver: τ_d is the paper's, the others are ours.
    fn default() -> Alertness {
        Alertness { epoch: 2.0, sight: 150.0, comfort: 2.0 }
    }
}

impl Attention {
    /// Share of its time that the driver is inattentive.
    #[inline]
    pub fn inattentive_share(&self) -> f64 {
        if self.inattentive_for == 0.0 {
            return 0.0;
        }
        self.inattentive_for / (self.concentrated_for + self.inattentive_for)
    }

    /// Correlation time of the state [s], 1/(1/τ_c + 1/τ_i): after it, knowledge of the earlier state tells e times
    /// less about the present one. 0 for a driver who is always in the same state.
    pub fn memory(&self) -> f64 {
        self.concentrated_for * self.inattentive_share()
    }

    /// How the driver attends in the state `concentration`.
    #[inline]
    pub fn alertness(&self, concentration: Concentration) -> Alertness {
        match concentration {
            Concentration::Concentrated => Alertness { epoch: self.epoch, sight: SIGHT, comfort: 1.0 },
            Concentration::Inattentive => self.inattentive,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_driver_is_always_concentrated_unless_its_style_says_otherwise() {
        let usual = Attention::default();
        assert_eq!(usual.inattentive_share(), 0.0);
        let alertness = usual.alertness(Concentration::Concentrated);
        assert_eq!(alertness, Alertness { epoch: 1.0, sight: SIGHT, comfort: 1.0 });
    }

    #[test]
    fn shares_and_memory_follow_from_the_mean_times_in_both_states() {
        let of = |concentrated_for, inattentive_for| {
            let attention = Attention { concentrated_for, inattentive_for, ..Attention::default() };
            (attention.inattentive_share(), attention.memory())
        };
        assert_eq!(of(60.0, 20.0), (0.25, 15.0));
        assert_eq!(of(0.0, 20.0), (1.0, 0.0));
        assert_eq!(of(60.0, 0.0), (0.0, 0.0));
        assert_eq!(of(0.0, 0.0), (0.0, 0.0));
    }
}
