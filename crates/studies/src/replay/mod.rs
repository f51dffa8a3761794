//! Replays: recorded vehicles beside drivers who react, and how well these match what was recorded of them.
//!
//! `trace.rs` follows the drivers and their records through simulations. `parting.rs`, `collisions.rs` and `score.rs`
//! compare them; `exposure.rs` tells how much of the replay is as recorded.

mod collisions;
mod departed;
mod exposure;
mod files;
mod page;
mod parting;
mod report;
mod score;
mod trace;

use std::collections::{BTreeMap, BTreeSet};
use std::num::NonZero;
use std::path::PathBuf;
use std::sync::Arc;

use laneweave_network::Network;
use laneweave_scenario::scenario::{Origin, Replay, Scenario};
use laneweave_scenario::style::Model;
use laneweave_scenario::{Fault, Played, Player, Windows, open_windows};

use crate::parallel::in_parallel;
use collisions::CollisionWatch;
use exposure::Exposure;
use laneweave::Simulation;
use laneweave::run::{Results, Run};
use trace::{Followed, Trace, Tracer};

pub use collisions::Collisions;
pub use departed::{Example, HandedOver, LateStart};
pub use page::page;
pub use parting::{PartedAfter, Parting};
pub use report::{CollisionMeans, Difference, Driver, HandOvers, Matched, Mean, Named, ReplayReport, Score};

/// The models that are usually compared beside the drivers' own.
pub const USUAL: [Model; 2] = [Model::Null, Model::Mobil];

/// Drivers decide at least so often [s].
const STEP: f64 = 0.1;

/// The scenario that replays a recording on `map`, from its first frame to its last, with no other traffic. A step is
/// as long as frames that are at most 0.1 s apart, or a whole part of the time between two frames. Of several files
/// those are replayed that hold the longest recording together; what became of the files is said in words.
///
/// # Errors
/// If a recording cannot be read, or has only one frame.
pub fn scenario(map: PathBuf, replay: Replay) -> Result<(Scenario, Vec<String>), Fault> {
    let Windows { recording, files, mut notes, problems } =
        open_windows(&replay.recording, replay.columns.as_deref())?;
    notes.extend(problems.iter().map(ToString::to_string));
    let (first, last) = recording.frames().unwrap_or_default();
    if first == last {
        let place = replay.recording.first().map_or(String::new(), |it| it.display().to_string());
        return Err(Fault::new(place, "the recording has only one frame", "choose a longer recording"));
    }
    let mut scenario = Scenario::of_map(map);
    scenario.demand.vehicles_per_hour = Some(0.0);
    scenario.guidance.interval_s = 0.0;
    scenario.run.step_s = fitting_step(recording.step);
    scenario.run.duration_s = (last - first) as f64 * recording.step;
    scenario.output.record_s = (1.0 / scenario.run.step_s).round() * scenario.run.step_s;
    scenario.output.dir = "replay".into();
    scenario.replay = Replay { recording: files, ..replay };
    Ok((scenario, notes))
}

/// The step for a recording with so much time between its frames [s].
pub(crate) fn fitting_step(frames: f64) -> f64 {
    /// Times are rounded to this [s].
    const ROUNDING: f64 = 1e-9;
    let several = (STEP / frames + ROUNDING).floor();
    let step = if several >= 1.0 { several * frames } else { frames / (frames / STEP - ROUNDING).ceil() };
    (step / ROUNDING).round() * ROUNDING
}

/// A replay, run with its results and compared with what was recorded.
pub struct Replayed {
    /// The results of its run.
    pub results: Results,
    /// How well the drivers match what was recorded; none if the run was interrupted.
    pub report: Option<ReplayReport>,
    /// The roads.
    pub network: Arc<Network>,
}

/// What is compared in a replay.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// Rollouts of each model.
    pub rollouts: u64,
    /// Lane-change models beside the drivers' own.
    pub models: Vec<Model>,
    /// Rollouts at the same time.
    pub threads: usize,
}

