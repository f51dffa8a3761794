//! Commands as rows of a table: written by a run, and read again.

use std::path::Path;

use laneweave_sim::{Command, Commanded, Target, VehicleId, World};
use laneweave_study::{Cell, Column, ReadError, TextTable, seconds};
use serde_json::{Map, Value};

use super::refused::refused;
use crate::fault::Fault;
use crate::scenario::LONGEST;
use crate::source::in_words;

/// The columns of a table of commands.
pub static COMMAND_COLUMNS: [Column; 5] = [
    Column::real("time_s"),
    Column::text("target"),
    Column::text("id"),
    Column::text("act"),
    Column::text("values"),
];

/// Times are written with this error at most, in steps.
const TOLERANCE: f64 = 1e-3;

/// A command as texts.
pub struct Written {
    time_s: f64,
    target: &'static str,
    id: Option<String>,
    act: String,
    values: String,
}

impl Written {
    /// The command `it` of a run with steps of `step_s` [s].
    pub fn of(it: &Commanded, step_s: f64) -> Written {
        let target = it.vehicle.map(Target::Vehicle).or_else(|| it.command.target());
        let (target, id) = target.as_ref().map_or(("", None), kind_and_id);
        let (act, values) = act_and_values(&it.command);
        Written { time_s: seconds(f64::from(it.step) * step_s), target, id, act, values }
    }

    /// Its cells under [`COMMAND_COLUMNS`].
    pub fn cells(&self) -> [Cell<'_>; COMMAND_COLUMNS.len()] {
        let Written { time_s, target, id, act, values } = self;
        [
            (*time_s).into(),
            (*target).into(),
            id.as_deref().into(),
            act.as_str().into(),
            values.as_str().into(),
        ]
    }
}

/// What the columns `target` and `id` say of what a command concerns. A style has no id: its name is in the values.
fn kind_and_id(target: &Target) -> (&'static str, Option<String>) {
    match target {
        Target::Lanelet(id) => ("lanelet", Some(id.to_string())),
        Target::Origin(id) => ("origin", Some(id.to_string())),
        Target::Light(id) | Target::Plan(id) => ("light", Some(id.to_string())),
        Target::Parameter(..) | Target::Style(_) => ("style", None),
        Target::Vehicle(id) => ("vehicle", Some(id.to_string())),
    }
}

/// The name of what a command does, and its values in JSON. A command is serialized as `{"ACT":VALUES}`, or as `"ACT"`.
fn act_and_values(command: &Command) -> (String, String) {
    // Every command can be serialized.
    let json = serde_json::to_string(command).unwrap_or_default();
    let inner = json.strip_prefix("{\"").and_then(|it| it.strip_suffix('}'));
    match inner.and_then(|it| it.split_once("\":")) {
        Some((act, values)) => (act.into(), values.into()),
        None => (json.trim_matches('"').into(), "null".into()),
    }
}

/// A command of a table.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    /// The step before whose decisions it is carried out.
    pub(super) step: u32,
    /// Its number in the table, from 1 on.
    pub(super) number: usize,
    /// For a new vehicle: the id under which the table knows it.
    pub(super) inserts: Option<VehicleId>,
    pub(super) command: Command,
}

/// The commands of the table at `path`, in the order of their times. They are checked in `world`, which is empty.
pub(super) fn read(path: &Path, world: &World) -> Result<Vec<Row>, Fault> {
    let table = TextTable::read(path).map_err(|error| match error {
        ReadError::File(error) => Fault::refused(path, "read", &error),
        ReadError::Row { row, what } => Fault::new(place(path, row), what, "correct this row"),
        ReadError::Name | ReadError::Content(_) => {
            let remedy = "give a table `commands` of a run, or write one as CSV";
            Fault::new(path.display(), error, remedy)
        }
    })?;
    let columns = Columns::of(&table, path)?;
    let mut rows = Vec::with_capacity(table.rows.len());
    for (cells, number) in table.rows.iter().zip(1..) {
        let read = columns.row(cells, number, world.clock().dt);
        let row = read.map_err(|(what, remedy)| Fault::new(place(path, number), what, remedy))?;
        world.check_content(&row.command).map_err(|error| refused(place(path, number), &error))?;
        rows.push(row);
    }
    rows.sort_by_key(|it| it.step);
    Ok(rows)
}

