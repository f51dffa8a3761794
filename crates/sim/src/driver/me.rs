//! A driver with all of its state.

use std::borrow::Cow;

use laneweave_models::change::LaneChangeModel;
use laneweave_models::follow::Pace;
use laneweave_models::{Alertness, Attention, Concentration, Style};

use crate::driver::attention::concentration;
use crate::state::lane::{DriverState, Kinematics, LaneChangeState, VehicleId};
use crate::state::moment::Moment;
use crate::view::scene::{Scene, Spot};

/// The driver of a vehicle.
#[derive(Clone, Copy)]
pub(crate) struct Me<'a> {
    pub(crate) spot: Spot,
    pub(crate) motion: &'a Kinematics,
    pub(crate) driver: &'a DriverState,
    pub(crate) lane_change: &'a LaneChangeState,
    pub(crate) style: &'a Style,
}

impl<'a> Me<'a> {
    /// The driver of the entry at `spot`.
    #[inline]
    pub(crate) fn at(scene: &Scene<'a>, spot: Spot) -> Me<'a> {
        let (motion, driver, lane_change) = (scene.motion(spot), scene.driver(spot), scene.lane_change(spot));
        Me { spot, motion, driver, lane_change, style: scene.style_of(driver) }
    }
}

/// Its motion, as car-following models take it.
#[inline]
pub(super) fn pace(motion: &Kinematics, driver: &DriverState) -> Pace {
    Pace {
        speed: motion.speed,
        desired: f64::from(driver.desired),
        headway_relaxation: f64::from(motion.headway_relaxation),
    }
}

/// The attention of a driver at its turn.
#[derive(Clone, Copy)]
pub(crate) struct Attending {
    pub(crate) state: Concentration,
    pub(crate) alertness: Alertness,
    /// Steps from one turn to the next.
    pub(crate) period: u32,
    /// Epochs that pass in that time.
    pub(crate) epochs: f64,
}

impl Attending {
    /// The attention of `me` at this moment.
    #[inline]
    pub(crate) fn of(me: &Me, moment: Moment) -> Attending {
        Attending::with(&me.style.attention, me.motion.id, moment)
    }

    /// The attention of the driver of `id` at this moment, if it attends in this way.
    #[inline]
    pub(crate) fn with(attention: &Attention, id: VehicleId, moment: Moment) -> Attending {
        let state = concentration(attention, moment.random, id, moment.clock.time());
        let alertness = attention.alertness(state);
        let period = moment.clock.steps(alertness.epoch);
        let epochs = f64::from(period) * moment.clock.dt / alertness.epoch;
        Attending { state, alertness, period, epochs }
    }

    /// The lane-change model of a driver of `style` with this attention.
    pub(crate) fn model<'a>(&self, style: &'a Style) -> Cow<'a, LaneChangeModel> {
        match self.state {
            Concentration::Concentrated => Cow::Borrowed(&style.change),
            Concentration::Inattentive => Cow::Owned(style.change.with_comfort(self.alertness.comfort)),
        }
    }
}
