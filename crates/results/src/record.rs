//! The record of a run, stored with its results, so that it can be repeated: to explain it, to resume it, or to
//! change it.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};

use laneweave_scenario::scenario::{Origin, Output, Replay, Scenario};
use laneweave_scenario::style::built_in;
use laneweave_scenario::{Fault, Source};
use laneweave_study::Format;
use serde::Deserialize;
use xxhash_rust::xxh3::{Xxh3, xxh3_64};

use crate::checkpoint;
use crate::folder::{BRANCH, COMMANDS, Claim, RESULTS};
use crate::whole_file::write_whole;

/// The name of the summary in the results.
pub const SUMMARY: &str = "summary.json";
/// The name of the scenario in them.
pub const SCENARIO: &str = "scenario.toml";
/// The folder of its style files, and the name of a built-in map, without its extension.
const STYLES: &str = "styles";
const MAP: &str = "map";
/// The line below the command: it distinguishes the scenario of a run from one that a user has written.
const MARK: &str = "# What ran, with all defaults and options: kept with its results, and replaced by the next run into this folder.";

/// A run with stored results.
#[derive(Clone, Debug)]
pub struct Record {
    /// The run. Its commands are those of its own table, whoever gave them.
    pub scenario: Scenario,
    /// The source of its values.
    pub origin: Origin,
    /// What is known of its end.
    pub end: End,
}

/// The end of a run, from its summary.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct End {
    /// Hash of all vehicles.
    pub state_hash: String,
    /// Hash of everything on which the run depended.
    pub fingerprint: String,
    /// Simulated and measured time [s].
    pub duration_s: f64,
    /// Simulated time before it [s].
    pub warmup_s: f64,
}

/// Prepares the claimed folder for another run: removes the results of a former run, and nothing else.
///
/// # Errors
/// If the folder has a scenario that comes from no run and that this run would replace, or if something cannot be
/// removed.
pub fn clear(claim: &Claim) -> Result<(), Fault> {
    let path = claim.dir().join(SCENARIO);
    let former = match fs::read(&path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            return claim.clear(&[SUMMARY]).and_then(|()| claim.clear(&checkpoint::FILES));
        }
        read => read.map_err(|error| Fault::refused(&path, "read", &error))?,
    };
    if former.split(|it| *it == b'\n').nth(1) != Some(MARK.as_bytes()) {
        let what = "this scenario was not written by a run; the results of this run would replace it";
        return Err(Fault::new(path.display(), what, "choose another results folder with --out"));
    }
    let branch = claim.dir().join(BRANCH);
    if branch.is_dir() {
        Claim::on(&branch)?.clear_differences()?;
        // Other files stay, and the folder with them.
        let _ = fs::remove_dir(&branch);
    }
    claim.clear(RESULTS)?;
    claim.clear(&[SCENARIO])
}

/// Checks that the results of `scenario` would not replace its commands.
///
/// # Errors
/// If they would.
pub fn spare_commands(scenario: &Scenario) -> Result<(), Fault> {
    let Some(path) = &scenario.commands else { return Ok(()) };
    let whole = |path: &Path| fs::canonicalize(path).ok();
    let is_result =
        |name: &str| whole(&scenario.output.dir.join(name)).is_some_and(|it| Some(it) == whole(path));
    if RESULTS.iter().any(|it| is_result(it)) {
        let what = "the results of this run would replace these commands";
        return Err(Fault::new(path.display(), what, "choose another results folder with --out"));
    }
    Ok(())
}

/// Writes `scenario` into the folder of its results, `dir`, with its style files and its `command`; a run of this
/// file is the same. Returns the written text.
///
/// # Errors
/// If a file cannot be read or written.
pub fn keep(scenario: &Scenario, origin: &Origin, dir: &Path, command: &str) -> Result<String, Fault> {
    let styles = keep_styles(scenario, origin, dir)?;
    let map = match origin.built_in_map() {
        Some(text) => PathBuf::from(keep_text(dir, [MAP, "osm"], text, |_| false)?),
        None => relative(&scenario.map, dir)?,
    };
    let commands = scenario.commands.as_ref().map(|it| relative(it, dir)).transpose()?;
    let mut kept = Scenario { map, styles, commands, ..scenario.clone() };
    for file in files_mut(&mut kept) {
        *file = relative(file, dir)?;
    }
    let toml = toml::to_string(&kept).map_err(|error| Fault::bug(SCENARIO, error))?;
    let text = format!("# {command}\n{MARK}\n\n{toml}");
    write_whole(&dir.join(SCENARIO), &text)?;
    Ok(text)
}

