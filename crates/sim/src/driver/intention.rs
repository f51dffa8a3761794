//! What a driver intends to do in the next step. It decides as in a step, and its plan is read.

use laneweave_network::Side;
use serde::{Deserialize, Serialize};

use crate::driver::decide::decide_one;
use crate::driver::drive::acceleration;
use crate::driver::me::Me;
use crate::driver::plan::{Outbox, Plan};
use crate::driver::wish::wish;
use crate::state::control::{Control, Lateral, Longitudinal};
use crate::state::moment::Moment;
use crate::view::scene::{Scene, Spot};

/// What a driver intends to do in the next step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Intention {
    /// Its acceleration [m/s²].
    pub acceleration: f64,
    /// The side to which it wants to change, or goes on changing. `None` if it keeps its lane, gives up a desired
    /// change, or aborts one.
    pub changes_to: Option<Side>,
}

impl Intention {
    /// The control that makes the vehicle do the same.
    pub fn control(self) -> Control {
        Control::Drive {
            longitudinal: Longitudinal::Acceleration(self.acceleration),
            lateral: self.changes_to.map_or(Lateral::Keep, Lateral::Change),
        }
    }
}

/// What the driver of the vehicle with the main entry `spot` intends.
pub(crate) fn intention(scene: &Scene, moment: Moment, spot: Spot) -> Intention {
    let (mut plan, mut outbox) = (Plan::default(), Outbox::default());
    if scene.driver(spot).has_to_decide(moment.clock.step) {
        decide_one(scene, moment, spot, &mut [0; 2], &mut plan, &mut outbox);
    }
    Intention {
        acceleration: acceleration(scene, moment.clock, spot),
        changes_to: wish(&Me::at(scene, spot), &outbox.requests, &plan.concerns),
    }
}
