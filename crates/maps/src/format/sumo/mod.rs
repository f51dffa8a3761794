//! Road networks of SUMO (`.net.xml`), after the format's description at <https://sumo.dlr.de/docs/Networks> as of
//! version 1.20; what stands in brackets is ours.
//!
//! A lane of an edge becomes a lanelet, and so does each movement: a connection with all of its internal lanes, which
//! has the id of the first of them. What follows what is told by the connections, not by shapes. Where the format
//! leaves something open, these rules apply:
//!
//! * The shape of a lane is its centre line; it is 3.2 m wide unless the net says otherwise. A movement is as wide as
//!   the lanes that it joins.
//! * `allow` and `disallow` say who uses a lane. Lanes that none of our classes may use are left out, and named.
//! * The `request` rows of a junction say who gives way to whom, and at which line. Where priority is from the right or
//!   the left it follows from the shape, so that four who wait for each other go on.
//! * A light follows the program of its junction: of several the last one, and of actuated ones the durations of their
//!   phases. A green that yields is a green: who gives way is said by the requests.
//! * [An edge lies in a town if it has no motorway's type and a limit of at most 60 km/h: the format does not say.]

mod light;
mod line;
mod movement;
mod net;
mod permission;
mod program;
mod right_of_way;

use std::collections::HashMap;

use laneweave_network::{DrivingSide, Lanelet, LaneletIndex, Network, Polyline, Side};

use crate::contents::Contents;
use crate::drawing::KMH_PER_MPS;
use crate::error::MapError;
use crate::graph::Graph;
use crate::map::Map;
use crate::options::ReadOptions;
use crate::problem::Problem;
use crate::size::Size;
use crate::xml::XmlError;
use net::{Function, LaneElement, Net};
use program::Programs;
use right_of_way::Rules;

/// Limits up to this are those of streets in towns [km/h].
const FASTEST_IN_TOWN: f64 = 60.0;
/// Limits above this are taken as errors [km/h].
const FASTEST: f64 = 500.0;
/// A longer lane has a point that is far off [m].
const LONGEST: f64 = 100_000.0;

/// Reads a road network of SUMO. Lanes that cannot be used as they stand are left out and listed as problems.
///
/// # Errors
/// If it is no such XML or holds no lane that vehicles may use.
pub fn read(bytes: &[u8], options: &ReadOptions) -> Result<Map, MapError> {
    if bytes.len() as u64 > Size::MAXIMUM.0 {
        return Err(MapError::TooLarge { largest: Size::MAXIMUM });
    }
    let mut problems = Vec::new();
    let mut net = net::parse(bytes, &mut problems)?;
    let mut lanelets = Vec::new();
    let lanes = lanes(&net, &mut lanelets, &mut problems);
    stand_beside(&net, &lanes, &mut lanelets);
    let movements = movement::add(&net, &lanes, &mut lanelets, &mut problems);
    let mut rules = Rules::of(&lanelets);
    let programs = light::add(&net, &movements, &mut rules, &mut problems);
    right_of_way::add(&net, &movements, &mut rules);
    let rules = rules.all;
    let contents = Contents { counts: std::mem::take(&mut net.counts), ..Contents::default() };
    problems.extend(std::mem::take(&mut net.unused).problems());
    if lanelets.is_empty() {
        let remedy = "give edges lanes that passenger cars may use";
        return Err(MapError::NotDrivable { lanelets: net.lanes.len(), problems, remedy });
    }
    let (graph, heaps) = Graph::of(&lanelets);
    problems.extend(heaps);
    problems.sort_by_key(|it| it.line);
    let of_net = if net.is_left_hand { DrivingSide::Left } else { DrivingSide::Right };
    let mut network = Network::new(lanelets, options.driving_side.unwrap_or(of_net))?;
    network.law = options.law.rules();
    Ok(Map { network, graph, rules, programs, contents, problems, origin: None })
}

/// Replaces programs of lights of `map`, which is a net, by those of an additional file. What has no light becomes a
/// problem of the map.
///
/// # Errors
/// If the file is no XML.
pub fn add_programs(map: &mut Map, additional: &[u8]) -> Result<(), XmlError> {
    let programs = Programs::of_additional(additional)?;
    for name in light::replace(map, &programs) {
        map.problems.push(Problem {
            element: format!("tlLogic {name}"),
            line: None,
            what: "no light of the net has it, or its phases have no sound states, so it is not used".into(),
            remedy: "name a junction of the net, and give each phase a duration and a state for each link"
                .into(),
        });
    }
    Ok(())
}

