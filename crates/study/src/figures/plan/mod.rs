//! Plans of roads: parts that lie far from each other have panels of their own, each drawn to scale.

mod bounds;
mod panel;
mod parts;

pub use bounds::Bounds;
pub use panel::{Panel, Space, panels};
