//! Sweeps: many variants of a scenario, each with several seeds. A [`Sweep`] knows its runs by their keys; whoever
//! does them, on this machine or on others, needs the folder and the keys only, and leaves a row for each.
//!
//! * `plan.rs`, `cube.rs`, `variant.rs`: from a plan to variants of a scenario
//! * `folder.rs`, `row.rs`: what lies in the folder, so that a sweep that was ended goes on
//! * `workers.rs`: processes of this machine do the runs
//! * `tables.rs`: the rows become tables

mod cube;
mod folder;
mod plan;
mod row;
mod shard;
mod tables;
mod variant;
mod workers;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use laneweave::Simulation;
use laneweave::maps::FileKind;
use laneweave_results::record::Fingerprints;
use laneweave_scenario::{Fault, FaultKind, Source};
use xxhash_rust::xxh3::xxh3_64;

use self::folder::{Description, Folder};
use self::plan::{Plan, no_plan};
use self::row::Row;
use self::variant::Variant;
use crate::parallel::in_parallel_while;

pub use row::measures;
pub use shard::Shard;
pub use tables::Swept;
pub use workers::{Processes, serve};

/// A run of a sweep.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    /// Its key: a hash of all on which the run depends, 16 hexadecimal digits.
    pub key: String,
    /// The number of its variant, from 0 on.
    pub variant: usize,
    /// Its seed.
    pub seed: u64,
}

/// A sweep, in its folder.
pub struct Sweep {
    folder: Folder,
    plan: Plan,
    /// The text of the plan.
    text: String,
    /// The fingerprint of each variant with the first seed.
    fingerprints: Vec<String>,
    runs: Vec<Run>,
    /// The place of each run in them, by its key.
    places: BTreeMap<String, usize>,
}

impl Sweep {
    /// Begins the sweep of the plan in the file at `plan` in the folder `out`, or goes on with it if it was begun
    /// there. Before a sweep begins, each variant is made ready to run, by as many threads as `threads`; `goes_on` is
    /// told the share that is ready. Returns `None` if it says no.
    ///
    /// # Errors
    /// If the plan, a scenario of it or the folder cannot be used. Nothing has run then.
    pub fn begin(
        plan: &Path,
        out: &Path,
        threads: usize,
        goes_on: impl Fn(f64) -> bool + Sync,
    ) -> Result<Option<Sweep>, Fault> {
        if let FileKind::Map(_) = FileKind::by_name(plan) {
            return Err(no_plan(plan, "a map"));
        }
        Sweep::begin_source(Source::read(plan)?, out, threads, goes_on)
    }

    /// The same with a plan in memory, as a TOML `text`, as if it were in the file at `path`.
    ///
    /// # Errors
    /// If the plan, a scenario of it or the folder cannot be used. Nothing has run then.
    pub fn begin_text(
        text: &str,
        path: &Path,
        out: &Path,
        threads: usize,
        goes_on: impl Fn(f64) -> bool + Sync,
    ) -> Result<Option<Sweep>, Fault> {
        let source = Source { path: path.to_owned(), text: text.to_owned() };
        Sweep::begin_source(source, out, threads, goes_on)
    }

    fn begin_source(
        source: Source,
        out: &Path,
        threads: usize,
        goes_on: impl Fn(f64) -> bool + Sync,
    ) -> Result<Option<Sweep>, Fault> {
        let plan = Plan::of(&source)?;
        let folder = Folder(out.to_owned());
        let mut fingerprints = Fingerprints::default();
        let variants = plan.variants.iter().map(|it| {
            let (scenario, origin) = plan.scenario(it, plan.seeds[0])?;
            fingerprints.of(&scenario, &origin).map_err(|fault| plan.named(fault, &source, it))
        });
        let variants = variants.collect::<Result<Vec<String>, Fault>>()?;
        let path = std::path::absolute(&source.path);
        let description = Description {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            plan: path.map_err(|error| Fault::refused(&source.path, "found", &error))?,
            text: source.text.clone(),
            files: fingerprints.files,
            seeds: plan.seeds.clone(),
            variants: variants.clone(),
        };
        let sweep = Sweep::of(folder, plan, source.text, variants)?;
        let is_new = sweep.folder.description()?.is_none();
        if is_new && !sweep.check(threads, goes_on)? {
            return Ok(None);
        }
        sweep.folder.begin(&description)?;
        Ok(Some(sweep))
    }

