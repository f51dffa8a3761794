//! What a table, or a file beside it, says that is not used, although it would change what is read.

use std::path::Path;

use laneweave_maps::Problem;

use super::known::TRACKS;
use super::layout::{Field, Layout};
use super::rows::Fields;

/// Names that columns of a field have in many tables, in lower case; without those of which a layout must name one.
const USUAL: [(Field, &[&str]); 7] = [
    (Field::Class, &["class", "type", "agent_type", "v_class", "vehicle_type", "category"]),
    (Field::Vx, &["vx", "v_x", "xvelocity", "vel_x", "speed_x"]),
    (Field::Vy, &["vy", "v_y", "yvelocity", "vel_y", "speed_y"]),
    (Field::Speed, &["speed", "v", "velocity", "v_vel"]),
    (Field::Heading, &["heading", "psi_rad", "yaw", "psi", "theta", "orientation"]),
    (Field::Length, &["length", "v_length"]),
    (Field::Width, &["width", "v_width"]),
];
/// Names of columns that tell recordings apart.
const RECORDINGS: [&str; 6] =
    ["case_id", "recordingid", "recording_id", "location", "scenario_id", "sequence_id"];

/// A problem that names the columns of a table with the header `first` that a `layout` does not name, although it has
/// no other column for what they hold.
pub(super) fn columns(first: &Fields, layout: &Layout) -> Option<Problem> {
    let names: Vec<String> = first.iter().map(|it| String::from_utf8_lossy(it).into_owned()).collect();
    let columns = &layout.columns;
    let named: Vec<&str> = Field::ALL.into_iter().filter_map(|it| columns.name(it)).collect();
    let has_speeds = columns.speed.is_some() || columns.vx.is_some();
    let is_known = |field: &Field| {
        let is_speed = matches!(field, Field::Vx | Field::Vy | Field::Speed);
        columns.name(*field).is_some() || (is_speed && has_speeds)
    };
    let would_change = |name: &str| {
        let name = name.to_ascii_lowercase();
        USUAL.iter().any(|(field, names)| !is_known(field) && names.contains(&name.as_str()))
            || (layout.same.is_none() && RECORDINGS.contains(&name.as_str()))
    };
    let found = names.iter().filter(|it| !named.contains(&it.as_str()) && would_change(it));
    let found: Vec<&str> = found.map(String::as_str).collect();
    (!found.is_empty()).then(|| Problem {
        element: "the header".into(),
        line: Some(first.line),
        what: format!("its columns {} are not used", found.join(", ")),
        remedy: "name them in the file for --columns, or leave them out of the table".into(),
    })
}

/// A problem that names a file beside the table `path` that belongs to it and is not read: those of a dataset where the
/// user says what the columns hold, and INTERACTION's pedestrians, which have a table of their own.
pub(crate) fn file_beside(path: &Path, has_layout: bool) -> Option<Problem> {
    let name = path.file_name()?.to_str()?;
    let meta = || name.strip_suffix(TRACKS).map(|it| format!("{it}_tracksMeta.csv")).filter(|_| has_layout);
    let walkers = || name.strip_prefix("vehicle_tracks").map(|it| format!("pedestrian_tracks{it}"));
    let other = meta().or_else(walkers).filter(|it| path.with_file_name(it).is_file())?;
    Some(Problem {
        element: "the dataset".into(),
        line: None,
        what: format!("{other} lies beside the table and is not read"),
        remedy: if has_layout {
            "leave out --columns if the table is one of a dataset that is known".into()
        } else {
            "give it as well if its road users are wanted".into()
        },
    })
}
