//! What is true of simulated drivers: their styles, their desired speeds, when they decide, and when they begin to want
//! a change.

use std::collections::{BTreeMap, BTreeSet};

use laneweave::sim::{Clock, Vehicle};
use laneweave::{Phase, Simulation};
use laneweave_calibration::observe::{FreeTime, Known};

/// Notes the truth at every step, as a drone's [`laneweave::recordings::Watch`] notes the vehicles.
pub(super) struct Truth {
    /// The step at which the recording begins.
    first: u32,
    known: Known,
    /// The names of the styles of all drivers, by the ids of their vehicles.
    styles: BTreeMap<i64, String>,
    /// The vehicles whose drivers can begin to want a change now.
    free: BTreeSet<i64>,
}

impl Truth {
    /// The truth from the present step of `simulation` on.
    pub(super) fn from_now(simulation: &Simulation) -> Truth {
        let known = Known { free: Some(Default::default()), ..Known::default() };
        Truth { first: simulation.clock().step, known, styles: BTreeMap::new(), free: BTreeSet::new() }
    }

    /// Notes what is true of all drivers now.
    pub(super) fn see(&mut self, simulation: &Simulation) {
        for vehicle in simulation.views() {
            self.note(simulation.clock(), &vehicle);
        }
    }

    fn note(&mut self, clock: Clock, vehicle: &Vehicle) {
        let (id, driver) = (i64::from(vehicle.id()), vehicle.driver);
        let period = clock.steps(vehicle.style().attention.epoch);
        let turn = f64::from((driver.due + period - self.first % period) % period) * clock.dt;
        self.styles.entry(id).or_insert_with(|| vehicle.style().name.clone());
        self.known.desired.insert(id, vehicle.style().speed_factor);
        self.known.turns.insert(id, turn);
        let time = f64::from(clock.step - self.first) * clock.dt;
        let is_free = driver.phase == Phase::Cruises && clock.step >= driver.cooldown_until;
        let was_free = if is_free { !self.free.insert(id) } else { self.free.remove(&id) };
        let times = self.known.free.get_or_insert_default().entry(id).or_default();
        match times.last_mut().filter(|_| was_free) {
            Some(last) => {
                let wanted = (driver.phase == Phase::Wants).then_some(vehicle.lane_change.side);
                *last = FreeTime { until: time, wanted, ..*last };
            }
            None if is_free => times.push(FreeTime { from: time, until: time, wanted: None }),
            None => {}
        }
    }

    /// All that was noted, and the styles.
    pub(super) fn into_known(self) -> (Known, BTreeMap<i64, String>) {
        (self.known, self.styles)
    }
}
