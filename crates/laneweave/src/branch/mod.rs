//! Twins: the same traffic twice from a time on, once with one thing changed (a counterfactual). All random numbers
//! are the same, so the change causes every difference between the two.

mod differences;
#[cfg(feature = "reports")]
mod page;
mod setting;

use laneweave_models::Style;
use laneweave_results::output::Traces;
use laneweave_results::record::{End, Record};
use laneweave_scenario::scenario::{Prepared, driving, mixture, prepare};
use laneweave_scenario::style::Population;
use laneweave_scenario::{Fault, Script};
use laneweave_sim::World;

pub use differences::{Differences, Instant, Vehicle};
#[cfg(feature = "reports")]
pub use page::page;
pub use setting::Setting;

/// Two worlds that were one up to the branch time.
pub struct Twins {
    /// The unchanged run.
    pub base: World,
    /// The changed run.
    pub branch: World,
    /// The vehicles of the lane with the largest distance driven, in either; none where the demand has no origin.
    pub lanes: [Option<Traces>; 2],
    /// The commands of both.
    scripts: [Script; 2],
    /// Steps until the run ends.
    steps_left: u32,
}

impl Twins {
    /// The run of `record` up to the time `at` [s], and from there on with `settings`.
    ///
    /// # Errors
    /// If there is no such time in the run, or a setting does not fit.
    pub fn part(record: &Record, at: f64, settings: &[Setting]) -> Result<Twins, Fault> {
        let Record { scenario, origin, end: End { duration_s, warmup_s, .. } } = record;
        let steps = |duration: f64| (duration / scenario.run.step_s).round() as u32;
        let [all, before] = [duration_s + warmup_s, at].map(steps);
        if at.is_nan() || at < 0.0 || before >= all {
            let what = format!("the time {at} s");
            let remedy =
                format!("the run lasted from 0 to {} s: choose a time before its end", duration_s + warmup_s);
            return Err(Fault::new("--at", what, remedy));
        }
        let driver_parameters = changed(record, settings)?;
        let Prepared { world: mut base, script: mut done, origins, .. } = prepare(scenario, origin)?;
        let mut branch = prepare(scenario, origin)?.world;
        let commands = settings.iter().rev().find_map(Setting::commands);
        let other = commands.map(|it| Script::of_file(it, &branch)).transpose()?;
        (0..before).for_each(|_| done.step(&mut base));
        let other = other.map_or_else(|| done.clone(), |it| it.after(&done));
        let bug = |error: &dyn std::fmt::Display| Fault::new("branch", error, "report this as a bug");
        let saved = base.save().map_err(|error| bug(&error))?;
        branch.restore(&saved).map_err(|error| bug(&error))?;
        branch.change_driver_parameters(driver_parameters).map_err(|error| bug(&error))?;
        let duration = f64::from(all - before) * scenario.run.step_s;
        let lane = || Traces::most_driven(1, &base, &origins, base.clock().time(), duration).pop();
        let lanes = [lane(), lane()];
        Ok(Twins { base, branch, lanes, scripts: [done, other], steps_left: all - before })
    }

    /// The commands of the branch that were not possible, in a line each.
    pub fn warnings(&self) -> Vec<String> {
        self.scripts[1].warnings()
    }

    /// Runs both to the end.
    pub fn drive(&mut self) -> Differences {
        let mut differences = Differences::between(&self.base);
        for _ in 0..self.steps_left {
            let [of_base, of_branch] = &mut self.scripts;
            of_base.step(&mut self.base);
            of_branch.step(&mut self.branch);
            differences.observe(&self.base, &self.branch);
            for (lane, world) in self.lanes.iter_mut().zip([&self.base, &self.branch]) {
                lane.iter_mut().for_each(|it| it.observe(world));
            }
        }
        differences.complete(&self.base, &self.branch);
        differences
    }
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
