//! Vehicles, routes and types in files of SUMO, as plain data with their lines, after the format's description at
//! <https://sumo.dlr.de/docs/Definition_of_Vehicles,_Vehicle_Types,_and_Routes> as of version 1.20.

use std::borrow::Cow;
use std::collections::BTreeMap;

use laneweave_maps::Unused;
use laneweave_maps::xml::{ANY, Element, Visitor, XmlError, number, walk};

use super::config::seconds;

/// What all files of a simulation say.
#[derive(Default)]
pub(super) struct Elements {
    pub(super) types: BTreeMap<String, TypeElement>,
    /// Types with their weights, by the name of their distribution.
    pub(super) type_distributions: BTreeMap<String, Vec<(String, f64)>>,
    pub(super) routes: BTreeMap<String, RouteElement>,
    /// Routes with their weights, by the name of their distribution.
    pub(super) route_distributions: BTreeMap<String, Vec<(String, f64)>>,
    /// The places of bus stops, by their ids.
    pub(super) bus_stops: BTreeMap<String, BusStop>,
    pub(super) vehicles: Vec<VehicleElement>,
    pub(super) unused: Unused,
    /// The names of the files that were read.
    pub(super) files: Vec<String>,
}

impl Elements {
    /// An id with the name of a file.
    pub(super) fn in_file(&self, id: &str, file: usize) -> String {
        let file = self.files.get(file).map_or("", |it| it);
        if id.is_empty() { format!("in {file}") } else { format!("{id} in {file}") }
    }
}

/// A type of vehicles: its attributes.
pub(super) struct TypeElement {
    /// The number of its file.
    pub(super) file: usize,
    pub(super) line: usize,
    pub(super) attributes: BTreeMap<String, String>,
}

/// A route: edges in order, with stops.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct RouteElement {
    pub(super) edges: Vec<String>,
    pub(super) stops: Vec<StopElement>,
}

/// A place where buses stop.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct BusStop {
    pub(super) lane: String,
    /// Where the front bumper stands: the end of the stop [m]; from the end of the lane if negative.
    pub(super) end_m: Option<f64>,
}

/// A stop of a vehicle.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct StopElement {
    pub(super) line: usize,
    /// A bus stop by its id, or a place of its own.
    pub(super) at: Result<String, BusStop>,
    /// [s].
    pub(super) duration_s: f64,
    /// The vehicle does not go on before this time [s]: after its departure, if the stop is one of a route that has a
    /// name.
    pub(super) until_s: Option<f64>,
}

/// A vehicle, a trip, or a flow of them.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct VehicleElement {
    /// The number of its file.
    pub(super) file: usize,
    pub(super) line: usize,
    pub(super) id: String,
    pub(super) when: When,
    /// Its type, or a distribution of types.
    pub(super) kind: Option<String>,
    pub(super) way: Way,
    pub(super) stops: Vec<StopElement>,
    /// departLane, departPos, departSpeed and arrivalPos as they are written.
    pub(super) ends: [Option<String>; 4],
}

/// When vehicles depart.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum When {
    /// Once, at this time [s].
    At(f64),
    /// Again and again between two times [s].
    Flow([f64; 2], Rhythm),
    /// It is not known what this means.
    Unclear(String),
}

/// How often the vehicles of a flow depart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rhythm {
    /// So many in all, at even intervals.
    Number(f64),
    /// One every so many seconds.
    Period(f64),
    /// At exponentially distributed intervals, so many a second in the mean.
    Exponential(f64),
    /// One with this probability in each second.
    Probability(f64),
}

/// Which way a vehicle takes.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Way {
    /// A route, or one of a distribution of routes, by name.
    Named(String),
    /// These edges.
    Along(RouteElement),
    /// The fastest way from an edge over others to another one.
    Between(Vec<String>),
}

/// Adds what the file with this name says. Files that it includes are returned, with their lines.
pub(super) fn read(
    bytes: &[u8],
    name: String,
    elements: &mut Elements,
) -> Result<Vec<(String, usize)>, XmlError> {
    elements.files.push(name);
    let mut reader =
        Reader { elements, included: Vec::new(), distribution: String::new(), vehicle: None, route: None };
    walk(bytes, ANY, &mut reader)?;
    Ok(reader.included)
}

