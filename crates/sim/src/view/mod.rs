//! One instant as drivers see it: where vehicles are, and which ones are next to each other.
//!
//! * `scene.rs` who is ahead and behind; `fork.rs` the same near a fork; `sight.rs` what a driver sees along a lane
//! * `snapshot.rs` a scene from plain data, such as a recorded frame: a recorded driver perceives what a simulated one
//!   would
//! * `pose.rs` where a body is, computed when it is asked for

pub(crate) mod fork;
pub(crate) mod pose;
pub(crate) mod scene;
pub(crate) mod sight;
pub(crate) mod snapshot;
