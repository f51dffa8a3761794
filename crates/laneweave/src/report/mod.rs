//! Reports as single HTML files: parts of a page that any report is made of, and the report of a run.
//!
//! A page needs no network, no script and no other file; its figures are inline SVG that takes its colours from the
//! page.

pub(crate) mod classes;
mod numbers;
mod page;
pub(crate) mod roads;
mod run;
mod table;

pub use numbers::{counted, number, percent, signed, with_interval};
pub use page::{Figure, Page, Section, Tile};
pub use run::{About, RunReport};
pub use table::{Align, Table};
