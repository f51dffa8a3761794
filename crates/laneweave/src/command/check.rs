//! `laneweave check`.

use std::path::PathBuf;

use clap::Args;
use laneweave::Fault;
use laneweave::check::{GraphJson, Report, picture};
use laneweave::output::write_whole;
use laneweave::scenario::{MapOptions, open_map};
use serde::Serialize;

use super::say;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// The map file (Lanelet2: .osm, or compressed: .osm.gz).
    map: PathBuf,
    #[command(flatten)]
    options: Reading,
    /// Print the report as one JSON object.
    #[arg(long)]
    json: bool,
    /// Write the routing graph here, as one JSON object keyed by the ids of the lanelets.
    #[arg(long, value_name = "FILE")]
    graph: Option<PathBuf>,
    /// Write a picture of the map here.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

/// How a map is read.
#[derive(Debug, Args)]
pub(crate) struct Reading {
    /// Latitude and longitude in degrees that become (0, 0) [default: those of the map's first node, rounded to 0.1].
    #[arg(long, value_name = "LAT,LON", value_parser = place, allow_hyphen_values = true)]
    origin: Option<[f64; 2]>,
    /// Whose speed limits hold where the map gives none [default: germany].
    #[arg(long, value_name = "germany|usa", value_parser = law)]
    law: Option<laneweave::scenario::Law>,
}

impl Reading {
    pub(crate) fn options(&self) -> MapOptions {
        MapOptions { origin: self.origin, law: self.law.unwrap_or_default(), ..MapOptions::default() }
    }
}

fn place(text: &str) -> Result<[f64; 2], String> {
    let degrees = |part: &str| part.trim().parse().map_err(|_| format!("{part:?} is no number of degrees"));
    let (latitude, longitude) = text.split_once(',').ok_or("write LAT,LON, such as 49,8.4")?;
    Ok([degrees(latitude)?, degrees(longitude)?])
}

fn law(text: &str) -> Result<laneweave::scenario::Law, String> {
    match text {
        "germany" => Ok(laneweave::scenario::Law::Germany),
        "usa" => Ok(laneweave::scenario::Law::Usa),
        _ => Err("choose germany or usa".into()),
    }
}

impl Arguments {
    pub(crate) fn execute(self) -> Result<(), Fault> {
        let map = open_map(&self.map, &self.options.options())?;
        let report = Report::of(&map);
        if let Some(path) = &self.graph {
            write_whole(path, &json(&GraphJson(&map))?)?;
        }
        if let Some(path) = &self.svg {
            let name = self.map.file_name().unwrap_or_default().to_string_lossy();
            write_whole(path, &picture(&name, &map))?;
        }
        say(&if self.json { json(&report)? } else { report.to_text() });
        Ok(())
    }
}

fn json(value: &impl Serialize) -> Result<String, Fault> {
    let text = serde_json::to_string_pretty(value);
    text.map(|it| it + "\n").map_err(|error| Fault::new("JSON", error, "report this as a bug"))
}
