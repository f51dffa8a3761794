//! laneweave: a traffic simulator; its drivers change lanes for human reasons. This is the library of the command
//! with the same name.
//!
//! A [`Simulation`] is traffic on a map, in the words of the road. This runs a scenario, writes all its result files,
//! and prints a result:
//!
//! ```no_run
//! use laneweave::{Fault, Simulation};
//!
//! fn main() -> Result<(), Fault> {
//!     let simulation = Simulation::builder("maps/ramps.osm")
//!         .vehicles_per_hour(4000.0)
//!         .style("aggressive", 1.0)
//!         .style("conservative", 3.0)
//!         .build()?;
//!     let summary = simulation.run_to_results("out")?;
//!     println!("{} vehicles changed lanes {} times", summary.entered, summary.lane_changes);
//!     Ok(())
//! }
//! ```
//!
//! Below it, a [`scenario`] names a map, [`style`]s and a demand. It is prepared into a world of [`sim`]. A
//! [`run`](run::Run) steps through the world while [`output`]s observe it and write its result files.

pub mod branch;
pub mod check;
pub mod compare;
pub mod fit;
mod parallel;
pub mod replay;
pub mod run;
mod simulation;

pub use laneweave_models::Parameter;
pub use laneweave_network::{LightState, Side};
#[cfg(feature = "reports")]
pub use laneweave_results::report;
pub use laneweave_results::{checkpoint, folder, output, record};
pub use laneweave_scenario::{
    Bottleneck, COMMAND_COLUMNS, Capacity, Cause, Fault, Played, Player, Script, Source, Written,
    did_you_mean, open_recording, open_recordings, refused, scenario, style,
};
pub use laneweave_sim::{
    BrakingCause, Class, Columns, Control, IncidentKind, Intention, LaneChangeKind, Lateral, Longitudinal,
    NewVehicle, Phase, VehicleId,
};
pub use parallel::in_parallel;
pub use simulation::{
    Builder, Event, Incident, LaneChange, Light, MapSource, Observer, Occurrence, Simulation, VehicleState,
};

pub use laneweave_calibration as calibration;
pub use laneweave_explain as explain;
pub use laneweave_maps as maps;
pub use laneweave_models as models;
pub use laneweave_network as network;
pub use laneweave_recordings as recordings;
pub use laneweave_sim as sim;
pub use laneweave_study as study;

/// The Rust of the README compiles.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