    /// The sweep that was begun in the folder `out`.
    ///
    /// # Errors
    /// If there is none, or if its scenario cannot be read any more.
    pub fn begun(out: &Path) -> Result<Sweep, Fault> {
        let folder = Folder(out.to_owned());
        let description = folder.description()?.ok_or_else(|| {
            let what = "this folder has no sweep";
            let remedy = "give the plan, or the folder of a sweep that was begun";
            Fault::new(out.display(), what, remedy).of_kind(FaultKind::NotFound)
        })?;
        if description.version != env!("CARGO_PKG_VERSION") {
            let what = format!("this sweep was begun by laneweave {}", description.version);
            let remedy = "go on with that version, or begin in another folder";
            return Err(Fault::new(out.display(), what, remedy).of_kind(FaultKind::State));
        }
        let mut plan = Plan::of(&description.source())?;
        plan.seeds.clone_from(&description.seeds);
        Sweep::of(folder, plan, description.text, description.variants)
    }

    fn of(folder: Folder, plan: Plan, text: String, fingerprints: Vec<String>) -> Result<Sweep, Fault> {
        let mut known: BTreeMap<&str, &Variant> = BTreeMap::new();
        for (variant, fingerprint) in plan.variants.iter().zip(&fingerprints) {
            if let Some(same) = known.insert(fingerprint, variant) {
                let place = variant.changes.last().map_or_else(String::new, |it| it.place.clone());
                let what = format!("the variants {} and {} are the same", same.to_text(), variant.to_text());
                return Err(Fault::new(place, what, "leave one of them out"));
            }
        }
        let of_variant = |(variant, fingerprint): (usize, &String)| {
            let run = |seed: u64| Run { key: key(fingerprint, seed), variant, seed };
            plan.seeds.iter().map(move |seed| run(*seed)).collect::<Vec<Run>>()
        };
        let runs: Vec<Run> = fingerprints.iter().enumerate().flat_map(of_variant).collect();
        let places = runs.iter().enumerate().map(|(at, run)| (run.key.clone(), at)).collect();
        Ok(Sweep { folder, plan, text, fingerprints, runs, places })
    }

    /// Makes each variant ready to run. Returns whether `goes_on` said so until the end.
    fn check(&self, threads: usize, goes_on: impl Fn(f64) -> bool + Sync) -> Result<bool, Fault> {
        let check = |(): &mut (), variant: &Variant| {
            let (scenario, origin) = self.plan.scenario(variant, self.plan.seeds[0])?;
            Simulation::from_scenario(&scenario, &origin).map(drop)
        };
        let variants = &self.plan.variants;
        let goes_on = |ready: usize| goes_on(ready as f64 / variants.len() as f64);
        Ok(in_parallel_while(variants, threads, goes_on, || (), check)?.is_some())
    }

    /// All runs: by variant, and by seed.
    pub fn runs(&self) -> &[Run] {
        &self.runs
    }

    /// The number of variants.
    pub fn variants(&self) -> usize {
        self.plan.variants.len()
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        &self.folder.0
    }

    /// The keys of the runs of a `shard` that are not done.
    ///
    /// # Errors
    /// If the folder cannot be read.
    pub fn open_keys(&self, shard: Shard) -> Result<Vec<String>, Fault> {
        let rows = self.folder.rows()?;
        let of_shard = self.runs.iter().enumerate().filter(|(at, _)| shard.has(*at)).map(|(_, run)| &run.key);
        Ok(of_shard.filter(|it| !rows.contains_key(*it)).cloned().collect())
    }

