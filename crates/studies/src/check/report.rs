//! The report on a map, in numbers and in words.

use std::collections::{BTreeMap, HashMap};
use std::fmt::{self, Write};

use laneweave::sim::{Place, Places};
use laneweave_maps::{BORDERS, Map, Problem, RuleKind, check};
use laneweave_network::{ChainIndex, Classes, DrivingSide, Id, Network, Position, Sign};
use laneweave_scenario::scenario::driven;
use laneweave_scenario::{Late, Remark, on_late_trips, remarks};
use laneweave_study::units::{KMH_PER_MPS, METRES_PER_KM};
use serde::Serialize;

/// Maximum of kinds of problems in the text.
const LISTED: usize = 20;

/// The report on a map. Fields are added, never renamed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// Latitude and longitude of the local frame's origin [°]; null for maps with metric coordinates of their own.
    pub origin: Option<[f64; 2]>,
    /// `left` or `right`.
    pub driving_side: &'static str,
    /// Elements of the file by kind.
    pub elements: BTreeMap<String, usize>,
    /// Lanelets that vehicles may use.
    pub lanelets: usize,
    /// Of them, those that may be used in both directions.
    pub two_way: usize,
    /// Length of all lanelets that vehicles may use [km].
    pub lane_km: f64,
    /// Least and greatest speed limit [km/h].
    pub speed_limits_kmh: [f64; 2],
    /// Lanelets that are for some vehicles only, by who may use them.
    pub restricted: Vec<Restricted>,
    /// Pairs of lanelets that follow each other.
    pub following: usize,
    /// Lanelets from which a change to the left is allowed, and to the right.
    pub lane_changes: [usize; 2],
    /// Pairs of lanelets that conflict.
    pub conflicts: usize,
    /// Lanes of the simulation: runs of lanelets without a fork or a merge.
    pub chains: usize,
    /// Entrances: places where vehicles enter and can drive to an exit; none on a closed map.
    pub entrances: Vec<Opening>,
    /// Exits; none on a closed map.
    pub exits: Vec<Opening>,
    /// Trips with too little road for the lane changes of their route. The default demand leaves them out, unless
    /// there are no others.
    pub late_trips: Vec<Late>,
    /// On a closed map, the lanelets along which trips start.
    pub inner_places: usize,
    /// Traffic lights.
    pub lights: Vec<Lit>,
    /// The last lanelets of lanes that end beside a continuing one.
    pub lane_drops: Vec<Id>,
    /// Regulatory elements by kind.
    pub rules: BTreeMap<String, usize>,
    /// Obstacles that stand on or beside the roads.
    pub obstacles: usize,
    /// Elements that could not be used unchanged, or are suspicious.
    pub problems: Vec<Problem>,
    /// Remarks on the traffic of the map.
    pub remarks: Vec<Remark>,
}

/// Lanelets that the same classes of vehicles may use, and others not.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Restricted {
    /// The classes that may use them.
    pub classes: Vec<&'static str>,
    /// Their ids.
    pub lanelets: Vec<Id>,
}

impl Restricted {
    /// All of them on a network.
    fn all(network: &Network) -> Vec<Restricted> {
        let mut by_classes: BTreeMap<Classes, Vec<Id>> = BTreeMap::new();
        for lanelet in network.lanelets.iter().filter(|it| it.classes != Classes::ALL) {
            by_classes.entry(lanelet.classes).or_default().push(lanelet.id);
        }
        let names = |it: Classes| it.iter().map(|class| class.body().name).collect();
        by_classes.into_iter().map(|(it, lanelets)| Restricted { classes: names(it), lanelets }).collect()
    }
}

/// An entrance or an exit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Opening {
    /// Its name: the smallest id of its lanelets.
    pub id: Id,
    /// Its number of lanes.
    pub lanes: usize,
}

/// A traffic light.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Lit {
    /// Its name: the smallest id of the regulatory elements that drivers obey together.
    pub id: Id,
    /// The lanelets on which they stop.
    pub lanelets: Vec<Id>,
}

