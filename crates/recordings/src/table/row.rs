//! One row of a table.

use super::dialect::Commas;
use super::id::Id;
use super::layout::{Axes, Field, Layout};
use crate::recording::{RoadUser, State};

/// The values of a row, in metres, seconds and radians, but for times.
pub(super) struct Row {
    pub(super) track: Id,
    /// The number of its frame, where a column gives it.
    pub(super) frame: Option<i64>,
    /// Its time [ms], where a column gives it.
    pub(super) time_ms: Option<f64>,
    pub(super) class: Class,
    pub(super) length: Option<f64>,
    pub(super) width: Option<f64>,
    /// Without a frame yet. Speed and heading are NaN where the row does not give them.
    pub(super) state: State,
}

/// The class of a road user by its row.
pub(super) enum Class {
    /// This one.
    Known(RoadUser),
    /// Its name is not known.
    Unknown(String),
    /// The table has no classes.
    NotGiven,
}

/// Why a row cannot be used.
pub(super) struct Flaw {
    pub(super) what: String,
    pub(super) remedy: &'static str,
}

/// Frames and times beyond this are refused [1 or ms]; smaller ones have exact differences.
const MAXIMUM_COUNT: f64 = (1_i64 << 50) as f64;
/// Below this speed a motion has no direction [m/s].
const STANDSTILL: f64 = 0.1;

/// The fields of a row, to be read by a layout.
struct Fields<'a> {
    fields: &'a [&'a [u8]; Field::ALL.len()],
    layout: &'a Layout,
    commas: Commas,
}

impl Row {
    /// The row with `fields` in the order of [`Field::ALL`].
    pub(super) fn of(
        fields: &[&[u8]; Field::ALL.len()],
        layout: &Layout,
        commas: Commas,
    ) -> Result<Row, Flaw> {
        let it = Fields { fields, layout, commas };
        let metres = layout.units.length.metres();
        let up = if layout.axes == Axes::YDown { -1.0 } else { 1.0 };
        let (speed, motion) = it.motion(metres, up)?;
        let heading = it.number(Field::Heading)?.map(|it| up * it * layout.units.angle.radians());
        let [x, y] = [Field::X, Field::Y].map(|field| it.needed(field));
        Ok(Row {
            track: it.track()?,
            frame: it.count(Field::Frame)?.map(|it| it as i64),
            time_ms: it.time()?,
            class: it.class(),
            length: it.number(Field::Length)?.map(|it| it * metres),
            width: it.number(Field::Width)?.map(|it| it * metres),
            state: State {
                frame: 0,
                x: x? * metres,
                y: y? * metres * up,
                speed,
                heading: heading.unwrap_or(motion),
            },
        })
    }
}

impl Fields<'_> {
    fn of(&self, field: Field) -> &[u8] {
        self.fields[field as usize]
    }

    /// The name of the column of a field.
    fn name(&self, field: Field) -> &str {
        self.layout.columns.name(field).unwrap_or_default()
    }

    /// Speed, and the direction of the velocity; NaN where they are not given.
    fn motion(&self, metres: f64, up: f64) -> Result<(f64, f64), Flaw> {
        if let (Some(_), Some(_)) = (&self.layout.columns.vx, &self.layout.columns.vy) {
            let (vx, vy) = (self.needed(Field::Vx)? * metres, self.needed(Field::Vy)? * metres * up);
            let speed = (vx * vx + vy * vy).sqrt();
            return Ok((speed, if speed > STANDSTILL { vy.atan2(vx) } else { f64::NAN }));
        }
        match self.layout.columns.speed {
            Some(_) => Ok((self.needed(Field::Speed)? * metres, f64::NAN)),
            None => Ok((f64::NAN, f64::NAN)),
        }
    }

    fn track(&self) -> Result<Id, Flaw> {
        Id::of(self.of(Field::Track)).ok_or_else(|| {
            let what = format!("{} is empty, or longer than {} bytes", self.name(Field::Track), Id::LONGEST);
            Flaw { what, remedy: "give every road user an id" }
        })
    }

    fn time(&self) -> Result<Option<f64>, Flaw> {
        let unit = self.layout.units.time.milliseconds();
        Ok(self.count(Field::Time)?.map(|it| it * unit))
    }

    fn class(&self) -> Class {
        if self.layout.columns.class.is_none() {
            return Class::NotGiven;
        }
        let name = self.of(Field::Class);
        let text = str::from_utf8(name).ok();
        // Numbers of classes may be written with a decimal.
        let named = |it: &str| self.layout.classes.get(it.strip_suffix(".0").unwrap_or(it)).copied();
        let known = text.and_then(|it| named(it).or_else(|| RoadUser::of_name(it)));
        known.map_or_else(|| Class::Unknown(excerpt(name)), Class::Known)
    }

    /// A number within the range of frames and times, where its column exists.
    fn count(&self, field: Field) -> Result<Option<f64>, Flaw> {
        if self.layout.columns.name(field).is_none() {
            return Ok(None);
        }
        let value = self.needed(field)?;
        if field == Field::Frame && value.fract() != 0.0 {
            return Err(self.not_valid(field));
        }
        if value.is_nan() || value.abs() > MAXIMUM_COUNT {
            let found = excerpt(self.of(field));
            let what = format!("{} is {found}, beyond ±{MAXIMUM_COUNT}", self.name(field));
            return Err(Flaw { what, remedy: "correct the number" });
        }
        Ok(Some(value))
    }

    /// A number that a row may leave out.
    fn number(&self, field: Field) -> Result<Option<f64>, Flaw> {
        let text = self.of(field);
        if text.is_empty() { Ok(None) } else { self.needed(field).map(Some) }
    }

    fn needed(&self, field: Field) -> Result<f64, Flaw> {
        self.commas.number(self.of(field)).ok_or_else(|| self.not_valid(field))
    }

    fn not_valid(&self, field: Field) -> Flaw {
        let found = excerpt(self.of(field));
        Flaw {
            what: format!("{} is {found:?}, which is not a valid number for it", self.name(field)),
            remedy: "correct the number",
        }
    }
}

/// The beginning of a field, for messages.
fn excerpt(field: &[u8]) -> String {
    String::from_utf8_lossy(&field[..field.len().min(40)]).into_owned()
}
