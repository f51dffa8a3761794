//! Recordings as a user names them: files, read and joined.

use std::fs::{File, read_to_string};
use std::path::{Path, PathBuf};

use laneweave_maps::Problem;
use laneweave_network::Network;
use laneweave_recordings::table::Layout;
use laneweave_recordings::{Recording, RecordingError, join, open};

use crate::fault::{Fault, FaultKind};

/// Reads a recording: CommonRoad (XML), a table of a dataset that is known, or one whose columns the TOML file
/// `columns` names.
///
/// # Errors
/// If it cannot be read, or is of none of these formats.
pub fn open_recording(path: &Path, columns: Option<&Path>) -> Result<(Recording, Vec<Problem>), Fault> {
    let layout = columns.map(layout).transpose()?;
    // The system's reason for a file that cannot be opened says more than its message.
    File::open(path).map_err(|error| Fault::refused(path, "read", &error))?;
    open(path, layout.as_ref()).map_err(|error| unreadable(path, &error))
}

/// Reads recordings, and joins them if there are several.
///
/// # Errors
/// If one cannot be read, or continues none of the others.
pub fn open_recordings(
    paths: &[PathBuf],
    columns: Option<&Path>,
) -> Result<(Recording, Vec<Problem>), Fault> {
    let (mut parts, mut problems) = (Vec::new(), Vec::new());
    for path in paths {
        let (recording, found) = open_recording(path, columns)?;
        parts.push(recording);
        problems.extend(found);
    }
    if parts.len() == 1 {
        return Ok((parts.remove(0), problems));
    }
    let joined = join(parts).map_err(|error| {
        let message = error.to_string();
        let (what, remedy) = message.rsplit_once("; ").unwrap_or((&message, "give other recordings"));
        Fault::new(
            paths.iter().map(|it| it.display().to_string()).collect::<Vec<_>>().join(", "),
            what,
            remedy,
        )
        .of_kind(FaultKind::Recording)
    })?;
    Ok((joined.recording, problems))
}

fn layout(path: &Path) -> Result<Layout, Fault> {
    let text = read_to_string(path).map_err(|error| Fault::refused(path, "read", &error))?;
    Layout::parse(&text).map_err(|error| unreadable(path, &error))
}

/// The fault of a recording that cannot be read.
pub fn unreadable(path: &Path, error: &RecordingError) -> Fault {
    let message = error.to_string();
    let (what, remedy) = message.rsplit_once("; ").unwrap_or((&message, "correct the file"));
    Fault::new(path.display(), what, remedy).of_kind(FaultKind::Recording)
}

/// A recording of another place, or in another frame, has no vehicles on lanelets.
pub fn elsewhere(recording: &Recording, network: &Network) -> Problem {
    let span = |points: &mut dyn Iterator<Item = (f64, f64)>| {
        points.fold([f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY], |it, (x, y)| {
            [it[0].min(x), it[1].max(x), it[2].min(y), it[3].max(y)]
        })
    };
    let states = recording.tracks.iter().flat_map(|it| &it.states);
    let theirs = span(&mut states.map(|it| (it.x, it.y)));
    let points = network.lanelets.iter().flat_map(|it| it.centre.points());
    let own = span(&mut points.map(|it| (it.x, it.y)));
    let text = |[west, east, south, north]: [f64; 4]| {
        format!("x {west:.0} to {east:.0} m and y {south:.0} to {north:.0} m")
    };
    Problem {
        element: "the recording".into(),
        line: None,
        what: format!(
            "most of the recording lies outside all lanelets: it covers {}, the map {}",
            text(theirs),
            text(own)
        ),
        remedy: "choose the map of its location, or give the origin of its coordinates with --origin".into(),
    }
}
