//! From files to a world that can run. A [`scenario`] names a map, [`style`]s and a demand. A mistake in it becomes a
//! [`Fault`] with its place and its remedy before the simulation begins.

mod capacity;
mod fault;
mod late_trips;
mod recording;
mod remarks;
mod replay;
pub mod scenario;
mod script;
mod source;
pub mod style;
mod sumo;
mod windows;

pub use capacity::{Bottleneck, Capacity, Estimate};
pub use fault::{Fault, FaultKind, did_you_mean};
pub use late_trips::{Late, on_late_trips};
pub use recording::{elsewhere, open_recording, open_recordings, unreadable};
pub use remarks::{Remark, remarks};
pub use replay::{AtItsEnd, Departures, HandOver, Played, Player, Recorded, Start};
pub use script::{COMMAND_COLUMNS, Script, Written, refused};
pub use source::{Source, in_words};
pub use sumo::Sumo;
pub use windows::{Named, Windows, joined, open_windows};
