//! A net as plain data: edges with their lanes, connections, and junctions, with their lines.

use std::collections::{BTreeMap, HashSet};

use laneweave_network::{Classes, Point};

use super::permission;
use super::program::Programs;
use crate::problem::Problem;
use crate::shape::MAXIMUM_COORDINATE;
use crate::unused::{Meaning, Unused};
use crate::xml::{Element, Visitor, XmlError, number, walk};

/// Width of a lane without one [m].
const USUAL_WIDTH: f64 = 3.2;

/// A road network.
#[derive(Default)]
pub(super) struct Net {
    pub(super) is_left_hand: bool,
    pub(super) edges: Vec<EdgeElement>,
    /// The lanes of all edges: those of an edge follow each other.
    pub(super) lanes: Vec<LaneElement>,
    pub(super) connections: Vec<Connection>,
    pub(super) junctions: Vec<Junction>,
    pub(super) programs: Programs,
    /// How many elements of each kind it has.
    pub(super) counts: BTreeMap<String, usize>,
    /// What traffic does not use.
    pub(super) unused: Unused,
    /// The ids of all lanes.
    lane_ids: HashSet<String>,
}

/// What an edge is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Function {
    /// A road.
    Normal,
    /// A way within a junction.
    Internal,
    /// For pedestrians.
    Walking,
}

/// An edge.
pub(super) struct EdgeElement {
    pub(super) id: String,
    pub(super) function: Function,
    kind: String,
    /// The place of its first lane.
    pub(super) first_lane: usize,
}

impl EdgeElement {
    /// Whether its type is that of a motorway or its ramps, as OpenStreetMap calls it.
    pub(super) fn is_motorway(&self) -> bool {
        self.kind.contains("motorway")
    }
}

/// A lane.
pub(super) struct LaneElement {
    pub(super) id: String,
    pub(super) line: usize,
    /// The place of its edge.
    pub(super) edge: usize,
    /// [m/s].
    pub(super) speed: f64,
    /// [m].
    pub(super) width: f64,
    pub(super) shape: Vec<Point>,
    pub(super) classes: Classes,
    /// Whether drivers may change lanes to the left, and to the right.
    pub(super) may_change: [bool; 2],
}

impl LaneElement {
    pub(super) fn problem(&self, what: &str, remedy: &str) -> Problem {
        Problem {
            element: format!("lane {}", self.id),
            line: Some(self.line),
            what: what.into(),
            remedy: remedy.into(),
        }
    }
}

/// A way from one lane to another, on which there may be an internal lane.
pub(super) struct Connection {
    pub(super) line: usize,
    pub(super) from: String,
    pub(super) from_lane: usize,
    pub(super) to: String,
    pub(super) to_lane: usize,
    pub(super) via: Option<String>,
    /// Its character in nets: `s` for a stop sign, `w` for an all-way stop, and others.
    pub(super) state: char,
    /// The program that its light follows, and its index in the states of that.
    pub(super) light: Option<(String, usize)>,
}

/// A junction.
pub(super) struct Junction {
    pub(super) kind: String,
    /// The last internal lanes of its movements, in the order of its requests.
    pub(super) internal_lanes: Vec<String>,
    /// The requests with their indices.
    pub(super) requests: Vec<Request>,
}

/// What a movement meets in its junction.
pub(super) struct Request {
    pub(super) index: usize,
    /// Whether it gives way to each of the others, by their index.
    pub(super) response: Vec<bool>,
    /// Whether its drivers wait within the junction.
    pub(super) waits_inside: bool,
}

const WALKING: Meaning = ("nobody walks here", "leave it so");
const OF_OTHERS: Meaning =
    ("none of our classes of vehicles may use them, so they are left out", "leave it so");
const NOT_READ: Meaning = ("this element is not read", "leave it so");

/// Reads a net. Elements that cannot be used become problems.
pub(super) fn parse(bytes: &[u8], problems: &mut Vec<Problem>) -> Result<Net, XmlError> {
    let mut reader = Reader { net: Net::default(), problems };
    walk(bytes, "net", &mut reader)?;
    Ok(reader.net)
}

