//! Where twins part: the time from which on one of them has other settings.

use std::fmt::Display;

use laneweave_models::Style;
use laneweave_results::record::{End, Record};
use laneweave_scenario::scenario::{Prepared, driving, mixture};
use laneweave_scenario::style::Population;
use laneweave_scenario::{Fault, Script};
use laneweave_sim::World;

use super::Setting;

/// Where the twins of a run part, and what is different from there on.
pub struct Parting {
    step: u32,
    driver_parameters: Vec<Style>,
    /// Other commands, if they change.
    commands: Option<Script>,
}

impl Parting {
    /// The twins of `record` part at the time `at` [s]; one of them then has the `settings`. Its commands are checked
    /// in `empty`, a world of the run at its start.
    ///
    /// # Errors
    /// If there is no such time in the run, or a setting does not fit.
    pub fn of(record: &Record, at: f64, settings: &[Setting], empty: &World) -> Result<Parting, Fault> {
        let End { duration_s, warmup_s, .. } = record.end;
        let step = steps(record, at);
        if at.is_nan() || at < 0.0 || step >= last_step(record) {
            let what = format!("the time {at} s");
            let remedy =
                format!("the run lasted from 0 to {} s: choose a time before its end", duration_s + warmup_s);
            return Err(Fault::new("--at", what, remedy));
        }
        let driver_parameters = changed(record, settings)?;
        let commands = settings.iter().rev().find_map(Setting::commands);
        let commands = commands.map(|it| Script::of_file(it, empty)).transpose()?;
        Ok(Parting { step, driver_parameters, commands })
    }

    /// The step after which they part.
    pub fn step(&self) -> u32 {
        self.step
    }

    /// Makes `twin` what `base` is now, and gives it the settings.
    ///
    /// # Errors
    /// None, as long as both are of the run.
    pub fn part(&self, base: &Prepared, twin: &mut Prepared) -> Result<(), Fault> {
        let bug = |error: &dyn Display| Fault::new("branch", error, "report this as a bug");
        let saved = base.world.save().map_err(|error| bug(&error))?;
        twin.world.restore(&saved).map_err(|error| bug(&error))?;
        let changed = twin.world.change_driver_parameters(self.driver_parameters.clone());
        changed.map_err(|error| bug(&error))?;
        let other = self.commands.clone().map(|it| it.after(&base.script));
        twin.script = other.unwrap_or_else(|| base.script.clone());
        Ok(())
    }
}

/// The step after which the run of `record` has ended.
pub(super) fn last_step(record: &Record) -> u32 {
    let End { duration_s, warmup_s, .. } = record.end;
    steps(record, duration_s + warmup_s)
}

/// A duration [s] in steps.
fn steps(record: &Record, duration: f64) -> u32 {
    (duration / record.scenario.run.step_s).round() as u32
}

/// The drivers of `record` with `settings`.
fn changed(record: &Record, settings: &[Setting]) -> Result<Vec<Style>, Fault> {
    let Record { scenario, origin, .. } = record;
    let mut mixture = mixture(scenario, origin)?;
    let population = Population::draw(&mixture, scenario.run.seed)?;
    for setting in settings {
        setting.apply(&mut mixture)?;
    }
    Ok(driving(scenario, population.redrawn(&mixture, scenario.run.seed)?))
}
