//! One row of a track file.

use std::str::FromStr;

use super::header::COLUMNS;
use crate::recording::{RoadUser, State};

/// The values of a row.
pub(super) struct Row {
    pub(super) track: i64,
    pub(super) timestamp_ms: i64,
    pub(super) class: RoadUser,
    /// The name of its class, if that is not known.
    pub(super) unknown_class: Option<String>,
    pub(super) length: Option<f64>,
    pub(super) width: Option<f64>,
    /// Its heading is NaN where the row gives none and the road user stands.
    pub(super) state: State,
}

/// Why a row cannot be used.
pub(super) struct Flaw {
    pub(super) what: String,
    pub(super) remedy: &'static str,
}

/// Frames and times beyond this are refused [1 or ms]; smaller ones have exact differences.
const MAXIMUM_COUNT: i64 = 1 << 50;
/// Below this speed a motion has no direction [m/s].
const STANDSTILL: f64 = 0.1;

impl Row {
    /// The row with `fields` in the order of [`COLUMNS`].
    pub(super) fn of(fields: &[&[u8]; COLUMNS.len()]) -> Result<Row, Flaw> {
        let [track, frame, timestamp, class, x, y, vx, vy, heading, length, width] = *fields;
        let (class, unknown_class) = class_of(class);
        let (vx, vy): (f64, f64) = (number(6, vx)?, number(7, vy)?);
        let speed = (vx * vx + vy * vy).sqrt();
        let motion = if speed > STANDSTILL { vy.atan2(vx) } else { f64::NAN };
        Ok(Row {
            // Pedestrians are numbered P1, P2, …, in a file of their own.
            track: number(0, track.strip_prefix(b"P").unwrap_or(track))?,
            timestamp_ms: count(2, timestamp)?,
            class,
            unknown_class,
            length: optional(9, length)?,
            width: optional(10, width)?,
            state: State {
                frame: count(1, frame)?,
                x: number(4, x)?,
                y: number(5, y)?,
                speed,
                heading: optional(8, heading)?.unwrap_or(motion),
            },
        })
    }
}

fn class_of(name: &[u8]) -> (RoadUser, Option<String>) {
    let class = match name {
        b"car" | b"van" => RoadUser::Car,
        b"truck" => RoadUser::Truck,
        b"bus" => RoadUser::Bus,
        b"motorcycle" => RoadUser::Motorcycle,
        b"bicycle" => RoadUser::Bicycle,
        b"pedestrian" => RoadUser::Pedestrian,
        // The dataset does not distinguish these.
        b"pedestrian/bicycle" => RoadUser::Other,
        _ => return (RoadUser::Other, Some(excerpt(name))),
    };
    (class, None)
}

fn number<T: FromStr>(column: usize, field: &[u8]) -> Result<T, Flaw> {
    str::from_utf8(field).ok().and_then(|it| it.parse().ok()).ok_or_else(|| Flaw {
        what: format!("{} is {:?}, which is not a valid number for it", COLUMNS[column], excerpt(field)),
        remedy: "correct the number",
    })
}

fn count(column: usize, field: &[u8]) -> Result<i64, Flaw> {
    let value: i64 = number(column, field)?;
    if value.unsigned_abs() > MAXIMUM_COUNT as u64 {
        let what = format!("{} is {value}, beyond ±{MAXIMUM_COUNT}", COLUMNS[column]);
        return Err(Flaw { what, remedy: "correct the number" });
    }
    Ok(value)
}

fn optional(column: usize, field: &[u8]) -> Result<Option<f64>, Flaw> {
    if field.is_empty() { Ok(None) } else { number(column, field).map(Some) }
}

/// The beginning of a field, for messages.
fn excerpt(field: &[u8]) -> String {
    String::from_utf8_lossy(&field[..field.len().min(40)]).into_owned()
}
