//! `laneweave check`.

use std::path::{Path, PathBuf};

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueHint};
use laneweave::maps::{FileKind, Size};
use laneweave::output::{json, write_whole};
use laneweave::scenario::{DrivingSide, Law, MapOptions, open_map};
use laneweave::{Fault, Windows, open_windows};
use laneweave_studies::check::{
    GraphJson, Named, RecordingReport, Report, SetReport, explorer, picture, tracks,
};
use serde::Serialize;

use super::say;

#[derive(Debug, Args)]
pub(crate) struct CheckArguments {
    /// A map (Lanelet2: .osm, CommonRoad: .xml; compressed: .osm.gz), or with --map a recording (.csv of INTERACTION,
    /// highD, inD, rounD, exiD or NGSIM, any other with --columns; CommonRoad: .xml). Several recordings that continue
    /// one another are joined; several CommonRoad files without --map are a set, each with its own map.
    #[arg(value_name = "MAP|RECORDING", value_hint = ValueHint::FilePath, required = true)]
    files: Vec<PathBuf>,
    /// The map of the recording.
    #[arg(long, value_name = "MAP", value_hint = ValueHint::FilePath, conflicts_with_all = ["graph", "svg", "html"])]
    map: Option<PathBuf>,
    /// A TOML file that says what the columns of the recording hold.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, requires = "map")]
    columns: Option<PathBuf>,
    #[command(flatten)]
    options: Reading,
    /// Print the report as one JSON object.
    #[arg(long)]
    json: bool,
    /// Write the routing graph to this file, as one JSON object with lanelet ids as keys.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    graph: Option<PathBuf>,
    /// Write a picture of the map to this file.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    svg: Option<PathBuf>,
    /// Write a page to this file on which lanelets of the map are found by their ids: the picture, what is known of
    /// each lanelet, entrances, exits and problems.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    html: Option<PathBuf>,
}

/// How a map is read.
#[derive(Debug, Args)]
pub(crate) struct Reading {
    /// Latitude and longitude in degrees of the origin (0, 0) [default: those of the map's first node, rounded to
    /// 0.1].
    #[arg(long, value_name = "LAT,LON", value_parser = place, allow_hyphen_values = true)]
    origin: Option<[f64; 2]>,
    /// The traffic law whose speed limits apply where the map gives none [default: germany].
    #[arg(long, value_parser = law())]
    law: Option<Law>,
    /// On which side traffic drives [default: the side that the map gives, otherwise right].
    #[arg(long, value_name = "SIDE", value_parser = driving_side())]
    driving_side: Option<DrivingSide>,
    #[command(flatten)]
    size: Limit,
}

/// How large a map may be.
#[derive(Debug, Args)]
pub(crate) struct Limit {
    /// Largest size of the map, unpacked if it is compressed, such as 500MB; at most 2GiB [default: 1GiB].
    #[arg(long, value_name = "SIZE")]
    max_map_size: Option<Size>,
}

impl Limit {
    /// In the unit of scenarios [MB].
    pub(crate) fn mb(&self) -> Option<f64> {
        self.max_map_size.map(Size::mb)
    }
}

impl Reading {
    pub(crate) fn options(&self) -> MapOptions {
        MapOptions {
            origin: self.origin,
            law: self.law.unwrap_or_default(),
            driving_side: self.driving_side,
            max_size_mb: self.size.mb(),
            ..MapOptions::default()
        }
    }
}

fn place(text: &str) -> Result<[f64; 2], String> {
    let degrees =
        |part: &str| part.trim().parse().map_err(|_| format!("{part:?} is not a number of degrees"));
    let (latitude, longitude) = text.split_once(',').ok_or("write LAT,LON, such as 49,8.4")?;
    Ok([degrees(latitude)?, degrees(longitude)?])
}

fn law() -> impl TypedValueParser<Value = Law> {
    PossibleValuesParser::new(["germany", "usa"]).map(|it| if it == "usa" { Law::Usa } else { Law::Germany })
}