struct Reader<'a> {
    elements: &'a mut Elements,
    included: Vec<(String, usize)>,
    /// The distribution that is open.
    distribution: String,
    /// The vehicle that is open.
    vehicle: Option<VehicleElement>,
    /// The route outside of vehicles that is open, with its name.
    route: Option<(String, RouteElement)>,
}

impl Visitor for Reader<'_> {
    fn open(&mut self, path: &str, element: &Element) -> Result<(), XmlError> {
        match path {
            "" => {}
            "vType" | "vTypeDistribution/vType" => self.vehicle_type(path, element)?,
            "vTypeDistribution" => self.distribution(element, "vTypes")?,
            "routeDistribution" => self.distribution(element, "routes")?,
            "route" | "routeDistribution/route" => self.route(path, element)?,
            "vehicle" | "trip" | "flow" => self.vehicle(element)?,
            "vehicle/route" | "flow/route" => {
                let [edges] = element.values(["edges"])?;
                let edges = names(&edges.unwrap_or_default());
                if let Some(vehicle) = &mut self.vehicle {
                    vehicle.way = Way::Along(RouteElement { edges, stops: Vec::new() });
                }
            }
            _ if path.ends_with("stop") && (self.vehicle.is_some() || self.route.is_some()) => {
                self.stop(element)?
            }
            "busStop" | "trainStop" | "containerStop" | "chargingStation" => self.bus_stop(element)?,
            "include" => {
                let [file] = element.values(["href"])?;
                self.included.extend(file.map(|it| (it.into_owned(), element.line)));
            }
            // They belong to the net.
            "tlLogic" | "tlLogic/phase" => {}
            _ if path.ends_with("param") => {}
            other => self.unused(other, element)?,
        }
        Ok(())
    }

    fn close(&mut self, path: &str, _: &str) {
        match path {
            "vehicle" | "trip" | "flow" => self.elements.vehicles.extend(self.vehicle.take()),
            "route" | "routeDistribution/route" => self.elements.routes.extend(self.route.take()),
            _ => {}
        }
    }
}

