//! Movements: ways over a junction, from a lane of one edge to a lane of another. Each is a connection with all
//! internal lanes on its way.

use std::collections::{HashMap, HashSet};

use laneweave_network::{Classes, Id, Lanelet, LaneletIndex, Point, Polyline};

use super::net::{Connection, Function, Net};
use super::{ByName, Places, line, link, side_of};
use crate::problem::Problem;

/// Maximum of movements that begin, or end, at a lane: what is built from them grows quadratically.
const MAXIMUM_SHARING: usize = 32;
/// Maximum of internal lanes on one way.
const MOST_PIECES: usize = 8;
const LEFT_OUT: &str = ", so it is left out";
/// A shorter way needs no lanelet [m].
const SHORTEST: f64 = 0.01;

/// A movement that became a lanelet.
pub(super) struct Movement<'a> {
    pub(super) connection: &'a Connection,
    pub(super) lanelet: LaneletIndex,
    /// The place of its last internal lane, which names it in its junction.
    pub(super) last: Option<usize>,
    /// Where its drivers wait if they wait within the junction: the distance along it [m].
    pub(super) inside: Option<f64>,
}

impl Movement<'_> {
    pub(super) fn problem(&self, what: &str, remedy: &str) -> Problem {
        problem(self.connection, what, remedy)
    }
}

/// Adds the movements to `lanelets`, and links them with the lanes from which and to which they lead.
pub(super) fn add<'a>(
    net: &'a Net,
    lanes: &Places,
    lanelets: &mut Vec<Lanelet>,
    problems: &mut Vec<Problem>,
) -> Vec<Movement<'a>> {
    let ways = Ways::of(net);
    let mut ids: HashSet<Id> = lanelets.iter().map(|it| it.id).collect();
    let mut movements: Vec<Movement<'a>> = Vec::new();
    let mut leading = vec![0; lanelets.len()];
    for connection in &net.connections {
        let [from, to] = match ways.ends(connection) {
            Ok(ends) => ends,
            Err(what) => {
                problems.push(problem(
                    connection,
                    &format!("{what}{LEFT_OUT}"),
                    "name an edge and a lane of the net",
                ));
                continue;
            }
        };
        // Those of internal lanes are part of others, and some lanes have no lanelet.
        let [Some(before), Some(after)] = [lanes[from], lanes[to]] else { continue };
        let pieces = ways.pieces(connection, to);
        let classes = pieces.iter().chain([&from, &to]).map(|it| net.lanes[*it].classes);
        let classes = classes.fold(Classes::ALL, Classes::shared);
        if classes.is_empty() {
            continue;
        }
        if lanelets[before.at()].following.len() >= MAXIMUM_SHARING || leading[after.at()] >= MAXIMUM_SHARING
        {
            let what = format!("{MAXIMUM_SHARING} others already begin or end there{LEFT_OUT}");
            problems.push(problem(connection, &what, "delete connections that are there twice"));
            continue;
        }
        let Some(id) = names(connection, &pieces, net).into_iter().find(|it| ids.insert(*it)) else {
            let what = format!("it is there twice{LEFT_OUT}");
            problems.push(problem(connection, &what, "delete one of them"));
            continue;
        };
        leading[after.at()] += 1;
        let ends = [before, after].map(|it| &lanelets[it.at()]);
        let Some((centre, joint)) = centre(net, &pieces, ends) else {
            lanelets[before.at()].following.push(after);
            continue;
        };
        let widths = [from, to].map(|it| net.lanes[it].width);
        let [left, right] = line::borders(&centre, widths);
        let speeds = pieces.iter().map(|it| net.lanes[*it].speed).filter(|it| *it > 0.0);
        let speed = speeds.fold(ends[0].speed_limit.min(ends[1].speed_limit), f64::min);
        let lanelet = LaneletIndex(lanelets.len() as u32);
        let mut made = Lanelet::alone(id, [left, right, centre], speed);
        made.classes = classes;
        made.is_in_town = lanelets[before.at()].is_in_town;
        made.following = vec![after];
        lanelets[before.at()].following.push(lanelet);
        lanelets.push(made);
        movements.push(Movement { connection, lanelet, last: pieces.last().copied(), inside: joint });
    }
    stand_beside(net, &movements, lanelets);
    movements
}

/// Makes movements neighbours that lie side by side on an internal edge: they lead from one edge to one other. Nobody
/// changes lanes there.
fn stand_beside(net: &Net, movements: &[Movement], lanelets: &mut [Lanelet]) {
    let mut by_place: Vec<(usize, LaneletIndex)> =
        movements.iter().filter_map(|it| Some((it.last?, it.lanelet))).collect();
    by_place.sort_unstable();
    for pair in by_place.windows(2) {
        let [(place, near), (next, far)] = [pair[0], pair[1]];
        if next != place + 1 || net.lanes[place].edge != net.lanes[next].edge {
            continue;
        }
        let side = side_of(&lanelets[near.at()], &lanelets[far.at()]);
        link(&mut lanelets[near.at()], far, side, false);
        link(&mut lanelets[far.at()], near, side.opposite(), false);
    }
}

