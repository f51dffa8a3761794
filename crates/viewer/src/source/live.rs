//! A simulation that runs now, and that a user changes by hand.

use std::collections::{BTreeMap, BTreeSet};
use std::mem::discriminant;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use laneweave::scenario::{Origin, Scenario};
use laneweave::sim::{Command, Commanded, Target};
use laneweave::{Control, Fault, Lateral, Longitudinal, NewVehicle, Simulation, VehicleId};

use super::driven::Driven;
use super::ghosts;
use super::hands::{Deed, Done, Hand, Hands};
use super::saved::{Saved, save};
use super::{Abilities, Hello, Kind, Mark, Marks, Source, TwinFacts, Wants};
use crate::scene::{Scene, Surroundings};
use crate::snapshot::Snapshot;

/// Acts on the same thing that follow each other within this time are one: a slider that moves.
const ONE_ACT: Duration = Duration::from_secs(1);

/// A simulation that runs now. It never ends.
pub struct Live {
    driven: Driven,
    /// Something was done by hand since the last step.
    waits: bool,
    /// What was set, by hand or by the scenario.
    touched: BTreeSet<Target>,
    /// All commands that were carried out.
    given: Vec<Commanded>,
    done: Vec<Done>,
    /// Those of `done` that are new or have changed since they were told, by their places.
    untold: BTreeSet<usize>,
    /// What was set, as it was told.
    told: BTreeMap<Target, Hand>,
    /// Something may be set that is not told yet.
    has_news: bool,
    /// The unchanged twin and its begin [s], if somebody wants one.
    twin: Option<(f64, Box<Driven>)>,
    /// Where scenarios are saved; nowhere if the scenario alone does not lead to the begin of the traffic.
    dir: Option<PathBuf>,
}

impl Live {
    /// The simulation of `scenario`. What is done by hand is saved in folders inside `dir`.
    ///
    /// # Errors
    /// If something is missing, not readable, or invalid.
    pub fn new(scenario: &Scenario, origin: &Origin, dir: PathBuf) -> Result<Live, Fault> {
        Ok(Live::driven(Driven::new(scenario, origin)?, Some(dir)))
    }

    /// A simulation that goes on from where it is, on a map that has this beside its network. What is done by hand can
    /// be saved only if it is at its start: otherwise its scenario does not lead to where it is.
    pub fn of(simulation: Simulation, around: Surroundings, dir: PathBuf) -> Live {
        let dir = simulation.is_as_it_began().then_some(dir);
        Live::driven(Driven::of(simulation, around), dir)
    }

    fn driven(driven: Driven, dir: Option<PathBuf>) -> Live {
        Live {
            driven,
            waits: false,
            touched: BTreeSet::new(),
            given: Vec::new(),
            done: Vec::new(),
            untold: BTreeSet::new(),
            told: BTreeMap::new(),
            has_news: false,
            twin: None,
            dir,
        }
    }

    /// Gives a command before the next step, in place of those that wait and contradict it.
    fn give(&mut self, command: &Command) -> Result<(), Fault> {
        let leaving = command.vehicle().is_some_and(|it| self.driven.simulation.is_leaving(it));
        if leaving && !matches!(command, Command::Remove(_)) {
            return Err(Fault::new("by hand", "it is being taken off the road", "choose another vehicle"));
        }
        self.driven
            .simulation
            .replace(command.clone())
            .map_err(|fault| Fault { place: "by hand".into(), ..fault })?;
        self.touched.extend(command.target());
        self.waits = true;
        Ok(())
    }

    /// A command that takes something back, without a lane change that was made since then.
    fn without_old_change(&self, back: Command) -> Command {
        let changes = |it| matches!(it, Control::Drive { lateral: Lateral::Change(_), .. });
        match back {
            Command::Control(id, Control::Drive { longitudinal, lateral: Lateral::Change(_) })
                if !changes(self.driven.simulation.control_of(id)) =>
            {
                Command::Control(id, Control::Drive { longitudinal, lateral: Lateral::Keep })
            }
            other => other,
        }
    }

    /// Whether the vehicle that a command concerns, if it concerns one, is there and stays there.
    fn is_possible(&self, command: &Command) -> bool {
        let Some(id) = command.vehicle() else { return true };
        let simulation = &self.driven.simulation;
        simulation.view(id).is_some() && !simulation.is_leaving(id)
    }

