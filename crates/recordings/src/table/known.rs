//! What other files of a dataset say of the road users in a table: `01_tracksMeta.csv` and `01_recordingMeta.csv` lie
//! beside `01_tracks.csv`.

use std::collections::HashMap;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};

use laneweave_maps::Problem;

use super::header::bare;
use super::lines::Lines;
use crate::error::RecordingError;
use crate::recording::RoadUser;

/// What other files of a dataset say of the road users in a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Known {
    /// Their classes by id.
    pub classes: HashMap<i64, RoadUser>,
    /// Frames per second.
    pub frames_per_second: Option<f64>,
}

/// The end of the names of tables that have files beside them.
const TRACKS: &str = "_tracks.csv";

impl Known {
    /// What the files beside the table `path` say, and what is missing there.
    ///
    /// # Errors
    /// If such a file exists and cannot be read.
    pub fn beside(path: &Path) -> Result<(Known, Vec<Problem>), RecordingError> {
        let mut known = Known::default();
        let mut problems = Vec::new();
        match file_beside(path, "_tracksMeta.csv") {
            Some(meta) => known.read_tracks(BufReader::new(File::open(meta)?), &mut problems)?,
            None => problems.push(missing("tracksMeta", "the classes of its road users are not known")),
        }
        match file_beside(path, "_recordingMeta.csv") {
            Some(meta) => known.read_recording(BufReader::new(File::open(meta)?))?,
            None => problems.push(missing("recordingMeta", "25 frames a second are assumed")),
        }
        Ok((known, problems))
    }

    /// Reads the classes of road users.
    fn read_tracks(&mut self, file: impl BufRead, problems: &mut Vec<Problem>) -> Result<(), RecordingError> {
        let mut lines = Lines::of(file);
        let header = lines.next()?.map_or_else(Vec::new, |it| it.text.to_vec());
        let (ids, classes) = (column(&header, &["id", "trackId"])?, column(&header, &["class"])?);
        while let Some(line) = lines.next()? {
            let field = |at: usize| line.text.split(|it| *it == b',').nth(at).map(bare).unwrap_or_default();
            let id = str::from_utf8(field(ids)).ok().and_then(|it| it.parse().ok());
            let name = String::from_utf8_lossy(field(classes)).to_ascii_lowercase();
            match id.zip(class_of(&name)) {
                Some((id, class)) => _ = self.classes.insert(id, class),
                None if line.text.is_empty() => {}
                None => problems.push(Problem {
                    element: "row of tracksMeta".into(),
                    line: Some(line.number),
                    what: format!("it has no id, or its class {name:?} is unknown, so it is left out"),
                    remedy: "correct the row".into(),
                }),
            }
        }
        Ok(())
    }

    /// Reads the frame rate.
    fn read_recording(&mut self, file: impl BufRead) -> Result<(), RecordingError> {
        let mut lines = Lines::of(file);
        let header = lines.next()?.map_or_else(Vec::new, |it| it.text.to_vec());
        let rate = column(&header, &["frameRate"])?;
        let line = lines.next()?.map_or_else(Vec::new, |it| it.text.to_vec());
        let field = line.split(|it| *it == b',').nth(rate).map(bare).unwrap_or_default();
        self.frames_per_second = str::from_utf8(field).ok().and_then(|it| it.parse().ok());
        Ok(())
    }
}

/// The file beside the table `path` whose name ends like this, if it exists.
fn file_beside(path: &Path, end: &str) -> Option<PathBuf> {
    let name = path.file_name()?.to_str()?.strip_suffix(TRACKS)?;
    Some(path.with_file_name(format!("{name}{end}"))).filter(|it| it.is_file())
}

fn missing(file: &str, what: &str) -> Problem {
    Problem {
        element: "the dataset".into(),
        line: None,
        what: format!("no {file} file is beside the table, so {what}"),
        remedy: format!("put it there: beside 01{TRACKS} it is 01_{file}.csv"),
    }
}

/// The place of the first column with one of these names.
fn column(header: &[u8], names: &[&'static str]) -> Result<usize, RecordingError> {
    let header = header.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(header);
    let place =
        header.split(|it| *it == b',').position(|it| names.iter().any(|name| bare(it) == name.as_bytes()));
    place.ok_or_else(|| RecordingError::MissingColumn {
        column: names[0].to_owned(),
        found: String::from_utf8_lossy(&header[..header.len().min(200)]).into_owned(),
    })
}

/// The class with this name in lower case, in highD, inD, rounD and exiD.
fn class_of(name: &str) -> Option<RoadUser> {
    Some(match name {
        "car" | "van" => RoadUser::Car,
        "truck" | "truck_bus" => RoadUser::Truck,
        "bus" => RoadUser::Bus,
        "motorcycle" => RoadUser::Motorcycle,
        "bicycle" => RoadUser::Bicycle,
        "pedestrian" => RoadUser::Pedestrian,
        // What a truck tows moves with it, and has a track of its own.
        "trailer" | "animal" | "other" => RoadUser::Other,
        _ => return None,
    })
}