/// Runs the replay of `scenario` with its results, and further rollouts with other seeds and other lane-change models.
/// `command` is the command line that is kept with the results. `look` sees the first rollout before every step. The
/// replay ends early when `is_stopped`.
///
/// # Errors
/// If something is missing, not readable, or invalid, or if the results cannot be written.
pub fn replay(
    scenario: &Scenario,
    origin: &Origin,
    asked: &Asked,
    command: &str,
    mut look: impl FnMut(&Simulation),
    is_stopped: impl Fn() -> bool + Sync,
) -> Result<Replayed, Fault> {
    let run = Run::begin(scenario, origin, command)?;
    let remedy = "name the recording in the table [replay]";
    let player = run.simulation().player().cloned();
    let player = player.ok_or_else(|| Fault::new("replay", "this scenario replays no recording", remedy))?;
    let mut first = Watched::default();
    let network = run.simulation().shared_network();
    let results = run.drive(|simulation| {
        first.observe(simulation, &Followed::Drivers);
        look(simulation);
        Ok::<bool, Fault>(!is_stopped())
    })?;
    if results.summary.interrupted {
        return Ok(Replayed { results, report: None, network });
    }
    let rollouts = Rollouts { scenario, origin, player: &player, is_stopped: &is_stopped };
    let report = rollouts.report(asked, first)?;
    Ok(Replayed { results, report: (!is_stopped()).then_some(report), network })
}

/// What was seen of one rollout.
#[derive(Default)]
struct Watched {
    tracer: Tracer,
    collisions: CollisionWatch,
    exposure: Exposure,
    vehicles: Vec<Named>,
    /// The ids of those that are to become drivers.
    chosen: BTreeSet<i64>,
}

impl Watched {
    fn observe(&mut self, simulation: &Simulation, followed: &Followed) {
        self.exposure.observe(simulation);
        self.tracer.observe(simulation, followed, &self.exposure.not_compared);
        self.collisions.observe(simulation);
        if simulation.played().count() > self.vehicles.len() {
            let name = |id: i64| simulation.player()?.name(id).map(str::to_owned);
            let named = |Played { recorded, vehicle, .. }| Named { recorded, name: name(recorded), vehicle };
            self.vehicles = simulation.played().map(named).collect();
            self.chosen = simulation.played().filter(|it| it.is_reactive).map(|it| it.recorded).collect();
        }
    }
}

/// What rollouts have in common.
struct Rollouts<'a, Stopped> {
    scenario: &'a Scenario,
    origin: &'a Origin,
    player: &'a Player,
    is_stopped: &'a Stopped,
}

impl<Stopped: Fn() -> bool + Sync> Rollouts<'_, Stopped> {
    /// The report on the `first` rollout and on all others, which are run for it.
    fn report(&self, asked: &Asked, first: Watched) -> Result<ReplayReport, Fault> {
        let record = Followed::Recorded(&first.tracer.traces);
        let recorded = self.run(None, self.scenario.run.seed, self.player.as_recorded(), &record)?;
        let own = (1..asked.rollouts).map(|it| (None, it));
        let others = asked.models.iter().flat_map(|model| (0..asked.rollouts).map(|it| (Some(*model), it)));
        let jobs: Vec<(Option<Model>, u64)> = own.chain(others).collect();
        let done = in_parallel(&jobs, asked.threads, |(model, number)| {
            let seed = self.scenario.run.seed.wrapping_add(*number);
            self.run(*model, seed, self.player.with_seed(seed), &Followed::Drivers)
        })?;
        let mut done = done.into_iter();
        let mut take = |count: u64| done.by_ref().take(count as usize).collect::<Vec<Watched>>();
        let mut rollouts = vec![(
            None,
            [vec![first], take(asked.rollouts.saturating_sub(1))].into_iter().flatten().collect(),
        )];
        rollouts.extend(asked.models.iter().map(|model| (Some(*model), take(asked.rollouts))));
        Ok(ReplayReport::of(self.scenario, self.player, &recorded, rollouts))
    }

    /// One rollout without results.
    fn run(
        &self,
        model: Option<Model>,
        seed: u64,
        player: Player,
        followed: &Followed,
    ) -> Result<Watched, Fault> {
        let model = model.or(self.scenario.model);
        let mut scenario = Scenario { model, ..self.scenario.clone() };
        (scenario.run.threads, scenario.run.seed) = (NonZero::new(1), seed);
        let mut simulation = Simulation::playing(&scenario, self.origin, player)?;
        let mut watched = Watched::default();
        for _ in 0..simulation.run_steps().iter().sum() {
            if (self.is_stopped)() {
                break;
            }
            simulation.advance();
            watched.observe(&simulation, followed);
        }
        Ok(watched)
    }
}

/// Traces by the ids of the recording.
type Traces = BTreeMap<i64, Trace>;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_fall_on_the_frames_of_a_recording() {
        for (frames, step) in [(0.1, 0.1), (0.04, 0.08), (0.2, 0.1), (1.0, 0.1), (0.12, 0.06), (0.03, 0.09)] {
            assert!((fitting_step(frames) - step).abs() < 1e-9, "{frames}: {}", fitting_step(frames));
        }
        assert_eq!(fitting_step(1.0 / 30.0), 0.1);
    }
}
