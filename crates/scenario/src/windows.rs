//! Windows: files with recordings of one place. Those that continue one another are one recording.

use std::path::{Path, PathBuf};

use laneweave_maps::Problem;
use laneweave_recordings::{JoinError, Recording, Series, series};

use crate::fault::Fault;
use crate::recording::open_recording;

/// A recording with the name of its file, or of its files.
pub type Named = (String, Recording);

/// The longest recording that some files hold together.
pub struct Windows {
    /// The recording.
    pub recording: Recording,
    /// Its files.
    pub files: Vec<PathBuf>,
    /// Problems in reading the files.
    pub problems: Vec<Problem>,
    /// Of several files, what was joined, what was not and why, and what is left out.
    pub notes: Vec<String>,
}

/// Reads recordings, and joins them as far as they continue one another: the longest whole counts.
///
/// # Errors
/// If one cannot be read.
pub fn open_windows(paths: &[PathBuf], columns: Option<&Path>) -> Result<Windows, Fault> {
    let (mut names, mut recordings, mut problems) = (Vec::new(), Vec::new(), Vec::new());
    for path in paths {
        let (recording, found) = open_recording(path, columns)?;
        names.push(path.display().to_string());
        recordings.push(recording);
        problems.extend(found);
    }
    let all = series(recordings);
    let mut notes = notes(&names, &all);
    let seconds = |it: &Recording| it.tracks.iter().map(|it| it.states.len()).sum::<usize>() as f64 * it.step;
    let longest = (0..all.len()).rev().max_by(|a, b| {
        let [a, b] = [a, b].map(|it| seconds(&all[*it].joined.recording));
        a.total_cmp(&b)
    });
    let others = all.iter().enumerate().filter(|it| Some(it.0) != longest);
    let others: Vec<&str> = others.flat_map(|(_, it)| own(&names, it)).collect();
    notes.extend(others.iter().map(|it| format!("{it} is left out: the others hold more")));
    let whole = longest.and_then(|it| all.into_iter().nth(it));
    let (files, recording) = whole.map_or_else(
        || (Vec::new(), Recording { step: 0.1, ..Recording::default() }),
        |it| (it.numbers.iter().map(|it| paths[it - 1].clone()).collect(), it.joined.recording),
    );
    Ok(Windows { recording, files, problems, notes })
}

/// The recordings of a site, joined as far as they continue one another, and what was joined and what was not, in
/// words.
pub fn joined(windows: Vec<Named>) -> (Vec<Named>, Vec<String>) {
    let (names, recordings): (Vec<String>, Vec<Recording>) = windows.into_iter().unzip();
    let all = series(recordings);
    let notes = notes(&names, &all);
    (all.into_iter().map(|it| (name(&own(&names, &it)), it.joined.recording)).collect(), notes)
}

/// The names of the files of a series.
fn own<'a>(names: &'a [String], it: &Series) -> Vec<&'a str> {
    it.numbers.iter().map(|number| names[number - 1].as_str()).collect()
}

/// What became of several files.
fn notes(names: &[String], all: &[Series]) -> Vec<String> {
    let of = |it: &Series| note(&own(names, it), it);
    if names.len() < 2 { Vec::new() } else { all.iter().map(of).collect() }
}

/// What became of the files of a series.
fn note(names: &[&str], it: &Series) -> String {
    match (names, &it.apart) {
        ([only], None) => format!("{only} stays by itself: none of the others continues it"),
        ([only], Some(why)) => format!("{only} stays by itself: {}", reason(why)),
        (all, None) => format!("{} are joined: {} vehicles go on", all.join(", "), it.joined.continued),
        (all, Some(why)) => format!(
            "{} are joined: {} vehicles go on; they stay apart from the first: {}",
            all.join(", "),
            it.joined.continued,
            reason(why)
        ),
    }
}

/// Why a recording continues none of the others, without its number among all.
fn reason(why: &JoinError) -> String {
    match why {
        JoinError::Elsewhere { common, agreeing, .. } => {
            format!("of {common} vehicles with the same ids {agreeing} are where they would be")
        }
        JoinError::Step { found, expected, .. } => {
            format!("its frames are {found} s apart, those of the first {expected} s")
        }
        JoinError::Nothing => "there is no other".into(),
    }
}

/// A short name of files.
fn name(names: &[&str]) -> String {
    match names {
        [first, rest @ ..] if rest.len() > 1 => format!("{first} and {} more", rest.len()),
        all => all.join(" and "),
    }
}

#[cfg(test)]
mod tests {
    use laneweave_recordings::{RoadUser, State, Track};

    use super::*;

    /// Two cars at 20 m/s from one frame to another, of a tenth of a second.
    fn window(from: i64, to: i64, y: f64) -> Recording {
        let track = |id: i64| {
            let state = |frame: i64| {
                let x = 2.0 * frame as f64 - 50.0 * id as f64;
                State { frame, x, y, speed: 20.0, heading: 0.0 }
            };
            let states = (from..=to).map(state).collect();
            Track { id, class: RoadUser::Car, length: 4.5, width: 1.8, states }
        };
        Recording { step: 0.1, tracks: vec![track(1), track(2)], ..Recording::default() }
    }

    #[test]
    fn windows_that_continue_one_another_are_one_and_a_bad_one_spoils_nothing_else() {
        let windows = [("a", 0, 50, 0.0), ("bad", 51, 100, 30.0), ("b", 51, 100, 0.0)];
        let windows = windows.map(|(name, from, to, y)| (name.to_owned(), window(from, to, y)));
        let (all, notes) = joined(windows.to_vec());
        let names: Vec<&str> = all.iter().map(|it| it.0.as_str()).collect();
        assert_eq!(names, ["a and b", "bad"]);
        assert_eq!(all[0].1.frames(), Some((0, 100)));
        assert_eq!(
            notes,
            [
                "a, b are joined: 2 vehicles go on",
                "bad stays by itself: of 2 vehicles with the same ids 0 are where they would be",
            ]
        );
        assert_eq!(joined(windows[..1].to_vec()).1, Vec::<String>::new());
    }
}
