//! A run that has ended. No frames were kept of it: it is driven again, bit for bit, from states that a survey keeps.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

use laneweave::record::{End, Record};
use laneweave::{Fault, VehicleId};

use super::driven::Driven;
use super::hands::{Hand, Hands};
use super::saved::Saved;
use super::{Abilities, Hello, Kind, Mark, Marks, Source, Wants};
use crate::scene::Scene;
use crate::snapshot::Snapshot;

/// States that the survey keeps.
const STATES: u32 = 60;
/// Steps between two messages of the survey.
const NEWS: u32 = 100;

/// States by their steps, in order, which two threads share.
type States = Arc<Mutex<Vec<(u32, Vec<u8>)>>>;

/// A run that has ended.
pub struct Rerun {
    driven: Driven,
    /// The step after which it has ended.
    last_step: u32,
    /// States of its world by their steps, in order.
    states: States,
    marks: Arc<Mutex<Marks>>,
    /// Tells the survey that nobody waits for it any more.
    is_over: Arc<AtomicBool>,
}

impl Rerun {
    /// The run with its results in `dir`, at its start. Its marks and states are looked for by another thread.
    ///
    /// # Errors
    /// If there is none, or if something is missing, not readable, or invalid.
    pub fn open(dir: &Path) -> Result<Rerun, Fault> {
        let Record { scenario, origin, end: End { duration_s, warmup_s, .. } } = Record::open(dir)?;
        let last_step = ((duration_s + warmup_s) / scenario.run.step_s).round() as u32;
        let driven = Driven::new(scenario.clone(), origin.clone())?;
        let survey = Driven::new(scenario, origin)?;
        let rerun = Rerun {
            driven,
            last_step,
            states: Arc::default(),
            marks: Arc::default(),
            is_over: Arc::default(),
        };
        let shared = (Arc::clone(&rerun.states), Arc::clone(&rerun.marks), Arc::clone(&rerun.is_over));
        thread::spawn(move || look(survey, last_step, &shared));
        Ok(rerun)
    }

    /// The last kept state that is not after `step`.
    fn state_before(&self, step: u32) -> Option<(u32, Vec<u8>)> {
        let states = self.states.lock().unwrap_or_else(PoisonError::into_inner);
        let after = states.partition_point(|it| it.0 <= step);
        after.checked_sub(1).map(|it| states[it].clone())
    }
}

impl Drop for Rerun {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Relaxed);
    }
}

type Shared = (States, Arc<Mutex<Marks>>, Arc<AtomicBool>);

/// Drives the run once, and keeps states and marks of it.
fn look(mut survey: Driven, last_step: u32, (states, marks, is_over): &Shared) {
    let every = last_step.div_ceil(STATES).max(1);
    let mut found = Vec::new();
    for step in 0..=last_step {
        if is_over.load(Ordering::Relaxed) {
            return;
        }
        if step.is_multiple_of(every)
            && let Ok(state) = survey.prepared.save()
        {
            states.lock().unwrap_or_else(PoisonError::into_inner).push((step, state));
        }
        if step == last_step || step.is_multiple_of(NEWS) {
            let mut marks = marks.lock().unwrap_or_else(PoisonError::into_inner);
            marks.marks.append(&mut found);
            marks.until_s = survey.time_s();
        }
        if step < last_step {
            survey.step(&mut found);
        }
    }
}

/// A run that has ended cannot be changed.
fn is_over<T>(what: &str) -> Result<T, Fault> {
    let remedy = "view its scenario, and do it there";
    Err(Fault::new(what, "a run that has ended cannot be changed", remedy))
}

impl Source for Rerun {
    fn scene(&self) -> Scene {
        self.driven.scene()
    }

    fn hello(&self) -> Hello {
        let step_s = self.step_s();
        Hello {
            version: 1,
            kind: Kind::Run,
            title: self.driven.title(),
            step_s,
            time_s: self.time_s(),
            begin_s: 0.0,
            end_s: Some(f64::from(self.last_step) * step_s),
            can: Abilities { hands: false, seek: true, explain: true },
            styles: self.driven.styles(),
            demand: self.driven.demand(),
        }
    }

    fn step_s(&self) -> f64 {
        self.driven.scenario.run.step_s
    }

    fn time_s(&self) -> f64 {
        self.driven.time_s()
    }

    fn step(&mut self, marks: &mut Vec<Mark>) -> Result<(), Fault> {
        if !self.has_ended() {
            self.driven.step(marks);
        }
        Ok(())
    }

    fn has_ended(&self) -> bool {
        self.driven.world().clock().step >= self.last_step
    }

    fn seek(&mut self, time_s: f64) -> Result<(), Fault> {
        let step =
            (time_s / self.driven.scenario.run.step_s).round().clamp(0.0, f64::from(self.last_step)) as u32;
        let now = self.driven.world().clock().step;
        let kept = self.state_before(step).filter(|(at, _)| step < now || *at > now);
        if let Some((_, state)) = kept {
            let restored = self.driven.prepared.restore(&state);
            restored.map_err(|error| Fault::new("seek", error, "report this as a bug"))?;
            self.driven.forget();
        }
        let mut passed = Vec::new();
        while self.driven.world().clock().step < step {
            self.driven.step(&mut passed);
        }
        Ok(())
    }

    fn see(&self, wants: &Wants, snapshot: &mut Snapshot) {
        self.driven.see(wants, snapshot);
    }

    fn find(&self, id: i64) -> Option<[f64; 2]> {
        self.driven.find(id)
    }

    fn marks(&self) -> Option<Arc<Mutex<Marks>>> {
        Some(Arc::clone(&self.marks))
    }

    fn hand(&mut self, _: &Hand) -> Result<Option<VehicleId>, Fault> {
        is_over("by hand")
    }

    fn undo(&mut self) -> Result<(), Fault> {
        is_over("undo")
    }

    fn twin(&mut self, _: bool) -> Result<(), Fault> {
        is_over("twin")
    }

    fn hands(&self) -> Hands {
        Hands::default()
    }

    fn has_news_of_hands(&mut self) -> bool {
        false
    }

    fn save(&self) -> Result<Saved, Fault> {
        is_over("save")
    }

    fn state_hash(&self) -> u64 {
        self.driven.world().state_hash()
    }
}