    /// Puts a vehicle on the road, and keeps its speed.
    fn insert(&mut self, vehicle: &NewVehicle) -> Result<VehicleId, Fault> {
        let inserted = self.driven.simulation.insert(vehicle.clone());
        let id = inserted.map_err(|fault| Fault { place: "by hand".into(), ..fault })?;
        let longitudinal = Longitudinal::Speed(vehicle.speed_mps);
        self.give(&Command::Control(id, Control::Drive { longitudinal, lateral: Lateral::Keep }))?;
        Ok(id)
    }

    /// Notes what was done. Acts on the same thing that follow each other soon are one.
    fn note(&mut self, command: Command, back: Option<Command>, [to_what, how]: [String; 2]) {
        self.has_news = true;
        let at = Instant::now();
        let same = |it: &&mut Done| !it.is_undone && at - it.at < ONE_ACT && is_same(&it.command, &command);
        if let Some(last) = self.done.last_mut().filter(same) {
            (last.text, last.command, last.at) = (last.to_what.clone() + &how, command, at);
            self.untold.insert(last.number - 1);
            return;
        }
        let (number, time_s) = (self.done.len() + 1, self.driven.time_s());
        let text = format!("{to_what}{how}");
        self.untold.insert(self.done.len());
        self.done.push(Done { number, time_s, text, is_undone: false, to_what, command, back, at });
    }

    /// What was set, as it is now.
    fn set(&self) -> impl Iterator<Item = (&Target, Hand)> {
        self.touched.iter().filter_map(|it| Some((it, Hand::setting(it, &self.driven.simulation)?)))
    }
}

/// Whether the two are of one kind and concern the same thing.
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
            demand: self.driven.demand(),
        }
    }

    fn step_s(&self) -> f64 {
        self.driven.simulation.step_s()
    }

    fn time_s(&self) -> f64 {
        self.driven.time_s()
    }

    fn step(&mut self, marks: &mut Vec<Mark>) -> Result<(), Fault> {
        self.waits = false;
        self.driven.step(marks);
        self.twin.iter_mut().for_each(|(_, it)| it.step(&mut Vec::new()));
        // The scenario may have commands of its own.
        let given = self.driven.simulation.commands();
        let targets = given.iter().filter_map(|it| it.command.target());
        let settings: Vec<Target> = targets.filter(|it| !matches!(it, Target::Vehicle(_))).collect();
        self.has_news |= !settings.is_empty();
        self.touched.extend(settings);
        self.given.extend_from_slice(given);
        Ok(())
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
        let Deed { command, back, text } = Deed::of(hand, &self.driven.simulation)?;
        if let Command::Insert(vehicle) = &command {
            let id = self.insert(vehicle)?;
            self.note(command, Some(Command::Remove(id)), text);
            return Ok(Some(id));
        }
        self.give(&command)?;
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
        self.give(&self.without_old_change(back))?;
        self.done[index].is_undone = true;
        self.untold.insert(index);
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
        Hands { done: self.done.clone(), set: self.set().map(|(_, it)| it).collect() }
    }

    fn news_of_hands(&mut self) -> Option<Hands> {
        if !std::mem::take(&mut self.has_news) {
            return None;
        }
        let done = std::mem::take(&mut self.untold).into_iter().map(|it| self.done[it].clone()).collect();
        let is_new = |(target, it): &(&Target, Hand)| self.told.get(target) != Some(it);
        let news: Vec<(Target, Hand)> =
            self.set().filter(is_new).map(|(target, it)| (target.clone(), it)).collect();
        self.told.extend(news.iter().cloned());
        let hands = Hands { done, set: news.into_iter().map(|(_, it)| it).collect() };
        (!hands.done.is_empty() || !hands.set.is_empty()).then_some(hands)
    }

    fn save(&self) -> Result<Saved, Fault> {
        let simulation = &self.driven.simulation;
        let dir = self.dir.as_ref().ok_or_else(|| {
            let what = "a program drove this traffic before it was shown, so its scenario does not lead here";
            Fault::new("save", what, "save its state in the program, or show it from its start")
        })?;
        save(dir, (simulation.scenario(), simulation.origin()), &self.given, simulation.time_s())
    }

    fn state_hash(&self) -> u64 {
        self.driven.simulation.state_hash()
    }
}
