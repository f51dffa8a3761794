//! A run that has ended, and its twin. No frames were kept of it: it is driven again, bit for bit, from states that a
//! survey keeps.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

use laneweave::record::{End, Record};
use laneweave::{Fault, VehicleId};
use laneweave_studies::branch::Setting;

use super::hands::{Hand, Hands};
use super::pair::{Change, Pair, State};
use super::saved::Saved;
use super::{Abilities, Hello, Kind, Mark, Marks, Source, TwinFacts, Wants};
use crate::scene::Scene;
use crate::snapshot::Snapshot;

/// States that the survey keeps.
const STATES: u32 = 60;
/// Steps between two messages of the survey.
const NEWS: u32 = 100;

/// States in the order of their steps, which two threads share.
type States = Arc<Mutex<Vec<State>>>;

/// A run that has ended.
pub struct Rerun {
    pair: Pair,
    /// Time between two steps [s].
    step_s: f64,
    /// The step after which it has ended.
    last_step: u32,
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
        Rerun::new(&Record::open(dir)?, None)
    }

    /// The same run, and beside it its twin, which has the `settings` from the time `at` on [s].
    ///
    /// # Errors
    /// As for [`Rerun::open`], or if there is no such time in the run, or a setting does not fit.
    pub fn with_twin(dir: &Path, at: f64, settings: &[Setting]) -> Result<Rerun, Fault> {
        Rerun::new(&Record::open(dir)?, Some(&Change { at, settings: settings.to_vec() }))
    }

    fn new(record: &Record, change: Option<&Change>) -> Result<Rerun, Fault> {
        let Record { scenario, end: End { duration_s, warmup_s, .. }, .. } = record;
        let step_s = scenario.run.step_s;
        let last_step = ((duration_s + warmup_s) / step_s).round() as u32;
        let pair = Pair::new(record, change)?;
        let survey = Pair::new(record, change)?;
        let rerun = Rerun {
            pair,
            step_s,
            last_step,
            states: Arc::default(),
            marks: Arc::default(),
            is_over: Arc::default(),
        };
        let shared = (Arc::clone(&rerun.states), Arc::clone(&rerun.marks), Arc::clone(&rerun.is_over));
        let look = move || look(survey, last_step, &shared);
        let looking = thread::Builder::new().name("looking".into()).spawn(look);
        looking.map_err(|error| Fault::new("view", error, "close other programs, and try again"))?;
        Ok(rerun)
    }

    /// The last kept state that is not after `step`.
    fn state_before(&self, step: u32) -> Option<State> {
        let states = self.states.lock().unwrap_or_else(PoisonError::into_inner);
        let after = states.partition_point(|it| it.step <= step);
        after.checked_sub(1).map(|it| states[it].clone())
    }

    /// The hash of all vehicles of the twin, if there is one.
    pub fn twin_hash(&self) -> Option<u64> {
        self.pair.twin_hash()
    }
}

impl Drop for Rerun {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Relaxed);
    }
}

type Shared = (States, Arc<Mutex<Marks>>, Arc<AtomicBool>);

/// Drives the run and its twin once, and keeps states of both, and marks of the run.
fn look(mut survey: Pair, last_step: u32, (states, marks, is_over): &Shared) {
    let every = last_step.div_ceil(STATES).max(1);
    let mut found = Vec::new();
    for step in 0..=last_step {
        if is_over.load(Ordering::Relaxed) {
            return;
        }
        if step.is_multiple_of(every) {
            states.lock().unwrap_or_else(PoisonError::into_inner).extend(survey.save());
        }
        if step == last_step || step.is_multiple_of(NEWS) {
            let mut marks = marks.lock().unwrap_or_else(PoisonError::into_inner);
            marks.marks.append(&mut found);
            marks.until_s = survey.base.time_s();
        }
        if step < last_step && survey.step(&mut found).is_err() {
            // Who looks at this time is told why.
            return;
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
        self.pair.base.scene()
    }

    fn hello(&self) -> Hello {
        let step_s = self.step_s();
        Hello {
            version: 1,
            kind: Kind::Run,
            title: self.pair.base.title(),
            step_s,
            time_s: self.time_s(),
            begin_s: 0.0,
            end_s: Some(f64::from(self.last_step) * step_s),
            can: Abilities { hands: false, seek: true, explain: true, twin: self.pair.has_twin() },
            styles: self.pair.base.styles(),
            demand: self.pair.base.demand(),
        }
    }

    fn step_s(&self) -> f64 {
        self.step_s
    }

    fn time_s(&self) -> f64 {
        self.pair.base.time_s()
    }

    fn step(&mut self, marks: &mut Vec<Mark>) -> Result<(), Fault> {
        if self.has_ended() { Ok(()) } else { self.pair.step(marks) }
    }

    fn has_ended(&self) -> bool {
        self.pair.steps() >= self.last_step
    }

    fn seek(&mut self, time_s: f64) -> Result<(), Fault> {
        let step = (time_s / self.step_s).round().clamp(0.0, f64::from(self.last_step)) as u32;
        let now = self.pair.steps();
        let kept = self.state_before(step).filter(|it| step < now || it.step > now);
        if let Some(state) = kept {
            self.pair.restore(&state)?;
        }
        let mut passed = Vec::new();
        while self.pair.steps() < step {
            self.pair.step(&mut passed)?;
        }
        Ok(())
    }

    fn see(&self, wants: &Wants, snapshot: &mut Snapshot) {
        self.pair.see(wants, snapshot);
    }

    fn find(&self, id: i64) -> Option<[f64; 2]> {
        self.pair.base.find(id)
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

    fn twin(&mut self, is_wanted: bool) -> Result<(), Fault> {
        if self.pair.show(is_wanted) || !is_wanted {
            return Ok(());
        }
        let remedy = "view it with --at and --set, which say what is different in its twin";
        Err(Fault::new("twin", "this run is viewed without a twin", remedy))
    }

    fn twin_facts(&self) -> Option<TwinFacts> {
        self.pair.facts()
    }

    fn hands(&self) -> Hands {
        Hands::default()
    }

    fn news_of_hands(&mut self) -> Option<Hands> {
        None
    }

    fn save(&self) -> Result<Saved, Fault> {
        is_over("save")
    }

    fn state_hash(&self) -> u64 {
        self.pair.base.simulation.state_hash()
    }
}
