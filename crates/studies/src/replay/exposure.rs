//! How much of a replay is as recorded: what is handed over, and for how long drivers are comparable.

use std::collections::BTreeSet;

use laneweave::sim::Vehicle;
use laneweave::{Simulation, VehicleId};
use laneweave_scenario::Departures;
use laneweave_study::units::METRES_PER_KM;

/// What was seen of one rollout.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Exposure {
    /// Time of all recorded motor vehicles that are no drivers [s], and the part of it in which they are handed over.
    recorded_s: f64,
    handed_over_s: f64,
    /// Distance that they drove [km].
    recorded_km: f64,
    /// Time of drivers [s], and the part of it in which they are comparable with their records.
    driver_s: f64,
    compared_s: f64,
    /// Drivers so far.
    drivers: BTreeSet<VehicleId>,
    /// What happened otherwise than recorded.
    pub(super) departures: Departures,
    /// Drivers who began later than recorded, or behind, and those because of whom somebody was handed over: what they
    /// do afterwards is not compared with their records.
    pub(super) not_compared: BTreeSet<VehicleId>,
}

impl Exposure {
    /// Looks at the vehicles of the recording in `simulation`, once after each step.
    pub(super) fn observe(&mut self, simulation: &Simulation) {
        let now = simulation.departures();
        let (hand_overs, starts) = (self.departures.hand_overs.len(), self.departures.starts.len());
        let elsewhere = now.starts[starts..].iter().filter(|it| it.because_of.is_some()).map(|it| it.vehicle);
        self.not_compared
            .extend(now.hand_overs[hand_overs..].iter().map(|it| it.because_of).chain(elsewhere));
        if self.departures != *now {
            self.departures.clone_from(now);
        }
        let dt = simulation.step_s();
        for played in simulation.played() {
            let Some(vehicle) = simulation.view(played.vehicle) else { continue };
            if !vehicle.is_on_its_own_path() {
                self.drivers.insert(played.vehicle);
                self.driver_s += dt;
                self.compared_s += if self.not_compared.contains(&played.vehicle) { 0.0 } else { dt };
            } else if !played.is_reactive {
                self.note_recorded(&vehicle, played.is_handed_over, dt);
            }
        }
    }

    fn note_recorded(&mut self, vehicle: &Vehicle, is_handed_over: bool, dt: f64) {
        self.recorded_s += dt;
        self.recorded_km += vehicle.speed() * dt / METRES_PER_KM;
        self.handed_over_s += if is_handed_over { dt } else { 0.0 };
    }

    /// Number of drivers.
    pub(super) fn drivers(&self) -> usize {
        self.drivers.len()
    }

    /// Hand-overs per vehicle-kilometre of recorded vehicles.
    pub(super) fn hand_overs_per_km(&self) -> Option<f64> {
        share(self.departures.hand_overs.len() as f64, self.recorded_km)
    }

    /// Share of the time of recorded vehicles in which they are handed over.
    pub(super) fn handed_over(&self) -> Option<f64> {
        share(self.handed_over_s, self.recorded_s)
    }

    /// Share of the time of drivers in which they are comparable with their records.
    pub(super) fn compared(&self) -> Option<f64> {
        share(self.compared_s, self.driver_s)
    }
}

fn share(part: f64, whole: f64) -> Option<f64> {
    (whole > 0.0).then(|| part / whole)
}
