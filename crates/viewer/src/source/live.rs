//! A simulation that runs now, and that a user changes by hand.

use std::mem::discriminant;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};

use laneweave::scenario::{Origin, Scenario};
use laneweave::sim::{Command, Commanded};
use laneweave::{Control, Fault, Lateral, Longitudinal, Parameter, refused};

use super::driven::Driven;
use super::ghosts;
use super::hands::{Deed, Done, Hand, Present, Saved, save};
use super::{Abilities, DemandFacts, Hello, Kind, Mark, Marks, Source, StyleFacts, TwinFacts, Wants};
use crate::scene::Scene;
use crate::snapshot::Snapshot;

/// Acts on the same thing within this time are one [s]: a slider that moves.
const ONE_ACT: f64 = 1.0;

/// A simulation that runs now. It never ends.
pub struct Live {
    driven: Driven,
    /// Commands for the next step, at most one of a kind for a thing.
    pending: Vec<Command>,
    /// All commands that were carried out.
    given: Vec<Commanded>,
    done: Vec<Done>,
    /// The unchanged twin and its begin [s], if somebody wants one.
    twin: Option<(f64, Box<Driven>)>,
    /// Where scenarios are saved.
    dir: PathBuf,
}

impl Live {
    /// The simulation of `scenario`. What is done by hand is saved in folders inside `dir`.
    ///
    /// # Errors
    /// If something is missing, not readable, or invalid.
    pub fn new(scenario: Scenario, origin: Origin, dir: PathBuf) -> Result<Live, Fault> {
        let driven = Driven::new(scenario, origin)?;
        Ok(Live { driven, pending: Vec::new(), given: Vec::new(), done: Vec::new(), twin: None, dir })
    }

    /// The last command that `found` knows, of those for the next step and those before it.
    fn last<T>(&self, found: impl Fn(&Command) -> Option<T>) -> Option<T> {
        let given = self.given.iter().map(|it| &it.command);
        given.chain(&self.pending).rev().find_map(found)
    }

    fn style(&self, name: &str) -> Option<StyleFacts> {
        self.driven.styles().into_iter().find(|it| it.name == name)
    }

    /// The demand of each entrance.
    fn demand_now(&self) -> Vec<DemandFacts> {
        let mut facts = self.driven.demand();
        for it in &mut facts {
            let now = it.origin.parse().ok().and_then(|origin| self.demand(origin));
            it.vehicles_per_hour = now.unwrap_or(it.vehicles_per_hour);
        }
        facts
    }

    /// Gives a command before the next step, in place of one of the same kind for the same thing.
    fn give(&mut self, command: Command) -> Result<(), Fault> {
        let checked = self.driven.world().check_content(&command);
        checked.map_err(|error| refused("by hand", &error))?;
        self.pending.retain(|it| !is_same(it, &command));
        self.pending.push(command);
        Ok(())
    }

    /// Puts a vehicle on the road, and keeps its speed.
    fn insert(&mut self, command: Command) -> Result<Command, Fault> {
        let Command::Insert(vehicle) = &command else { return Ok(command) };
        let longitudinal = Longitudinal::Speed(vehicle.speed_mps);
        let inserted = self.driven.prepared.world.command(command.clone());
        let id = inserted.map_err(|error| refused("by hand", &error))?;
        let id =
            id.ok_or_else(|| Fault::new("by hand", "the new vehicle has no id", "report this as a bug"))?;
        self.give(Command::Control(id, Control::Drive { longitudinal, lateral: Lateral::Keep }))?;
        Ok(Command::Remove(id))
    }

    /// Notes what was done. Acts on the same thing that follow each other soon are one.
    fn note(&mut self, command: &Command, back: Option<Command>, text: String) {
        let time_s = self.driven.time_s();
        let vehicle = match (command, &back) {
            (Command::Insert(_), Some(Command::Remove(id))) => Some(id.to_string()),
            _ => None,
        };
        let same = |it: &&mut Done| {
            let is_soon = time_s - it.time_s < ONE_ACT && !it.is_undone;
            is_soon && it.vehicle.is_none() && it.back.as_ref().is_some_and(|it| is_same(it, command))
        };
        if let Some(last) = self.done.last_mut().filter(same) {
            last.text = text;
            return;
        }
        let number = self.done.len() + 1;
        self.done.push(Done { number, time_s, text, vehicle, is_undone: false, back });
    }
}

impl Present for Live {
    fn parameter(&self, style: &str, parameter: Parameter) -> Option<f64> {
        let set = self.last(|it| match it {
            Command::SetParameter { style: of, parameter: number, value } => {
                (of == style && *number == parameter).then_some(*value)
            }
            _ => None,
        });
        set.or_else(|| self.style(style)?.value(parameter))
    }

