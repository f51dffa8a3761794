//! Values of a map for the keys of a scenario.

use std::collections::BTreeMap;

use laneweave_network::{Class, DrivingSide, Extension, Id, Lanelet, LightIndex, SignalPlan};
use laneweave_sim::Place;
use serde_json::{Value, json};

use super::super::turns::forks;
use super::super::{Basis, Prepared};
use crate::style::BUILT_IN;

/// Maximum of places in a list.
const LISTED: usize = 24;
/// Maximum of forks that are listed as examples.
const LISTED_FORKS: usize = 3;

/// Values and rows by the paths of their keys.
pub(super) struct Facts {
    pub(super) values: BTreeMap<&'static str, Fact>,
    pub(super) rows: BTreeMap<&'static str, Rows>,
}

/// A value on this map.
pub(super) struct Fact {
    pub(super) value: Value,
    /// A note about it.
    pub(super) note: Option<String>,
}

/// Possible entries of a table of names, or of a list of tables, on this map.
pub(super) struct Rows {
    pub(super) note: String,
    pub(super) rows: Vec<Row>,
    /// The number of the others.
    pub(super) omitted: usize,
}

/// A line of a table, or one with keys of its own.
pub(super) enum Row {
    Entry { name: String, value: f64, what: String },
    Table { header: &'static str, keys: Vec<(&'static str, Value)> },
}

impl Facts {
    pub(super) fn of(prepared: &Prepared) -> Facts {
        let side = match prepared.world.network().driving_side {
            DrivingSide::Left => "left",
            DrivingSide::Right => "right",
        };
        let values = [
            ("map_options.driving_side", json!(side), Some("On this map:".into())),
            ("map_options.max_size_mb", json!(500.0), Some("For example:".into())),
            ("map_options.origin", origin(prepared), Some(origin_note(prepared).into())),
            (
                "demand.vehicles_per_hour",
                json!(tenths(prepared.conditions.demand_veh_h)),
                Some(demand_note(prepared)),
            ),
            (
                "demand.profile",
                json!([[0.0, 1.0], [900.0, 1.5]]),
                Some("For example, 50 % more after a quarter of an hour:".into()),
            ),
            ("replay.columns", json!("columns.toml"), Some("For example:".into())),
            ("commands", json!("out/commands.parquet"), Some("For example:".into())),
            ("model", json!("mcdm"), Some("For example:".into())),
            ("run.threads", json!(prepared.threads), Some("On this machine:".into())),
            ("run.drivers_seed", json!(1), Some("For example:".into())),
            ("run.parameter_draw", json!(0), Some("For example, the first draw:".into())),
        ];
        let rows = [
            ("demand.entrances", entrances(prepared)),
            ("demand.exits", exits(prepared)),
            ("demand.od", od(prepared)),
            ("demand.line", line(prepared)),
            ("turns", turns(prepared)),
            ("signals", signals(prepared)),
            ("external", external(prepared)),
            ("obstacle", obstacle(prepared)),
            ("styles", styles()),
        ];
        Facts {
            values: values.into_iter().map(|(path, value, note)| (path, Fact { value, note })).collect(),
            rows: rows.into_iter().collect(),
        }
    }
}

fn origin(prepared: &Prepared) -> Value {
    prepared
        .conditions
        .origin
        .map_or(json!([49.0, 8.4]), |(latitude, longitude)| json!([latitude, longitude]))
}

fn origin_note(prepared: &Prepared) -> &'static str {
    match prepared.conditions.origin {
        Some(_) => "On this map:",
        None => "Has no effect on this map: its coordinates are in metres. For example:",
    }
}

/// The default demand, and the estimated capacity.
fn demand_note(prepared: &Prepared) -> String {
    match prepared.conditions.basis {
        Basis::Estimated => format!("Default: {}:", prepared.share_of_capacity()),
        _ => "On this map:".into(),
    }
}

