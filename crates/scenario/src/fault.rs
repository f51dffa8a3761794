//! Faults: what is wrong with the user's input, where, and what to do about it.

use std::fmt;
use std::io;
use std::path::Path;

use laneweave_study::TableError;

/// What kind of mistake a fault is. A program may treat kinds differently; a binding makes them exceptions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FaultKind {
    /// A file, or something with this name, does not exist.
    NotFound,
    /// A text is not in its format.
    Syntax,
    /// A value is not allowed, or does not fit the others.
    Value,
    /// A map cannot be used.
    Map,
    /// A recording cannot be used.
    Recording,
    /// A style cannot be used.
    Style,
    /// A command to the traffic is not possible.
    Command,
    /// Not possible in the present state, such as going back in time.
    State,
    /// The system refuses to read or write a file.
    File,
    /// Standard output cannot be written.
    Output,
    /// Nothing reads standard output any more.
    Closed,
    /// A mistake of this program.
    Internal,
}

/// A mistake in the input, with its place and its remedy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Its kind.
    pub kind: FaultKind,
    /// Where: `FILE:LINE:COLUMN`, a file, or an option of the command.
    pub place: String,
    /// The problem.
    pub what: String,
    /// What the user can do about it.
    pub remedy: String,
}

impl Fault {
    /// The fault `what` at `place`, with its `remedy`: a value that is not allowed, unless it is said to be of another
    /// kind.
    pub fn new(place: impl fmt::Display, what: impl fmt::Display, remedy: impl fmt::Display) -> Fault {
        Fault {
            kind: FaultKind::Value,
            place: place.to_string(),
            what: what.to_string(),
            remedy: remedy.to_string(),
        }
    }

    /// The same fault, of another kind.
    #[must_use]
    pub fn of_kind(self, kind: FaultKind) -> Fault {
        Fault { kind, ..self }
    }

    /// A mistake of this program at `place`.
    pub fn bug(place: impl fmt::Display, what: impl fmt::Display) -> Fault {
        Fault::new(place, what, "report this as a bug").of_kind(FaultKind::Internal)
    }

    /// Standard output cannot be written.
    pub fn output(error: &io::Error) -> Fault {
        let kind = match error.kind() {
            io::ErrorKind::BrokenPipe => FaultKind::Closed,
            _ => FaultKind::Output,
        };
        let what = format!("cannot be written: {}", plain(error));
        Fault::new("standard output", what, "free some space there, or redirect the output").of_kind(kind)
    }

    /// The system refuses to `deed` the file at `path`.
    pub fn refused(path: &Path, deed: &str, error: &io::Error) -> Fault {
        let remedy = match error.kind() {
            io::ErrorKind::NotFound => "check the path",
            io::ErrorKind::PermissionDenied => "check the permissions, or choose another place",
            io::ErrorKind::AlreadyExists => "choose another name, or delete it first",
            io::ErrorKind::IsADirectory => "give a file, not a folder",
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded | io::ErrorKind::FileTooLarge => {
                "make room for it, or choose another place"
            }
            io::ErrorKind::InvalidData => "give a text file in UTF-8",
            _ => "choose another place",
        };
        let kind = match error.kind() {
            io::ErrorKind::NotFound => FaultKind::NotFound,
            _ => FaultKind::File,
        };
        Fault::new(path.display(), format!("cannot be {deed}: {}", plain(error)), remedy).of_kind(kind)
    }
}

/// The system's message without its error number.
fn plain(error: &io::Error) -> String {
    let text = error.to_string();
    text.split(" (os error").next().unwrap_or(&text).to_lowercase()
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}; {}", self.place, self.what, self.remedy)
    }
}

impl std::error::Error for Fault {}

impl From<TableError> for Fault {
    fn from(error: TableError) -> Fault {
        match &error {
            TableError::Create { path, source } => Fault::refused(path, "created", source),
            TableError::Write { path, source } => Fault::refused(path, "written", source),
            TableError::Width { path, .. } | TableError::Cell { path, .. } => {
                Fault::bug(path.display(), &error)
            }
        }
    }
}

/// A remedy for an unknown name: the most similar known name, or else all of them, if there are not too many.
pub fn did_you_mean<'a>(unknown: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    /// Names with less similarity than this are not suggested.
    const ALIKE: f64 = 0.5;
    /// Maximum of names in a list.
    const LISTED: usize = 30;
    let known: Vec<&str> = known.into_iter().collect();
    let likeness = |name: &&str| strsim::normalized_damerau_levenshtein(unknown, name);
    let nearest = known.iter().copied().max_by(|a, b| likeness(a).total_cmp(&likeness(b)));
    match nearest {
        Some(name) if likeness(&name) >= ALIKE => format!("did you mean {name:?}?"),
        Some(_) if known.len() > LISTED => {
            format!("known are {} and {} more", known[..LISTED].join(", "), known.len() - LISTED)
        }
        Some(_) => format!("known are {}", known.join(", ")),
        None => "leave it out".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_reads_as_place_what_and_remedy() {
        let fault = Fault::new("a.toml:3:1", "unknown key \"sed\"", "did you mean \"seed\"?");
        assert_eq!(fault.to_string(), "a.toml:3:1: unknown key \"sed\"; did you mean \"seed\"?");
    }

    #[test]
    fn the_nearest_name_is_offered_or_else_all() {
        let known = ["duration_s", "step_s", "seed"];
        assert_eq!(did_you_mean("duraton_s", known), "did you mean \"duration_s\"?");
        assert_eq!(did_you_mean("qqqq", known), "known are duration_s, step_s, seed");
        assert_eq!(did_you_mean("qqqq", []), "leave it out");
    }
}