/// What a movement may be called: like its first internal lane, or like the lanes that it joins.
fn names(connection: &Connection, pieces: &[usize], net: &Net) -> Vec<Id> {
    let first = pieces.first().map(|it| Id::from(net.lanes[*it].id.as_str()));
    first.into_iter().chain([Id::from(name(connection).as_str())]).collect()
}

fn name(Connection { from, from_lane, to, to_lane, .. }: &Connection) -> String {
    format!("{from}_{from_lane} to {to}_{to_lane}")
}

fn problem(connection: &Connection, what: &str, remedy: &str) -> Problem {
    Problem {
        element: format!("connection {}", name(connection)),
        line: Some(connection.line),
        what: what.into(),
        remedy: remedy.into(),
    }
}

/// Lanes by their names, and how internal lanes go on.
struct Ways<'a> {
    net: &'a Net,
    edges: ByName<'a>,
    lanes: ByName<'a>,
    /// The connection that begins at an internal lane.
    onward: HashMap<usize, &'a Connection>,
}

impl<'a> Ways<'a> {
    fn of(net: &'a Net) -> Ways<'a> {
        let edges = net.edges.iter().enumerate().map(|(number, it)| (it.id.as_str(), number)).collect();
        let lanes = net.lanes.iter().enumerate().map(|(number, it)| (it.id.as_str(), number)).collect();
        let mut ways = Ways { net, edges, lanes, onward: HashMap::new() };
        for connection in &net.connections {
            if let Ok([from, _]) = ways.ends(connection)
                && net.edges[net.lanes[from].edge].function == Function::Internal
            {
                ways.onward.insert(from, connection);
            }
        }
        ways
    }

    /// The places of the lanes at the ends of a connection.
    fn ends(&self, connection: &Connection) -> Result<[usize; 2], String> {
        let Connection { from, from_lane, to, to_lane, .. } = connection;
        Ok([self.lane(from, *from_lane)?, self.lane(to, *to_lane)?])
    }

    fn lane(&self, edge: &str, index: usize) -> Result<usize, String> {
        let number = *self.edges.get(edge).ok_or_else(|| format!("there is no edge {edge}"))?;
        let lane = self.net.edges[number].first_lane.saturating_add(index);
        let is_there = self.net.lanes.get(lane).is_some_and(|it| it.edge == number);
        is_there.then_some(lane).ok_or_else(|| format!("the edge {edge} has no lane {index}"))
    }

    /// The internal lanes between the ends of a connection that leads `to` a lane.
    fn pieces(&self, connection: &Connection, to: usize) -> Vec<usize> {
        let mut pieces = Vec::new();
        let mut via = connection.via.as_deref();
        while let Some(lane) = via.and_then(|it| self.lanes.get(it)).copied() {
            if pieces.len() == MOST_PIECES || pieces.contains(&lane) {
                break;
            }
            pieces.push(lane);
            let next = self.onward.get(&lane).copied();
            let is_on_the_way = |it: &&Connection| self.ends(it).is_ok_and(|[_, end]| end == to);
            via = next.filter(is_on_the_way).and_then(|it| it.via.as_deref());
        }
        pieces
    }
}

/// The centre line of a movement over these internal lanes between two lanelets, and where its first internal lane
/// ends, if there are several [m]; `None` if the lanelets meet.
fn centre(net: &Net, pieces: &[usize], [before, after]: [&Lanelet; 2]) -> Option<(Polyline, Option<f64>)> {
    let [start, end] = [before.centre.at(before.length()), after.centre.at(0.0)];
    let mut points: Vec<Point> = vec![start];
    let mut joint = None;
    for (number, piece) in pieces.iter().enumerate() {
        points.extend(
            net.lanes[*piece].shape.iter().copied().filter(|it| it.x.is_finite() && it.y.is_finite()),
        );
        if number == 0 && pieces.len() > 1 {
            joint = Polyline::new(points.iter().copied()).map(|it| it.length());
        }
    }
    if pieces.is_empty() {
        points
            .extend(curve([start, end], [before.centre.heading(before.length()), after.centre.heading(0.0)]));
    }
    points.push(end);
    let line = Polyline::new(points)?;
    (line.length() >= SHORTEST).then_some((line, joint))
}

/// Points of a curve between two points with these headings: a Bézier curve of third degree, as SUMO draws movements.
fn curve([start, end]: [Point; 2], headings: [f64; 2]) -> impl Iterator<Item = Point> {
    const PIECES: u32 = 8;
    let reach = start.distance(&end) / 3.0;
    let moved = |it: Point, heading: f64, by: f64| {
        Point::new(it.x + by * heading.cos(), it.y + by * heading.sin(), it.z)
    };
    let handles = [moved(start, headings[0], reach), moved(end, headings[1], -reach)];
    (1..PIECES).map(move |number| {
        let share = f64::from(number) / f64::from(PIECES);
        let between = |a: Point, b: Point| a.towards(&b, share);
        let sides = [between(start, handles[0]), between(handles[0], handles[1]), between(handles[1], end)];
        between(between(sides[0], sides[1]), between(sides[1], sides[2]))
    })
}
