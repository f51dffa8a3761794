//! The vehicles of SUMO in a scenario: who drives them, and when they depart.

use laneweave_maps::Problem;
use laneweave_network::{Classes, Network};

use super::mixture::mixture;
use super::{Demand, Origin, Scenario};
use crate::fault::Fault;
use crate::style::StyleTemplate;
use crate::sumo::{Schedule, Vehicles};

/// The vehicles of SUMO that a scenario names, if it does.
pub(super) struct Scheduled<'a> {
    scenario: &'a Scenario,
    vehicles: Option<Vehicles>,
}

impl<'a> Scheduled<'a> {
    /// Reads the files that `scenario` names.
    ///
    /// # Errors
    /// If one cannot be read, or if the scenario has another demand beside it.
    pub(super) fn of(scenario: &'a Scenario, origin: &Origin) -> Result<Scheduled<'a>, Fault> {
        if !scenario.sumo.is_asked() {
            return Ok(Scheduled { scenario, vehicles: None });
        }
        let bare = Demand { vehicles_per_hour: None, ..scenario.demand.clone() };
        let is_none = scenario.demand.vehicles_per_hour.is_none_or(|it| it == 0.0);
        if !is_none || bare != Demand::default() || !scenario.turns.is_empty() {
            let what = "the vehicles of SUMO are all traffic, but the scenario has another demand, too";
            let key = if is_none { &["demand"][..] } else { &["demand", "vehicles_per_hour"] };
            return Err(Fault::new(origin.place(key), what, "remove that demand, or the table sumo"));
        }
        Ok(Scheduled { scenario, vehicles: Some(Vehicles::read(&scenario.sumo)?) })
    }

    /// The drivers: those of the types of vehicles, or the styles of the scenario.
    ///
    /// # Errors
    /// If a style is unknown or wrong.
    pub(super) fn mixture(&self, origin: &Origin) -> Result<Vec<(StyleTemplate, f64)>, Fault> {
        match &self.vehicles {
            Some(it) if self.scenario.styles.is_empty() => it.mixture(),
            _ => mixture(self.scenario, origin),
        }
    }

    /// The departures on `network`. The weights of the `mixture` become the numbers of their drivers, and what is left
    /// out is added to the `problems`.
    ///
    /// # Errors
    /// If nobody departs.
    pub(super) fn schedule(
        &self,
        network: &Network,
        mixture: &mut [(StyleTemplate, f64)],
        problems: &mut Vec<Problem>,
    ) -> Result<Option<Schedule>, Fault> {
        let Some(vehicles) = &self.vehicles else { return Ok(None) };
        let names: Vec<&str> = mixture.iter().map(|(it, _)| it.typical().name.as_str()).collect();
        let styles = self.scenario.styles.is_empty().then_some(&names[..]);
        let (schedule, left_out) = vehicles.schedule(network, self.scenario, styles);
        problems.extend(left_out);
        if schedule.departures.is_empty() {
            let what = "no vehicle of its files drives while it is simulated";
            let remedy = "give route files of this net, and times in which vehicles depart";
            return Err(Fault::new("sumo", what, remedy));
        }
        schedule.weigh(mixture);
        Ok(Some(schedule))
    }
}

/// The classes that drive in `scenario`, with those of its departures.
pub(super) fn classes(scenario: &Scenario, schedule: Option<&Schedule>) -> Classes {
    match schedule {
        Some(schedule) => schedule.departures.iter().map(|it| it.class).collect(),
        None => scenario.demand.classes(),
    }
}
