//! Styles as data: files in TOML of the shape of [`laneweave_models::Style`], in which any number may be a
//! distribution over the drivers instead.

mod distribution;
mod library;
mod model;
mod population;
mod ranges;
mod template;

pub use distribution::Distribution;
pub use library::{BUILT_IN, BuiltIn, DEFAULT_MIXTURE, built_in, copy, find};
pub use model::Model;
pub use population::Population;
pub use template::{Parameter, StyleTemplate};
