//! `laneweave routes`.

use std::fmt::Write;
use std::path::PathBuf;

use clap::{Args, ValueHint};
use laneweave::Fault;
use laneweave::maps::{By, Map, NodeIndex, Route, Sense, routes};
use laneweave::network::LaneletIndex;
use laneweave::scenario::open_map;
use serde::Serialize;

use super::check::{Reading, json};
use super::numbers::{id, number, whole};
use super::say;

#[derive(Debug, Args)]
pub(crate) struct RoutesArguments {
    /// The map (Lanelet2: .osm, CommonRoad: .xml; compressed: .osm.gz).
    #[arg(value_hint = ValueHint::FilePath)]
    map: PathBuf,
    /// Id of the first lanelet; the routes start at its beginning.
    #[arg(allow_negative_numbers = true, value_parser = id)]
    from: i64,
    /// Id of the last lanelet; the routes end at its end.
    #[arg(allow_negative_numbers = true, value_parser = id)]
    to: i64,
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

/// A way: its lanelets in order. Of lanelets between which lanes are changed only the last counts as driven.
#[derive(Serialize)]
struct Way {
    length_m: f64,
    free_travel_time_s: f64,
    lane_changes: usize,
    /// Ways over the same roads that were found, which differ in their lanes: this one and slower ones.
    variants: usize,
    lanelets: Vec<Leg>,
}

#[derive(Serialize)]
struct Leg {
    id: i64,
    /// `following`, or the side of the lane change by which it is reached.
    by: &'static str,
    /// It is driven against its direction.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    backward: bool,
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
        let [from, to] = [("FROM", self.from), ("TO", self.to)].map(|(name, id)| find(&map, name, id));
        let sense = Sense { most: self.most, longest: self.longest };
        let (from, to) = (from?, to?);
        // Two-way lanelets may be driven either way.
        let pairs = from.iter().flat_map(|from| to.iter().map(move |to| (*from, *to)));
        let mut found: Vec<Route> = pairs.flat_map(|(from, to)| routes(&map, from, to, sense)).collect();
        found.sort_by(|a, b| a.time.total_cmp(&b.time));
        found.truncate(self.most);
        let found: Vec<Way> = found.iter().map(|it| Way::of(it, &map)).collect();
        say(&if self.json { json(&Ways { routes: found })? } else { text(&found, self.from, self.to) })
    }
}

/// The nodes of the lanelet with this id.
fn find(map: &Map, name: &str, id: i64) -> Result<Vec<NodeIndex>, Fault> {
    let lanelets = &map.network.lanelets;
    let place = lanelets.iter().position(|it| it.id == id).map(|it| it as u32);
    let nodes = place.map(|it| {
        let backward = map.graph.backward(LaneletIndex(it));
        [NodeIndex(it)].into_iter().chain(backward).collect()
    });
    nodes.ok_or_else(|| {
        let nearest = lanelets.iter().map(|it| it.id).min_by_key(|it| it.abs_diff(id)).unwrap_or_default();
        let remedy = format!("choose one of its {} lanelets; the nearest id is {nearest}", lanelets.len());
        Fault::new(name, format!("this map has no lanelet {id} for vehicles"), remedy)
    })
}

impl Way {
    fn of(route: &Route, map: &Map) -> Way {
        let legs = route.steps.iter().map(|step| {
            let node = &map.graph.nodes[step.node.at()];
            Leg {
                id: map.network.lanelets[node.lanelet.at()].id,
                by: match step.by {
                    By::Following => "following",
                    By::Left => "left",
                    By::Right => "right",
                },
                backward: node.is_backward,
            }
        });
        Way {
            length_m: route.length,
            free_travel_time_s: route.time,
            variants: route.variants,
            lane_changes: route.steps.iter().filter(|it| it.by != By::Following).count(),
            lanelets: legs.collect(),
        }
    }
}

fn text(ways: &[Way], from: i64, to: i64) -> String {
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