/// For each lane of a net the lanelet that it became.
type Places = Vec<Option<LaneletIndex>>;

/// Adds the lanes of edges that vehicles may use, without links.
fn lanes(net: &Net, lanelets: &mut Vec<Lanelet>, problems: &mut Vec<Problem>) -> Places {
    let mut lanes = vec![None; net.lanes.len()];
    for (number, lane) in net.lanes.iter().enumerate() {
        let edge = &net.edges[lane.edge];
        if edge.function != Function::Normal || lane.classes.is_empty() {
            continue;
        }
        match centre_of(lane).map(|it| (line::borders(&it, [lane.width; 2]), it)) {
            Ok(([left, right], centre)) => {
                lanes[number] = Some(LaneletIndex(lanelets.len() as u32));
                let mut lanelet = Lanelet::alone(lane.id.as_str(), [left, right, centre], lane.speed);
                lanelet.classes = lane.classes;
                lanelet.is_in_town = lane.speed <= FASTEST_IN_TOWN / KMH_PER_MPS && !edge.is_motorway();
                lanelets.push(lanelet);
            }
            Err((what, remedy)) => problems.push(lane.problem(what, remedy)),
        }
    }
    lanes
}

/// The centre line of a lane; or what is wrong with it, and the remedy.
fn centre_of(lane: &LaneElement) -> Result<Polyline, (&'static str, &'static str)> {
    if !(lane.speed > 0.0 && lane.speed <= FASTEST / KMH_PER_MPS) {
        let what = "its speed is not above 0 and up to 500 km/h, so it is left out";
        return Err((what, "write it in m/s, like 13.89"));
    }
    if !(lane.width > 0.1 && lane.width < 50.0) {
        return Err((
            "its width is not between 0.1 and 50 m, so it is left out",
            "write it in metres, like 3.2",
        ));
    }
    let line = Polyline::new(lane.shape.iter().copied()).ok_or((
        "its shape is not two points or more, so it is left out",
        "write shape=\"x,y x,y\", in metres",
    ))?;
    if line.length() > LONGEST {
        return Err(("it is longer than 100 km, so it is left out", "correct the point that is far away"));
    }
    Ok(line)
}

/// Makes lanes of an edge neighbours.
fn stand_beside(net: &Net, lanes: &Places, lanelets: &mut [Lanelet]) {
    for number in 1..net.lanes.len() {
        let pair = [number - 1, number];
        let [Some(near), Some(far)] = pair.map(|it| lanes[it]) else { continue };
        let [one, other] = pair.map(|it| &net.lanes[it]);
        if one.edge != other.edge {
            continue;
        }
        let side = side_of(&lanelets[near.at()], &lanelets[far.at()]);
        link(&mut lanelets[near.at()], far, side, one.may_change[side.at()]);
        let back = side.opposite();
        link(&mut lanelets[far.at()], near, back, other.may_change[back.at()]);
    }
}

/// On which side of a lanelet another one lies.
fn side_of(lanelet: &Lanelet, other: &Lanelet) -> Side {
    let middle = 0.5 * lanelet.length();
    let (at, there) = (lanelet.centre.at(middle), other.centre.at(0.5 * other.length()));
    let (sine, cosine) = lanelet.centre.heading(middle).sin_cos();
    let is_left = cosine * (there.y - at.y) - sine * (there.x - at.x) > 0.0;
    if is_left { Side::Left } else { Side::Right }
}

fn link(lanelet: &mut Lanelet, there: LaneletIndex, side: Side, may_change: bool) {
    let Lanelet { left, right, adjacent_left, adjacent_right, .. } = lanelet;
    let place = match (side, may_change) {
        (Side::Left, true) => left,
        (Side::Left, false) => adjacent_left,
        (Side::Right, true) => right,
        (Side::Right, false) => adjacent_right,
    };
    *place = Some(there);
}

/// Numbers by text.
type ByName<'a> = HashMap<&'a str, usize>;
