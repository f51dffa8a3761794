//! Layouts of tables: which column holds what, in which unit.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::error::RecordingError;
use crate::recording::RoadUser;

/// How a table of tracks is to be read: one row for a road user in a frame.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Layout {
    /// The names of its columns.
    pub columns: Columns,
    /// The units of its numbers.
    #[serde(default)]
    pub units: Units,
    /// Which point of a road user x and y are.
    #[serde(default)]
    pub point: Point,
    /// Whether y points up or down, beside an x that points to the right.
    #[serde(default)]
    pub axes: Axes,
    /// Frames per second, where neither a column nor another file gives the time.
    #[serde(default)]
    pub frames_per_second: Option<f64>,
    /// An id that appears again after such a pause is that of another road user [s]; for ever the same where it is not
    /// given.
    #[serde(default)]
    pub reused_after_s: Option<f64>,
    /// A column that has the same value in all rows, such as the place: a table of several is refused.
    #[serde(default)]
    pub same: Option<String>,
    /// The names of the columns of a table without a header: one whose first row has no column `track`. Columns beyond
    /// them are not used.
    #[serde(default)]
    pub header: Option<Vec<String>>,
    /// The names of classes in the table.
    #[serde(default)]
    pub classes: BTreeMap<String, RoadUser>,
}

/// The columns of a table by what they hold. All that are given are required, but for `heading`, `length` and `width`,
/// which may be missing or empty.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Columns {
    /// The id of the road user.
    pub track: String,
    /// The number of the frame. Without it frames are counted by the time.
    #[serde(default)]
    pub frame: Option<String>,
    /// The time.
    #[serde(default)]
    pub time: Option<String>,
    /// The class.
    #[serde(default)]
    pub class: Option<String>,
    /// Position to the right, or east.
    pub x: String,
    /// Position upwards, or north.
    pub y: String,
    /// Velocity along x. Without velocity and speed, both come from smoothed positions.
    #[serde(default)]
    pub vx: Option<String>,
    /// Velocity along y.
    #[serde(default)]
    pub vy: Option<String>,
    /// Speed, where there is no velocity.
    #[serde(default)]
    pub speed: Option<String>,
    /// Heading, counter-clockwise from x.
    #[serde(default)]
    pub heading: Option<String>,
    /// Length of the road user.
    #[serde(default)]
    pub length: Option<String>,
    /// Width of the road user.
    #[serde(default)]
    pub width: Option<String>,
}

/// The units of a table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Units {
    /// Of positions, sizes and, per second, of speeds.
    pub length: LengthUnit,
    /// Of headings.
    pub angle: AngleUnit,
    /// Of times.
    pub time: TimeUnit,
}

/// A unit of length.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
pub enum LengthUnit {
    /// Metres.
    #[default]
    #[serde(rename = "m")]
    Metres,
    /// Feet.
    #[serde(rename = "ft")]
    Feet,
}

/// A unit of angles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
pub enum AngleUnit {
    /// Radians.
    #[default]
    #[serde(rename = "rad")]
    Radians,
    /// Degrees.
    #[serde(rename = "deg")]
    Degrees,
}

/// A unit of time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
pub enum TimeUnit {
    /// Milliseconds.
    #[serde(rename = "ms")]
    Milliseconds,
    /// Seconds.
    #[default]
    #[serde(rename = "s")]
    Seconds,
}

/// A point of a road user.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Point {
    /// Its centre.
    #[default]
    Centre,
    /// The middle of its front.
    Front,
    /// The corner with the least x and y of a box around it, along the axes.
    Corner,
}

/// The direction of y.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Axes {
    /// Up, as on a map.
    #[default]
    YUp,
    /// Down, as in an image. The recording is mirrored, so that y points up.
    YDown,
}

impl Layout {
    /// The layout in TOML.
    ///
    /// # Errors
    /// If it is no TOML, or has other keys or values.
    pub fn parse(text: &str) -> Result<Layout, RecordingError> {
        toml::from_str(text).map_err(|error| {
            let line = error.span().map_or(1, |it| 1 + text[..it.start].matches('\n').count());
            RecordingError::Layout { what: format!("line {line}: {}", error.message()) }
        })
    }

    /// A table with these columns, in metres, seconds and radians.
    pub fn of_columns(columns: Columns) -> Layout {
        Layout {
            columns,
            units: Units::default(),
            point: Point::default(),
            axes: Axes::default(),
            frames_per_second: None,
            reused_after_s: None,
            same: None,
            header: None,
            classes: BTreeMap::new(),
        }
    }
}

impl LengthUnit {
    pub(super) fn metres(self) -> f64 {
        match self {
            LengthUnit::Metres => 1.0,
            LengthUnit::Feet => 0.3048,
        }
    }
}

impl AngleUnit {
    pub(super) fn radians(self) -> f64 {
        match self {
            AngleUnit::Radians => 1.0,
            AngleUnit::Degrees => std::f64::consts::PI / 180.0,
        }
    }
}

impl TimeUnit {
    pub(super) fn milliseconds(self) -> f64 {
        match self {
            TimeUnit::Milliseconds => 1.0,
            TimeUnit::Seconds => 1000.0,
        }
    }
}

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Field {
    Track,
    Frame,
    Time,
    Class,
    X,
    Y,
    Vx,
    Vy,
    Speed,
    Heading,
    Length,
    Width,
}

impl Field {
    /// All of them, in their order.
    pub(super) const ALL: [Field; 12] = [
        Field::Track,
        Field::Frame,
        Field::Time,
        Field::Class,
        Field::X,
        Field::Y,
        Field::Vx,
        Field::Vy,
        Field::Speed,
        Field::Heading,
        Field::Length,
        Field::Width,
    ];

    pub(super) fn may_be_missing(self) -> bool {
        matches!(self, Field::Heading | Field::Length | Field::Width)
    }
}

impl Columns {
    /// The name of the column of a field.
    pub(super) fn name(&self, field: Field) -> Option<&str> {
        match field {
            Field::Track => Some(&self.track),
            Field::Frame => self.frame.as_deref(),
            Field::Time => self.time.as_deref(),
            Field::Class => self.class.as_deref(),
            Field::X => Some(&self.x),
            Field::Y => Some(&self.y),
            Field::Vx => self.vx.as_deref(),
            Field::Vy => self.vy.as_deref(),
            Field::Speed => self.speed.as_deref(),
            Field::Heading => self.heading.as_deref(),
            Field::Length => self.length.as_deref(),
            Field::Width => self.width.as_deref(),
        }
    }
}
