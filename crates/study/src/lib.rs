//! From observations of traffic to evidence: statistics, Edie's density and flow, figures, tables.
//!
//! Knows no simulator: plain numbers come in; numbers, SVG text and files go out.

mod edie;
mod figures;
mod rate;
mod returning;
mod signal;
mod statistics;
mod table;

pub use edie::{EdieError, EdieGrid, EdieRow, Window};
pub use figures::{Mark, RateSeries, Sample, escaped, rate_density, text_width, time_space};
pub use rate::{RatePoint, rate_by_density};
pub use returning::{Attempt, returning_rate};
pub use signal::{Signal, SignalQueue};
pub use statistics::{Estimate, Interval, geh, mean, poisson_interval, required_replications};
pub use table::{Cell, Cells, Column, Format, Kind, PartialFile, TableError, TableWriter};