/// The files of the recording that `scenario` replays, if it does, and those of SUMO's vehicles.
fn files_mut(scenario: &mut Scenario) -> impl Iterator<Item = &mut PathBuf> {
    let is_asked = scenario.replay.is_asked();
    let Replay { recording, columns, .. } = &mut scenario.replay;
    recording.iter_mut().chain(columns).filter(move |_| is_asked).chain(scenario.sumo.files_mut())
}

/// The styles of `scenario` with copies of their files.
fn keep_styles(scenario: &Scenario, origin: &Origin, dir: &Path) -> Result<BTreeMap<String, f64>, Fault> {
    let mut kept = BTreeMap::new();
    for (name, weight) in &scenario.styles {
        let Source { path, text } = origin.style(name)?;
        if built_in(name).is_some_and(|it| it.text == text) {
            kept.insert(name.clone(), *weight);
            continue;
        }
        let folder = dir.join(STYLES);
        fs::create_dir_all(&folder).map_err(|error| Fault::refused(&folder, "made", &error))?;
        let stem = path.file_stem().map_or_else(String::new, |it| it.to_string_lossy().into_owned());
        let key = |name: &str| format!("{STYLES}/{name}");
        let name = keep_text(&folder, [&stem, "toml"], &text, |it| kept.contains_key(&key(it)))?;
        kept.insert(key(&name), *weight);
    }
    Ok(kept)
}

/// Stores `text` in a file of `folder`, and returns its name: `STEM.EXTENSION`, or `STEM-2.EXTENSION` and so on if
/// that name is taken by another text, which stays.
fn keep_text(
    folder: &Path,
    [stem, extension]: [&str; 2],
    text: &str,
    is_taken: impl Fn(&str) -> bool,
) -> Result<String, Fault> {
    let mut number = 1;
    loop {
        let name = match number {
            1 => format!("{stem}.{extension}"),
            _ => format!("{stem}-{number}.{extension}"),
        };
        number += 1;
        if is_taken(&name) {
            continue;
        }
        let path = folder.join(&name);
        match fs::read(&path) {
            Ok(there) if there == text.as_bytes() => return Ok(name),
            Ok(_) => {}
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                write_whole(&path, text)?;
                return Ok(name);
            }
            Err(error) => return Err(Fault::refused(&path, "read", &error)),
        }
    }
}

/// The relative path to `file` from `dir`.
fn relative(file: &Path, dir: &Path) -> Result<PathBuf, Fault> {
    let whole = |path: &Path| fs::canonicalize(path).map_err(|error| Fault::refused(path, "found", &error));
    let [file, dir] = [whole(file)?, whole(dir)?];
    let shared = file.components().zip(dir.components()).take_while(|(a, b)| a == b).count();
    // There is no relative path to another drive.
    if shared == 0 {
        return Ok(file);
    }
    let up = dir.components().skip(shared).map(|_| Component::ParentDir);
    Ok(up.chain(file.components().skip(shared)).collect())
}

/// The summary as JSON of the run with its results in `dir`, if that run is complete.
///
/// # Errors
/// If the file cannot be read, or is no summary.
pub fn ended(dir: &Path) -> Result<Option<String>, Fault> {
    let summary = dir.join(SUMMARY);
    let text = match fs::read_to_string(&summary) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        read => read.map_err(|error| Fault::refused(&summary, "read", &error))?,
    };
    let value: serde_json::Value = serde_json::from_str(&text)
        .map_err(|error| Fault::new(summary.display(), error, "delete it, and resume again"))?;
    Ok((value["interrupted"] == false).then_some(text))
}

/// Hash of everything on which a run depends: the program's version, the scenario without its output, its threads and
/// its size limit of the map, the commands, the recording that it replays, the styles, the map.
///
/// # Errors
/// If the map, the commands or a style file cannot be read.
pub fn fingerprint(scenario: &Scenario, origin: &Origin) -> Result<String, Fault> {
    Fingerprints::default().of(scenario, origin)
}

/// Fingerprints of many scenarios: each file is read once.
#[derive(Debug, Default)]
pub struct Fingerprints {
    /// The hash of each file that was read.
    pub files: BTreeMap<PathBuf, u64>,
}

impl Fingerprints {
    /// The [`fingerprint`] of a scenario.
    ///
    /// # Errors
    /// If the map, the commands or a style file cannot be read.
    pub fn of(&mut self, scenario: &Scenario, origin: &Origin) -> Result<String, Fault> {
        let mut hash = Xxh3::new();
        hash.update(env!("CARGO_PKG_VERSION").as_bytes());
        let mut bare = Scenario { map: PathBuf::new(), styles: BTreeMap::new(), ..scenario.clone() };
        bare.commands = None;
        files_mut(&mut bare).for_each(|it| *it = PathBuf::new());
        bare.output = Output::default();
        bare.run.threads = None;
        bare.map_options.max_size_mb = None;
        let toml = toml::to_string(&bare).map_err(|error| Fault::bug(SCENARIO, error))?;
        hash.update(toml.as_bytes());
        for (text, weight) in style_texts(scenario, origin)? {
            hash.update(text.as_bytes());
            hash.update(&weight.to_le_bytes());
        }
        for file in files_mut(&mut scenario.clone()).chain(&mut scenario.commands.clone()) {
            hash.update(&self.of_file(file)?.to_le_bytes());
        }
        let map = match origin.built_in_map() {
            Some(text) => xxh3_64(text.as_bytes()),
            None => self.of_file(&scenario.map)?,
        };
        hash.update(&map.to_le_bytes());
        Ok(format!("{:016x}", hash.digest()))
    }