/// A net that grows element by element.
struct Reader<'a> {
    net: Net,
    problems: &'a mut Vec<Problem>,
}

impl Visitor for Reader<'_> {
    fn open(&mut self, path: &str, element: &Element) -> Result<(), XmlError> {
        match path {
            "" => {
                let [side] = element.values(["lefthand"])?;
                self.net.is_left_hand = side.is_some_and(|it| is_true(&it));
            }
            "edge" => self.edge(element)?,
            "edge/lane" => self.lane(element)?,
            "connection" => self.connection(element)?,
            "junction" => self.junction(element)?,
            "junction/request" => self.request(element)?,
            "location" | "type" | "roundabout" => {}
            "tlLogic" => self.program(element)?,
            "tlLogic/phase" => self.net.programs.add_phase(element)?,
            _ if path.ends_with("/param") || path == "param" => {}
            "edge/neigh" | "edge/lane/neigh" => {
                let meaning = ("nobody overtakes on the lanes of others", "leave it so");
                self.unused("neighbouring lanes of the other direction", "lane", "lane", element, meaning)?;
            }
            other => self.unused(&format!("elements <{other}>"), "element", "id", element, NOT_READ)?,
        }
        Ok(())
    }

    fn close(&mut self, _: &str, _: &str) {}
}

