//! The section that describes the run.

use super::RunReport;
use crate::numbers::number;
use crate::report::page::Section;

pub(super) fn section(run: &RunReport) -> Section {
    let RunReport { summary, provenance, .. } = run;
    let mut facts = run.about.facts();
    let mut note = |name: &str, value: String| facts.push((name.into(), value));
    note("Command", provenance.command.clone());
    note("Program", format!("laneweave {}", provenance.version));
    note("Seed", provenance.seed.to_string());
    if summary.interrupted {
        let until = number(summary.duration_s, 4);
        note(
            "Interrupted",
            format!("the run was stopped after {until} s; all numbers are of the time before"),
        );
    }
    let hash = &summary.state_hash;
    note("Final state", format!("{hash} (hash of all vehicles at the end; equal inputs give equal hashes)"));
    Section::new("what", "What ran").facts(facts)
}

/// The scenario with all its settings, so that the report alone is enough to repeat the run.
pub(super) fn scenario(run: &RunReport) -> Section {
    Section::new("scenario", "The scenario")
        .note("All settings and defaults, as in scenario.toml in the same folder; laneweave run runs it again. Paths are relative to that folder.")
        .listing(run.provenance.scenario.clone())
}
