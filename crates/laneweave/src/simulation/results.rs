//! A simulation that is run with all its result files.

use std::path::PathBuf;

use laneweave_results::output::Summary;
use laneweave_scenario::{Fault, FaultKind};

use super::Simulation;
use crate::run::{BY_COMMANDS, Run};

/// The command line of a run that a program began.
const BY_A_PROGRAM: &str = "run by a program, with the library of laneweave";

impl Simulation {
    /// Runs the scenario from its beginning to its end, writes all result files into the folder `dir`, and returns the
    /// summary. Results of a former run in that folder are replaced. Commands may have been given before.
    ///
    /// # Errors
    /// If the simulation has made a step, or its world was changed otherwise; if its map is no file; or if a file
    /// cannot be read or written.
    pub fn run_to_results(self, dir: impl Into<PathBuf>) -> Result<Summary, Fault> {
        let command = if self.is_commanded { BY_COMMANDS } else { BY_A_PROGRAM };
        self.run_with(dir.into(), command, |_| Ok::<(), Fault>(()))
    }

    /// The same, while a program gives commands: `act` is called before every step. What it does stands in the table
    /// `commands` of the results, from which the run can be repeated.
    ///
    /// # Errors
    /// Like those of [`run_to_results`](Self::run_to_results); and if `act` fails, or simulates steps itself.
    ///
    /// ```no_run
    /// # fn main() -> Result<(), laneweave::Fault> {
    /// let simulation = laneweave::Simulation::from_file("scenarios/demo.toml")?;
    /// let summary = simulation.run_to_results_with("out", |it| -> Result<(), laneweave::Fault> {
    ///     // A vehicle that has come to a halt is taken off the road.
    ///     for event in it.events() {
    ///         if let laneweave::Event::Halt(halt) = event
    ///             && it.vehicle(halt.vehicle).is_some()
    ///         {
    ///             it.remove(halt.vehicle)?;
    ///         }
    ///     }
    ///     Ok(())
    /// })?;
    /// println!("{} vehicles were removed", summary.removed);
    /// # Ok(())
    /// # }
    /// ```
    pub fn run_to_results_with<E: From<Fault>>(
        self,
        dir: impl Into<PathBuf>,
        act: impl FnMut(&mut Simulation) -> Result<(), E>,
    ) -> Result<Summary, E> {
        self.run_with(dir.into(), BY_COMMANDS, act)
    }

    fn run_with<E: From<Fault>>(
        mut self,
        dir: PathBuf,
        command: &str,
        mut act: impl FnMut(&mut Simulation) -> Result<(), E>,
    ) -> Result<Summary, E> {
        let refused = |what: &str, remedy: &str| {
            Err(Fault::new("run_to_results", what, remedy).of_kind(FaultKind::State).into())
        };
        if !self.has_map_file {
            let what = "the map is no file, so the results could not name it";
            return refused(what, "write the map into a file, and build the simulation from that");
        }
        if self.time_s() > 0.0 || self.is_changed {
            return refused("the simulation is no longer as it began", "make a new one, and run that");
        }
        self.scenario.output.dir = dir;
        Ok(Run::of(self, command)?.drive(|it| act(it).map(|()| true))?.summary)
    }
}
