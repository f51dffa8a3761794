//! Simulations of SUMO: the vehicles of its files on its nets.
//!
//! * `config.rs` configurations; `elements.rs` vehicles, routes and types as plain data
//! * `edges.rs` the edges of a net among the lanelets of a network
//! * `vehicle_type.rs` types as classes and styles; `schedule.rs` vehicles as departures, and `growing.rs` their places

mod config;
mod edges;
mod elements;
mod growing;
mod schedule;
mod vehicle_type;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use laneweave_maps::xml::XmlError;
use laneweave_maps::{Map, MapError, Problem, Size, contents};
use laneweave_network::Network;
use laneweave_sim::Random;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::fault::{Fault, FaultKind};
use crate::scenario::Scenario;
use crate::source::Source;
use crate::style::StyleTemplate;
use edges::Edges;
use elements::{Elements, TypeElement, When};
pub(crate) use schedule::Schedule;
use schedule::{Scheduler, USUAL_TYPE};

/// Vehicles of SUMO: the files that say when and where they drive.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Sumo {
    /// Files with vehicles, trips, flows, routes and types (.rou.xml), relative to the scenario file.
    pub routes: Vec<PathBuf>,
    /// Files with types, bus stops and programs of lights (.add.xml), relative to the scenario file.
    pub additional: Vec<PathBuf>,
    /// The configuration that names these files (.sumocfg), relative to the scenario file: its options without a
    /// counterpart are named.
    pub configuration: Option<PathBuf>,
    /// The time in these files at which the simulation begins [s].
    pub begin_s: f64,
}

/// How long a simulation goes on after its last departure if the configuration gives no end [s]; ours.
const UNTIL_ALL_ARRIVE: f64 = 1800.0;
/// Files that include each other are read to this depth.
const DEEPEST: usize = 16;

impl Sumo {
    /// Whether there are such files.
    pub fn is_asked(&self) -> bool {
        !self.routes.is_empty() || !self.additional.is_empty()
    }

    /// The paths of its files.
    pub fn files_mut(&mut self) -> impl Iterator<Item = &mut PathBuf> {
        self.routes.iter_mut().chain(&mut self.additional).chain(&mut self.configuration)
    }
}

/// The scenario of the configuration at `path`.
///
/// # Errors
/// If it, or a file that it names, cannot be read.
pub(crate) fn open(path: &Path) -> Result<Scenario, Fault> {
    let bytes = read_file(path, path.display().to_string())?;
    let read = config::read(&bytes, path.parent().unwrap_or(Path::new("")));
    let read = read.map_err(|error| broken(path, &error))?;
    let Some(net) = read.net else {
        let remedy = "add <input><net-file value=\"town.net.xml\"/></input>";
        return Err(Fault::new(path.display(), "it names no net-file", remedy));
    };
    let mut scenario = Scenario::of_map(net);
    let begin_s = read.begin_s.unwrap_or(0.0);
    let configuration = Some(path.to_owned());
    scenario.sumo = Sumo { routes: read.routes, additional: read.additional, configuration, begin_s };
    scenario.demand.vehicles_per_hour = Some(0.0);
    scenario.styles = BTreeMap::new();
    scenario.run.step_s = read.step_s.unwrap_or(scenario.run.step_s).min(LONGEST_STEP);
    scenario.run.seed = read.seed.unwrap_or(scenario.run.seed);
    scenario.run.duration_s = match read.end_s {
        Some(end) => end - begin_s,
        None => {
            let last = Vehicles::read(&scenario.sumo)?.last_departure_s();
            (last - begin_s).max(0.0) + UNTIL_ALL_ARRIVE
        }
    };
    Ok(scenario)
}

/// Longer steps of SUMO become this one [s]: drivers who react need shorter ones; ours.
const LONGEST_STEP: f64 = 0.1;

/// The net `map` with the programs of lights in its other files.
///
/// # Errors
/// If a file cannot be read.
pub(crate) fn with_programs(mut map: Map, sumo: &Sumo) -> Result<Map, Fault> {
    for path in sumo.additional.iter().chain(&sumo.routes) {
        add_programs(path, path.display().to_string(), &mut map, DEEPEST)?;
    }
    Ok(map)
}

/// Gives the lights of `map` the programs in the file at `path`, and in the files that it includes.
fn add_programs(path: &Path, place: String, map: &mut Map, depth: usize) -> Result<(), Fault> {
    let deeper = deeper(&place, depth)?;
    let bytes = read_file(path, place)?;
    // Most files have none, and are large.
    let has = |tag: &str| bytes.windows(tag.len()).any(|it| it == tag.as_bytes());
    if has("<tlLogic") {
        laneweave_maps::sumo::add_programs(map, &bytes).map_err(|error| broken(path, &error))?;
    }
    if has("<include") {
        for (file, place) in included(path, &bytes, &mut Elements::default())? {
            add_programs(&file, place, map, deeper)?;
        }
    }
    Ok(())
}

/// The vehicles of a scenario.
pub(crate) struct Vehicles {
    elements: Elements,
}

impl Vehicles {
    /// The vehicles that these files name.
    ///
    /// # Errors
    /// If a file cannot be read.
    pub(crate) fn read(sumo: &Sumo) -> Result<Vehicles, Fault> {
        let mut elements = Elements::default();
        for path in sumo.additional.iter().chain(&sumo.routes) {
            let named_in = sumo.configuration.as_deref().unwrap_or(path);
            add(path, named_in.display().to_string(), &mut elements, DEEPEST)?;
        }
        if let Some(path) = &sumo.configuration {
            let bytes = read_file(path, path.display().to_string())?;
            let read = config::read(&bytes, Path::new("")).map_err(|error| broken(path, &error))?;
            for (option, line) in read.unused {
                let meaning = ("it has no counterpart", "leave it so");
                elements.unused.add(
                    &format!("options {option}"),
                    ("option of", file_name(path), line),
                    meaning,
                );
            }
        }
        Ok(Vehicles { elements })
    }

