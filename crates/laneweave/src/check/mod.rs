//! What a map holds, as far as one can tell without driving on it.

mod graph;
mod picture;
mod report;

pub use graph::GraphJson;
pub use picture::picture;
pub use report::{Complaint, Opening, Report};
