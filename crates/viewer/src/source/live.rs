//! A simulation that runs now, and that a user changes by hand.

use std::collections::BTreeMap;
use std::mem::discriminant;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use laneweave::scenario::{Origin, Scenario};
use laneweave::sim::{Command, Commanded};
use laneweave::{Control, Fault, Lateral, LightState, Longitudinal, Parameter, VehicleId, refused};

use super::driven::Driven;
use super::ghosts;
use super::hands::{Deed, Done, Hand, Hands, Present};
use super::saved::{Saved, save};
use super::{Abilities, DemandFacts, Hello, Kind, Mark, Marks, Source, StyleFacts, TwinFacts, Wants};
use crate::scene::Scene;
use crate::snapshot::Snapshot;

/// Acts on the same thing that follow each other within this time are one: a slider that moves.
const ONE_ACT: Duration = Duration::from_secs(1);

/// A simulation that runs now. It never ends.
pub struct Live {
    driven: Driven,
    /// Commands for the next step, at most one of a kind for a thing.
    pending: Vec<Command>,
    /// Something was done by hand since the last step.
    waits: bool,
    /// All commands that were carried out.
    given: Vec<Commanded>,
    done: Vec<Done>,
    /// What was done or set is not told yet.
    has_news: bool,
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
        let (pending, given, done) = (Vec::new(), Vec::new(), Vec::new());
        Ok(Live { driven, pending, waits: false, given, done, has_news: false, twin: None, dir })
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

    /// Gives a command before the next step, in place of one of the same kind for the same thing. A vehicle that is
    /// taken off the road does nothing else.
    fn give(&mut self, command: Command) -> Result<(), Fault> {
        let checked = self.driven.world().check_content(&command);
        checked.map_err(|error| refused("by hand", &error))?;
        if !self.is_possible(&command) {
            return Err(Fault::new("by hand", "it is being taken off the road", "choose another vehicle"));
        }
        let leaves = matches!(command, Command::Remove(_));
        self.pending.retain(|it| !(is_same(it, &command) || leaves && it.target() == command.target()));
        self.pending.push(command);
        self.waits = true;
        Ok(())
    }

    /// A command that takes something back, without a lane change that was made since then.
    fn without_old_change(&self, back: Command) -> Command {
        let changes = |it| matches!(it, Control::Drive { lateral: Lateral::Change(_), .. });
        match back {
            Command::Control(id, Control::Drive { longitudinal, lateral: Lateral::Change(_) })
                if !changes(self.control(id)) =>
            {
                Command::Control(id, Control::Drive { longitudinal, lateral: Lateral::Keep })
            }
            other => other,
        }
    }

    /// Whether the vehicle that a command concerns, if it concerns one, is there and stays there.
    fn is_possible(&self, command: &Command) -> bool {
        let Some(id) = command.vehicle() else { return true };
        self.driven.world().vehicle(id).is_some() && !self.pending.contains(&Command::Remove(id))
    }

    /// A command was refused when it should have been carried out: it was not done, or what it should take back stays.
    fn was_refused(&mut self, command: &Command) {
        let concerns = |it: &&mut Done| {
            if it.is_undone { it.back.as_ref() == Some(command) } else { it.command == *command }
        };
        self.done.iter_mut().rev().find(concerns).into_iter().for_each(|it| it.is_undone = !it.is_undone);
    }

    /// Puts a vehicle on the road, and keeps its speed.
    fn insert(&mut self, command: &Command) -> Result<VehicleId, Fault> {
        let inserted = self.driven.prepared.world.command(command.clone());
        let id = inserted.map_err(|error| refused("by hand", &error))?;
        let id =
            id.ok_or_else(|| Fault::new("by hand", "the new vehicle has no id", "report this as a bug"))?;
        if let Command::Insert(vehicle) = command {
            let longitudinal = Longitudinal::Speed(vehicle.speed_mps);
            self.give(Command::Control(id, Control::Drive { longitudinal, lateral: Lateral::Keep }))?;
        }
        Ok(id)
    }

    /// Notes what was done. Acts on the same thing that follow each other soon are one.
    fn note(&mut self, command: Command, back: Option<Command>, [to_what, how]: [String; 2]) {
        self.has_news = true;
        let at = Instant::now();
        let same = |it: &&mut Done| !it.is_undone && at - it.at < ONE_ACT && is_same(&it.command, &command);
        if let Some(last) = self.done.last_mut().filter(same) {
            (last.text, last.command, last.at) = (last.to_what.clone() + &how, command, at);
            return;
        }
        let (number, time_s) = (self.done.len() + 1, self.driven.time_s());
        let text = format!("{to_what}{how}");
        self.done.push(Done { number, time_s, text, is_undone: false, to_what, command, back, at });
    }

