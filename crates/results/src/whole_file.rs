//! Files that are complete or not there.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use laneweave_scenario::Fault;
use laneweave_study::PartialFile;
use serde::Serialize;

/// Writes a file that is complete or not there at all.
///
/// # Errors
/// If it cannot be written.
pub fn write_whole(path: &Path, content: &(impl AsRef<[u8]> + ?Sized)) -> Result<(), Fault> {
    let write = || -> io::Result<()> {
        let (partial, mut file) = PartialFile::create(path)?;
        file.write_all(content.as_ref())?;
        partial.complete()
    };
    write().map_err(|error| Fault::refused(path, "written", &error))
}

/// Data as JSON, to be read by people, too.
///
/// # Errors
/// If it cannot be written so, which is a mistake of laneweave.
pub fn json(data: &impl Serialize) -> Result<String, Fault> {
    let text = serde_json::to_string_pretty(data);
    text.map(|it| it + "\n").map_err(|error| Fault::bug("JSON", error))
}

/// The files, if all were written; otherwise the first fault, at the places of all that are missing. One that cannot
/// be written keeps no other from being whole.
///
/// # Errors
/// If one was not written.
pub fn all_whole(
    written: impl IntoIterator<Item = Result<Vec<PathBuf>, Fault>>,
) -> Result<Vec<PathBuf>, Fault> {
    let (mut files, mut missing) = (Vec::new(), None::<Fault>);
    for it in written {
        match (it, &mut missing) {
            (Ok(more), _) => files.extend(more),
            (Err(fault), None) => missing = Some(fault),
            (Err(fault), Some(first)) if first.place.split(", ").any(|it| it == fault.place) => {}
            (Err(fault), Some(first)) => first.place += &format!(", {}", fault.place),
        }
    }
    missing.map_or(Ok(files), Err)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_that_is_missing_is_named_once() {
        let fault = |place: &str| Err(Fault::new(place, "no room", "make room"));
        let written = |name: &str| Ok(vec![PathBuf::from(name)]);
        let named = all_whole([written("a"), fault("b"), fault("c"), written("d"), fault("b")]);
        assert_eq!(named.map_err(|it| it.to_string()), Err("b, c: no room; make room".to_owned()));
        assert_eq!(all_whole([written("a"), written("b")]).map(|it| it.len()).ok(), Some(2));
    }
}
