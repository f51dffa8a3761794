//! The recorded demand, simulated: vehicles come when and where they came, and drive on as drivers.

use std::collections::HashSet;
use std::num::NonZero;
use std::path::PathBuf;

use laneweave::Simulation;
use laneweave_recorded::Drone;
use laneweave_recordings::{Recording, clean};
use laneweave_scenario::scenario::{MapOptions, Origin, Replay, Scenario};
use laneweave_scenario::{AtItsEnd, Fault, Player, Recorded};

use super::split::Piece;
use crate::fit::sources::{Part, Sources};
use crate::replay::fitting_step;

/// Errors of the positions that the drone sees [m].
const NOISE: f64 = 0.1;
/// What is recorded within so far of a place shows that the place is in view [m] (ours).
const CELL: f64 = 5.0;

/// A piece of a recording that can be simulated again and again.
pub(super) struct Stage {
    scenario: Scenario,
    player: Player,
    /// The recording has frames so far apart [s].
    step: f64,
    /// The frame in which vehicles become drivers.
    release: i64,
    view: View,
}

/// The drivers of a rollout.
#[derive(Clone)]
pub(super) struct Drivers {
    /// The texts of their style files, with their shares.
    pub(super) styles: Vec<(String, f64)>,
    /// The number of a draw of their parameters.
    pub(super) draw: Option<u32>,
}

/// What was simulated.
pub(super) struct Rollout {
    /// What a drone recorded of it. Its frames are those of the recording.
    pub(super) recording: Recording,
    pub(super) collisions: u64,
}

impl Stage {
    /// The stage for a piece of the recordings.
    ///
    /// # Errors
    /// If the map has no road to drive on.
    pub(super) fn of(sources: &Sources, piece: &Piece, drivers: &Drivers) -> Result<Stage, Fault> {
        let part: &Part = &sources.parts[piece.part];
        let (site, recording) = (&sources.sites[part.site], &part.recording);
        let first = recording.frames().map_or(0, |it| it.0);
        let step = recording.step;
        let mut scenario = Scenario::of_map(site.map.path.clone());
        scenario.map_options = MapOptions { joins_ends: true, ..site.map.options.clone() };
        scenario.demand.vehicles_per_hour = Some(0.0);
        scenario.guidance.interval_s = 0.0;
        scenario.run.step_s = fitting_step(step);
        scenario.run.threads = NonZero::new(1);
        scenario.run.duration_s = (piece.measured[1] - piece.release) as f64 * step;
        scenario.output.record_s = 0.0;
        scenario.replay = Replay {
            recording: vec![PathBuf::from("the recording")],
            reactive_share: 1.0,
            // They are first put on the road as they were recorded.
            reactive_from_s: scenario.run.step_s,
            ..Replay::default()
        };
        let recorded = Recorded {
            recording: recording.clone(),
            from_s: (piece.release - first) as f64 * step,
            permitted: site.permitted.clone(),
            at_its_end: AtItsEnd::DrivesOn,
        };
        let (asked, origin) = driven_by(&scenario, drivers);
        let simulation = Simulation::replaying(&asked, &origin, recorded)?;
        let missing = || Fault::new("the recording", "it has no vehicles", "choose another one");
        let player = simulation.player().cloned().ok_or_else(missing)?;
        Ok(Stage { scenario, player, step, release: piece.release, view: View::of(recording) })
    }

    /// Simulates it with these drivers.
    ///
    /// # Errors
    /// If a number of a style is invalid.
    pub(super) fn rollout(&self, drivers: &Drivers, seed: u64) -> Result<Rollout, Fault> {
        let (mut scenario, origin) = driven_by(&self.scenario, drivers);
        scenario.run.seed = seed;
        let mut simulation = Simulation::playing(&scenario, &origin, self.player.with_seed(seed))?;
        let mut watch = simulation.drone_watch();
        let [_, steps] = simulation.run_steps();
        for _ in 0..steps {
            simulation.advance();
            simulation.show(&mut watch);
        }
        let drone = Drone { noise: NOISE, seed, ..Drone::exact(1.0 / self.step) };
        let mut seen = drone.observe(&self.view.keep(watch.into_recording()));
        let states = seen.tracks.iter_mut().flat_map(|it| &mut it.states);
        states.for_each(|it| it.frame += self.release);
        Ok(Rollout { recording: clean(seen).0, collisions: simulation.counters().collisions })
    }
}

/// The scenario with these drivers.
fn driven_by(scenario: &Scenario, drivers: &Drivers) -> (Scenario, Origin) {
    let (mut scenario, mut origin) = (scenario.clone(), Origin::default());
    scenario.styles.clear();
    for (number, (text, share)) in drivers.styles.iter().enumerate() {
        let name = number.to_string();
        origin = origin.with_style(&name, text);
        scenario.styles.insert(name, *share);
    }
    scenario.run.parameter_draw = drivers.draw;
    (scenario, origin)
}

/// What is in view: the surroundings of all places where a vehicle was recorded.
struct View(HashSet<[i32; 2]>);

impl View {
    fn of(recording: &Recording) -> View {
        let states = recording.tracks.iter().flat_map(|it| &it.states);
        View(states.map(|it| cell(it.x, it.y)).collect())
    }

    /// What is in view of a recording.
    fn keep(&self, mut recording: Recording) -> Recording {
        let is_near =
            |[x, y]: [i32; 2]| (-1..=1).any(|dx| (-1..=1).any(|dy| self.0.contains(&[x + dx, y + dy])));
        for track in &mut recording.tracks {
            track.states.retain(|it| is_near(cell(it.x, it.y)));
        }
        recording.tracks.retain(|it| !it.states.is_empty());
        recording
    }
}

fn cell(x: f64, y: f64) -> [i32; 2] {
    [x, y].map(|it| (it / CELL).floor() as i32)
}
