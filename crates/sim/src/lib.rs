//! The world and its step.
//!
//! perceive → decide → drive on one snapshot, then advance, then resolve what concerns two lanes, then enter and
//! observe. The order of vehicles and the number of threads change nothing, bit for bit.

mod accelerate;
mod advance;
mod appeal;
mod attention;
mod clock;
mod decide;
mod demand;
mod drive;
mod events;
mod junction;
mod navigate;
mod overlap;
mod perceive;
mod plan;
mod pool;
mod pose;
mod prefetch;
mod random;
mod records;
mod resolve;
mod scene;
mod snapshot;
mod tally;
mod traffic;
mod turn;
mod vehicle;
mod world;

pub use clock::Clock;
pub use demand::{Demand, Share};
pub use events::{Event, LaneChange};
pub use junction::Passages;
pub use navigate::{Destination, Goal, Navigator, Waypoint};
pub use perceive::{driver, perceive};
pub use random::{Purpose, Random};
pub use scene::{Found, LaneSight, Scene, Spot, Viewpoint};
pub use snapshot::{Across, Seen, Snapshot};
pub use tally::Tally;
pub use traffic::{Car, Kind, Lane, Mind, Motion, Phase, Twin, VehicleId};
pub use vehicle::{Body, Class};
pub use world::{Counts, NewVehicle, Setup, Vehicle, World, WorldError};
