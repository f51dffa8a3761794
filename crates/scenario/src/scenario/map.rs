//! The map of a scenario: read from its file, or built in.

use std::path::Path;

use laneweave_maps::{Map, MapError, ReadOptions, Size, lanelet2, load};
use laneweave_network::DrivingSide;

use super::{MapOptions, Origin, Scenario};
use crate::fault::{Fault, FaultKind};
use crate::sumo::with_programs;

/// Reads the map of a scenario.
///
/// # Errors
/// If it cannot be read, or has no lanelet for vehicles.
pub fn read_map(scenario: &Scenario, origin: &Origin) -> Result<Map, Fault> {
    let options = ReadOptions::from(&scenario.map_options);
    let read = match origin.map {
        Some(text) => lanelet2::read(text.as_bytes(), &options),
        None => load(&scenario.map, &options),
    };
    let map = read.map_err(|error| {
        let fault = map_fault(&error, &scenario.map, origin);
        match error {
            // The file may be a scenario or a map.
            MapError::UnknownFormat { .. } if origin.in_file(&["map"]).is_none() => {
                Fault { remedy: fault.remedy + ", scenario (.toml)", ..fault }
            }
            _ => fault,
        }
    })?;
    with_programs(map, &scenario.sumo)
}

/// Reads the map at `path`, with options of the command.
///
/// # Errors
/// If it cannot be read, or has no lanelet for vehicles.
pub fn open_map(path: &Path, options: &MapOptions) -> Result<Map, Fault> {
    let mut origin = Origin::default();
    origin.replaced("map_options.origin", "--origin");
    load(path, &ReadOptions::from(options)).map_err(|error| map_fault(&error, path, &origin))
}

impl From<&MapOptions> for ReadOptions {
    fn from(options: &MapOptions) -> ReadOptions {
        ReadOptions {
            origin: options.origin.map(|[latitude, longitude]| (latitude, longitude)),
            law: options.law.into(),
            driving_side: options.driving_side.map(DrivingSide::from),
            largest: options.max_size_mb.map_or_else(Size::default, Size::of_mb),
        }
    }
}

/// The fault of the map at `path`: for a wrong path, its place is in the scenario file; for a wrong content, in the
/// map.
fn map_fault(error: &MapError, path: &Path, origin: &Origin) -> Fault {
    let line = error.line();
    let message = error.to_string();
    let message = line.and_then(|it| message.strip_prefix(&format!("line {it}: "))).unwrap_or(&message);
    let (what, remedy) = message.rsplit_once("; ").unwrap_or((message, "correct the map"));
    let file = path.display();
    let named_at = origin.in_file(&["map"]);
    let kind = match error {
        MapError::Missing => FaultKind::NotFound,
        _ => FaultKind::Map,
    };
    let fault = match (error, line, named_at) {
        (_, Some(line), _) => Fault::new(format!("{file}:{line}"), what, remedy),
        (MapError::TooLarge { .. }, ..) => {
            let remedy = "split the map into smaller ones, or increase --max-map-size, at most 2GiB";
            Fault::new(file, what, remedy)
        }
        (MapError::Origin(..), ..) => Fault::new(origin.place(&["map_options", "origin"]), what, remedy),
        (
            MapError::Missing
            | MapError::Folder
            | MapError::UnknownFormat { .. }
            | MapError::OtherKind { .. }
            | MapError::Foreign { .. }
            | MapError::Misnamed { .. },
            _,
            Some(place),
        ) => Fault::new(place, format!("map {file}: {what}"), remedy),
        _ => Fault::new(file, what, remedy),
    };
    fault.of_kind(kind)
}

impl From<super::DrivingSide> for DrivingSide {
    fn from(side: super::DrivingSide) -> DrivingSide {
        match side {
            super::DrivingSide::Left => DrivingSide::Left,
            super::DrivingSide::Right => DrivingSide::Right,
        }
    }
}
