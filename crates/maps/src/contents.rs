//! The contents of a map file beside the roads that traffic uses.

use std::collections::BTreeMap;

use laneweave_network::Point;

/// The contents of a map file, whether or not traffic uses them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contents {
    /// How many elements of each kind it has, such as `lanelet road` or `regulatory_element traffic_light`.
    pub counts: BTreeMap<String, usize>,
    /// The legal limits of lanelets for vehicles to which the map gives none [km/h].
    pub limits_of_law: Vec<f64>,
    /// Outlines of crosswalks.
    pub crosswalks: Vec<Vec<Point>>,
}
