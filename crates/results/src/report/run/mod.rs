//! The report of a run.

mod about;
mod changes;
mod flow;
mod following;
mod incidents;
mod numbers;
mod problems;
mod roads;
mod trips;

use laneweave_network::Network;

use super::Page;
use crate::outcome::{About, Provenance, Summary};
use crate::report::kept::Record;

/// All that is known of a run when it is over.
#[derive(Clone, Copy)]
pub struct RunReport<'a> {
    /// What ran.
    pub about: &'a About,
    /// Where its results come from.
    pub provenance: &'a Provenance,
    /// What it amounts to.
    pub summary: &'a Summary,
    /// What was seen of it.
    pub record: &'a Record,
    /// The roads.
    pub network: &'a Network,
    /// Simulated time at its end [s].
    pub end: f64,
}

impl RunReport<'_> {
    /// The report as a page.
    pub fn page(&self) -> Page {
        let lead = format!(
            "Report of a simulation run by laneweave {}. All results follow from the map, the scenario and the seed; nothing \
             depends on the machine.",
            env!("CARGO_PKG_VERSION")
        );
        Page::new(format!("Traffic on {}", self.about.map), lead)
            .section(about::section(self))
            .section(numbers::section(self))
            .section(changes::section(self))
            .section(flow::section(self))
            .section(roads::section(self))
            .section(following::section(self))
            .section(trips::section(self))
            .section(problems::section(self))
            .section(problems::method())
            .section(about::scenario(self))
    }
}

/// What was measured without a value is said rather than drawn: an empty figure says nothing.
const NOBODY: &str = "No vehicle drove in the measured time.";
