//! Generated maps: drawings made from a few numbers.
//!
//! A generator gives a [`Drawing`](laneweave_maps::Drawing). [`build`](laneweave_maps::Drawing::build) makes a map of
//! it, and [`lanelet2::write`](laneweave_maps::lanelet2::write) a file.

mod approach;
mod canvas;
mod compass;
mod control;
mod error;
mod grid;
mod junction;
mod large_town;
mod layout;
mod motorway;
mod movement;
mod own;
mod path;
mod random;
mod ring;
mod roundabout;
mod street;
mod town;

pub use approach::approach;
pub use control::Control;
pub use error::GenerateError;
pub use grid::{Arterial, Grid, arterial, grid};
pub use large_town::large_town;
pub use motorway::{Motorway, Weaving, motorway};
pub use own::own_maps;
pub use random::{Element, Hazard, RandomMap, random, random_with};
pub use roundabout::{Roundabout, roundabout};
pub use town::town;
