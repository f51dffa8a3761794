//! An incomplete run, resumed from its last checkpoint.

use std::fs;
use std::path::Path;

use laneweave_results::checkpoint::{self, Checkpoint};
use laneweave_results::folder::{Claim, RESULTS};
use laneweave_results::output::Provenance;
use laneweave_results::record::{self, SCENARIO, SUMMARY};
use laneweave_scenario::Fault;
use laneweave_scenario::scenario::{Origin, Scenario};

use super::results::Run;
use crate::Simulation;

/// The command line of a run to which a program gives commands.
pub(crate) const BY_COMMANDS: &str = "run by a program that gives commands, with the library of laneweave";

/// What becomes of a run that is resumed.
pub enum Resumed {
    /// It goes on, from its last checkpoint or from its beginning.
    Run(Box<Run>),
    /// It is already complete, with this summary as JSON.
    Complete(String),
}

/// The scenario of a run that was kept with its results in `dir`, complete or not.
///
/// # Errors
/// If there is none.
pub fn kept(dir: &Path) -> Result<(Scenario, Origin), Fault> {
    let (mut scenario, origin) = Origin::open(&dir.join(SCENARIO)).map_err(|fault| {
        let remedy = "give the results folder of an incomplete run";
        Fault::new(dir.display(), format!("nothing to resume: {} {}", fault.place, fault.what), remedy)
    })?;
    scenario.output.dir = dir.into();
    Ok((scenario, origin))
}

/// Resumes the run with the scenario that was [`kept`]. Its threads and the size limit of its map may be changed
/// before.
///
/// # Errors
/// If something on which the run depends has changed since, or if its checkpoint is damaged.
pub fn resume(scenario: &Scenario, origin: &Origin) -> Result<Resumed, Fault> {
    let dir = &scenario.output.dir;
    let claim = Claim::on(dir)?;
    if let Some(summary) = record::ended(dir)? {
        claim.clear(&checkpoint::FILES)?;
        return Ok(Resumed::Complete(summary));
    }
    let fingerprint = record::fingerprint(scenario, origin)?;
    let from = Checkpoint::read(&dir.join(checkpoint::FILE))?;
    if let Some(from) = &from {
        let refused = |what: &str| Fault::new(dir.display(), what, "run it again from the beginning");
        if from.fingerprint != fingerprint {
            let what =
                "the map, a style, the commands, the scenario or the program has changed since this was run";
            return Err(refused(what));
        }
        if from.output_settings != record::output_settings(scenario)? {
            return Err(refused("the [output] of its scenario has changed since this was run"));
        }
    }
    let path = dir.join(SCENARIO);
    let text = fs::read_to_string(&path).map_err(|error| Fault::refused(&path, "read", &error))?;
    let provenance = Provenance::of(text, scenario.run.seed, fingerprint);
    if provenance.command == BY_COMMANDS {
        let what = "a program gave commands to this run, and only that program can give them again";
        return Err(Fault::new(dir.display(), what, "run the program again"));
    }
    let simulation = Simulation::from_scenario(scenario, origin)?;
    claim.clear(if from.is_some() { &[SUMMARY] } else { RESULTS })?;
    Ok(Resumed::Run(Box::new(Run::new(simulation, provenance, from, claim))))
}
