//! `laneweave sweep`.

use std::io;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread::available_parallelism;

use clap::{Args, ValueHint};
use laneweave::Fault;
use laneweave_studies::sweep::{Processes, Shard, Sweep, Worker, serve};

use super::numbers::within;
use super::progress::ShareDone;
use super::stop::Stop;
use super::{Call, SUCCESS};
use super::{complain, say};

/// The option with which a process does runs whose keys another process gives it.
const WORKER: &str = "--worker";

#[derive(Debug, Args)]
pub(crate) struct SweepArguments {
    /// A plan (.toml); or the folder of a sweep that was begun, to go on with it.
    #[arg(value_name = "PLAN.toml|DIR", value_hint = ValueHint::AnyPath)]
    input: PathBuf,
    /// Folder of the sweep [default: sweep].
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    out: Option<PathBuf>,
    /// Do part I of N only, 1 to N; programs with one folder and different parts share a sweep.
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Number of runs at a time, each in a process of its own [default: the cores of the machine].
    #[arg(long, value_name = "N", value_parser = within::<usize>(1..=1024))]
    workers: Option<usize>,
    /// Print errors only.
    #[arg(long)]
    quiet: bool,
    /// Do the runs whose keys come on standard input.
    #[arg(long, hide = true)]
    worker: bool,
}

impl SweepArguments {
    pub(crate) fn execute(self, call: &Call) -> Result<u8, Fault> {
        if self.worker {
            let worker = Worker::of(Arc::new(Sweep::begun(&self.input)?));
            // Who asked is gone, and with it the need for answers.
            let _ = serve(worker, io::stdin(), io::stdout());
            return Ok(SUCCESS);
        }
        let cores = available_parallelism().map_or(1, NonZero::get);
        let workers = self.workers.unwrap_or(cores);
        let stop = Stop::listen()?;
        let Some(sweep) = self.sweep(workers, &stop)? else {
            complain(format_args!("nothing has run"));
            return Ok(stop.code());
        };
        let shard = self.shard.unwrap_or_default();
        let keys = sweep.open_keys(shard)?;
        let program = [&call.program[..], &["sweep".into(), WORKER.into()]].concat();
        let shown = (!self.quiet).then(|| ShareDone::of("runs"));
        let goes_on = |ended: usize| {
            shown.iter().for_each(|it| it.show(ended as f64 / keys.len() as f64));
            !stop.is_raised()
        };
        let done = Processes { program, count: workers }.run(&sweep, &keys, goes_on);
        shown.into_iter().for_each(ShareDone::clear);
        let is_done = done?;
        self.report(&sweep, shard, is_done)?;
        Ok(if is_done { SUCCESS } else { stop.code() })
    }

    /// The sweep, ready to run; `None` if it was stopped before.
    fn sweep(&self, threads: usize, stop: &Stop) -> Result<Option<Sweep>, Fault> {
        if self.input.is_dir() {
            if self.out.is_some() {
                let what = "the input is the folder of a sweep already";
                return Err(Fault::new("--out", what, "leave it out, or give the plan as input"));
            }
            return Sweep::begun(&self.input).map(Some);
        }
        let out = self.out.as_deref().unwrap_or(Path::new("sweep"));
        let shown = (!self.quiet).then(|| ShareDone::of("making variants ready"));
        let sweep = Sweep::begin(&self.input, out, threads, |share| {
            shown.iter().for_each(|it| it.show(share));
            !stop.is_raised()
        });
        shown.into_iter().for_each(ShareDone::clear);
        sweep
    }

    /// Writes the tables, or says what is left to do.
    fn report(&self, sweep: &Sweep, shard: Shard, is_done: bool) -> Result<(), Fault> {
        let (all, folder) = (sweep.runs().len(), sweep.folder().display());
        match sweep.finish()? {
            Ok(_) if self.quiet => Ok(()),
            Ok(swept) => say(&format!(
                "{all} runs of {} variants\n{}all runs: {}\nmeans with intervals: {}\n",
                sweep.variants(),
                swept.text,
                swept.runs.display(),
                swept.variants.display()
            )),
            Err(open) => {
                let done = format!("{folder}: {} of {all} runs are done", all - open);
                match is_done && !shard.is_all() {
                    true if self.quiet => return Ok(()),
                    true => return say(&format!("{done}; the part that ends last writes the tables\n")),
                    false => {}
                }
                complain(format_args!("{done}; laneweave sweep {folder} goes on"));
                Ok(())
            }
        }
    }
}
