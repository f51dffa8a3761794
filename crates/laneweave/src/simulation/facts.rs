//! What is known of a scenario before it runs, and what became of it.

use laneweave_maps::Problem;
use laneweave_results::About;
use laneweave_scenario::scenario::write;
use laneweave_scenario::{Capacity, Departures, Fault, Played, Player, Remark};
use laneweave_sim::{Counters, Counts, TripRecord, VehicleId};

use super::Simulation;

impl Simulation {
    /// The scenario in a few facts, as in reports.
    pub fn about(&self) -> About {
        About::of(&self.scenario, &self.prepared)
    }

    /// The elements of the map that could not be used unchanged.
    pub fn problems(&self) -> &[Problem] {
        &self.prepared.conditions.problems
    }

    /// Remarks on the traffic of the map, the most important one first.
    pub fn remarks(&self) -> &[Remark] {
        &self.prepared.conditions.remarks
    }

    /// The estimated capacity of the map.
    pub fn capacity(&self) -> &Capacity {
        &self.prepared.conditions.capacity
    }

    /// Mean demand over all entrances while it is measured [veh/h].
    pub fn demand_veh_h(&self) -> f64 {
        self.prepared.conditions.demand_veh_h
    }

    /// The default demand in a line for the screen, if it is used.
    pub fn demand_note(&self) -> Option<String> {
        self.prepared.demand_note()
    }

    /// A warning for the screen if the demand is above the estimated capacity, in a line.
    pub fn demand_warning(&self) -> Option<String> {
        self.prepared.demand_warning()
    }

    /// A warning for the screen if the step is so long that it changes the traffic, in a line.
    pub fn step_warning(&self) -> Option<String> {
        self.prepared.step_warning()
    }

    /// What did not happen as the scenario asks, in a line each: the first commands that were refused, and external
    /// vehicles that are not on the road yet.
    pub fn warnings(&self) -> Vec<String> {
        self.prepared.script.warnings()
    }

    /// The scenario as a file to edit, with the meaning and the default of every key, and what the map offers. Paths in
    /// it are those of `scenario`.
    ///
    /// # Errors
    /// None, as long as scenarios can be written as JSON.
    pub fn to_toml(&self, scenario: &laneweave_scenario::scenario::Scenario) -> Result<String, Fault> {
        write(scenario, &self.prepared)
    }

    /// The recording that is replayed, if one is.
    pub fn player(&self) -> Option<&Player> {
        self.prepared.script.player()
    }

    /// The recorded vehicles that have come so far.
    pub fn played(&self) -> impl Iterator<Item = Played> + '_ {
        self.prepared.script.played()
    }

    /// What happened otherwise than recorded so far: hand-overs, late drivers, and those who were taken off the road.
    pub fn departures(&self) -> &Departures {
        self.prepared.script.departures()
    }

    /// The counters of drivers since the warm-up ended.
    pub fn counters(&self) -> Counters {
        self.world().counters()
    }

    /// The counts of vehicles, trips and lane changes since the warm-up ended.
    pub fn counts(&self) -> &Counts {
        self.world().counts()
    }

    /// The record of the trip of a vehicle on the road.
    pub fn trip(&self, id: VehicleId) -> Option<&TripRecord> {
        self.world().trip(id)
    }

    /// Number of vehicles on the road.
    pub fn on_road(&self) -> usize {
        self.world().on_road()
    }

    /// Number of vehicles that wait to enter.
    pub fn waiting_to_enter(&self) -> usize {
        self.world().waiting()
    }
}
