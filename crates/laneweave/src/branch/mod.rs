//! Twins: the same traffic twice from a time on, once with one thing changed (a counterfactual). All random numbers
//! are the same, so the change causes every difference between the two.

mod differences;
#[cfg(feature = "reports")]
mod page;
mod parting;
mod setting;

use laneweave_results::output::Traces;
use laneweave_results::record::Record;
use laneweave_scenario::scenario::{Prepared, prepare};
use laneweave_scenario::{Fault, Script};
use laneweave_sim::World;

pub use differences::{Differences, Instant, Vehicle};
#[cfg(feature = "reports")]
pub use page::page;
pub use parting::Parting;
use parting::last_step;
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
        let Record { scenario, origin, .. } = record;
        let [mut base, mut branch] = [prepare(scenario, origin)?, prepare(scenario, origin)?];
        let parting = Parting::of(record, at, settings, &branch.world)?;
        (0..parting.step()).for_each(|_| base.step());
        parting.part(&base, &mut branch)?;
        let steps_left = last_step(record) - parting.step();
        let duration = f64::from(steps_left) * scenario.run.step_s;
        let lane = || {
            let begin = base.world.clock().time();
            Traces::most_driven(1, &base.world, &base.origins, begin, duration).pop()
        };
        let lanes = [lane(), lane()];
        let [
            Prepared { world: base, script: of_base, .. },
            Prepared { world: branch, script: of_branch, .. },
        ] = [base, branch];
        Ok(Twins { base, branch, lanes, scripts: [of_base, of_branch], steps_left })
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
