//! A map that was read or drawn: what can be driven.

use std::collections::BTreeMap;

use laneweave_network::{Id, Network, Program};

use crate::contents::Contents;
use crate::graph::Graph;
use crate::problem::Problem;
use crate::rule::Rule;

/// A map that was read.
#[derive(Clone, Debug)]
pub struct Map {
    /// Its roads.
    pub network: Network,
    /// Where vehicles may go from each lanelet.
    pub graph: Graph,
    /// The rules of traffic, beside the lanelets themselves.
    pub rules: Vec<Rule>,
    /// The programs of its lights, by the ids of their rules; empty if it has none.
    pub programs: BTreeMap<Id, Program>,
    /// The other contents of the file.
    pub contents: Contents,
    /// Elements that could not be used unchanged, in order of lines.
    pub problems: Vec<Problem>,
    /// Latitude and longitude of the local frame's origin [°], if the map was projected.
    pub origin: Option<(f64, f64)>,
}