/// The first step that begins at the time `time_s` [s] or later, of steps of `dt` [s].
pub(crate) fn first_step_from(time_s: f64, dt: f64) -> u32 {
    (time_s / dt - TOLERANCE).ceil() as u32
}

/// The place of a row.
pub(super) fn place(path: &Path, row: usize) -> String {
    format!("{}, row {row}", path.display())
}

/// Where the columns are.
struct Columns {
    time: usize,
    act: usize,
    values: usize,
    target: Option<usize>,
    id: Option<usize>,
}

/// What is wrong in a row, and the remedy.
type Wrong = (String, String);

fn wrong(what: impl Into<String>, remedy: impl Into<String>) -> Wrong {
    (what.into(), remedy.into())
}

impl Columns {
    fn of(table: &TextTable, path: &Path) -> Result<Columns, Fault> {
        let column = |name: &str| {
            table.column(name).ok_or_else(|| {
                let remedy = "a table of commands has the columns time_s, act and values: add it";
                Fault::new(path.display(), format!("there is no column {name}"), remedy)
            })
        };
        Ok(Columns {
            time: column("time_s")?,
            act: column("act")?,
            values: column("values")?,
            target: table.column("target"),
            id: table.column("id"),
        })
    }

    fn row(&self, cells: &[Option<String>], number: usize, dt: f64) -> Result<Row, Wrong> {
        let cell = |at: usize| cells[at].as_deref();
        let time = cell(self.time).unwrap_or_default();
        let in_range = |it: &f64| (0.0..=LONGEST).contains(it);
        let time_s = time.trim().parse().ok().filter(in_range).ok_or_else(|| {
            wrong(format!("a time_s of {time:?}"), format!("give seconds from 0 to {LONGEST}"))
        })?;
        let command = command(cell(self.act).unwrap_or_default(), cell(self.values).unwrap_or("null"))?;
        let target = command.target();
        let (kind, id) = target.as_ref().map_or(("vehicle", None), kind_and_id);
        let given = self.target.and_then(cell).filter(|it| *it != kind);
        if let Some(given) = given {
            let what = format!("the target is {given:?}, but the values concern a {kind}");
            return Err(wrong(what, format!("write {kind}, or leave the cell empty")));
        }
        let given = self.id.and_then(cell);
        let inserts = if matches!(command, Command::Insert(_)) { given } else { None };
        if let Some(given) = given.filter(|it| inserts.is_none() && id.as_deref() != Some(it.trim())) {
            let target = target.map_or_else(String::new, |it| it.to_string());
            let what = format!("the id is {given}, but the values concern {target}");
            return Err(wrong(what, "correct one of them, or leave the cell empty"));
        }
        let inserts = inserts.map(|it| {
            it.parse().map_err(|_| wrong(format!("an id of {it:?}"), "give a whole number from 0 on"))
        });
        let step = first_step_from(time_s, dt);
        Ok(Row { step, number, inserts: inserts.transpose()?, command })
    }
}

/// The command that does `act` with `values`, a text in JSON.
fn command(act: &str, values: &str) -> Result<Command, Wrong> {
    let values: Value = serde_json::from_str(values).map_err(|error| {
        let remedy = "write JSON, such as [7, \"aggressive\"] for the act set_style of vehicle 7";
        wrong(format!("the values are no JSON: {error}"), remedy)
    })?;
    let one = Map::from_iter([(act.to_owned(), values)]);
    serde_json::from_value(Value::Object(one)).map_err(|error| {
        let message = error.to_string();
        in_words(&message).unwrap_or_else(|| (message, "correct the values".into()))
    })
}