impl Reader<'_> {
    fn count(&mut self, kind: &str) {
        *self.net.counts.entry(kind.to_owned()).or_insert(0) += 1;
    }

    /// Counts an element that traffic does not use, named by this attribute.
    fn unused(
        &mut self,
        kind: &str,
        name: &'static str,
        key: &'static str,
        element: &Element,
        meaning: Meaning,
    ) -> Result<(), XmlError> {
        let [id] = element.values([key])?;
        self.net.unused.add(kind, (name, id.unwrap_or_default(), element.line), meaning);
        Ok(())
    }

    fn edge(&mut self, element: &Element) -> Result<(), XmlError> {
        let [id, function, kind] = element.values(["id", "function", "type"])?;
        let id = id.unwrap_or_default().into_owned();
        let function = match function.as_deref() {
            Some("internal") => Function::Internal,
            Some("crossing" | "walkingarea") => Function::Walking,
            _ => Function::Normal,
        };
        match function {
            Function::Walking => {
                let place = ("edge", &id, element.line);
                self.net.unused.add("crossings and areas for pedestrians", place, WALKING);
            }
            Function::Normal => self.count("edge"),
            Function::Internal => {}
        }
        let (kind, first_lane) = (kind.unwrap_or_default().into_owned(), self.net.lanes.len());
        self.net.edges.push(EdgeElement { id, function, kind, first_lane });
        Ok(())
    }

    fn lane(&mut self, element: &Element) -> Result<(), XmlError> {
        let [id, allow, disallow] = element.values(["id", "allow", "disallow"])?;
        let [speed, width, shape] = element.values(["speed", "width", "shape"])?;
        let [left, right] = element.values(["changeLeft", "changeRight"])?;
        let id = id.unwrap_or_default().into_owned();
        if id.is_empty() || !self.net.lane_ids.insert(id.clone()) {
            self.refuse(
                element,
                &format!("its id {id:?} is empty or there twice"),
                "give it an id of its own",
            );
            return Ok(());
        }
        // A lane always stands in an edge: that is its path.
        let edge = self.net.edges.len().saturating_sub(1);
        let lane = LaneElement {
            id,
            line: element.line,
            edge,
            speed: speed.map_or(f64::NAN, |it| number(&it)),
            width: width.map_or(USUAL_WIDTH, |it| number(&it)),
            shape: shape.map(|it| points(&it)).unwrap_or_default(),
            classes: permission::classes(allow.as_deref(), disallow.as_deref()),
            may_change: [left, right]
                .map(|it| it.is_none_or(|it| !permission::classes(Some(&it), None).is_empty())),
        };
        if self.net.edges[edge].function == Function::Normal {
            self.count("lane");
            if lane.classes.is_empty() {
                let whose = allow.map_or("nobody".into(), |it| it.into_owned());
                let place = ("lane", &lane.id, lane.line);
                self.net.unused.add(&format!("lanes for {whose}"), place, OF_OTHERS);
            }
        }
        self.net.lanes.push(lane);
        Ok(())
    }

    fn connection(&mut self, element: &Element) -> Result<(), XmlError> {
        let [from, from_lane, to, to_lane] = element.values(["from", "fromLane", "to", "toLane"])?;
        let [via, state, light, index] = element.values(["via", "state", "tl", "linkIndex"])?;
        let place = |it: Option<std::borrow::Cow<'_, str>>| it.and_then(|it| it.trim().parse().ok());
        let (Some(from), Some(to)) = (from, to) else {
            self.refuse(element, "it has no from or no to", "name both edges");
            return Ok(());
        };
        let (Some(from_lane), Some(to_lane)) = (place(from_lane), place(to_lane)) else {
            let remedy = "write fromLane and toLane as whole numbers from 0 on";
            self.refuse(element, "its lanes are not numbers", remedy);
            return Ok(());
        };
        self.net.connections.push(Connection {
            line: element.line,
            from: from.into_owned(),
            from_lane,
            to: to.into_owned(),
            to_lane,
            via: via.map(|it| it.into_owned()),
            state: state.and_then(|it| it.chars().next()).unwrap_or('-'),
            light: light.map(|it| it.into_owned()).zip(place(index)),
        });
        Ok(())
    }

    fn program(&mut self, element: &Element) -> Result<(), XmlError> {
        self.net.programs.add(element)?;
        let [id, kind] = element.values(["id", "type"])?;
        let (id, kind) = (id.unwrap_or_default(), kind.unwrap_or_default());
        self.count(&format!("tlLogic {kind}"));
        if kind != "static" {
            self.problems.push(Problem {
                element: format!("tlLogic {id}"),
                line: Some(element.line),
                what: format!("its type is {kind:?}, but its phases have their durations, whoever comes"),
                remedy: "leave it so, or give it the type static".into(),
            });
        }
        Ok(())
    }

    fn refuse(&mut self, element: &Element, what: &str, remedy: &str) {
        self.problems.push(Problem {
            element: format!("<{}>", element.name),
            line: Some(element.line),
            what: format!("{what}, so it is left out"),
            remedy: remedy.into(),
        });
    }

    fn junction(&mut self, element: &Element) -> Result<(), XmlError> {
        let [kind, internal] = element.values(["type", "intLanes"])?;
        let kind = kind.unwrap_or_default().into_owned();
        if kind != "internal" {
            self.count(&format!("junction {kind}"));
        }
        let internal = internal.unwrap_or_default();
        self.net.junctions.push(Junction {
            kind,
            internal_lanes: internal.split_whitespace().map(str::to_owned).collect(),
            requests: Vec::new(),
        });
        Ok(())
    }

    fn request(&mut self, element: &Element) -> Result<(), XmlError> {
        let [index, response, inside] = element.values(["index", "response", "cont"])?;
        let Some(index) = index.and_then(|it| it.trim().parse().ok()) else {
            self.refuse(element, "its index is no whole number", "number the requests from 0 on");
            return Ok(());
        };
        let response = response.unwrap_or_default();
        if let Some(junction) = self.net.junctions.last_mut() {
            junction.requests.push(Request {
                index,
                // The last character is that of the movement 0.
                response: response.chars().rev().map(|it| it == '1').collect(),
                waits_inside: inside.is_some_and(|it| is_true(&it)),
            });
        }
        Ok(())
    }
}

/// Whether SUMO takes this value as true.
fn is_true(value: &str) -> bool {
    matches!(value.trim(), "1" | "true" | "True" | "TRUE" | "yes" | "on" | "x" | "T" | "t")
}

/// The points of a shape: `x,y` or `x,y,z`, separated by blanks. One that is not is nowhere.
fn points(shape: &str) -> Vec<Point> {
    let point = |it: &str| {
        let mut numbers = it.split(',').map(number);
        let mut next = |missing: f64| {
            let value = numbers.next().unwrap_or(missing);
            if value.abs() <= MAXIMUM_COORDINATE { value } else { f64::NAN }
        };
        Point::new(next(f64::NAN), next(f64::NAN), next(0.0))
    };
    shape.split_whitespace().map(point).collect()
}