    fn share(&self, style: &str) -> Option<f64> {
        let set = self.last(|it| match it {
            Command::SetShare { style: of, weight } => (of == style).then_some(*weight),
            _ => None,
        });
        set.or_else(|| Some(self.style(style)?.weight))
    }

    fn demand(&self, origin: i64) -> Option<f64> {
        let set = self.last(|it| match it {
            Command::SetDemand { origin: of, vehicles_per_hour } => {
                (*of == origin).then_some(*vehicles_per_hour)
            }
            _ => None,
        });
        let name = origin.to_string();
        let planned = || self.driven.demand().into_iter().find(|it| it.origin == name);
        set.or_else(|| Some(planned()?.vehicles_per_hour))
    }
}

/// Whether a world takes only one of the two in a step.
fn is_same(a: &Command, b: &Command) -> bool {
    a.target().is_some() && a.target() == b.target() && discriminant(a) == discriminant(b)
}

impl Source for Live {
    fn scene(&self) -> Scene {
        self.driven.scene()
    }

    fn hello(&self) -> Hello {
        Hello {
            version: 1,
            kind: Kind::Live,
            title: self.driven.title(),
            step_s: self.step_s(),
            time_s: self.time_s(),
            begin_s: 0.0,
            end_s: None,
            can: Abilities { hands: true, seek: false, explain: true, twin: true },
            styles: self.driven.styles(),
            demand: self.demand_now(),
        }
    }

    fn step_s(&self) -> f64 {
        self.driven.scenario.run.step_s
    }

    fn time_s(&self) -> f64 {
        self.driven.time_s()
    }

    fn step(&mut self, marks: &mut Vec<Mark>) -> Result<(), Fault> {
        let mut failed = None;
        for command in std::mem::take(&mut self.pending) {
            if let Err(error) = self.driven.prepared.world.command(command) {
                failed = Some(refused("by hand", &error));
            }
        }
        self.driven.step(marks);
        self.twin.iter_mut().for_each(|(_, it)| it.step(&mut Vec::new()));
        self.given.extend_from_slice(self.driven.world().commands());
        failed.map_or(Ok(()), Err)
    }

    fn has_ended(&self) -> bool {
        false
    }

    fn seek(&mut self, _: f64) -> Result<(), Fault> {
        let remedy = "run it, and view the folder of its results";
        Err(Fault::new("seek", "a simulation that runs now has no other times", remedy))
    }

    fn see(&self, wants: &Wants, snapshot: &mut Snapshot) {
        self.driven.see(wants, snapshot);
        self.twin.iter().for_each(|(_, it)| ghosts::add(it, wants, snapshot));
    }

    fn find(&self, id: i64) -> Option<[f64; 2]> {
        self.driven.find(id)
    }

    fn marks(&self) -> Option<Arc<Mutex<Marks>>> {
        None
    }

    fn hand(&mut self, hand: &Hand) -> Result<(), Fault> {
        let Deed { command, back, text } = Deed::of(hand, self.driven.world(), self)?;
        if let Command::Insert(_) = command {
            let back = self.insert(command.clone())?;
            self.note(&command, Some(back), text);
            return Ok(());
        }
        self.give(command.clone())?;
        self.note(&command, back, text);
        Ok(())
    }

    fn undo(&mut self) -> Result<(), Fault> {
        let Some(last) = self.done.iter().rposition(|it| !it.is_undone) else {
            return Err(Fault::new("undo", "nothing was done by hand", "do something first"));
        };
        let back = self.done[last].back.clone().ok_or_else(|| {
            let what = format!("{}: this cannot be taken back", self.done[last].text);
            Fault::new("undo", what, "put another vehicle on the road")
        })?;
        self.give(back)?;
        self.done[last].is_undone = true;
        Ok(())
    }

    fn twin(&mut self, is_wanted: bool) -> Result<(), Fault> {
        let begun = || self.driven.twin().map(|it| (self.driven.time_s(), Box::new(it)));
        self.twin = is_wanted.then(begun).transpose()?;
        Ok(())
    }

    fn twin_facts(&self) -> Option<TwinFacts> {
        self.twin.as_ref().map(|(since_s, _)| TwinFacts { since_s: *since_s, settings: Vec::new() })
    }

    fn done(&self) -> Vec<Done> {
        self.done.clone()
    }

    fn save(&self) -> Result<Saved, Fault> {
        let Driven { scenario, origin, .. } = &self.driven;
        save(&self.dir, (scenario, origin), &self.given, self.driven.time_s())
    }

    fn state_hash(&self) -> u64 {
        self.driven.world().state_hash()
    }
}