fn entrances(prepared: &Prepared) -> Rows {
    let row = |(place, rate): &(Place, f64)| Row::Entry {
        name: place.id().to_string(),
        value: tenths(*rate),
        what: lanes(place),
    };
    let note = if is_closed(prepared) {
        "This map is closed: trips start on its lanelets."
    } else {
        "The entrances of this map, with their default demand:"
    };
    let all = &prepared.conditions.origins;
    Rows { note: note.into(), rows: all.iter().take(LISTED).map(row).collect(), omitted: beyond(all.len()) }
}

fn exits(prepared: &Prepared) -> Rows {
    let all = prepared.world.demand().exits();
    let row = |place: &Place| Row::Entry { name: place.id().to_string(), value: 1.0, what: lanes(place) };
    let note = "The exits of this map:".into();
    Rows { note, rows: all.iter().take(LISTED).map(row).collect(), omitted: beyond(all.len()) }
}

/// As an example, the first entrance with the first exit that it has a route to.
fn od(prepared: &Prepared) -> Rows {
    let row = pair(prepared).map(|(from, to, rate)| Row::Table {
        header: "[[demand.od]]",
        keys: vec![
            ("from", json!(from.to_string())),
            ("to", json!(to.to_string())),
            ("vehicles_per_hour", json!(tenths(rate))),
        ],
    });
    Rows { note: "For example:".into(), rows: row.into_iter().collect(), omitted: 0 }
}

/// The first entrance with the first exit that it has a route to, and its demand [veh/h].
fn pair(prepared: &Prepared) -> Option<(Id, Id, f64)> {
    let world = &prepared.world;
    let exits = world.demand().exits();
    prepared.conditions.origins.iter().enumerate().find_map(|(from, (place, rate))| {
        let to = (0..exits.len()).find(|to| world.leads(from, *to))?;
        Some((place.id(), exits[to].id(), *rate))
    })
}

/// As an example, a line between the same places, with a stop on its first lanelet.
fn line(prepared: &Prepared) -> Rows {
    let network = prepared.world.network();
    let length = |id: Id| network.lanelet_with(id).map_or(0.0, |it| network.lanelets[it.at()].length());
    let has_room = |(from, ..): &(Id, Id, f64)| length(*from) >= 2.0 * Class::Bus.body().length;
    let tables = pair(prepared).filter(has_room).map(|(from, to, _)| {
        let keys = vec![
            ("name", json!("1")),
            ("from", json!(from.to_string())),
            ("to", json!(to.to_string())),
            ("every_s", json!(600.0)),
        ];
        let stop = vec![
            ("lanelet", json!(from)),
            ("position_m", json!(tenths(0.5 * length(from)))),
            ("rest_s", json!(20.0)),
        ];
        [("[[demand.line]]", keys), ("[[demand.line.stops]]", stop)]
    });
    let rows = tables.into_iter().flatten().map(|(header, keys)| Row::Table { header, keys });
    Rows { note: "For example:".into(), rows: rows.collect(), omitted: 0 }
}

/// The junctions with their default shares, by the number of lanes.
fn turns(prepared: &Prepared) -> Rows {
    if is_closed(prepared) {
        let note = "Not on this map: every lanelet is a destination. On other maps:".into();
        let keys =
            vec![("from", json!(1)), ("left", json!(1.0)), ("straight", json!(2.0)), ("right", json!(1.0))];
        return Rows { note, rows: vec![Row::Table { header: "[[turns]]", keys }], omitted: 0 };
    }
    let all = forks(prepared.world.network());
    let row = |it: &super::super::Turns| Row::Table {
        header: "[[turns]]",
        keys: vec![
            ("from", json!(it.from)),
            ("left", json!(it.left)),
            ("straight", json!(it.straight)),
            ("right", json!(it.right)),
        ],
    };
    let note = if all.is_empty() {
        "No road of this map leads to a fork.".into()
    } else {
        "For example, at forks of this map, in proportion to the number of lanes:".into()
    };
    let omitted = all.len().saturating_sub(LISTED_FORKS);
    Rows { note, rows: all.iter().take(LISTED_FORKS).map(row).collect(), omitted }
}

