//! The script of a run: the commands that its scenario gives, and the external vehicles and the obstacles that it puts
//! on the road.
//!
//! A script stands beside the world, has no clock of its own, and gives the commands that are due before each step.
//! Every loop over a scenario steps through it. The commands that were carried out make the table `commands`, whose
//! rows are written and read in one place (`row.rs`); a run is repeated from its own table.

mod obstacles;
mod refused;
mod row;
mod state;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use laneweave_network::Rectangle;
use laneweave_sim::{Command, Control, NewVehicle, VehicleId, World};
use laneweave_study::seconds;

use crate::fault::Fault;
use crate::replay::{Departures, Played, Player};
use crate::scenario::{External, LONGEST, Origin, Scenario};
use obstacles::Stage;
use row::Row;
pub(crate) use row::first_step_from;
pub(crate) use state::State;

pub use refused::refused;
pub use row::{COMMAND_COLUMNS, Written};

/// What comes to stand on the road waits so long for room behind it [s] (ours): in a jam nobody leaves so much.
const WAITS: f64 = 60.0;

/// What a scenario does to its traffic. It has no clock of its own: what is due follows from that of the world.
#[derive(Clone, Default)]
pub struct Script {
    /// The file of the commands.
    path: PathBuf,
    /// Its commands, in the order of their times.
    rows: Vec<Row>,
    /// The ids of the new vehicles in the file.
    inserts: BTreeSet<VehicleId>,
    externals: Vec<Planned>,
    obstacles: Vec<obstacles::Planned>,
    /// The recording that is played, if one is.
    player: Option<Arc<Player>>,
    pub(crate) state: State,
}

/// An external vehicle of the scenario.
#[derive(Clone)]
struct Planned {
    name: Option<String>,
    from_step: u32,
    vehicle: NewVehicle,
    control: Control,
}

impl Script {
    /// The script of `scenario`, whose `world` is at its start, with what stands in the map, and the recording that
    /// `player` plays.
    pub(crate) fn of(
        scenario: &Scenario,
        origin: &Origin,
        standing: &[Rectangle],
        player: Option<Player>,
        world: &World,
    ) -> Result<Script, Fault> {
        if scenario.commands.is_some() && !scenario.external.is_empty() {
            let what = "this scenario has commands and external vehicles";
            let remedy = "leave out [[external]]: the table of commands puts those of its run on the road";
            return Err(Fault::new(origin.place(&["external"]), what, remedy));
        }
        let mut script = Script::default();
        for (number, external) in scenario.external.iter().enumerate() {
            let planned = planned(external, world);
            let planned = planned.and_then(|it| script.checked(it, world));
            script.externals.push(planned.map_err(|(key, what, remedy)| {
                Fault::new(origin.place(&["external", &number.to_string(), key]), what, remedy)
            })?);
        }
        for (number, obstacle) in scenario.obstacle.iter().enumerate() {
            let planned = obstacles::planned(obstacle, world).map_err(|(key, what, remedy)| {
                Fault::new(origin.place(&["obstacle", &number.to_string(), key]), what, remedy)
            })?;
            script.obstacles.push(planned);
        }
        let standing = standing.iter().filter_map(|it| obstacles::Planned::of_map(it, world));
        script.obstacles.extend(standing);
        script.player = player.map(Arc::new);
        script.state = script.at_its_start();
        script.with_commands(scenario.commands.as_deref(), world)
    }

    /// The commands of the file at `path` alone, or none. They are checked in `empty`, a world at its start.
    ///
    /// # Errors
    /// If the file cannot be read, or a command in it is not possible.
    pub fn of_file(path: Option<&Path>, empty: &World) -> Result<Script, Fault> {
        Script::default().with_commands(path, empty)
    }

    /// The same script at its start, with another seed for the drivers of its recording.
    pub(crate) fn restarted(&self, seed: u64) -> Script {
        let player = self.player.as_ref().map(|it| Arc::new(it.with_seed(seed)));
        let script = Script { player, ..self.clone() };
        Script { state: script.at_its_start(), ..script }
    }

    fn at_its_start(&self) -> State {
        let recorded = self.player.as_ref().map_or(0, |it| it.len());
        State::of(self.externals.len(), self.obstacles.len(), recorded)
    }

    /// The same script, which goes on with the recording and the obstacles of the script `before`, and knows the
    /// vehicles that it has inserted.
    #[must_use]
    pub fn after(self, before: &Script) -> Script {
        let (player, obstacles) = (before.player.clone(), before.obstacles.clone());
        Script { state: self.state.after(&before.state), player, obstacles, ..self }
    }

    fn with_commands(self, path: Option<&Path>, empty: &World) -> Result<Script, Fault> {
        let rows = path.map_or(Ok(Vec::new()), |it| row::read(it, empty))?;
        let path = path.map_or_else(PathBuf::new, Path::to_owned);
        let mut inserts = BTreeSet::new();
        for row in &rows {
            if let Some(id) = row.inserts
                && !inserts.insert(id)
            {
                let what = format!("vehicle {id} is inserted for the second time");
                return Err(Fault::new(row::place(&path, row.number), what, "choose another id"));
            }
        }
        Ok(Script { path, rows, inserts, ..self })
    }