    /// What is set by commands, as it is now.
    fn set(&self) -> Vec<Hand> {
        let mut set = BTreeMap::new();
        for command in self.given.iter().map(|it| &it.command).chain(&self.pending) {
            if let (Some(hand), Some(target)) = (Hand::setting(command), command.target()) {
                set.insert(target, hand);
            }
        }
        set.into_values().collect()
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

    fn control(&self, vehicle: VehicleId) -> Control {
        let waiting = self.pending.iter().find_map(|it| match it {
            Command::Control(of, control) => (*of == vehicle).then_some(*control),
            _ => None,
        });
        waiting.unwrap_or_else(|| self.driven.world().control_of(vehicle))
    }

    fn style_of(&self, vehicle: VehicleId) -> Option<String> {
        let now = self.driven.world().vehicle(vehicle)?;
        let waiting = self.pending.iter().find_map(|it| match it {
            Command::SetStyle(of, style) => (*of == vehicle).then_some(style),
            _ => None,
        });
        Some(waiting.unwrap_or(&now.style().name).clone())
    }

    fn light(&self, light: i64) -> Option<LightState> {
        self.last(|it| match it {
            Command::SetLight { light: of, shows } => (*of == light).then_some(*shows),
            _ => None,
        })?
    }

    fn offset(&self, light: i64) -> Option<f64> {
        let lights = &self.driven.world().network().junctions.lights;
        let plan = |id: i64| lights.iter().find(|it| it.id == id)?.plan;
        let of_light = plan(light)?;
        let set = self.last(|it| match it {
            Command::SetOffset { light: of, offset_s } => {
                plan(*of).is_some_and(|it| it.first == of_light.first).then_some(*offset_s)
            }
            _ => None,
        });
        Some(set.unwrap_or(of_light.offset))
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
        self.waits = false;
        let mut failed = None;
        for command in std::mem::take(&mut self.pending) {
            if let Err(error) = self.driven.prepared.world.command(command.clone()) {
                self.was_refused(&command);
                failed = Some(refused("by hand", &error));
            }
        }
        self.driven.step(marks);
        self.twin.iter_mut().for_each(|(_, it)| it.step(&mut Vec::new()));
        let given = self.driven.world().commands();
        // The scenario may have commands of its own.
        self.has_news |= failed.is_some() || given.iter().any(|it| Hand::setting(&it.command).is_some());
        self.given.extend_from_slice(given);
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

    fn hand(&mut self, hand: &Hand) -> Result<Option<VehicleId>, Fault> {
        let Deed { command, back, text } = Deed::of(hand, self.driven.world(), self)?;
        if let Command::Insert(_) = command {
            let id = self.insert(&command)?;
            self.note(command, Some(Command::Remove(id)), text);
            return Ok(Some(id));
        }
        self.give(command.clone())?;
        self.note(command, back, text);
        Ok(None)
    }

    fn waits(&self) -> bool {
        self.waits
    }

    fn undo(&mut self) -> Result<(), Fault> {
        let can = |it: &Done| it.back.clone().filter(|back| !it.is_undone && self.is_possible(back));
        let last = self.done.iter().enumerate().rev().find_map(|(index, it)| Some((index, can(it)?)));
        let Some((index, back)) = last else {
            return Err(match self.done.iter().rfind(|it| !it.is_undone) {
                None => Fault::new("undo", "nothing was done by hand", "do something first"),
                Some(it) => {
                    let what = format!("{}: this cannot be taken back", it.text);
                    Fault::new("undo", what, "put another vehicle on the road")
                }
            });
        };
        self.give(self.without_old_change(back))?;
        self.done[index].is_undone = true;
        self.has_news = true;
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

    fn hands(&self) -> Hands {
        Hands { done: self.done.clone(), set: self.set() }
    }

    fn has_news_of_hands(&mut self) -> bool {
        std::mem::take(&mut self.has_news)
    }

    fn save(&self) -> Result<Saved, Fault> {
        let Driven { scenario, origin, .. } = &self.driven;
        save(&self.dir, (scenario, origin), &self.given, self.driven.time_s())
    }

    fn state_hash(&self) -> u64 {
        self.driven.world().state_hash()
    }
}
