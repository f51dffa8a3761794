//! Map files read into road networks.
//!
//! A file is read into a [`Drawing`] (points, borders, and lanes between borders), and a drawing becomes a
//! [`Network`](laneweave_network::Network). Programs can make drawings, too, and write them as files.
//!
//! A map file is read in three steps. First come elements as they stand in the file ([`lanelet2::Document`], which can
//! be written again). Then comes the drawing, and from it what can be driven: the network, whose lanelets are used in
//! their own direction, and the [`Graph`], which also has two-way lanelets backwards, and conflicts. Whether lanes
//! share a conflict area is decided exactly. A format each is in `format/`; `kind.rs` tells what a file is.

mod build;
mod check;
mod conflict;
mod contents;
pub mod drawing;
mod error;
mod foreign;
mod format;
mod graph;
mod kind;
mod law;
mod left_hand;
mod load;
mod loose_ends;
mod map;
mod options;
mod problem;
mod regulation;
mod routes;
mod rule;
mod shape;
mod size;
mod unused;
pub mod xml;

pub use check::check;
pub use contents::{Contents, Marking, MarkingPaint};
pub use drawing::Drawing;
pub use error::MapError;
pub use foreign::Foreign;
pub use format::{FORMATS, Format, commonroad, lanelet2, sumo};
pub use graph::{Graph, Node, NodeIndex};
pub use kind::{FileKind, is_compressed, uncompressed};
pub use law::Law;
pub use load::{contents, load};
pub use map::Map;
pub use options::ReadOptions;
pub use problem::{BORDERS, Problem};
pub use regulation::regulations;
pub use routes::{By, Route, Sense, Step, routes};
pub use rule::{Rule, RuleKind};
pub use size::Size;
pub use unused::{Meaning, Unused};