impl Report {
    /// The report on `map`.
    pub fn of(map: &Map) -> Report {
        let Map { network, graph, rules, contents, problems, origin, programs: _ } = map;
        let Network { lanelets, chains, lane_drops, driving_side, .. } = network;
        let (driven, places) = driven(map);
        let late_trips = Late::between(&driven, &places);
        let mut remarks = remarks(map, &driven, &places, &[]);
        remarks.extend(on_late_trips(&late_trips).into_iter().flatten());
        let Places { origins, destinations } = places;
        let gates = |places: &[Place]| places.iter().filter_map(opening).collect::<Vec<_>>();
        let (entrances, exits) = (gates(&origins), gates(&destinations));
        let limits = lanelets.iter().map(|it| it.speed_limit * KMH_PER_MPS);
        let bound = |pick: fn(f64, f64) -> f64| tenths(limits.clone().reduce(pick).unwrap_or_default());
        let mut kinds: BTreeMap<String, usize> = BTreeMap::new();
        for rule in rules.iter().filter(|it| it.kind != RuleKind::SpeedLimit) {
            *kinds.entry(rule.kind.name().into()).or_default() += 1;
        }
        let conflicts: usize = graph.conflicting.iter().map(Vec::len).sum();
        let two_way = graph.nodes.len() - lanelets.len();
        Report {
            origin: origin.map(|(latitude, longitude)| [latitude, longitude]),
            driving_side: match driving_side {
                DrivingSide::Left => "left",
                DrivingSide::Right => "right",
            },
            elements: contents.counts.clone(),
            lanelets: lanelets.len(),
            two_way,
            lane_km: (lanelets.iter().map(|it| it.length()).sum::<f64>()).round() / METRES_PER_KM,
            speed_limits_kmh: [bound(f64::min), bound(f64::max)],
            restricted: Restricted::all(network),
            following: lanelets.iter().map(|it| it.following.len()).sum(),
            lane_changes: [
                lanelets.iter().filter(|it| it.left.is_some()).count(),
                lanelets.iter().filter(|it| it.right.is_some()).count(),
            ],
            // A two-way lanelet is in its own list.
            conflicts: (conflicts - two_way) / 2,
            chains: chains.len(),
            inner_places: origins.len() - entrances.len(),
            entrances,
            exits,
            late_trips: late_trips.concat(),
            lights: lights(&driven),
            lane_drops: lane_drops
                .iter()
                .filter_map(|it| network.chain(*it).lanelets.last())
                .map(|it| lanelets[it.at()].id)
                .collect(),
            rules: kinds,
            obstacles: contents.obstacles.len(),
            remarks,
            problems: sorted(problems.iter().cloned().chain(check(network)).collect()),
        }
    }

    /// The report in words.
    pub fn to_text(&self) -> String {
        let mut out = String::new();
        // Writing to a string never fails.
        let _ = self.write_to(&mut out);
        out
    }

    fn write_to(&self, out: &mut String) -> fmt::Result {
        // On a map without borders, the other problems matter little.
        if let Some(Problem { what, remedy, .. }) = self.problems.iter().find(|it| it.element == BORDERS) {
            writeln!(out, "{what}; {remedy}.\n")?;
        }
        match self.origin {
            Some([latitude, longitude]) => {
                writeln!(out, "Coordinates are projected (UTM), relative to {latitude}, {longitude}.")?;
            }
            None => writeln!(out, "Coordinates are those of the file, in metres.")?,
        }
        writeln!(out, "Traffic drives on the {}.\n", self.driving_side)?;
        let counted: Vec<String> =
            self.elements.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
        if !counted.is_empty() {
            wrapped(out, "The file contains", &counted)?;
        }
        let [slowest, fastest] = self.speed_limits_kmh;
        let limits =
            if slowest == fastest { format!("{slowest}") } else { format!("{slowest} to {fastest}") };
        let [left, right] = self.lane_changes;
        writeln!(
            out,
            "\nlanelets for vehicles  {}, {} km, speed limits {limits} km/h",
            self.lanelets, self.lane_km
        )?;
        writeln!(out, "of them two-way        {}", self.two_way)?;
        for Restricted { classes, lanelets } in &self.restricted {
            writeln!(out, "only for some          {}: {}", classes.join(", "), listed(lanelets))?;
        }
        writeln!(out, "successor pairs        {}", self.following)?;
        writeln!(out, "lane changes allowed   {left} to the left, {right} to the right")?;
        writeln!(out, "conflicting pairs      {}", self.conflicts)?;
        writeln!(out, "lanes (chains)         {}", self.chains)?;
        writeln!(out, "entrances              {}", openings(&self.entrances))?;
        writeln!(out, "exits                  {}", openings(&self.exits))?;
        if self.inner_places > 0 {
            writeln!(out, "closed map             trips start and end on {} lanelets", self.inner_places)?;
        }
        writeln!(out, "lane drops             {}", listed(&self.lane_drops))?;
        let lights: Vec<Id> = self.lights.iter().map(|it| it.id).collect();
        writeln!(out, "traffic lights         {}", listed(&lights))?;
        let rules: Vec<String> = self.rules.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
        writeln!(
            out,
            "rules                  {}",
            if rules.is_empty() { "none".into() } else { rules.join(", ") }
        )?;
        if self.obstacles > 0 {
            writeln!(out, "obstacles              {}, on or beside the roads", self.obstacles)?;
        }
        if !self.remarks.is_empty() {
            writeln!(out, "\nWhat to expect of traffic:")?;
            self.remarks.iter().try_for_each(|it| writeln!(out, "  {it}"))?;
        }
        if self.problems.is_empty() {
            return writeln!(out, "\nNo problems.");
        }
        writeln!(out, "\nProblems ({}; --json lists all):", self.problems.len())?;
        for alike in self.problems.chunk_by(|a, b| a.what == b.what && a.remedy == b.remedy).take(LISTED) {
            let Problem { element, line, what, remedy } = &alike[0];
            let line = line.map_or(String::new(), |it| format!(" (line {it})"));
            let others = match alike.len() {
                1 => String::new(),
                count => format!(" and {} more", count - 1),
            };
            writeln!(out, "  {element}{line}{others}: {what}; {remedy}")?;
        }
        Ok(())
    }
}

