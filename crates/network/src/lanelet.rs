//! One lanelet: a piece of lane between two borders, and what lies around it.

use crate::class::Classes;
use crate::geometry::Polyline;
use crate::id::Id;
use serde::{Deserialize, Serialize};

/// A lanelet's place in [`crate::Network::lanelets`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct LaneletIndex(pub u32);

impl LaneletIndex {
    /// The place as an index.
    pub fn at(self) -> usize {
        self.0 as usize
    }
}

/// Left or right in the direction of travel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// To the left.
    Left,
    /// To the right.
    Right,
}

impl Side {
    /// Both sides, left first.
    pub const BOTH: [Side; 2] = [Side::Left, Side::Right];

    /// Its place in [`Side::BOTH`].
    #[inline]
    pub fn at(self) -> usize {
        self as usize
    }

    /// Its name in tables: left or right.
    pub fn name(self) -> &'static str {
        match self {
            Side::Left => "left",
            Side::Right => "right",
        }
    }

    /// The other side.
    pub fn opposite(self) -> Side {
        match self {
            Side::Left => Side::Right,
            Side::Right => Side::Left,
        }
    }

    /// +1 to the left, −1 to the right: the sign of a lateral offset.
    pub fn sign(self) -> f64 {
        match self {
            Side::Left => 1.0,
            Side::Right => -1.0,
        }
    }
}

/// On which side of the road traffic keeps. The overtaking side is the opposite one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DrivingSide {
    /// Drives on the right, overtakes on the left.
    #[default]
    Right,
    /// Drives on the left, overtakes on the right.
    Left,
}

impl DrivingSide {
    /// The side on which faster traffic drives.
    pub fn overtaking(self) -> Side {
        match self {
            DrivingSide::Right => Side::Left,
            DrivingSide::Left => Side::Right,
        }
    }
}

/// A piece of lane that vehicles may use, oriented in its direction of travel.
#[derive(Clone, Debug)]
pub struct Lanelet {
    /// Its id in the map.
    pub id: Id,
    /// Left border, in the direction of travel.
    pub left_border: Polyline,
    /// Right border, in the direction of travel.
    pub right_border: Polyline,
    /// Centre line, whose length is the lanelet's.
    pub centre: Polyline,
    /// Speed limit [m/s].
    pub speed_limit: f64,
    /// Who may use it.
    pub classes: Classes,
    /// It lies in a built-up area and is no motorway.
    pub is_in_town: bool,
    /// Lanelets that continue it.
    pub following: Vec<LaneletIndex>,
    /// The lanelet on the left to which a change is allowed.
    pub left: Option<LaneletIndex>,
    /// The lanelet on the right to which a change is allowed.
    pub right: Option<LaneletIndex>,
    /// The neighbour on the left to which no change is allowed.
    pub adjacent_left: Option<LaneletIndex>,
    /// The neighbour on the right to which no change is allowed.
    pub adjacent_right: Option<LaneletIndex>,
}

impl Lanelet {
    /// A lanelet with nothing around it.
    pub fn alone(
        id: impl Into<Id>,
        [left_border, right_border, centre]: [Polyline; 3],
        speed_limit: f64,
    ) -> Lanelet {
        Lanelet {
            id: id.into(),
            left_border,
            right_border,
            centre,
            speed_limit,
            classes: Classes::ALL,
            is_in_town: false,
            following: Vec::new(),
            left: None,
            right: None,
            adjacent_left: None,
            adjacent_right: None,
        }
    }

    /// Length of the centre line [m].
    pub fn length(&self) -> f64 {
        self.centre.length()
    }

    /// The lanelet on `side` to which a change is allowed.
    pub fn beside(&self, side: Side) -> Option<LaneletIndex> {
        match side {
            Side::Left => self.left,
            Side::Right => self.right,
        }
    }

    /// Width for a vehicle on the centre line at `station` [m]: from there to the nearest points of the two borders.
    pub fn clear_width(&self, station: f64) -> f64 {
        let at = self.centre.at(station);
        self.left_border.distance_to(&at) + self.right_border.distance_to(&at)
    }

    /// Distance between the borders at `station` of the centre line [m].
    pub fn width(&self, station: f64) -> f64 {
        let fraction = station / self.length();
        let left = self.left_border.at(fraction * self.left_border.length());
        left.distance(&self.right_border.at(fraction * self.right_border.length()))
    }
}
