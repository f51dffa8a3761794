//! Reports as single HTML files: the parts of a page that all reports use, and the report of a run.
//!
//! A page needs no network and no other file; its figures are inline SVG that takes its colours from the page. A short
//! script saves them as files; without it the page can be read as well.
//!
//! Any command makes a [`Page`] of sections: tables and captions, and the figures of `laneweave_study` as inline SVG,
//! each with its data as CSV and links to both (`download.rs`). The report of a run (`run/`) is drawn from what its
//! output kept (`kept/`).

pub mod classes;
mod download;
mod kept;
mod page;
mod roads;
mod run;
mod table;

pub use crate::numbers::{counted, number, percent, signed, with_interval};
pub use crate::outcome::About;
pub use kept::{Crowd, Driving, Reasons, Record, StyleDriving, TripTimes};
pub use page::{Figure, Page, Section, Tile};
pub use roads::time_and_space;
pub use run::{RunReport, area};
pub use table::{Align, Table};