/// A side of the road by its name.
pub(super) fn driving_side() -> impl TypedValueParser<Value = DrivingSide> {
    PossibleValuesParser::new(["left", "right"])
        .map(|it| if it == "left" { DrivingSide::Left } else { DrivingSide::Right })
}

impl CheckArguments {
    pub(crate) fn execute(self) -> Result<(), Fault> {
        match &self.map {
            Some(map) => self.recording(map),
            None => self.map(),
        }
    }

    fn map(&self) -> Result<(), Fault> {
        let file = &self.files[0];
        let kind = FileKind::of(file);
        if self.files.len() > 1 && self.files.iter().all(|it| FileKind::of(it).has_tracks()) {
            return self.set();
        }
        if kind.is_table() || self.files.len() > 1 {
            return Err(Fault::new(
                file.display(),
                "a recording needs the map of its location",
                "add --map MAP",
            ));
        }
        self.check_outputs(file)?;
        let map = open_map(file, &self.options.options())?;
        let recording = if kind.has_tracks() { tracks(file)? } else { None };
        let recording = recording.map(|(it, problems)| RecordingReport::of(it, &problems, &map.network));
        let report = Report::of(&map);
        if let Some(path) = &self.graph {
            write_whole(path, &json(&GraphJson(&map))?)?;
        }
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        if let Some(path) = &self.svg {
            write_whole(path, &picture(&name, &map, &report.problems))?;
        }
        if let Some(path) = &self.html {
            write_whole(path, &explorer(&name, &map, &report))?;
        }
        if self.json {
            return say(&json(&Both { map: report, recording })?);
        }
        let tracks = recording.map(|it| format!("\nTracks in the same file:\n{}", it.to_text()));
        say(&(report.to_text() + &tracks.unwrap_or_default()))
    }

    /// Several recordings with their own maps.
    fn set(&self) -> Result<(), Fault> {
        let mut recordings = Vec::new();
        for file in &self.files {
            let map = open_map(file, &self.options.options())?;
            let Some((recording, problems)) = tracks(file)? else { continue };
            let report = RecordingReport::of(recording, &problems, &map.network);
            recordings.push(Named { file: file.display().to_string(), report });
        }
        let report = SetReport::of(recordings);
        say(&if self.json { json(&report)? } else { report.to_text() })
    }

    /// Checks before anything is written: no file replaces another one that is needed, and all have a folder.
    fn check_outputs(&self, file: &Path) -> Result<(), Fault> {
        let outputs = [("--graph", &self.graph), ("--svg", &self.svg), ("--html", &self.html)];
        let outputs: Vec<(&str, &PathBuf)> =
            outputs.into_iter().filter_map(|(option, path)| Some((option, path.as_ref()?))).collect();
        let place = |path: &Path| std::path::absolute(path).unwrap_or(path.to_owned());
        for (number, (option, path)) in outputs.iter().enumerate() {
            let folder = path.parent().filter(|it| !it.as_os_str().is_empty()).unwrap_or(Path::new("."));
            if !folder.is_dir() {
                let what = format!("the folder {} does not exist", folder.display());
                return Err(Fault::new(option, what, "create it first, or choose another folder"));
            }
            let is_input = path.canonicalize().is_ok_and(|it| file.canonicalize().is_ok_and(|own| it == own));
            if is_input || outputs[..number].iter().any(|(_, other)| place(other) == place(path)) {
                let what = format!("{} is already used for another file of this command", path.display());
                return Err(Fault::new(option, what, "choose another name"));
            }
        }
        Ok(())
    }

    fn recording(&self, map: &Path) -> Result<(), Fault> {
        let Windows { mut recording, problems, notes, .. } =
            open_windows(&self.files, self.columns.as_deref())?;
        let map = open_map(map, &self.options.options())?;
        recording.place(map.origin);
        let mut report = RecordingReport::of(recording, &problems, &map.network);
        report.windows = notes;
        say(&if self.json { json(&report)? } else { report.to_text() })
    }
}

/// A map, and the recording in the same file if there is one.
#[derive(Serialize)]
struct Both {
    #[serde(flatten)]
    map: Report,
    #[serde(skip_serializing_if = "Option::is_none")]
    recording: Option<RecordingReport>,
}
