//! From observations of traffic to evidence: statistics, Edie's density and flow, figures, tables.
//!
//! This crate knows no simulator: plain numbers come in; numbers, SVG text and files go out.

mod edie;
#[cfg(feature = "figures")]
mod figures;
mod histogram;
mod rate;
mod score;
mod signal;
mod spread;
mod statistics;
mod table;
mod trace;
pub mod units;

pub use edie::{EdieError, EdieGrid, EdieRow, Window};
#[cfg(feature = "figures")]
pub use figures::{
    Area, BarRow, Bounds, Distributed, Drawn, Estimated, LaneInTime, MarkAt, Marks, OnTop, Panel, Scattered,
    Shading, Sheet, Space, TimeLine, Upwards, bars, distribution, escaped, estimates, map, over_time, panels,
    rate_density, scatter, text_width, time_space,
};
pub use histogram::Histogram;
pub use rate::{RatePoint, RateSeries, rate_by_density};
pub use score::{count_score, crps};
pub use signal::{Signal, SignalQueue};
pub use spread::{chance_of_more, middle_95, quantile, share_between};
pub use statistics::{Estimate, Interval, Moments, geh, mean, poisson_interval, required_replications};
#[cfg(feature = "parquet")]
pub use table::sound;
pub use table::{
    Cell, Cells, Column, Format, Kind, PartialFile, ReadError, TableError, TableWriter, TextTable, seconds,
};
pub use trace::{Mark, Sample};
