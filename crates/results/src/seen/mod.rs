//! Traffic along roads: boxes of road and time, and the vehicles of one lane.

mod boxes;
mod road;
mod traces;

pub use boxes::Boxes;
pub use traces::Traces;
