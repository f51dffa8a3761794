//! Map files read into road networks; and generated maps, which can be written as files.
//!
//! A file is read into a [`Drawing`] (points, borders, and lanes between borders), and a drawing becomes a
//! [`Network`](laneweave_network::Network). The generator makes drawings, too.
//!
//! A map file is read in three steps. First come elements as they stand in the file ([`lanelet2::Document`], which can
//! be written again). Then comes the drawing, and from it what can be driven: the network, whose lanelets are used in
//! their own direction, and the [`Graph`], which also has two-way lanelets backwards, and conflicts. Whether lanes
//! share a conflict area is decided exactly.

mod check;
pub mod commonroad;
mod conflict;
mod contents;
mod drawing;
mod error;
mod format;
pub mod generate;
mod graph;
pub mod lanelet2;
mod problem;
mod regulation;
mod routes;
mod rule;
mod shape;
mod size;
pub mod xml;

pub use check::check;
pub use contents::{Contents, Marking, MarkingPaint};
pub use drawing::Drawing;
pub use error::MapError;
pub use format::{FORMATS, Format, Law, Map, ReadOptions, load};
pub use graph::{Graph, Node, NodeIndex};
pub use problem::{BORDERS, Problem};
pub use regulation::regulations;
pub use routes::{By, Route, Sense, Step, routes};
pub use rule::{Rule, RuleKind};
pub use size::Size;
