//! What was run, kept with its results so that it can be run again: to be explained, to go on, or to go otherwise.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Component, Path, PathBuf};

use serde::Deserialize;
use xxhash_rust::xxh3::Xxh3;

use crate::fault::Fault;
use crate::output::write_whole;
use crate::scenario::{Origin, Output, Scenario};
use crate::source::Source;
use crate::style::{built_in, find};

/// The scenario among the results.
pub const SCENARIO: &str = "scenario.toml";
/// The folder of its style files, and the map that came with the program.
const STYLES: &str = "styles";
const MAP: &str = "map.osm";

/// A run that has left its results.
#[derive(Clone, Debug)]
pub struct Record {
    /// What was run.
    pub scenario: Scenario,
    /// Where its values came from.
    pub origin: Origin,
    /// What is known of its end.
    pub end: End,
}

/// What the summary of a run says of its end.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct End {
    /// Hash of all vehicles.
    pub state_hash: String,
    /// Hash of all that the run depended on.
    pub fingerprint: String,
    /// Simulated and measured time [s].
    pub duration_s: f64,
    /// Simulated time before [s].
    pub warmup_s: f64,
}

/// Writes `scenario` into the folder of its results, `dir`, with its style files and the `command` that gave it: run from there it is
/// the same. Returns the text that was written.
///
/// # Errors
/// If a file cannot be read or written.
pub fn keep(scenario: &Scenario, origin: &Origin, dir: &Path, command: &str) -> Result<String, Fault> {
    let styles = keep_styles(scenario, origin, dir)?;
    let map = match origin.built_in_map() {
        Some(text) => {
            write_whole(&dir.join(MAP), text)?;
            PathBuf::from(MAP)
        }
        None => relative(&scenario.map, dir)?,
    };
    let kept = Scenario { map, styles, ..scenario.clone() };
    let toml = toml::to_string(&kept).map_err(|error| Fault::new(SCENARIO, error, "report this as a bug"))?;
    let text = format!("# {command}\n\n{toml}");
    write_whole(&dir.join(SCENARIO), &text)?;
    Ok(text)
}

/// The styles of `scenario`, whose files are copied.
fn keep_styles(scenario: &Scenario, origin: &Origin, dir: &Path) -> Result<BTreeMap<String, f64>, Fault> {
    let mut kept = BTreeMap::new();
    for (name, weight) in &scenario.styles {
        if built_in(name).is_some() {
            kept.insert(name.clone(), *weight);
            continue;
        }
        let folder = dir.join(STYLES);
        fs::create_dir_all(&folder).map_err(|error| Fault::refused(&folder, "made", &error))?;
        let Source { path, text } = find(name, origin.style_folder(), || name.clone())?;
        let stem = path.file_stem().map_or_else(String::new, |it| it.to_string_lossy().into_owned());
        let names = (1..).map(|number| match number {
            1 => format!("{STYLES}/{stem}.toml"),
            _ => format!("{STYLES}/{stem}-{number}.toml"),
        });
        let free = names.into_iter().find(|it| !kept.contains_key(it)).unwrap_or_default();
        write_whole(&dir.join(&free), &text)?;
        kept.insert(free, *weight);
    }
    Ok(kept)
}

/// The path to `file` from `dir` on.
fn relative(file: &Path, dir: &Path) -> Result<PathBuf, Fault> {
    let whole = |path: &Path| fs::canonicalize(path).map_err(|error| Fault::refused(path, "found", &error));
    let [file, dir] = [whole(file)?, whole(dir)?];
    let shared = file.components().zip(dir.components()).take_while(|(a, b)| a == b).count();
    // On another drive there is no way from one to the other.
    if shared == 0 {
        return Ok(file);
    }
    let up = dir.components().skip(shared).map(|_| Component::ParentDir);
    Ok(up.chain(file.components().skip(shared)).collect())
}

/// Hash of all that a run depends on: the program's version, the scenario but for its output and threads, the styles, the map.
///
/// # Errors
/// If the map or a style file cannot be read.
pub fn fingerprint(scenario: &Scenario, origin: &Origin) -> Result<String, Fault> {
    let mut hash = Xxh3::new();
    hash.update(env!("CARGO_PKG_VERSION").as_bytes());
    let mut bare = Scenario { map: PathBuf::new(), styles: BTreeMap::new(), ..scenario.clone() };
    bare.output = Output::default();
    bare.run.threads = None;
    let toml = toml::to_string(&bare).map_err(|error| Fault::new(SCENARIO, error, "report this as a bug"))?;
    hash.update(toml.as_bytes());
    let mut styles = Vec::new();
    for (name, weight) in &scenario.styles {
        styles.push((find(name, origin.style_folder(), || name.clone())?.text, weight.to_bits()));
    }
    // The names of the files do not matter.
    styles.sort();
    for (text, weight) in styles {
        hash.update(text.as_bytes());
        hash.update(&weight.to_le_bytes());
    }
    match origin.built_in_map() {
        Some(text) => hash.update(text.as_bytes()),
        None => {
            let map = &scenario.map;
            hash.update(&fs::read(map).map_err(|error| Fault::refused(map, "read", &error))?);
        }
    }
    Ok(format!("{:016x}", hash.digest()))
}

impl Record {
    /// The run that left its results in `dir`.
    ///
    /// # Errors
    /// If there are none, or what the run depended on has changed since.
    pub fn open(dir: &Path) -> Result<Record, Fault> {
        let remedy = "name the folder of results of a run, that of --out";
        let summary = dir.join("summary.json");
        let text = fs::read_to_string(&summary).map_err(|error| {
            let what = format!("no results of a run: summary.json cannot be read: {error}");
            Fault::new(dir.display(), what, remedy)
        })?;
        let end: End = serde_json::from_str(&text).map_err(|error| {
            Fault::new(summary.display(), format!("no summary of a run of this version: {error}"), remedy)
        })?;
        let (scenario, origin) = Origin::open(&dir.join(SCENARIO))?;
        let record = Record { scenario, origin, end };
        if fingerprint(&record.scenario, &record.origin)? != record.end.fingerprint {
            let what = format!(
                "the map {}, a style, the scenario or the program has changed since this was run",
                record.scenario.map.display()
            );
            return Err(Fault::new(dir.display(), what, "run it again"));
        }
        Ok(record)
    }
}