impl Reader<'_> {
    /// The number of the file that is read.
    fn file(&self) -> usize {
        self.elements.files.len() - 1
    }

    fn unused(&mut self, path: &str, element: &Element) -> Result<(), XmlError> {
        const MEANING: (&str, &str) = ("it is not read", "leave it so");
        let [id] = element.values(["id"])?;
        let id = self.elements.in_file(&id.unwrap_or_default(), self.file());
        let place = ("element", id, element.line);
        self.elements.unused.add(&format!("elements <{path}>"), place, MEANING);
        Ok(())
    }

    fn vehicle_type(&mut self, path: &str, element: &Element) -> Result<(), XmlError> {
        let all: Result<BTreeMap<String, String>, XmlError> = element
            .attributes()
            .map(|it| it.map(|(key, value)| (key.to_owned(), value.into_owned())))
            .collect();
        let attributes = all?;
        let id = attributes.get("id").cloned().unwrap_or_default();
        if path != "vType" {
            let weight = attributes.get("probability").map_or(1.0, |it| number(it));
            let of = self.elements.type_distributions.entry(self.distribution.clone()).or_default();
            of.push((id.clone(), weight));
        }
        self.elements.types.insert(id, TypeElement { file: self.file(), line: element.line, attributes });
        Ok(())
    }

    /// Opens a distribution, whose attribute with this key lists its members.
    fn distribution(&mut self, element: &Element, key: &str) -> Result<(), XmlError> {
        let [id, members, weights] = element.values(["id", key, "probabilities"])?;
        self.distribution = id.unwrap_or_default().into_owned();
        let weights = weights.unwrap_or_default();
        let weights = weights.split_whitespace().map(number).chain(std::iter::repeat(1.0));
        let members = names(&members.unwrap_or_default()).into_iter().zip(weights);
        let of = match key {
            "vTypes" => &mut self.elements.type_distributions,
            _ => &mut self.elements.route_distributions,
        };
        of.entry(self.distribution.clone()).or_default().extend(members);
        Ok(())
    }

    fn route(&mut self, path: &str, element: &Element) -> Result<(), XmlError> {
        let [id, edges, weight, known] = element.values(["id", "edges", "probability", "refId"])?;
        let in_distribution = path != "route";
        let name =
            id.or(known).unwrap_or_else(|| Cow::Owned(format!("{}@{}", self.distribution, element.line)));
        let name = name.into_owned();
        if in_distribution {
            let weight = weight.map_or(1.0, |it| number(&it));
            let of = self.elements.route_distributions.entry(self.distribution.clone()).or_default();
            of.push((name.clone(), weight));
        }
        self.route = edges.map(|it| (name, RouteElement { edges: names(&it), stops: Vec::new() }));
        Ok(())
    }

    fn vehicle(&mut self, element: &Element) -> Result<(), XmlError> {
        let [id, kind, route, depart] = element.values(["id", "type", "route", "depart"])?;
        let [from, via, to] = element.values(["from", "via", "to"])?;
        let ends = element.values(["departLane", "departPos", "departSpeed", "arrivalPos"])?;
        let edges = [from, via, to].into_iter().flatten().flat_map(|it| names(&it)).collect();
        let when = match element.name {
            "flow" => flow(element)?,
            _ => {
                let depart = depart.unwrap_or_default();
                seconds(&depart).map_or_else(|| When::Unclear(format!("depart={depart:?}")), When::At)
            }
        };
        self.vehicle = Some(VehicleElement {
            file: self.file(),
            line: element.line,
            id: id.unwrap_or_default().into_owned(),
            when,
            kind: kind.map(Cow::into_owned),
            way: route.map_or(Way::Between(edges), |it| Way::Named(it.into_owned())),
            stops: Vec::new(),
            ends: ends.map(|it| it.map(Cow::into_owned)),
        });
        Ok(())
    }

    fn stop(&mut self, element: &Element) -> Result<(), XmlError> {
        let [stop, lane, end] = element.values(["busStop", "lane", "endPos"])?;
        let [duration, until] = element.values(["duration", "until"])?;
        let at = match stop {
            Some(id) => Ok(id.into_owned()),
            None => {
                Err(BusStop { lane: lane.unwrap_or_default().into_owned(), end_m: end.map(|it| number(&it)) })
            }
        };
        let duration_s = duration.and_then(|it| seconds(&it)).unwrap_or(0.0);
        let until_s = until.and_then(|it| seconds(&it)).filter(|it| *it >= 0.0);
        let stop = StopElement { line: element.line, at, duration_s, until_s };
        match (&mut self.vehicle, &mut self.route) {
            (Some(vehicle), _) => vehicle.stops.push(stop),
            (None, Some((_, route))) => route.stops.push(stop),
            (None, None) => {}
        }
        Ok(())
    }

    fn bus_stop(&mut self, element: &Element) -> Result<(), XmlError> {
        let [id, lane, end] = element.values(["id", "lane", "endPos"])?;
        let place = BusStop { lane: lane.unwrap_or_default().into_owned(), end_m: end.map(|it| number(&it)) };
        self.elements.bus_stops.insert(id.unwrap_or_default().into_owned(), place);
        Ok(())
    }
}

/// When the vehicles of a flow depart.
fn flow(element: &Element) -> Result<When, XmlError> {
    let [begin, end, count] = element.values(["begin", "end", "number"])?;
    let [period, hourly, chance] = element.values(["period", "vehsPerHour", "probability"])?;
    let begin = begin.map_or(Some(0.0), |it| seconds(&it));
    let end = end.map_or(Some(f64::INFINITY), |it| seconds(&it));
    let exponential = |it: &str| Some(number(it.trim().strip_prefix("exp(")?.strip_suffix(')')?));
    let rhythm = match (&period, &hourly, &chance, &count) {
        (Some(it), ..) => {
            Some(exponential(it).map_or_else(|| Rhythm::Period(number(it)), Rhythm::Exponential))
        }
        (_, Some(it), ..) => Some(Rhythm::Period(3600.0 / number(it))),
        (_, _, Some(it), _) => Some(Rhythm::Probability(number(it))),
        (_, _, _, Some(it)) => Some(Rhythm::Number(number(it))),
        _ => None,
    };
    Ok(match (begin, end, rhythm) {
        (Some(begin), Some(end), Some(rhythm)) => When::Flow([begin, end], rhythm),
        _ => When::Unclear("begin, end or its rhythm".into()),
    })
}

/// Names that are separated by blanks.
fn names(list: &str) -> Vec<String> {
    list.split_whitespace().map(str::to_owned).collect()
}
