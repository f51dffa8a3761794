//! What a map holds, as far as one can tell without driving on it.

mod graph;

pub use graph::GraphJson;
