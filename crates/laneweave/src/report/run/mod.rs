//! The report of a run.

mod about;
mod changes;
mod flow;
mod following;
mod numbers;
mod problems;
mod roads;
mod trips;

use std::path::Path;

use super::Page;
use crate::output::{Record, Summary};

pub use about::About;

/// All that is known of a run when it is over.
#[derive(Clone, Copy)]
pub struct RunReport<'a> {
    /// What ran.
    pub about: &'a About,
    /// What it amounts to; without it there are no key numbers.
    pub summary: Option<&'a Summary>,
    /// What was seen of it.
    pub record: &'a Record,
    /// Simulated time at its end [s].
    pub end: f64,
}

impl RunReport<'_> {
    /// The report as a page.
    pub fn page(&self) -> Page {
        let lead = format!(
            "Report of a simulation run by laneweave {}. Everything here follows from the map, the scenario and the seed; \
             nothing depends on the machine.",
            env!("CARGO_PKG_VERSION")
        );
        let map = Path::new(&self.about.map)
            .file_name()
            .map_or(self.about.map.as_str().into(), |it| it.to_string_lossy());
        let page = Page::new(format!("Traffic on {map}"), lead).section(about::section(self));
        let page = match self.summary {
            Some(summary) => page.section(numbers::section(self, summary)),
            None => page,
        };
        page.section(changes::section(self))
            .section(flow::section(self))
            .section(roads::section(self))
            .section(following::section(self))
            .section(trips::section(self))
            .section(problems::section(self))
            .section(problems::method())
    }
}

/// What was measured without a value is said rather than drawn: an empty figure says nothing.
const NOBODY: &str = "Nobody drove while it was measured.";
