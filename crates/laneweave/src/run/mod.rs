//! Runs with all their result files: begun or resumed, and driven to their end.

mod results;
mod resume;
mod simulate;

pub use laneweave_results::Ending;
pub use results::{Results, Run};
pub(crate) use resume::BY_COMMANDS;
pub use resume::{Resumed, kept, resume};
pub use simulate::simulate;
