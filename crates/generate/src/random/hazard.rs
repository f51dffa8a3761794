//! Difficult elements of random maps.

use std::fmt;
use std::str::FromStr;

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
    /// A fork behind a fork, and a light: branches share a few metres.
    NestedFork,
    /// Forks with lanes between them that are shorter than a long vehicle, and a light.
    ForkRow,
    /// A lane that opens from nothing over a few metres, right before a light.
    OpeningAtLight,
    /// A branch that bulges out, and comes back beside the lane that it has left.
    Bulge,
    /// An entrance to two lanes, and an exit from the inner one across the outer one.
    SharedEntrance,
    /// A merge, and less than a vehicle's length behind it an exit.
    MergeExit,
    /// Exits from two lanes that cross each other.
    CrossingExits,
    /// A roundabout whose arms have room for hardly more than one vehicle each.
    ShortArms,
    /// A stretch of 2 to 12 m for lane changes before lanes part.
    TinyWindow,
    /// A bend with a radius of 8 to 10 m, of lanes of 2.2 to 2.4 m.
    Hairpin,
    /// A lane that turns back by 180° at the end of a street.
    TurnBack,
    /// An entrance whose first lanelet is 2 to 8 m long.
    ShortEntrance,
    /// A road that ends where another one begins, without a connection.
    Gap,
}

impl Hazard {
    /// All of them.
    pub const ALL: [Hazard; 34] = [
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
        Hazard::NestedFork,
        Hazard::ForkRow,
        Hazard::OpeningAtLight,
        Hazard::Bulge,
        Hazard::SharedEntrance,
        Hazard::MergeExit,
        Hazard::CrossingExits,
        Hazard::ShortArms,
        Hazard::TinyWindow,
        Hazard::Hairpin,
        Hazard::TurnBack,
        Hazard::ShortEntrance,
        Hazard::Gap,
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
            Hazard::NestedFork => "nested fork",
            Hazard::ForkRow => "row of forks",
            Hazard::OpeningAtLight => "lane that opens at a light",
            Hazard::Bulge => "bulge",
            Hazard::SharedEntrance => "entrance to two lanes",
            Hazard::MergeExit => "merge and exit",
            Hazard::CrossingExits => "crossing exits",
            Hazard::ShortArms => "roundabout with short arms",
            Hazard::TinyWindow => "tiny window",
            Hazard::Hairpin => "hairpin",
            Hazard::TurnBack => "lane that turns back",
            Hazard::ShortEntrance => "short first lanelet",
            Hazard::Gap => "gap",
        }
    }
}

impl FromStr for Hazard {
    type Err = String;

    /// The difficulty of this name, whose words may be joined by hyphens.
    fn from_str(name: &str) -> Result<Hazard, String> {
        let is_it = |it: &Hazard| it.name().replace(' ', "-") == name.replace(' ', "-");
        Hazard::ALL.into_iter().find(is_it).ok_or_else(|| {
            let names = Hazard::ALL.map(|it| it.name().replace(' ', "-")).join(", ");
            format!("there is no such element; choose one of {names}")
        })
    }
}

impl fmt::Display for Hazard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
