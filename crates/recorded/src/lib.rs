//! Where recordings and the simulator meet: recorded traffic as scenes, and simulated traffic as recordings.
//!
//! A [`Replay`] shows each frame of a recording as its drivers see it; [`Evidence`] is what can be told from that.
//! [`TurningShares`] are the destinations that recorded vehicles show. A [`Watch`] notes what a simulation does, and a
//! [`Drone`] makes of that what would have been recorded.

mod class;
mod drivers;
mod drone;
mod evidence;
mod replay;
mod turning_shares;
mod watch;

pub use class::class_of;
pub use drivers::Assumed;
pub use drone::{Drone, Interruptions};
pub use evidence::{Evidence, Exposure};
pub use replay::{Frame, Replay, ReplayError};
pub use turning_shares::TurningShares;
pub use watch::Watch;
