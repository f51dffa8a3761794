//! The contents of a map file beside the roads that traffic uses.

use std::collections::BTreeMap;

use laneweave_network::{Point, Rectangle};

/// The contents of a map file, whether or not traffic uses them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contents {
    /// How many elements of each kind it has, such as `lanelet road` or `regulatory_element traffic_light`.
    pub counts: BTreeMap<String, usize>,
    /// The legal limits of lanelets for vehicles to which the map gives none [km/h].
    pub limits_of_law: Vec<f64>,
    /// Outlines of crosswalks.
    pub crosswalks: Vec<Vec<Point>>,
    /// Lines that are painted on roads, or stand beside them. Empty if the format has none.
    pub markings: Vec<Marking>,
    /// The ground of what stands on or beside the roads and is no part of them, such as parked cars. Empty if the
    /// format has none.
    pub obstacles: Vec<Rectangle>,
}

/// A line that is painted on a road, or stands beside it.
#[derive(Clone, Debug, PartialEq)]
pub struct Marking {
    /// Its points.
    pub line: Vec<Point>,
    /// What it looks like.
    pub paint: MarkingPaint,
    /// Whether it is a broad line.
    pub is_thick: bool,
}

/// What a marking looks like. Of two lines side by side, the left one comes first, seen along the points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MarkingPaint {
    /// A broken line.
    Dashed,
    /// An unbroken line.
    Solid,
    /// A broken line on the left of an unbroken one.
    DashedSolid,
    /// An unbroken line on the left of a broken one.
    SolidDashed,
    /// Two unbroken lines.
    SolidSolid,
    /// Two broken lines.
    DashedDashed,
    /// A kerb.
    Curb,
    /// A guard rail, a wall or a fence.
    Barrier,
    /// The edge of a road, without paint.
    Edge,
}
