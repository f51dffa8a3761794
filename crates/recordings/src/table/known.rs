//! What other files of a dataset say of the road users in a table: `01_tracksMeta.csv` and `01_recordingMeta.csv` lie
//! beside `01_tracks.csv`.

use std::collections::HashMap;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};

use laneweave_maps::Problem;

use super::dialect::{Commas, Dialect};
use super::id::Id;
use super::rows::{Fields, Rows};
use crate::error::RecordingError;
use crate::recording::RoadUser;

/// What other files of a dataset say of the road users in a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Known {
    /// Their classes by id.
    pub classes: HashMap<Id, RoadUser>,
    /// Frames per second.
    pub frames_per_second: Option<f64>,
    /// East and north of the origin of its positions in the UTM zone of the place [m].
    pub utm_origin: Option<[f64; 2]>,
}

/// The end of the names of tables that have files beside them.
pub(super) const TRACKS: &str = "_tracks.csv";

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
        let mut meta = Meta::of(file)?;
        let (ids, classes) = (meta.column(&["id", "trackId"])?, meta.column(&["class"])?);
        while let Some(row) = meta.rows.next()? {
            let id = Id::of(row.get(ids));
            let name = String::from_utf8_lossy(row.get(classes)).to_ascii_lowercase();
            match id.zip(class_of(&name)) {
                Some((id, class)) => _ = self.classes.insert(id, class),
                None => problems.push(Problem {
                    element: "row of tracksMeta".into(),
                    line: Some(row.line),
                    what: format!("it has no id, or its class {name:?} is unknown, so it is left out"),
                    remedy: "correct the row".into(),
                }),
            }
        }
        Ok(())
    }

    /// Reads the frame rate, and where the origin of positions is.
    fn read_recording(&mut self, file: impl BufRead) -> Result<(), RecordingError> {
        let mut meta = Meta::of(file)?;
        let rate = meta.column(&["frameRate"])?;
        let origin = ["xUtmOrigin", "yUtmOrigin"].map(|it| meta.column(&[it]).ok());
        let commas = meta.commas;
        let Some(row) = meta.rows.next()? else { return Ok(()) };
        let number = |at| commas.number(row.get(at)).filter(|it| it.is_finite());
        self.utm_origin = match origin.map(|it| it.and_then(number)) {
            [Some(x), Some(y)] => Some([x, y]),
            _ => None,
        };
        self.frames_per_second = number(rate);
        Ok(())
    }
}

/// A file beside a table: a header and rows.
struct Meta<R> {
    names: Vec<String>,
    commas: Commas,
    rows: Rows<R>,
}

impl<R: BufRead> Meta<R> {
    fn of(mut file: R) -> Result<Meta<R>, RecordingError> {
        let dialect = Dialect::of(file.fill_buf()?);
        let mut rows = Rows::of(file, dialect);
        let text = |it: &[u8]| String::from_utf8_lossy(it).into_owned();
        let names = rows.next()?.map_or_else(Vec::new, |it: Fields| it.iter().map(text).collect());
        Ok(Meta { names, commas: dialect.commas, rows })
    }

    /// The place of the first column with one of these names.
    fn column(&self, names: &[&'static str]) -> Result<usize, RecordingError> {
        let place = self.names.iter().position(|it| names.contains(&it.as_str()));
        place.ok_or_else(|| RecordingError::MissingColumn {
            column: names[0].to_owned(),
            found: self.names.join(",").chars().take(200).collect(),
        })
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
