//! Roads as a driver sees them. This crate knows no files and no vehicles.
//!
//! A map's lanelets become [`Chain`]s, the lanes of the simulation: maximal fork-free runs of lanelets. Lanelet ids
//! appear in input and output only.

mod alongside;
mod bend;
mod build;
mod chain;
mod class;
mod crossed;
mod gate;
mod geometry;
mod ground;
mod id;
mod joints;
mod junction;
mod lanelet;
mod law;
mod network;
mod polygon;
mod rectangle;
mod regulate;
mod section;
mod signals;
mod symmetry;
mod width;

pub use alongside::Alongside;
pub use build::NetworkError;
pub use chain::{Bend, Beside, Chain, ChainIndex, ForkBranch, Limit, Position};
pub use class::{Body, Class, Classes};
pub use gate::{Gate, MINIMUM_GATE_LENGTH};
pub use geometry::{LineWalk, Point, Polyline, Pose, turn};
pub use ground::{Footprint, Ground};
pub use id::Id;
pub use joints::onward;
pub use junction::{
    Crossing, Extension, InPlan, Junctions, Light, LightConflict, LightIndex, LightState, Nearby, OnChain,
    Phase, Place, PlaceKind, Precedence, Priority, Program, Reach, Regulations, Sign, SignalPlan, Stop,
    StopKind, StopRule, Touch, Turn, Zone, ZoneIndex, ZoneKind,
};
pub use lanelet::{DrivingSide, Lanelet, LaneletIndex, Side};
pub use law::{LaneUse, RoadLaw};
pub use network::Network;
pub use polygon::Polygon;
pub use rectangle::Rectangle;
pub use section::{Branch, Section, Sections};
pub use signals::{LaneFlows, LightTraffic, Lights};
pub use symmetry::{Symmetry, symmetry};