/// The generated programs for the lights of the map.
fn signals(prepared: &Prepared) -> Rows {
    let junctions = &prepared.world.network().junctions;
    let name = |light: &LightIndex| junctions.lights[light.at()].id;
    let rows = |plan: &SignalPlan| -> Vec<Row> {
        let program = Row::Table { header: "[[signals]]", keys: vec![("offset_s", json!(plan.offset))] };
        let phases = plan.turns.iter().map(|turn| {
            let greens = match turn.extension {
                None => vec![("green_s", json!(turn.green))],
                Some(Extension { least, gap }) => vec![
                    ("max_green_s", json!(turn.green)),
                    ("min_green_s", json!(least)),
                    ("gap_s", json!(gap)),
                ],
            };
            let lights = ("green", turn.lights.iter().map(|it| json!(name(it))).collect());
            let pauses = [("yellow_s", json!(turn.yellow)), ("all_red_s", json!(turn.all_red))];
            let keys = [lights].into_iter().chain(greens).chain(pauses).collect();
            Row::Table { header: "[[signals.phases]]", keys }
        });
        std::iter::once(program).chain(phases).collect()
    };
    let all = &junctions.made;
    let note = match all.len() {
        0 if junctions.lights.is_empty() => "This map has no traffic lights.",
        0 => "No traffic light of this map has a generated program.",
        _ => "The generated programs of the traffic lights of this map:",
    };
    Rows {
        note: note.into(),
        rows: all.iter().take(LISTED).flat_map(rows).collect(),
        omitted: beyond(all.len()),
    }
}

/// The longest lanelet on which vehicles enter.
fn longest_entrance(prepared: &Prepared) -> Option<&Lanelet> {
    let network = prepared.world.network();
    let lanelets =
        prepared.conditions.origins.iter().filter_map(|(place, _)| network.lanelet_with(place.id()));
    lanelets.map(|it| &network.lanelets[it.at()]).max_by(|a, b| a.length().total_cmp(&b.length()))
}

fn obstacle(prepared: &Prepared) -> Rows {
    let row = longest_entrance(prepared).map(|lanelet| Row::Table {
        header: "[[obstacle]]",
        keys: vec![
            ("lanelet", json!(lanelet.id)),
            ("position_m", json!(tenths(0.5 * lanelet.length()))),
            ("from_s", json!(300.0)),
            ("until_s", json!(900.0)),
        ],
    });
    Rows { note: "For example:".into(), rows: row.into_iter().collect(), omitted: 0 }
}

fn external(prepared: &Prepared) -> Rows {
    let row =
        longest_entrance(prepared).zip(prepared.conditions.styles.first()).map(|(lanelet, (style, _))| {
            Row::Table {
                header: "[[external]]",
                keys: vec![
                    ("lanelet", json!(lanelet.id)),
                    ("position_m", json!(tenths(0.5 * lanelet.length()))),
                    ("speed_mps", json!(tenths(0.5 * lanelet.speed_limit))),
                    ("style", json!(style)),
                ],
            }
        });
    Rows { note: "For example:".into(), rows: row.into_iter().collect(), omitted: 0 }
}

fn styles() -> Rows {
    let names: Vec<&str> = BUILT_IN.iter().map(|it| it.name).collect();
    let note = format!("The built-in styles are {}. List them with: laneweave styles list", names.join(", "));
    Rows { note, rows: Vec::new(), omitted: 0 }
}

/// Trips start and end along lanes.
fn is_closed(prepared: &Prepared) -> bool {
    prepared.conditions.origins.iter().all(|(place, _)| matches!(place, Place::Inside(_)))
}

fn lanes(place: &Place) -> String {
    match (place, place.chains().len()) {
        (Place::Inside(_), _) => "on the lanelet".into(),
        (Place::Gate(_) | Place::Across(_), 1) => "1 lane".into(),
        (Place::Gate(_) | Place::Across(_), count) => format!("{count} lanes"),
    }
}

fn beyond(count: usize) -> usize {
    count.saturating_sub(LISTED)
}

fn tenths(number: f64) -> f64 {
    (10.0 * number).round() / 10.0
}
