//! The report of a run.

mod about;
mod brakings;
mod changes;
mod flow;
mod following;
mod incidents;
mod map;
mod numbers;
mod problems;
mod roads;
mod trips;

use laneweave_network::Network;
use laneweave_sim::LaneletAggregate;

pub use map::area;

use super::Page;
use crate::outcome::{About, Provenance, Summary};
use crate::report::kept::Record;

/// All data of a run after its end.
#[derive(Clone, Copy)]
pub struct RunReport<'a> {
    /// The description of the run.
    pub about: &'a About,
    /// The provenance of the results.
    pub provenance: &'a Provenance,
    /// The summary.
    pub summary: &'a Summary,
    /// The observations.
    pub record: &'a Record,
    /// The roads.
    pub network: &'a Network,
    /// The aggregates of its lanelets over the measured time.
    pub aggregates: &'a [LaneletAggregate],
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
            .section(map::section(self))
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

/// A measure without values gets a paragraph instead of an empty figure.
const NOBODY: &str = "No vehicle drove in the measured time.";
