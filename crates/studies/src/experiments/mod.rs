//! Experiments: what the drivers do, beside what is published, and the claims of the paper.
//!
//! An [`Experiment`] drives traffic over several seeds, the same arriving traffic for everything that it compares, and
//! returns a [`Finding`]: words, tables and figures. They follow from the command alone, whatever the machine and the
//! number of threads.

mod drive;
mod effort;
mod finding;
mod measures;
mod motorway_rates;
mod outcomes;
mod plausibility;
mod readings;
mod recovery;
mod roundabouts;
mod route_weights;
mod seen;
mod signals;
mod site_rates;
mod styles;
mod town_rates;
mod traffic;

pub use effort::Effort;
pub use finding::{Finding, Row};
pub use site_rates::site_rates;

use laneweave::Fault;

/// A question to the drivers, and how it is answered.
#[derive(Clone, Copy, Debug)]
pub struct Experiment {
    /// Its name in commands and files.
    pub name: &'static str,
    /// What it shows, in a few words.
    pub about: &'static str,
    run: fn(&Effort) -> Result<Finding, Fault>,
}

/// All experiments, in the order in which they run.
pub const EXPERIMENTS: &[Experiment] = &[
    Experiment {
        name: "plausibility",
        about: "the drivers beside published values",
        run: plausibility::plausibility,
    },
    Experiment {
        name: "C1",
        about: "the paper's first claim: on a motorway the rate of lane changes is like MOBIL's",
        run: motorway_rates::motorway_rates,
    },
    Experiment {
        name: "C2",
        about: "the paper's second claim: in a town the rate of lane changes follows the recorded one, and MOBIL's does not",
        run: town_rates::town_rates,
    },
    Experiment {
        name: "C3",
        about: "the paper's third claim: in congestion lane changes rise sharply with the weight of the route",
        run: route_weights::route_weights,
    },
    Experiment {
        name: "signals",
        about: "the delay at a light beside Webster's formula",
        run: signals::signals,
    },
    Experiment {
        name: "roundabouts",
        about: "the capacity of entries to roundabouts beside the Highway Capacity Manual",
        run: roundabouts::roundabouts,
    },
    Experiment { name: "styles", about: "what the drivers of each style do", run: styles::styles },
    Experiment {
        name: "readings",
        about: "the paper's formulas as printed, beside the repaired ones",
        run: readings::readings,
    },
    Experiment {
        name: "recovery",
        about: "weights of simulated drivers, found again by calibration",
        run: recovery::recovery,
    },
];

impl Experiment {
    /// Runs the experiment with this `effort`.
    ///
    /// # Errors
    /// None, as long as the built-in maps and styles are valid.
    pub fn run(&self, effort: &Effort) -> Result<Finding, Fault> {
        (self.run)(effort)
    }
}
