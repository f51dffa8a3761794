//! A run that is driven again, and its twin with other settings, if it has one. Both are one up to where they part.

use laneweave::Fault;
use laneweave::record::Record;
use laneweave_studies::branch::{Parting, Setting};

use super::driven::{Driven, Noted};
use super::{Mark, TwinFacts, Wants, ghosts};
use crate::snapshot::Snapshot;

/// What part the twins, and when.
#[derive(Clone, Debug)]
pub(super) struct Change {
    /// The time from which on one of them has the settings [s].
    pub(super) at: f64,
    pub(super) settings: Vec<Setting>,
}

/// The state of both after a step.
#[derive(Clone, Debug)]
pub(super) struct State {
    pub(super) step: u32,
    base: Kept,
    /// None before they part.
    twin: Option<Kept>,
}

/// The state of one of them, and what was noted of it until then.
#[derive(Clone, Debug)]
struct Kept {
    world: Vec<u8>,
    noted: Noted,
}

impl Kept {
    fn of(driven: &Driven) -> Option<Kept> {
        Some(Kept { world: driven.simulation.save().ok()?, noted: driven.noted() })
    }

    fn restore(&self, driven: &mut Driven) -> Result<(), Fault> {
        driven.simulation.restore(&self.world)?;
        driven.know(&self.noted);
        Ok(())
    }
}

/// A run, and its twin.
pub(super) struct Pair {
    pub(super) base: Driven,
    twin: Option<Twin>,
}

struct Twin {
    driven: Driven,
    parting: Parting,
    facts: TwinFacts,
    is_shown: bool,
}

impl Twin {
    /// The twin of `base`, which is at its start.
    fn new(record: &Record, Change { at, settings }: &Change, base: &Driven) -> Result<Twin, Fault> {
        let parting = Parting::of(record, *at, settings, &base.simulation)?;
        let mut driven = Driven::new(&record.scenario, &record.origin)?;
        // It has its drivers and commands from now on, so that it can go to any state after the parting.
        driven.part(base, &parting)?;
        let settings = settings.iter().map(|it| it.text().to_owned()).collect();
        let facts = TwinFacts { since_s: f64::from(parting.step()) * record.scenario.run.step_s, settings };
        Ok(Twin { driven, parting, facts, is_shown: true })
    }
}

impl Pair {
    /// The run of `record` at its start, with a twin if there is a `change`.
    pub(super) fn new(record: &Record, change: Option<&Change>) -> Result<Pair, Fault> {
        let base = Driven::new(&record.scenario, &record.origin)?;
        let twin = change.map(|it| Twin::new(record, it, &base)).transpose()?;
        Ok(Pair { base, twin })
    }

    /// Steps that were made.
    pub(super) fn steps(&self) -> u32 {
        self.base.simulation.clock().step
    }

    /// Simulates a step of both, and adds what happened in the run.
    ///
    /// # Errors
    /// If the twins cannot part.
    pub(super) fn step(&mut self, marks: &mut Vec<Mark>) -> Result<(), Fault> {
        let now = self.steps();
        if let Some(Twin { driven, parting, .. }) = &mut self.twin
            && now >= parting.step()
        {
            if now == parting.step() {
                driven.part(&self.base, parting)?;
            }
            driven.step(&mut Vec::new());
        }
        self.base.step(marks);
        Ok(())
    }

    /// The state of both now, as long as there is memory.
    pub(super) fn save(&self) -> Option<State> {
        let of_twin = self.twin.as_ref().filter(|it| self.steps() > it.parting.step());
        let twin = match of_twin {
            Some(it) => Some(Kept::of(&it.driven)?),
            None => None,
        };
        Some(State { step: self.steps(), base: Kept::of(&self.base)?, twin })
    }

    /// Goes to a state of the same run and twin.
    ///
    /// # Errors
    /// If it is none.
    pub(super) fn restore(&mut self, state: &State) -> Result<(), Fault> {
        state.base.restore(&mut self.base)?;
        if let (Some(twin), Some(saved)) = (&mut self.twin, &state.twin) {
            saved.restore(&mut twin.driven)?;
        }
        Ok(())
    }

    /// Adds what can be seen now.
    pub(super) fn see(&self, wants: &Wants, snapshot: &mut Snapshot) {
        self.base.see(wants, snapshot);
        if let Some(twin) = self.twin.as_ref().filter(|it| it.is_shown) {
            ghosts::add(self.shown(twin), wants, snapshot);
        }
    }

    /// The hash of all vehicles of the twin, if there is one.
    pub(super) fn twin_hash(&self) -> Option<u64> {
        self.twin.as_ref().map(|it| self.shown(it).simulation.state_hash())
    }

    /// The twin as it is now: the run itself, before they part.
    fn shown<'a>(&'a self, twin: &'a Twin) -> &'a Driven {
        if self.steps() > twin.parting.step() { &twin.driven } else { &self.base }
    }

    /// Whether there is a twin.
    pub(super) fn has_twin(&self) -> bool {
        self.twin.is_some()
    }

    /// Shows the twin, or hides it. Returns whether there is one.
    pub(super) fn show(&mut self, is_shown: bool) -> bool {
        self.twin.iter_mut().for_each(|it| it.is_shown = is_shown);
        self.twin.is_some()
    }

    /// The twin, if it is shown.
    pub(super) fn facts(&self) -> Option<TwinFacts> {
        self.twin.as_ref().filter(|it| it.is_shown).map(|it| it.facts.clone())
    }
}
