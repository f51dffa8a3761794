//! Difficult elements of random maps.

use std::fmt;

/// A difficult element of a random map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Hazard {
    /// A lane that narrows to nothing beside others.
    Taper,
    /// A lane that opens from nothing beside others.
    OpeningLane,
    /// A lane that ends with a square end beside others.
    BluntLaneDrop,
    /// A ramp with a lane that runs beside the road, then narrows to nothing.
    OnRamp,
    /// A lane that opens from nothing, runs beside the road, then leads away.
    OffRamp,
    /// A road that joins a lane without a lane of its own.
    Merge,
    /// A road that leaves a lane without a lane of its own.
    Fork,
    /// A lanelet of 0.5 to 1.4 m beside a lane, with no border in common.
    Strip,
    /// Entrances that begin at one place.
    EdgeFork,
    /// Exits that end at one place.
    EdgeMerge,
    /// One lane for both directions.
    OneLaneStreet,
    /// Directions whose lanes partly share one area.
    PartialOverlap,
    /// A short stretch for lane changes before lanes part.
    ShortWindow,
    /// A row of lanelets of 0.5 to 3 m.
    ShortLanelets,
    /// Lanes of 2.2 to 2.6 m.
    NarrowLanes,
    /// A bend with a radius of 8 to 20 m.
    SharpBend,
    /// A bend, and one back.
    ReverseCurve,
    /// A roundabout of one lane.
    Roundabout,
    /// A junction with lights.
    Lights,
    /// A junction at which one street has priority.
    Priority,
    /// A junction without any rule.
    PlainJunction,
}

impl Hazard {
    /// All of them.
    pub const ALL: [Hazard; 21] = [
        Hazard::Taper,
        Hazard::OpeningLane,
        Hazard::BluntLaneDrop,
        Hazard::OnRamp,
        Hazard::OffRamp,
        Hazard::Merge,
        Hazard::Fork,
        Hazard::Strip,
        Hazard::EdgeFork,
        Hazard::EdgeMerge,
        Hazard::OneLaneStreet,
        Hazard::PartialOverlap,
        Hazard::ShortWindow,
        Hazard::ShortLanelets,
        Hazard::NarrowLanes,
        Hazard::SharpBend,
        Hazard::ReverseCurve,
        Hazard::Roundabout,
        Hazard::Lights,
        Hazard::Priority,
        Hazard::PlainJunction,
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Hazard::Taper => "taper",
            Hazard::OpeningLane => "opening lane",
            Hazard::BluntLaneDrop => "blunt lane drop",
            Hazard::OnRamp => "on-ramp",
            Hazard::OffRamp => "off-ramp",
            Hazard::Merge => "merge",
            Hazard::Fork => "fork",
            Hazard::Strip => "strip",
            Hazard::EdgeFork => "fork at the edge",
            Hazard::EdgeMerge => "merge at the edge",
            Hazard::OneLaneStreet => "one-lane street",
            Hazard::PartialOverlap => "partial overlap",
            Hazard::ShortWindow => "short window",
            Hazard::ShortLanelets => "short lanelets",
            Hazard::NarrowLanes => "narrow lanes",
            Hazard::SharpBend => "sharp bend",
            Hazard::ReverseCurve => "S-bend",
            Hazard::Roundabout => "roundabout",
            Hazard::Lights => "junction with lights",
            Hazard::Priority => "junction with priority",
            Hazard::PlainJunction => "junction without rules",
        }
    }
}

impl fmt::Display for Hazard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
