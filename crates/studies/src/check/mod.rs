//! Checks of a map or a recording without a simulation.

mod evidence;
mod graph;
mod picture;
mod recording;
mod report;
mod set;

pub use evidence::{EvidenceReport, Forbidden, SeenAt, SeenOn};
pub use graph::GraphJson;
pub use laneweave_scenario::Remark;
pub use picture::{explorer, picture};
pub use recording::{ChangeRow, RecordingReport, tracks};
pub use report::{Lit, Opening, Report};
pub use set::{Named, SetReport};
