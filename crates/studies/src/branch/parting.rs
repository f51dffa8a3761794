//! Where twins part: the time from which on one of them has other settings.

use laneweave::Simulation;
use laneweave_results::record::{End, Record};
use laneweave_scenario::scenario::mixture;
use laneweave_scenario::style::StyleTemplate;
use laneweave_scenario::{Fault, Script};

use super::Setting;

/// Where the twins of a run part, and what is different from there on.
pub struct Parting {
    step: u32,
    /// The styles of the drivers, with their weights.
    styles: Vec<(StyleTemplate, f64)>,
    /// Other commands, if they change.
    commands: Option<Script>,
}

impl Parting {
    /// The twins of `record` part at the time `at` [s]; one of them then has the `settings`. Its commands are checked
    /// by `fresh`, the run at its start.
    ///
    /// # Errors
    /// If there is no such time in the run, or a setting does not fit.
    pub fn of(record: &Record, at: f64, settings: &[Setting], fresh: &Simulation) -> Result<Parting, Fault> {
        let End { duration_s, warmup_s, .. } = record.end;
        let step = steps(record, at);
        if at.is_nan() || at < 0.0 || step >= last_step(record) {
            let what = format!("the time {at} s");
            let remedy =
                format!("the run lasted from 0 to {} s: choose a time before its end", duration_s + warmup_s);
            return Err(Fault::new("--at", what, remedy));
        }
        let styles = changed(record, settings)?;
        let commands = settings.iter().rev().find_map(Setting::commands);
        let commands = commands.map(|it| fresh.read_commands(it)).transpose()?;
        Ok(Parting { step, styles, commands })
    }

    /// The step after which they part.
    pub fn step(&self) -> u32 {
        self.step
    }

    /// Makes `twin` what `base` is now, and gives it the settings.
    ///
    /// # Errors
    /// None, as long as both are of the run.
    pub fn part(&self, base: &Simulation, twin: &mut Simulation) -> Result<(), Fault> {
        twin.take_state_of(base)?;
        twin.change_styles(&self.styles)?;
        self.commands.iter().for_each(|it| twin.follow_commands(it));
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

/// The styles of `record` with `settings`.
fn changed(record: &Record, settings: &[Setting]) -> Result<Vec<(StyleTemplate, f64)>, Fault> {
    let mut mixture = mixture(&record.scenario, &record.origin)?;
    for setting in settings {
        setting.apply(&mut mixture)?;
    }
    Ok(mixture)
}
