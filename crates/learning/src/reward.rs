//! What an action was worth: named terms, each with a weight.

use laneweave::sim::{Vehicle, Viewpoint};
use laneweave::{Control, Simulation};
use serde::{Deserialize, Serialize};

/// The names of the terms, in the order of [`Terms::numbers`].
pub const TERMS: [&str; 9] = [
    "speed",
    "delay",
    "standing",
    "tailgating",
    "discomfort",
    "imposed_braking",
    "lane_change",
    "missed_turn",
    "collision",
];

/// The terms of a reward, or their weights: the reward is the sum of all terms, each multiplied by its weight. The
/// default weights are ours.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Rewards {
    /// Mean speed as a share of the speed limit, at most 1.
    pub speed: f64,
    /// The rest of it: the time lost, as a share of all time. The sum of `speed` over a way that is driven to its end
    /// is the same however long that takes, so time has a price only here.
    pub delay: f64,
    /// Share of the time in which the vehicle stands.
    pub standing: f64,
    /// Share of the time in which the vehicle ahead is closer than one second.
    pub tailgating: f64,
    /// Mean square of the acceleration, as a share of the hardest braking.
    pub discomfort: f64,
    /// Mean deceleration of a follower within three seconds, as a share of the hardest braking.
    pub imposed_braking: f64,
    /// Lane changes begun.
    pub lane_change: f64,
    /// Turns missed.
    pub missed_turn: f64,
    /// Collisions: at most one, which ends the episode.
    pub collision: f64,
}

impl Default for Rewards {
    fn default() -> Rewards {
        Rewards {
            speed: 1.0,
            delay: 0.0,
            standing: -0.5,
            tailgating: -0.5,
            discomfort: -0.5,
            imposed_braking: -1.0,
            lane_change: -0.05,
            missed_turn: -5.0,
            collision: -20.0,
        }
    }
}

impl Rewards {
    /// The values in the order of [`TERMS`].
    pub(crate) fn numbers(&self) -> [f64; TERMS.len()] {
        let Rewards { speed, delay, standing, tailgating, discomfort, imposed_braking, .. } = *self;
        let Rewards { lane_change, missed_turn, collision, .. } = *self;
        [speed, delay, standing, tailgating, discomfort, imposed_braking, lane_change, missed_turn, collision]
    }

    /// The reward for `terms` with these weights.
    pub(crate) fn of(&self, terms: &Rewards) -> f64 {
        self.numbers().iter().zip(terms.numbers()).map(|(weight, term)| weight * term).sum()
    }

    /// No term has a value yet.
    pub(crate) const NOTHING: Rewards = Rewards {
        speed: 0.0,
        delay: 0.0,
        standing: 0.0,
        tailgating: 0.0,
        discomfort: 0.0,
        imposed_braking: 0.0,
        lane_change: 0.0,
        missed_turn: 0.0,
        collision: 0.0,
    };

    /// Adds what a step means for the vehicle, which is `share` of the time of an action.
    pub(crate) fn add(&mut self, simulation: &Simulation, vehicle: &Vehicle, share: f64) {
        /// A vehicle that is slower stands [m/s].
        const STANDS: f64 = 0.1;
        /// A leader is too close below this time gap [s].
        const CLOSE: f64 = 1.0;
        /// Who is further behind than this time does not brake for the vehicle [s].
        const FOLLOWS: f64 = 3.0;
        let (chain, x) = (vehicle.spot.chain, vehicle.x());
        let limit = simulation.network().chain(chain).limit(x);
        let speed = (vehicle.speed() / limit).min(1.0);
        self.speed += share * speed;
        self.delay += share * (1.0 - speed);
        self.discomfort += share * (f64::from(vehicle.motion.acceleration) / Control::HARDEST).powi(2);
        if vehicle.speed() < STANDS {
            self.standing += share;
        }
        if !vehicle.is_in_lane() {
            return;
        }
        let scene = simulation.scene();
        let from: Viewpoint = scene.viewpoint(vehicle.spot);
        if scene.ahead(from).is_some_and(|it| it.gap < CLOSE * vehicle.speed()) {
            self.tailgating += share;
        }
        if let Some(follower) = scene.follower(from) {
            let motion = scene.motion(follower.spot);
            if follower.distance < FOLLOWS * motion.speed {
                self.imposed_braking += share * f64::from(-motion.acceleration).max(0.0) / Control::HARDEST;
            }
        }
    }
}
