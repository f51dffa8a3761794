//! Which lanes lead where, and what a route costs.

pub(crate) mod class_restrictions;
pub(crate) mod closures;
pub(crate) mod disutility;
pub(crate) mod fitting_speed;
pub(crate) mod guidance;
pub(crate) mod links;
pub(crate) mod navigate;
pub(crate) mod onward;
pub(crate) mod place;
pub(crate) mod renew_routes;
pub(crate) mod roads;
pub(crate) mod walk;
pub(crate) mod waypoint;
pub(crate) mod ways;
