//! `laneweave routes`.

use std::fmt::Write;
use std::path::PathBuf;

use clap::{Args, ValueHint};
use laneweave::maps::Sense;
use laneweave::output::json;
use laneweave::scenario::open_map;
use laneweave::{Fault, Id};
use laneweave_studies::routes::{Way, ways};
use serde::Serialize;

use super::check::Reading;
use super::numbers::{number, whole};
use super::say;

#[derive(Debug, Args)]
pub(crate) struct RoutesArguments {
    /// The map (Lanelet2: .osm, CommonRoad: .xml; compressed: .osm.gz).
    #[arg(value_hint = ValueHint::FilePath)]
    map: PathBuf,
    /// Id of the first lanelet; the routes start at its beginning.
    #[arg(allow_negative_numbers = true)]
    from: Id,
    /// Id of the last lanelet; the routes end at its end.
    #[arg(allow_negative_numbers = true)]
    to: Id,
    #[command(flatten)]
    reading: Reading,
    /// Largest number of routes to list.
    #[arg(long, value_name = "N", value_parser = whole::<usize>, default_value_t = Sense::default().most)]
    most: usize,
    /// Longest travel time of a route, as a multiple of that of the fastest route.
    #[arg(long, value_name = "TIMES", value_parser = number, default_value_t = Sense::default().longest)]
    longest: f64,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// The ways, as JSON.
#[derive(Serialize)]
struct Ways {
    routes: Vec<Way>,
}

impl RoutesArguments {
    pub(crate) fn execute(self) -> Result<(), Fault> {
        if self.longest.is_nan() || self.longest < 1.0 {
            return Err(Fault::new(
                "--longest",
                format!("a limit of {} times the fastest travel time", self.longest),
                "choose 1 or more",
            ));
        }
        if self.most == 0 {
            return Err(Fault::new("--most", "a limit of 0 routes", "choose 1 or more"));
        }
        let map = open_map(&self.map, &self.reading.options())?;
        let sense = Sense { most: self.most, longest: self.longest };
        let found = ways(&map, self.from, self.to, sense)?;
        say(&if self.json { json(&Ways { routes: found })? } else { text(&found, self.from, self.to) })
    }
}

fn text(ways: &[Way], from: Id, to: Id) -> String {
    if ways.is_empty() {
        return format!(
            "No route leads from lanelet {from} to lanelet {to}; `laneweave check` lists lanelets that are not connected.\n"
        );
    }
    let mut out = String::new();
    for (number, way) in ways.iter().enumerate() {
        let variants = match way.variants {
            1 => String::new(),
            count => format!(", the fastest of {count} variants that differ in their lanes"),
        };
        // Writing to a string never fails.
        let _ = write!(
            out,
            "{}. {:.0} m, {:.1} s at the speed limits, {} lane changes{variants}:\n  ",
            number + 1,
            way.length_m,
            way.free_travel_time_s,
            way.lane_changes
        );
        for (place, leg) in way.lanelets.iter().enumerate() {
            let link = match leg.by {
                "following" if place == 0 => "",
                "following" => " → ",
                "left" => " ↰ ",
                _ => " ↱ ",
            };
            let _ = write!(out, "{link}{}{}", leg.id, if leg.backward { " backwards" } else { "" });
        }
        out.push('\n');
    }
    out + "(→ next lanelet, ↰ lane change to the left, ↱ to the right)\n"
}
