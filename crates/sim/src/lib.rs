//! The world and its step.
//!
//! perceive → decide → drive on one snapshot, then advance, then resolve what concerns two lanes, then enter and
//! observe. The order of vehicles and the number of threads change nothing, bit for bit.

mod accelerate;
mod advance;
mod appeal;
mod attention;
mod beliefs;
mod clock;
mod decide;
mod demand;
mod drive;
mod enter;
mod events;
mod gamma;
mod guidance;
mod headways;
mod junction;
mod leave;
mod links;
mod navigate;
mod normal;
mod overlap;
mod perceive;
mod place;
mod plan;
mod pool;
mod pose;
mod prefetch;
mod random;
mod rate;
mod records;
mod resolve;
mod rotation;
mod scene;
mod snapshot;
mod source;
mod tally;
mod traffic;
mod turn;
mod vehicle;
mod views;
mod ways;
mod world;

pub use clock::Clock;
pub use demand::{Demand, Origin, Share};
pub use events::{Event, LaneChange};
pub use headways::{HeadwayError, Headways};
pub use junction::Passages;
pub use navigate::{Destination, Goal, Navigator};
pub use normal::quantile as normal_quantile;
pub use perceive::{driver, perceive};
pub use place::{Kerb, Place, Places};
pub use random::{Purpose, Random};
pub use rate::Rate;
pub use scene::{Found, LaneSight, Scene, Spot, Viewpoint};
pub use snapshot::{Across, Seen, Snapshot};
pub use tally::Tally;
pub use traffic::{Car, Kind, Lane, Mind, Motion, Phase, Twin, VehicleId};
pub use vehicle::{Body, Class, Fleet};
pub use ways::Waypoint;
pub use world::{Counts, NewVehicle, Setup, Vehicle, World, WorldError};