    /// Writes the tables, if all runs are done; otherwise returns the number of those that are not.
    ///
    /// # Errors
    /// If the rows cannot be read, or the tables cannot be written.
    pub fn finish(&self) -> Result<Result<Swept, usize>, Fault> {
        let mut rows = self.folder.rows()?;
        let all: Vec<(&Run, Row)> =
            self.runs.iter().filter_map(|it| Some((it, rows.remove(&it.key)?))).collect();
        if all.len() < self.runs.len() {
            return Ok(Err(self.runs.len() - all.len()));
        }
        self.folder.tidy()?;
        tables::write(self, &all).map(Ok)
    }

    /// The changes of the run with this key in a line, with its seed.
    pub fn run_text(&self, key: &str) -> String {
        self.run(key).map_or_else(
            |_| key.to_owned(),
            |it| {
                let changes = self.plan.variants[it.variant].to_text();
                let comma = if changes.is_empty() { "" } else { ", " };
                format!("{changes}{comma}seed {}", it.seed)
            },
        )
    }

    fn run(&self, key: &str) -> Result<&Run, Fault> {
        let found = self.places.get(key).map(|it| &self.runs[*it]);
        found.ok_or_else(|| {
            let what = format!("no run of this sweep has the key {key}");
            let remedy = "give keys of its plan; laneweave sweep DIR goes on with all of them";
            Fault::new(self.folder.0.display(), what, remedy).of_kind(FaultKind::NotFound)
        })
    }
}

/// The key of the run of a variant with this fingerprint and this seed.
fn key(fingerprint: &str, seed: u64) -> String {
    format!("{:016x}", xxh3_64(format!("{fingerprint} {seed}").as_bytes()))
}

/// Does runs of a sweep one after the other. Runs of one variant share what was made ready for it.
pub struct Worker {
    sweep: Arc<Sweep>,
    /// The variant of the run before, with its simulation.
    before: Option<(usize, Simulation)>,
}

impl Worker {
    /// Of this `sweep`.
    pub fn of(sweep: Arc<Sweep>) -> Worker {
        Worker { sweep, before: None }
    }

    /// Does the run with this key, and leaves its row in the folder. A run that is done is not done again.
    ///
    /// # Errors
    /// If there is no such run, or a file has changed on which it depends, or the row cannot be written.
    pub fn run(&mut self, key: &str) -> Result<(), Fault> {
        let sweep = Arc::clone(&self.sweep);
        let run = sweep.run(key)?;
        let path: PathBuf = sweep.folder.row(key);
        if Row::read(&path).is_some() {
            return Ok(());
        }
        let mut simulation = self.simulation(run)?;
        let row = Row::of(key, &mut simulation);
        self.before = Some((run.variant, simulation));
        row.write(&path)
    }

    /// The simulation of a run.
    fn simulation(&mut self, run: &Run) -> Result<Simulation, Fault> {
        if let Some((variant, mut simulation)) = self.before.take()
            && variant == run.variant
        {
            simulation.reset(run.seed)?;
            return Ok(simulation);
        }
        let Sweep { plan, fingerprints, folder, .. } = &*self.sweep;
        let of = |seed: u64| plan.scenario(&plan.variants[run.variant], seed);
        let (scenario, origin) = of(run.seed)?;
        let simulation = Simulation::from_scenario(&scenario, &origin)?;
        // After the files were read for the simulation, so that none can change unseen.
        let (first, origin) = of(plan.seeds[0])?;
        if Fingerprints::default().of(&first, &origin)? != fingerprints[run.variant] {
            let map = scenario.map.display();
            let what = format!(
                "the map {map}, a style, the scenario or a recording has changed since this sweep was begun"
            );
            let remedy = "undo the change, or begin in another folder";
            return Err(Fault::new(folder.0.display(), what, remedy).of_kind(FaultKind::State));
        }
        Ok(simulation)
    }
}
