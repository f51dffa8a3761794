//! The files of comparisons: a table of all runs, and a report.

use std::path::{Path, PathBuf};

use laneweave_results::folder::{Claim, REPORT};
use laneweave_results::output::write_whole;
use laneweave_results::record::SCENARIO;
use laneweave_scenario::Fault;
use laneweave_study::{Cell, Column, Format, TableWriter};

use super::{Comparison, MEASURES, page};

/// The name of the table of all runs.
const RUNS: &str = "runs.csv";

/// A folder with comparisons, which are added one after the other.
pub struct ComparisonFiles {
    claim: Claim,
    table: TableWriter,
    done: Vec<(String, Comparison)>,
}

impl ComparisonFiles {
    /// Begins them in the folder `out`.
    ///
    /// # Errors
    /// If it has a run, if another program writes into it, or if it cannot be written.
    pub fn begin(out: &Path) -> Result<ComparisonFiles, Fault> {
        if out.join(SCENARIO).exists() {
            let what = "this folder contains a scenario; the results of a run of it would be mixed with the comparison";
            return Err(Fault::new(out.display(), what, "choose another folder with --out"));
        }
        let claim = Claim::on(out)?;
        let table = TableWriter::create(&claim.dir().join(RUNS), Format::Csv, &columns())?;
        Ok(ComparisonFiles { claim, table, done: Vec::new() })
    }

    /// Adds a comparison of the `input` that was named so.
    ///
    /// # Errors
    /// If the table cannot be written.
    pub fn add(&mut self, input: String, comparison: Comparison) -> Result<(), Fault> {
        for trial in &comparison.trials {
            let named = [input.as_str().into(), trial.model.name().into(), (trial.seed as i64).into()];
            let measured = MEASURES.iter().map(|it| (it.of)(&trial.outcome).into());
            self.table.row(&named.into_iter().chain(measured).collect::<Vec<Cell>>())?;
        }
        self.done.push((input, comparison));
        Ok(())
    }

    /// Ends the table, writes the report, which tells the `command`, and returns the paths of report and table.
    ///
    /// # Errors
    /// If they cannot be written.
    pub fn finish(self, command: &str) -> Result<[PathBuf; 2], Fault> {
        self.table.finish()?;
        let [report, runs] = [REPORT, RUNS].map(|it| self.claim.dir().join(it));
        write_whole(&report, &page(&self.done, command).to_html())?;
        Ok([report, runs])
    }
}

/// The columns of the table of all runs.
fn columns() -> Vec<Column> {
    let named = [Column::text("input"), Column::text("model"), Column::integer("seed")];
    let measured = MEASURES.iter().map(|it| Column::real(it.column));
    named.into_iter().chain(measured).collect()
}
