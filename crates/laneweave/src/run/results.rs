//! A run that writes its result files.

use std::path::PathBuf;
use std::time::Instant;

use laneweave_results::checkpoint::{self, Checkpoint, Keeper};
use laneweave_results::folder::Claim;
use laneweave_results::output::{Inputs, Provenance, Summary, all_whole, outputs, write_whole};
use laneweave_results::record::{self, SCENARIO, SUMMARY};
use laneweave_scenario::Fault;
use laneweave_scenario::scenario::{Origin, Scenario};

use super::simulate::simulate;
use crate::Simulation;

/// A run that writes its result files into the folder `output.dir` of its scenario. No other process writes there
/// while this value lives.
pub struct Run {
    simulation: Simulation,
    provenance: Provenance,
    from: Option<Checkpoint>,
    claim: Claim,
    started: Instant,
}

/// The results of a run.
pub struct Results {
    /// Its summary, as in the file `summary.json`.
    pub summary: Summary,
    /// The result files.
    pub files: Vec<PathBuf>,
    /// Names and weights of the styles.
    pub styles: Vec<(String, f64)>,
    /// What did not happen as the scenario asks, in a line each.
    pub warnings: Vec<String>,
}

impl Run {
    /// A run of `scenario`. Its folder is created, and the results of a former run there are removed; nothing is
    /// written before everything has been checked. `command` is the command line that is kept with the results.
    ///
    /// # Errors
    /// If something is missing, not readable, or invalid, or if the folder cannot be used.
    pub fn begin(scenario: &Scenario, origin: &Origin, command: &str) -> Result<Run, Fault> {
        Run::of(Simulation::from_scenario(scenario, origin)?, command)
    }

    /// The same for a `simulation` that is at its start.
    ///
    /// # Errors
    /// If the map or a style is not readable, if the folder cannot be used, or if the results would replace the
    /// commands of the scenario.
    pub fn of(simulation: Simulation, command: &str) -> Result<Run, Fault> {
        let (scenario, origin) = (simulation.scenario(), simulation.origin());
        let fingerprint = record::fingerprint(scenario, origin)?;
        let dir = &scenario.output.dir;
        record::spare_commands(scenario)?;
        let claim = Claim::on(dir)?;
        record::clear(&claim)?;
        let kept = record::keep(scenario, origin, dir, command)?;
        let provenance = Provenance::of(kept, scenario.run.seed, fingerprint);
        Ok(Run::new(simulation, provenance, None, claim))
    }

    /// A run from its parts.
    pub(super) fn new(
        simulation: Simulation,
        provenance: Provenance,
        from: Option<Checkpoint>,
        claim: Claim,
    ) -> Run {
        Run { simulation, provenance, from, claim, started: Instant::now() }
    }

    /// The same run. Its wall time counts from the instant `started`, such as the begin of the process.
    #[must_use]
    pub fn started(self, started: Instant) -> Run {
        Run { started, ..self }
    }

    /// What runs, at its start.
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// Runs to the end, and completes the result files. `goes_on` is asked before every step; if it says no, the run
    /// ends as interrupted, with the results so far.
    ///
    /// # Errors
    /// If a file cannot be written, or if the checkpoint belongs to another run.
    pub fn complete(self, mut goes_on: impl FnMut(&Simulation) -> bool) -> Result<Results, Fault> {
        self.drive(|simulation| Ok(goes_on(simulation)))
    }

    /// The same with a program that gives commands: `act` is called before every step, and says whether the run goes
    /// on.
    ///
    /// # Errors
    /// If a file cannot be written, if the checkpoint belongs to another run, or if `act` fails or simulates steps
    /// itself.
    pub fn drive<E: From<Fault>>(
        self,
        act: impl FnMut(&mut Simulation) -> Result<bool, E>,
    ) -> Result<Results, E> {
        let Run { mut simulation, provenance, from, claim, started } = self;
        let scenario = simulation.scenario().clone();
        let dir = &scenario.output.dir;
        let mut outputs = outputs(&scenario, &simulation.prepared, &provenance)?;
        let output_settings = record::output_settings(&scenario)?;
        let keeper = simulation.prepared.conditions.checkpoint_steps.map(|every| Keeper {
            path: dir.join(checkpoint::FILE),
            every,
            fingerprint: provenance.fingerprint.clone(),
            output_settings,
        });
        let mut load_s = 0.0;
        let ending = simulate(&mut simulation, &mut outputs, from, keeper.as_ref(), act, || {
            load_s = started.elapsed().as_secs_f64();
        })?;
        let wall_s = started.elapsed().as_secs_f64();
        let inputs = Inputs { scenario: &scenario, ending: &ending, wall_s, load_s, provenance: &provenance };
        let prepared = &simulation.prepared;
        let summary = Summary::of(prepared, inputs);
        let written = outputs.into_iter().map(|it| it.finish(&prepared.world, &summary));
        let written = all_whole([Ok(vec![dir.join(SCENARIO)])].into_iter().chain(written));
        let (summary, path) = (summary.clone().after(started.elapsed().as_secs_f64()), dir.join(SUMMARY));
        let summed_up = write_whole(&path, &summary.to_json()?).map(|()| vec![path]);
        let files = all_whole([written, summed_up])?;
        if keeper.is_some() && !ending.is_interrupted {
            // Once the results are on disk, there is nothing to resume any more.
            claim.settle(&files)?;
            claim.clear(&checkpoint::FILES)?;
        }
        let (styles, warnings) = (prepared.conditions.styles.clone(), prepared.script.warnings());
        Ok(Results { summary, files, styles, warnings })
    }
}

impl Results {
    /// The summary and the names of the files, as a table for the screen.
    pub fn to_text(&self) -> String {
        self.summary.to_text(&self.styles, &self.files)
    }
}