    /// The last time at which one wants to start [s].
    fn last_departure_s(&self) -> f64 {
        let last = |it: &When| match it {
            When::At(time) => *time,
            When::Flow([begin, end], _) => {
                if end.is_finite() {
                    *end
                } else {
                    *begin
                }
            }
            When::Unclear(_) => 0.0,
        };
        self.elements.vehicles.iter().map(|it| last(&it.when)).fold(0.0, f64::max)
    }

    /// The drivers of the types, each with the same weight.
    ///
    /// # Errors
    /// If a number of a type is out of range.
    pub(crate) fn mixture(&self) -> Result<Vec<(StyleTemplate, f64)>, Fault> {
        let base = crate::style::built_in(BASE).map_or("", |it| it.text);
        let usual = TypeElement::usual();
        let types = self.elements.types.iter().filter(|it| it.1.class().is_some());
        let types = types.map(|(name, it)| (name.as_str(), it));
        let of_type = |(name, it): (&str, &TypeElement)| {
            let text = it.style(name, base).unwrap_or_default();
            let source = Source { path: format!("vType {name}, line {}", it.line).into(), text };
            Ok((StyleTemplate::parse(&source).map_err(|fault| fault.of_kind(FaultKind::Style))?, 1.0))
        };
        let mut mixture: Vec<(StyleTemplate, f64)> =
            types.chain([(USUAL_TYPE, &usual)]).map(of_type).collect::<Result<_, Fault>>()?;
        mixture.sort_by(|(a, _), (b, _)| a.typical().name.cmp(&b.typical().name));
        mixture.dedup_by(|(a, _), (b, _)| a.typical().name == b.typical().name);
        Ok(mixture)
    }

    /// Their departures on a network, and what is left out. Their drivers have the styles with these names, or, if
    /// there are none, any of the population.
    pub(crate) fn schedule(
        &self,
        network: &Network,
        scenario: &Scenario,
        styles: Option<&[&str]>,
    ) -> (Schedule, Vec<Problem>) {
        let ids: Vec<String> = network.lanelets.iter().map(|it| it.id.to_string()).collect();
        let begin_s = scenario.sumo.begin_s;
        let numbered =
            |it: &[&str]| it.iter().zip(0..).map(|(name, number)| ((*name).to_owned(), number)).collect();
        let scheduler = Scheduler {
            elements: &self.elements,
            edges: Edges::of(network, &ids),
            styles: styles.map(numbered),
            random: Random::new(scenario.run.seed),
            begin_s,
            end_s: begin_s + scenario.run.warmup_s + scenario.run.duration_s,
        };
        let (schedule, left_out) = scheduler.schedule();
        let mut unused = self.elements.unused.clone();
        for (name, of_type) in &self.elements.types {
            for key in of_type.unused() {
                let meaning = ("drivers do not have it", "leave it so");
                let id = self.elements.in_file(name, of_type.file);
                unused.add(&format!("types with {key}"), ("vType", id, of_type.line), meaning);
            }
        }
        (schedule, left_out.problems().chain(unused.problems()).collect())
    }
}

/// The style whose drivers those of SUMO are but for car-following and speed.
const BASE: &str = "conservative";

/// Adds what the file at `path` says, and the files that it includes.
fn add(path: &Path, place: String, elements: &mut Elements, depth: usize) -> Result<(), Fault> {
    let deeper = deeper(&place, depth)?;
    let bytes = read_file(path, place)?;
    for (file, place) in included(path, &bytes, elements)? {
        add(&file, place, elements, deeper)?;
    }
    Ok(())
}

/// How deep files may include others that are named at `place`.
fn deeper(place: &str, depth: usize) -> Result<usize, Fault> {
    let what = "files include each other without end";
    depth.checked_sub(1).ok_or_else(|| Fault::new(place, what, "remove one of the <include>"))
}

/// Adds what the file at `path` says. Returns the files that it includes, with the places where it does.
fn included(path: &Path, bytes: &[u8], elements: &mut Elements) -> Result<Vec<(PathBuf, String)>, Fault> {
    let included = elements::read(bytes, file_name(path), elements).map_err(|error| broken(path, &error))?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let named = |(file, line): (String, usize)| (folder.join(file), format!("{}:{line}", path.display()));
    Ok(included.into_iter().map(named).collect())
}

/// The name of the file at `path`.
fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// The text of the file at `path`, which is named at `place`.
fn read_file(path: &Path, place: String) -> Result<Vec<u8>, Fault> {
    contents(path, Size::default()).map_err(|error| {
        let message = error.to_string();
        let (what, remedy) = message.rsplit_once("; ").unwrap_or((&message, "give another file"));
        let kind = if matches!(error, MapError::Missing) { FaultKind::NotFound } else { FaultKind::Syntax };
        let named =
            if place == path.display().to_string() { String::new() } else { format!("{}: ", path.display()) };
        Fault::new(place, format!("{named}{what}"), remedy).of_kind(kind)
    })
}

fn broken(path: &Path, error: &XmlError) -> Fault {
    let message = error.to_string();
    let line = format!("line {}: ", error.line());
    let message = message.strip_prefix(&line).unwrap_or(&message);
    let (what, remedy) = message.rsplit_once("; ").unwrap_or((message, "correct this line"));
    Fault::new(format!("{}:{}", path.display(), error.line()), what, remedy)
}
