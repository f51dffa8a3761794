//! Real maps and recordings, which are not in the repository.

use std::ffi::OsStr;
use std::fs::OpenOptions;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Where they are unless `LANEWEAVE_DATA` says otherwise.
const BESIDE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data");

/// A file or folder of the real data, such as `lanelet2/karlsruhe.osm`. None if this machine has none of them: then the
/// test says that it skipped it.
///
/// # Panics
///
/// If the data should be there, and are not.
#[track_caller]
pub fn data(file: &str) -> Option<PathBuf> {
    let named = std::env::var_os("LANEWEAVE_DATA").filter(|it| !it.is_empty());
    let is_ci = std::env::var_os("CI").is_some_and(|it| it == "true");
    match find(named.as_deref(), Path::new(BESIDE), file, is_ci) {
        Ok(Found::There(path)) => Some(path),
        Ok(Found::Skipped(why)) => {
            say_skipped(file, &why);
            None
        }
        Err(what) => panic!("{what}"),
    }
}

#[derive(Debug, PartialEq)]
enum Found {
    There(PathBuf),
    /// It is not there, and need not be; why.
    Skipped(String),
}

/// Looks for a file in the folder that is `named`, or else in the one `beside`. The error is that it should be there.
fn find(named: Option<&OsStr>, beside: &Path, file: &str, is_ci: bool) -> Result<Found, String> {
    if named.is_some_and(|it| it == "none") {
        return Ok(Found::Skipped("LANEWEAVE_DATA is none".into()));
    }
    let folder = named.map_or(beside, Path::new);
    if !folder.is_dir() {
        let what = format!("{} is not a folder", folder.display());
        let remedy = "set LANEWEAVE_DATA to the folder of the data, or to none";
        return if named.is_some() || is_ci {
            Err(format!("{what}; {remedy}"))
        } else {
            Ok(Found::Skipped(what))
        };
    }
    let path = folder.join(file);
    if path.exists() { Ok(Found::There(path)) } else { Err(format!("{} is missing", path.display())) }
}

/// Says it past the test framework, which shows nothing of tests that pass, and in the file `LANEWEAVE_SKIPPED`.
fn say_skipped(file: &str, why: &str) {
    let thread = std::thread::current();
    let package = std::env::var("CARGO_PKG_NAME").unwrap_or_default();
    let line = format!("{package} {}: {file}\n", thread.name().unwrap_or("a test"));
    let _ = std::io::stderr().write_all(format!("skipped ({why}): {line}").as_bytes());
    if let Some(list) = std::env::var_os("LANEWEAVE_SKIPPED").filter(|it| !it.is_empty()) {
        let list = OpenOptions::new().create(true).append(true).open(list);
        list.and_then(|mut it| it.write_all(line.as_bytes())).expect("LANEWEAVE_SKIPPED names a file");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HERE: &str = env!("CARGO_MANIFEST_DIR");

    fn found(named: Option<&str>, beside: &str, file: &str, is_ci: bool) -> Result<Found, String> {
        find(named.map(OsStr::new), Path::new(beside), file, is_ci)
    }

    #[test]
    fn a_file_is_found_in_the_folder_that_is_named_or_else_in_the_one_beside() {
        let there = Ok(Found::There(Path::new(HERE).join("src/lib.rs")));
        assert_eq!(found(Some(HERE), "/nowhere", "src/lib.rs", true), there);
        assert_eq!(found(None, HERE, "src/lib.rs", false), there);
    }

    #[test]
    fn where_there_is_no_folder_only_a_machine_of_somebody_who_has_named_none_skips() {
        let skipped = found(None, "/nowhere", "a.osm", false);
        assert_eq!(skipped, Ok(Found::Skipped("/nowhere is not a folder".into())));
        let remedy = "set LANEWEAVE_DATA to the folder of the data, or to none";
        let refused = Err(format!("/nowhere is not a folder; {remedy}"));
        assert_eq!(found(None, "/nowhere", "a.osm", true), refused);
        for is_ci in [false, true] {
            assert_eq!(found(Some("/nowhere"), HERE, "a.osm", is_ci), refused);
        }
    }

    #[test]
    fn who_wants_no_data_skips_wherever_there_are_some() {
        for is_ci in [false, true] {
            let skipped = found(Some("none"), HERE, "src/lib.rs", is_ci);
            assert_eq!(skipped, Ok(Found::Skipped("LANEWEAVE_DATA is none".into())));
        }
    }

    #[test]
    fn a_file_that_a_folder_lacks_is_missing() {
        let missing = Err(format!("{HERE}/a.osm is missing"));
        assert_eq!(found(Some(HERE), "/nowhere", "a.osm", false), missing);
        assert_eq!(found(None, HERE, "a.osm", false), missing);
    }
}
