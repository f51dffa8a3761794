//! Processes of this machine do the runs of a sweep. Each reads keys from its standard input, does their runs, and
//! answers each with a line. A process that ends is begun again.

use std::ffi::OsString;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use laneweave_scenario::{Fault, FaultKind};
use serde::{Deserialize, Serialize};

use super::{Sweep, Worker};
use crate::parallel::in_parallel_while;

/// After so many ends of a process in the same run, the run is at fault.
const MOST_ENDS: u32 = 5;

/// The answer to a key.
#[derive(Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Answer {
    /// The run is done.
    Done,
    /// Why it is not.
    Fault { place: String, what: String, remedy: String },
}

/// Does the runs whose keys come as lines of `asked`, and answers each with a line.
///
/// # Errors
/// If what asks is gone.
pub fn serve(mut worker: Worker, asked: impl Read, mut answers: impl Write) -> io::Result<()> {
    for key in BufReader::new(asked).lines() {
        let answer = match worker.run(key?.trim()) {
            Ok(()) => Answer::Done,
            Err(Fault { place, what, remedy, .. }) => Answer::Fault { place, what, remedy },
        };
        writeln!(answers, "{}", serde_json::to_string(&answer)?)?;
        answers.flush()?;
    }
    Ok(())
}

/// Processes that do the runs of a sweep.
pub struct Processes {
    /// The program with its first arguments, to which the folder of the sweep is added: it has to [`serve`].
    pub program: Vec<OsString>,
    /// How many work side by side.
    pub count: usize,
}

impl Processes {
    /// Does the runs with these `keys`. `goes_on` is told how many have ended. Returns whether all are done: if it says
    /// no, no other run begins.
    ///
    /// # Errors
    /// If a run is not possible, or its process ends again and again.
    pub fn run(
        &self,
        sweep: &Sweep,
        keys: &[String],
        goes_on: impl Fn(usize) -> bool + Sync,
    ) -> Result<bool, Fault> {
        let ask = |process: &mut Option<Process>, key: &String| {
            for _ in 0..MOST_ENDS {
                let asked = match process {
                    Some(process) => process,
                    None => process.insert(Process::begin(&self.program, sweep.folder())?),
                };
                match asked.ask(key) {
                    Ok(Answer::Done) => return Ok(true),
                    Ok(Answer::Fault { place, what, remedy }) => {
                        return Err(Fault::new(place, what, remedy).of_kind(FaultKind::State));
                    }
                    // It has ended.
                    Err(_) => *process = None,
                }
                if !goes_on(0) {
                    return Ok(false);
                }
            }
            let what =
                format!("the process that did the run {} ended {MOST_ENDS} times", sweep.run_text(key));
            let remedy = "if memory is short, choose fewer with --workers; otherwise report this as a bug";
            Err(Fault::new(sweep.folder().display(), what, remedy).of_kind(FaultKind::State))
        };
        let done = in_parallel_while(keys, self.count, &goes_on, || None, ask)?;
        Ok(done.is_some_and(|it| it.iter().all(|it| *it)))
    }
}

/// A process that does runs.
struct Process {
    child: Child,
    keys: ChildStdin,
    answers: BufReader<ChildStdout>,
}

impl Process {
    fn begin(program: &[OsString], folder: &Path) -> Result<Process, Fault> {
        let name = program.first().cloned().unwrap_or_default();
        let refused = |error: io::Error| Fault::refused(Path::new(&name), "started", &error);
        let mut command = Command::new(&name);
        command.args(&program[1..]).arg(folder).stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().map_err(refused)?;
        match (child.stdin.take(), child.stdout.take()) {
            (Some(keys), Some(answers)) => Ok(Process { child, keys, answers: BufReader::new(answers) }),
            _ => Err(Fault::bug(name.display(), "it has no standard input or output")),
        }
    }

    /// Has it do a run.
    fn ask(&mut self, key: &str) -> io::Result<Answer> {
        writeln!(self.keys, "{key}")?;
        self.keys.flush()?;
        let mut line = String::new();
        self.answers.read_line(&mut line)?;
        Ok(serde_json::from_str(&line)?)
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // It has no run, or is not needed any more.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
