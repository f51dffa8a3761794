//! Styles as data: TOML files with the structure of [`laneweave_models::Style`], in which any number may instead be a
//! distribution over the drivers.

mod distribution;
mod library;
mod model;
mod population;
mod template;

pub use distribution::Distribution;
pub use library::{BUILT_IN, BuiltIn, DEFAULT_MIXTURE, built_in, copy, find};
pub use model::Model;
pub use population::Population;
pub use template::{Parameter, StyleTemplate};
