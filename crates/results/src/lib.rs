//! The results of a run: tables, a summary, checkpoints, a record from which it can be repeated, and reports.
//! Outputs read the world and never write it; a file that they write is complete or not there.

pub mod checkpoint;
pub mod folder;
pub mod numbers;
mod outcome;
pub mod output;
mod pack;
pub mod record;
#[cfg(feature = "reports")]
pub mod report;
mod seen;
mod whole_file;

pub use outcome::{About, Ending, LineServed};