    /// The same vehicle, if a program can tell it from the others.
    fn checked(&self, planned: Planned, world: &World) -> Result<Planned, Wrong> {
        if planned.name.is_some() && self.externals.iter().any(|it| it.name == planned.name) {
            let what = "another external vehicle has the same name".into();
            return Err(("name", what, "choose another name".into()));
        }
        let check = |key, command| {
            world.check_content(&command).map_err(|error| {
                let Fault { what, remedy, .. } = refused("", &error);
                (key, what, remedy)
            })
        };
        check("lanelet", Command::Insert(planned.vehicle.clone()))?;
        check("held_speed_mps", Command::Control(0, planned.control))?;
        Ok(planned)
    }

    /// Gives the commands that are due, and simulates a step of `world`.
    pub fn step(&mut self, world: &mut World) {
        let step = world.clock().step;
        let State { playback, .. } = &mut self.state;
        if let Some(player) = &self.player {
            if step == 0 {
                player.come_and_go(playback, world);
            }
            player.move_on(playback, world);
        }
        let begin = self.rows.partition_point(|it| it.step < step);
        for row in self.rows[begin..].iter().take_while(|it| it.step == step) {
            if let Err(why) = self.state.give(row, &self.inserts, world) {
                let time_s = seconds(world.clock().time());
                self.state
                    .refuse(|| format!("{} (at {time_s} s): {why}", row::place(&self.path, row.number)));
            }
        }
        for (planned, id) in self.externals.iter().zip(&mut self.state.externals) {
            if id.is_none() && planned.from_step <= step {
                *id = planned.put(world);
            }
        }
        for ((planned, stage), number) in self.obstacles.iter().zip(&mut self.state.obstacles).zip(0..) {
            *stage = planned.go_on(number, *stage, world);
        }
        world.step();
        if let Some(player) = &self.player {
            player.come_and_go(&mut self.state.playback, world);
        }
    }

    /// The recording that is played, if one is.
    pub fn player(&self) -> Option<&Player> {
        self.player.as_deref()
    }

    /// The recorded vehicles that have come so far.
    pub fn played(&self) -> impl Iterator<Item = Played> + '_ {
        self.player.iter().flat_map(|it| it.played(&self.state.playback))
    }

    /// What happened otherwise than recorded so far.
    pub fn departures(&self) -> &Departures {
        &self.state.playback.departures
    }

    /// The id of the external vehicle called `name`, as soon as it is on the road.
    pub fn external(&self, name: &str) -> Option<VehicleId> {
        let place = self.externals.iter().position(|it| it.name.as_deref() == Some(name))?;
        self.state.externals.get(place).copied().flatten()
    }

    /// Number of commands that were refused when they were due.
    pub fn refused(&self) -> u64 {
        self.state.refused
    }

    /// What did not happen as the scenario asks, in a line each: the first commands that were refused, and external
    /// vehicles that are not on the road yet.
    pub fn warnings(&self) -> Vec<String> {
        let mut lines = self.state.first_refused.clone();
        let more = self.state.refused - lines.len() as u64;
        if more > 0 {
            lines.push(format!("{more} more commands were refused"));
        }
        let waiting = self.externals.iter().zip(&self.state.externals).zip(1..);
        for ((planned, _), number) in waiting.filter(|((_, id), _)| id.is_none()) {
            let name = planned.name.as_ref().map_or(String::new(), |it| format!(" ({it})"));
            lines.push(format!("external vehicle {number}{name}: its place was never free"));
        }
        let never =
            self.state.obstacles.iter().zip(1..).filter(|it| matches!(it.0, Stage::Waits | Stage::Missed));
        lines.extend(never.map(|it| format!("obstacle {}: its place was never free", it.1)));
        lines
    }
}

/// The key of an external vehicle that is wrong, what is wrong with it, and the remedy.
type Wrong = (&'static str, String, String);

fn planned(external: &External, world: &World) -> Result<Planned, Wrong> {
    let time_s = external.time_s;
    if !(0.0..=LONGEST).contains(&time_s) {
        return Err(("time_s", format!("a time of {time_s} s"), format!("choose 0 to {LONGEST} s")));
    }
    Ok(Planned {
        name: external.name.clone(),
        from_step: first_step_from(time_s, world.clock().dt),
        vehicle: external.vehicle(),
        control: external.control(),
    })
}

impl Planned {
    /// Puts the vehicle on the road, if its place is free. One that stands there waits for a while until whoever drives
    /// behind can stop far enough behind it to go round it.
    fn put(&self, world: &mut World) -> Option<VehicleId> {
        let waits = world.clock().step < self.from_step + world.clock().steps(WAITS);
        if self.control.holds_still() && waits && !world.has_room_behind(&self.vehicle) {
            return None;
        }
        let id = world.command(Command::Insert(self.vehicle.clone())).ok().flatten()?;
        if self.control.is_external() {
            // It was checked, and is the first for this vehicle.
            let given = world.command(Command::Control(id, self.control));
            debug_assert!(given.is_ok(), "{given:?}");
        }
        Some(id)
    }
}
