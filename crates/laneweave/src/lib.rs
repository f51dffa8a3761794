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
//! A [`Template`] makes many simulations of one scenario, and a [`Fleet`] steps them together.
//!
//! Below it, a [`scenario`] names a map, [`style`]s and a demand. It is prepared into a world of [`sim`]. A
//! [`run`](run::Run) steps through the world while [`output`]s observe it and write its result files.

pub mod explain;
mod fleet;
pub mod run;
mod simulation;

pub use fleet::{Fleet, SIGHT_COLUMNS};
pub use laneweave_models::Parameter;
pub use laneweave_models::change::IncentiveName;
pub use laneweave_network::{Id, LightState, Side};
#[cfg(feature = "reports")]
pub use laneweave_results::report;
pub use laneweave_results::{checkpoint, folder, output, record};
pub use laneweave_scenario::{
    AtItsEnd, Bottleneck, COMMAND_COLUMNS, Capacity, Departures, Fault, FaultKind, HandOver, Played, Player,
    Recorded, Remark, Script, Source, Start, Windows, Written, did_you_mean, elsewhere, in_words,
    open_recording, open_recordings, open_windows, style, unreadable,
};
pub use laneweave_sim::{
    BrakingCause, Class, Columns, Control, IncidentKind, Intention, LaneChangeKind, Lateral, Longitudinal,
    NewVehicle, Phase, Rows, VehicleId,
};
pub use simulation::{
    Builder, Decision, Evaluation, Event, Incident, LaneChange, Leader, Light, MapSource, Observer,
    Occurrence, Reason, SideEvaluation, Simulation, StyleState, Template, VehicleState, Watcher,
};

pub use laneweave_generate as generate;
pub use laneweave_maps as maps;
pub use laneweave_models as models;
pub use laneweave_network as network;
pub use laneweave_study as study;

/// Recorded traffic: read, cleaned, matched to the map, and as its drivers see it; simulated traffic as a drone records
/// it.
pub mod recordings {
    #[doc(inline)]
    pub use laneweave_recorded::*;
    #[doc(inline)]
    pub use laneweave_recordings::*;
}

/// Scenarios as plain data, and what they are read from.
pub mod scenario {
    pub use laneweave_scenario::scenario::{
        Basis, Demand, DrivingSide, External, Guidance, Headways, Law, Line, MadeSignals, MapOptions,
        Obstacle, OdRow, Origin, Output, Replay, Run, Scenario, Signal, SignalPhase, Stop, SumoFile,
        TableFormat, Turns, VehiclesPerHour, driven, mixture, open_map, read_map,
    };
}

/// The parts of the simulator that a program may look at: plain data, and views that borrow from a
/// [`Simulation`].
pub mod sim {
    pub use laneweave_sim::{
        Account, Across, Act, Clock, Command, Commanded, Counters, Counts, Destination, DriverState,
        FIRST_INSERTED, FIRST_OBSTACLE, Goal, InnerPlace, Kinematics, LaneChangeState, LaneSight, Navigator,
        Place, Places, Purpose, Random, Rate, Scene, Seen, Snapshot, Spot, Target, TripRecord, Vehicle,
        Viewpoint, perceive,
    };
}

/// The Rust of the README compiles.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