fn tenths(number: f64) -> f64 {
    (10.0 * number).round() / 10.0
}

fn opening(place: &Place) -> Option<Opening> {
    match place {
        Place::Gate(gate) => Some(Opening { id: gate.id, lanes: gate.chains.len() }),
        Place::Inside(_) | Place::Across(_) => None,
    }
}

fn lights(network: &Network) -> Vec<Lit> {
    let mut lights: Vec<Lit> =
        network.junctions.lights.iter().map(|it| Lit { id: it.id, lanelets: Vec::new() }).collect();
    for chain in (0..network.chains.len()).map(|it| ChainIndex(it as u32)) {
        for stop in &network.junctions.on(chain).stops {
            if let Sign::Light(light) = stop.sign {
                lights[light.at()].lanelets.push(network.lanelet_at(Position::new(chain, stop.station)).0.id);
            }
        }
    }
    lights
}

/// Problems grouped by kind, in the order in which the kinds first occurred.
fn sorted(mut problems: Vec<Problem>) -> Vec<Problem> {
    let kind = |it: &Problem| (it.what.clone(), it.remedy.clone());
    let mut kinds: HashMap<(String, String), usize> = HashMap::new();
    for it in &problems {
        let next = kinds.len();
        kinds.entry(kind(it)).or_insert(next);
    }
    problems.sort_by_cached_key(|it| kinds.get(&kind(it)).copied());
    problems
}

/// The names of entrances or exits with their numbers of lanes, if there are not too many.
fn openings(all: &[Opening]) -> String {
    let lanes: usize = all.iter().map(|it| it.lanes).sum();
    let names: Vec<String> = all.iter().map(|it| it.id.to_string()).collect();
    match all.len() {
        0 => "none".into(),
        _ => format!("{} with {lanes} lanes: {}", all.len(), shortened(&names)),
    }
}

fn listed(ids: &[Id]) -> String {
    let names: Vec<String> = ids.iter().map(Id::to_string).collect();
    if names.is_empty() { "none".into() } else { format!("{}: {}", names.len(), shortened(&names)) }
}

/// The first of many names.
fn shortened(names: &[String]) -> String {
    const SHOWN: usize = 8;
    let rest = if names.len() > SHOWN { ", …" } else { "" };
    names[..names.len().min(SHOWN)].join(", ") + rest
}

/// Writes a sentence that lists `parts`, in lines of moderate length.
fn wrapped(out: &mut String, begin: &str, parts: &[String]) -> fmt::Result {
    const WIDTH: usize = 100;
    let mut line = begin.to_owned();
    for (index, part) in parts.iter().enumerate() {
        let end = if index + 1 == parts.len() { "." } else { "," };
        if line.len() + part.len() > WIDTH {
            writeln!(out, "{line}")?;
            line.clear();
        } else {
            line.push(' ');
        }
        write!(line, "{part}{end}")?;
    }
    writeln!(out, "{line}")
}
