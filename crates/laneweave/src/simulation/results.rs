//! A simulation that is run with all its result files.

use std::path::PathBuf;

use laneweave_results::output::Summary;
use laneweave_scenario::Fault;

use super::Simulation;
use crate::run::Run;

impl Simulation {
    /// Runs the scenario from its beginning to its end, writes all result files into the folder `dir`, and returns the
    /// summary. Results of a former run in that folder are replaced.
    ///
    /// # Errors
    /// If the simulation has made a step or was changed, if its map is no file, or if a file cannot be read or written.
    pub fn run_to_results(self, dir: impl Into<PathBuf>) -> Result<Summary, Fault> {
        let refused = |what: &str, remedy: &str| Err(Fault::new("run_to_results", what, remedy));
        if !self.has_map_file {
            let what = "the map is no file, so the results could not name it";
            return refused(what, "write the map into a file, and build the simulation from that");
        }
        if self.time_s() > 0.0 || self.is_changed {
            return refused("the simulation is no longer as it began", "make a new one, and run that");
        }
        let Simulation { mut scenario, origin, prepared, .. } = self;
        scenario.output.dir = dir.into();
        let run = Run::of(prepared, &scenario, &origin, "run by a program, with the library of laneweave")?;
        Ok(run.complete(|_| true)?.summary)
    }
}
