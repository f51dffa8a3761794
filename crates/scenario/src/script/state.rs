//! What a script has done so far.

use std::collections::{BTreeMap, BTreeSet};

use laneweave_sim::{Command, VehicleId, World};
use serde::{Deserialize, Serialize};

use super::obstacles::Stage;
use super::row::Row;
use crate::replay::Playback;

/// Maximum of refused commands that are told one by one.
const TOLD: usize = 3;

/// What a script has done so far.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct State {
    /// The ids of the inserted vehicles, by their ids in the file.
    inserted: BTreeMap<VehicleId, VehicleId>,
    /// The id of each external vehicle that was put on the road.
    pub(super) externals: Vec<Option<VehicleId>>,
    /// What has become of each obstacle.
    pub(super) obstacles: Vec<Stage>,
    /// What has been played of the recording.
    pub(super) playback: Playback,
    /// Number of refused commands, and the first of them in words.
    pub(super) refused: u64,
    pub(super) first_refused: Vec<String>,
}

impl State {
    /// That of a script with so many external vehicles, obstacles and parts of a recording, none of which is on the
    /// road.
    pub(super) fn of(externals: usize, obstacles: usize, recorded: usize) -> State {
        let playback = Playback::of(recorded);
        let obstacles = vec![Stage::Ahead; obstacles];
        State { externals: vec![None; externals], obstacles, playback, ..State::default() }
    }

    /// Whether it is that of a script with as many external vehicles, obstacles and parts of a recording.
    pub(crate) fn fits(&self, other: &State) -> bool {
        let parts = |it: &State| [it.externals.len(), it.obstacles.len(), it.playback.len()];
        let [own, others] = [self, other].map(parts);
        own == others
    }

    /// The same state, which knows the vehicles that were inserted `before`, and what stands on the road.
    pub(super) fn after(self, before: &State) -> State {
        let State { inserted, obstacles, playback, .. } = before.clone();
        State { inserted, obstacles, playback, ..self }
    }

    /// Gives the command of `row`, in a file with these new vehicles.
    ///
    /// # Errors
    /// Why it is refused.
    pub(super) fn give(
        &mut self,
        row: &Row,
        inserts: &BTreeSet<VehicleId>,
        world: &mut World,
    ) -> Result<(), String> {
        let mut command = row.command.clone();
        if let Some(id) = command.vehicle_mut() {
            *id = self.present(*id, inserts)?;
        }
        let vehicle = world.command(command).map_err(|it| it.to_string())?;
        if let (Command::Insert(_), Some(known), Some(id)) = (&row.command, row.inserts, vehicle) {
            self.inserted.insert(known, id);
        }
        Ok(())
    }

    /// The id that the vehicle with this id in the file has now.
    fn present(&self, id: VehicleId, inserts: &BTreeSet<VehicleId>) -> Result<VehicleId, String> {
        if let Some(present) = self.inserted.get(&id) {
            return Ok(*present);
        }
        if inserts.contains(&id) {
            return Err(format!("vehicle {id} was not inserted before"));
        }
        Ok(id)
    }

    /// Counts a refused command.
    pub(super) fn refuse(&mut self, told: impl FnOnce() -> String) {
        self.refused += 1;
        if self.first_refused.len() < TOLD {
            self.first_refused.push(told());
        }
    }
}
