//! Checks of a map or a recording without a simulation.

mod evidence;
mod graph;
#[cfg(feature = "reports")]
mod picture;
mod recording;
mod report;
mod set;

pub use evidence::{EvidenceReport, Forbidden, SeenAt, SeenOn};
pub use graph::GraphJson;
pub use laneweave_scenario::Remark;
#[cfg(feature = "reports")]
pub use picture::{explorer, picture};
pub use recording::{ChangeRow, RecordingReport, tracks};
pub use report::{Lit, Opening, Report};
pub use set::{Named, SetReport};
