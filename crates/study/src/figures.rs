//! Figures as SVG text: the same data give the same text, on every system.

mod axes;
mod drawing;
mod rate_density;
mod time_space;

pub use drawing::{escaped, text_width};
pub use rate_density::{RateSeries, rate_density};
pub use time_space::{Mark, Sample, time_space};
