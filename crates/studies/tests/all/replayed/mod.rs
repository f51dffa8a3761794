//! Recordings are replayed: vehicles drive as they were recorded, and drivers beside them react.

mod as_recorded;
mod beyond;
mod collisions;
mod desired;
mod future;
mod scores;
pub(crate) mod set_up;
