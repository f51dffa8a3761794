//! Twins: the same traffic twice from a time on, once with one thing changed (a counterfactual). All random numbers
//! are the same, so the change causes every difference between the two.

mod differences;
mod page;
mod parting;
mod setting;

use laneweave::Simulation;
use laneweave_results::output::Traces;
use laneweave_results::record::Record;
use laneweave_scenario::Fault;

pub use differences::{Differences, Instant, Vehicle};
pub use page::page;
pub use parting::Parting;
use parting::last_step;
pub use setting::Setting;

/// Two simulations that were one up to the branch time.
pub struct Twins {
    /// The unchanged run.
    pub base: Simulation,
    /// The changed run.
    pub branch: Simulation,
    /// The vehicles of the lane with the largest distance driven, in either; none where the demand has no origin.
    pub lanes: [Option<Traces>; 2],
    /// Steps until the run ends.
    steps_left: u32,
}

impl Twins {
    /// The run of `record` up to the time `at` [s], and from there on with `settings`.
    ///
    /// # Errors
    /// If there is no such time in the run, or a setting does not fit.
    pub fn part(record: &Record, at: f64, settings: &[Setting]) -> Result<Twins, Fault> {
        let Record { scenario, origin, .. } = record;
        let simulation = || Simulation::from_scenario(scenario, origin);
        let [mut base, mut branch] = [simulation()?, simulation()?];
        let parting = Parting::of(record, at, settings, &branch)?;
        (0..parting.step()).for_each(|_| base.advance());
        parting.part(&base, &mut branch)?;
        let steps_left = last_step(record) - parting.step();
        let duration = f64::from(steps_left) * scenario.run.step_s;
        let lanes = [(); 2].map(|()| base.traces(1, duration).pop());
        Ok(Twins { base, branch, lanes, steps_left })
    }

    /// The commands of the branch that were not possible, in a line each.
    pub fn warnings(&self) -> Vec<String> {
        self.branch.warnings()
    }

    /// Runs both to the end.
    pub fn drive(&mut self) -> Differences {
        let mut differences = Differences::between(&self.base);
        for _ in 0..self.steps_left {
            self.base.advance();
            self.branch.advance();
            differences.observe(&self.base, &self.branch);
            for (lane, simulation) in self.lanes.iter_mut().zip([&self.base, &self.branch]) {
                lane.iter_mut().for_each(|it| simulation.show(it));
            }
        }
        differences.complete(&self.base, &self.branch);
        differences
    }
}
