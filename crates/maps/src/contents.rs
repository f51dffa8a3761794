//! What a map file holds beside the roads that are driven.

use std::collections::BTreeMap;

use laneweave_network::Point;

/// What a map file holds, whether or not traffic uses it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contents {
    /// How many elements of each kind it has, such as `lanelet road` or `regulatory_element traffic_light`.
    pub counts: BTreeMap<String, usize>,
    /// The limits of lanelets for vehicles that the map gives none, so that the law does [km/h].
    pub limits_of_law: Vec<f64>,
    /// Outlines of crosswalks.
    pub crosswalks: Vec<Vec<Point>>,
}
