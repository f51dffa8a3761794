//! The commands of users: those that wait for the next step, and those that were carried out in the last one.

use std::mem::discriminant;

use serde::{Deserialize, Serialize};

use crate::state::command::{Command, Commanded};
use crate::state::lane::VehicleId;

/// The commands of users.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Commands {
    /// They wait for the next step.
    waiting: Vec<Commanded>,
    /// They were carried out in the last step.
    #[serde(skip)]
    done: Vec<Commanded>,
}

impl Commands {
    /// Adds a command that waits for `step`, or that put the new vehicle `id` on the road before it.
    pub(crate) fn wait(&mut self, step: u32, vehicle: Option<VehicleId>, command: Command) {
        self.waiting.push(Commanded { step, vehicle, command });
    }

    /// Takes back the commands that wait and that `command` replaces: those of its kind for the same thing, and all for
    /// a vehicle that is to be removed.
    pub(crate) fn withdraw(&mut self, command: &Command) {
        let Some(target) = command.target() else { return };
        let is_all = matches!(command, Command::Remove(_));
        self.waiting.retain(|it| {
            let is_same_kind = discriminant(&it.command) == discriminant(command);
            it.command.target().as_ref() != Some(&target) || !(is_all || is_same_kind)
        });
    }

    /// The commands that wait for the next step.
    pub(crate) fn waiting(&self) -> &[Commanded] {
        &self.waiting
    }

    /// The commands that wait, in the order in which they are carried out. They count as done.
    pub(crate) fn begin_step(&mut self) -> &[Commanded] {
        self.done.clear();
        if !self.waiting.is_empty() {
            std::mem::swap(&mut self.waiting, &mut self.done);
            self.done.sort_by(|a, b| {
                let order = |it: &Commanded| (it.command.rank() != 0, it.vehicle, it.command.rank());
                (order(a), a.command.target()).cmp(&(order(b), b.command.target()))
            });
        }
        &self.done
    }

    /// The commands of the last step, in the order in which they were carried out.
    pub(crate) fn done(&self) -> &[Commanded] {
        &self.done
    }
}
