//! Common parts of the benchmarks: rounds of measurement in turns, so that a disturbance of the machine affects all
//! compared cases alike.

pub mod machine;
pub mod trial;

use std::io::Write;

/// Prints a line; a closed output is no error.
pub fn say(line: &str) {
    let _ = writeln!(std::io::stdout(), "{line}");
}

/// Updates per second of each round.
#[derive(Clone, Debug, Default)]
pub struct Rates(Vec<f64>);

impl Rates {
    /// One more round.
    pub fn push(&mut self, updates: u64, wall_s: f64) {
        self.0.push(updates as f64 / wall_s);
    }

    /// The rate of the least disturbed round: other programs, and the neighbours of a virtual machine, only ever slow
    /// a round down.
    pub fn best(&self) -> f64 {
        self.0.iter().copied().fold(0.0, f64::max)
    }

    /// The median rate of all rounds.
    pub fn median(&self) -> f64 {
        let mut rates = self.0.clone();
        rates.sort_by(f64::total_cmp);
        rates.get(rates.len() / 2).copied().unwrap_or(0.0)
    }
}