    /// The hash of the file at `path`, as it was when it was first read.
    fn of_file(&mut self, path: &Path) -> Result<u64, Fault> {
        if let Some(known) = self.files.get(path) {
            return Ok(*known);
        }
        let content = fs::read(path).map_err(|error| Fault::refused(path, "read", &error))?;
        Ok(*self.files.entry(path.to_owned()).or_insert(xxh3_64(&content)))
    }
}

/// The texts of the styles of `scenario` with the bits of their weights, in the order of the texts: file names do not
/// matter.
///
/// # Errors
/// If a style file cannot be read.
pub fn style_texts(scenario: &Scenario, origin: &Origin) -> Result<Vec<(String, u64)>, Fault> {
    let mut styles = Vec::new();
    for (name, weight) in &scenario.styles {
        styles.push((origin.style(name)?.text, weight.to_bits()));
    }
    styles.sort();
    Ok(styles)
}

/// Hash of the output of a run: all its output settings except the folder.
///
/// # Errors
/// None, as long as every output setting can be serialized.
pub fn output_settings(scenario: &Scenario) -> Result<String, Fault> {
    let output = Output { dir: PathBuf::new(), ..scenario.output.clone() };
    let toml = toml::to_string(&output).map_err(|error| Fault::bug(SCENARIO, error))?;
    Ok(format!("{:016x}", xxh3_64(toml.as_bytes())))
}

impl End {
    /// Whether a run of `scenario` can have ended so: one that was interrupted is shorter.
    fn is_of(&self, scenario: &Scenario) -> bool {
        let times = [(self.duration_s, scenario.run.duration_s), (self.warmup_s, scenario.run.warmup_s)];
        times.iter().all(|(time, most)| (0.0..=most + scenario.run.step_s).contains(time))
    }
}

impl Record {
    /// The run with its results in `dir`.
    ///
    /// # Errors
    /// If there are none, or if something on which the run depended has changed since.
    pub fn open(dir: &Path) -> Result<Record, Fault> {
        let remedy =
            "give the results folder of a run (its --out), which contains summary.json and scenario.toml";
        if !dir.is_dir() {
            let what = if dir.exists() { "this is a file" } else { "this folder does not exist" };
            return Err(Fault::new(dir.display(), format!("no results of a run: {what}"), remedy));
        }
        let summary = dir.join(SUMMARY);
        let text = fs::read_to_string(&summary).map_err(|error| {
            if error.kind() == io::ErrorKind::NotFound && dir.join(SCENARIO).exists() {
                let remedy = format!("wait, or resume it: laneweave run {} --resume", dir.display());
                return Fault::new(dir.display(), "this run is not complete", remedy);
            }
            match error.kind() {
                io::ErrorKind::NotFound => Fault::new(
                    dir.display(),
                    "no results of a run: there is no summary.json in this folder",
                    remedy,
                ),
                _ => Fault::refused(&summary, "read", &error),
            }
        })?;
        let end: End = serde_json::from_str(&text).map_err(|error| {
            Fault::new(summary.display(), format!("not a summary of a run of this version: {error}"), remedy)
        })?;
        let (scenario, origin) = Origin::open(&dir.join(SCENARIO))?;
        let mut record = Record { scenario, origin, end };
        if fingerprint(&record.scenario, &record.origin)? != record.end.fingerprint {
            let what = format!(
                "the map {}, a style, the commands, the scenario or the program has changed since this was run",
                record.scenario.map.display()
            );
            return Err(Fault::new(dir.display(), what, "run it again"));
        }
        if !record.end.is_of(&record.scenario) {
            let End { duration_s, warmup_s, .. } = record.end;
            let what = format!(
                "{duration_s} s after {warmup_s} s of warm-up are more than the scenario of this run has: the file was changed"
            );
            return Err(Fault::new(summary.display(), what, "run it again"));
        }
        // All that was done to the run is in this table, also what a program did.
        let extension = Format::from(record.scenario.output.format).extension();
        record.scenario.commands = Some(dir.join(COMMANDS).with_extension(extension));
        record.scenario.external.clear();
        Ok(record)
    }
}
