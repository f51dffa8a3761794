//! Which lanes lead where, and what a route costs.
//!
//! * `roads.rs` the part `Roads`; `place.rs` gates and trip ends inside the map
//! * `ways.rs` plans for a destination and every chain: the lane changes that are left, the last place for the next
//!   one, the next chain and the best other route; `navigate.rs` keeps these tables; `onward.rs` is what drivers look
//!   up in them at every step; `walk.rs` follows a route chain by chain
//! * `disutility.rs` turns and lights on a route; `fitting_speed.rs` the desired speed before and in bends and lower
//!   limits
//! * `links.rs`, `guidance.rs` and `renew_routes.rs` measured travel times, and the routes planned with them
//! * `given_ways.rs` stops of lines, and ends of fixed ways
//! * `reachable.rs` which destinations can be reached, and `in_time.rs` which of them with road enough; `wander.rs` the
//!   way of drivers without one
//! * `class_restrictions.rs` which lanes a class may not use, or avoids; `closures.rs` which lanelets users closed, and
//!   where something stands (`standing.rs`)

pub(crate) mod class_restrictions;
pub(crate) mod closures;
pub(crate) mod disutility;
pub(crate) mod fitting_speed;
mod given_ways;
pub(crate) mod guidance;
pub(crate) mod in_time;
pub(crate) mod links;
pub(crate) mod navigate;
pub(crate) mod onward;
mod open_lanes;
pub(crate) mod place;
mod reachable;
pub(crate) mod renew_routes;
pub(crate) mod ring_lanes;
pub(crate) mod roads;
pub(crate) mod standing;
pub(crate) mod walk;
mod wander;
pub(crate) mod waypoint;
pub(crate) mod ways;
