//! What stands still: the roads of a map and what is on them, for a page to draw.

use std::collections::HashSet;

use laneweave::maps::{Contents, Map, Marking, MarkingPaint};
use laneweave::network::{
    Chain, ChainIndex, Classes, DrivingSide, Gate, InPlan, Lanelet, LaneletIndex, Light, Network, Point,
    Polyline, Sign,
};
use laneweave::{Id, Side, network};
use serde::Serialize;

/// Coordinates in a scene are rounded to this [m].
const GRAIN: f64 = 0.01;
/// Lights hang at this height [m].
const LIGHT_HEIGHT: f64 = 3.0;

/// A line: x, y and z of its points in turn, from the origin of the scene [m].
type Line = Vec<f64>;

/// What stands still. Its JSON is described in the reference of the viewer's protocol.
#[derive(Clone, Debug, Serialize)]
pub struct Scene {
    version: u32,
    title: String,
    driving_side: &'static str,
    /// Where its coordinates are 0 on the map [m].
    pub origin: [f64; 3],
    pub(crate) bounds: [f64; 4],
    pub(crate) lanelets: Vec<LaneletLines>,
    pub(crate) markings: Vec<MarkingLine>,
    pub(crate) crosswalks: Vec<Line>,
    pub(crate) stop_lines: Vec<StopLine>,
    lights: Vec<LightPosts>,
    entrances: Vec<GateArrow>,
    exits: Vec<GateArrow>,
}

#[derive(Clone, Debug, Serialize)]
pub(crate) struct LaneletLines {
    id: String,
    pub(crate) left: Line,
    pub(crate) right: Line,
    centre: Line,
    limit_kmh: f64,
    is_conflict: bool,
    /// The names of the classes that may use it, if these are not all.
    pub(crate) only_for: Option<String>,
}

#[derive(Clone, Debug, Serialize)]
pub(crate) struct MarkingLine {
    pub(crate) line: Line,
    pub(crate) paint: &'static str,
    pub(crate) is_thick: bool,
}

#[derive(Clone, Debug, Serialize)]
pub(crate) struct StopLine {
    pub(crate) line: Line,
    kind: &'static str,
    pub(crate) light: Option<usize>,
}

/// The plan of a light: lights with the same first light share it.
#[derive(Clone, Copy, Debug, Serialize)]
struct PlanFacts {
    first: usize,
    cycle_s: f64,
    offset_s: f64,
}

impl PlanFacts {
    fn of(light: &Light) -> Option<PlanFacts> {
        let InPlan { first, offset, .. } = light.plan.filter(|it| !it.is_actuated)?;
        Some(PlanFacts { first: first.at(), cycle_s: light.program.cycle, offset_s: offset })
    }
}

#[derive(Clone, Debug, Serialize)]
struct LightPosts {
    id: String,
    /// None for a light that is always green, or whose greens traffic extends.
    plan: Option<PlanFacts>,
    at: Vec<[f64; 3]>,
}

#[derive(Clone, Debug, Serialize)]
struct GateArrow {
    id: String,
    at: [f64; 3],
    heading: f64,
}

/// What a map has beside its network.
#[derive(Clone, Debug)]
pub struct Surroundings {
    contents: Contents,
    /// Whether vehicles on a lanelet may meet others that cross it.
    is_conflict: Vec<bool>,
}

impl Surroundings {
    /// Those of a `map`.
    pub fn of(map: &Map) -> Surroundings {
        let is_conflict = map.graph.conflicting.iter().map(|it| !it.is_empty()).collect();
        Surroundings { contents: map.contents.clone(), is_conflict }
    }
}

impl Scene {
    /// The scene of a road network with what else its map has.
    pub fn new(title: &str, network: &Network, around: &Surroundings) -> Scene {
        let Surroundings { contents, is_conflict } = around;
        let [low, high] = extent(network);
        let origin = [0, 1, 2].map(|axis| ((low[axis] + high[axis]) / 2.0).round());
        let frame = Frame { origin };
        let lanelets = network.lanelets.iter().zip(is_conflict);
        let (stop_lines, lights) = stops(network, &frame);
        Scene {
            version: 1,
            title: title.to_owned(),
            driving_side: match network.driving_side {
                DrivingSide::Left => "left",
                DrivingSide::Right => "right",
            },
            origin,
            bounds: [low[0] - origin[0], low[1] - origin[1], high[0] - origin[0], high[1] - origin[1]],
            lanelets: lanelets.map(|(it, is_conflict)| frame.lanelet(it, *is_conflict)).collect(),
            markings: markings(network, &contents.markings, &frame),
            crosswalks: contents.crosswalks.iter().map(|it| frame.line(it)).collect(),
            stop_lines,
            lights,
            entrances: frame.gates(network, &network.entrances, false),
            exits: frame.gates(network, &network.exits, true),
        }
    }
}

/// The frame of coordinates of a scene.
struct Frame {
    origin: [f64; 3],
}

impl Frame {
    fn point(&self, it: &Point) -> [f64; 3] {
        let round = |value: f64| (value / GRAIN).round() * GRAIN;
        // Twice rounded: 0.01 × n is no short decimal number otherwise.
        let short = |value: f64| (round(value) * 100.0).round() / 100.0;
        [short(it.x - self.origin[0]), short(it.y - self.origin[1]), short(it.z - self.origin[2])]
    }

    fn line(&self, points: &[Point]) -> Line {
        points.iter().flat_map(|it| self.point(it)).collect()
    }

    fn lanelet(&self, it: &Lanelet, is_conflict: bool) -> LaneletLines {
        LaneletLines {
            id: it.id.to_string(),
            left: self.line(it.left_border.points()),
            right: self.line(it.right_border.points()),
            centre: self.line(it.centre.points()),
            limit_kmh: (it.speed_limit * 36.0).round() / 10.0,
            is_conflict,
            only_for: (it.classes != Classes::ALL).then(|| it.classes.names()),
        }
    }

    /// The arrows of the lanes of `gates`, at the first or at the `last` station.
    fn gates(&self, network: &Network, gates: &[Gate], last: bool) -> Vec<GateArrow> {
        let lanes = gates.iter().flat_map(|gate| gate.chains.iter().map(move |it| (gate.id, it)));
        let arrow = |(id, chain): (Id, &ChainIndex)| {
            let chain = network.chain(*chain);
            let station = if last { chain.length } else { 0.0 };
            let (at, heading) = (chain.centre.at(station), chain.centre.heading(station));
            GateArrow { id: id.to_string(), at: self.point(&at), heading }
        };
        lanes.map(arrow).collect()
    }
}

/// The lowest and the highest coordinates of all borders [m].
fn extent(network: &Network) -> [[f64; 3]; 2] {
    let borders = network.lanelets.iter().flat_map(|it| [&it.left_border, &it.right_border]);
    borders.flat_map(|it| it.points()).fold(
        [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]],
        |[low, high], it| {
            let at = [it.x, it.y, it.z];
            [0, 1].map(|end| {
                [0, 1, 2]
                    .map(|axis| if end == 0 { low[axis].min(at[axis]) } else { high[axis].max(at[axis]) })
            })
        },
    )
}

/// Where drivers stop, and the lights for which they do.
fn stops(network: &Network, frame: &Frame) -> (Vec<StopLine>, Vec<LightPosts>) {
    let posts = |it: &Light| LightPosts { id: it.id.to_string(), plan: PlanFacts::of(it), at: Vec::new() };
    let mut lights: Vec<LightPosts> = network.junctions.lights.iter().map(posts).collect();
    let mut lines = Vec::new();
    for (number, chain) in network.chains.iter().enumerate() {
        for stop in &network.junctions.on(ChainIndex(number as u32)).stops {
            let [left, right] = across(network, chain, stop.station);
            let (kind, light) = match stop.sign {
                Sign::Light(light) => ("light", Some(light.at())),
                Sign::Stop => ("stop_sign", None),
                Sign::Line => ("line", None),
            };
            let line = frame.line(&[left, right]);
            // Several chains begin on the same lanelets.
            if lines.iter().any(|it: &StopLine| it.line == line && it.light == light) {
                continue;
            }
            if let Some(posts) = light.and_then(|it| lights.get_mut(it)) {
                let outside = match network.driving_side {
                    DrivingSide::Left => left,
                    DrivingSide::Right => right,
                };
                posts.at.push(frame.point(&Point { z: outside.z + LIGHT_HEIGHT, ..outside }));
            }
            lines.push(StopLine { line, kind, light });
        }
    }
    (lines, lights)
}

/// The points on the left and on the right border of a chain at a station.
fn across(network: &Network, chain: &Chain, station: f64) -> [Point; 2] {
    let number = chain.starts.partition_point(|it| *it <= station).saturating_sub(1);
    let lanelet = &network.lanelets[chain.lanelets[number].at()];
    let share = ((station - chain.starts[number]) / lanelet.length()).clamp(0.0, 1.0);
    [&lanelet.left_border, &lanelet.right_border].map(|it| it.at(share * it.length()))
}

/// The lines that the map has, or else those that its rules tell.
fn markings(network: &Network, known: &[Marking], frame: &Frame) -> Vec<MarkingLine> {
    if known.is_empty() {
        return told_by_rules(network, frame);
    }
    let line = |it: &Marking| MarkingLine {
        line: frame.line(&it.line),
        paint: match it.paint {
            MarkingPaint::Dashed => "dashed",
            MarkingPaint::Solid => "solid",
            MarkingPaint::DashedSolid => "dashed_solid",
            MarkingPaint::SolidDashed => "solid_dashed",
            MarkingPaint::SolidSolid => "solid_solid",
            MarkingPaint::DashedDashed => "dashed_dashed",
            MarkingPaint::Curb => "curb",
            MarkingPaint::Barrier => "barrier",
            MarkingPaint::Edge => "edge",
        },
        is_thick: it.is_thick,
    };
    known.iter().map(line).collect()
}

/// Lines as the rules of a map without any have them: a dashed one where a change is allowed, a solid one between
/// lanes where none is, an edge where no lane is beside. A border of two lanelets is drawn once.
fn told_by_rules(network: &Network, frame: &Frame) -> Vec<MarkingLine> {
    let mut drawn: HashSet<[u64; 4]> = HashSet::new();
    let mut lines = Vec::new();
    for (number, lanelet) in network.lanelets.iter().enumerate() {
        for (side, border) in Side::BOTH.into_iter().zip([&lanelet.left_border, &lanelet.right_border]) {
            if !drawn.insert(ends(border)) {
                continue;
            }
            let paint = paint_between(network, LaneletIndex(number as u32), side);
            lines.push(MarkingLine { line: frame.line(border.points()), paint, is_thick: false });
        }
    }
    lines
}

/// The ends of a line, in an order that does not depend on its direction.
fn ends(line: &Polyline) -> [u64; 4] {
    let mut ends = [line.points().first(), line.points().last()]
        .map(|it| it.map_or([0; 2], |it| [it.x.to_bits(), it.y.to_bits()]));
    ends.sort_unstable();
    [ends[0][0], ends[0][1], ends[1][0], ends[1][1]]
}

fn paint_between(network: &Network, lanelet: LaneletIndex, side: Side) -> &'static str {
    let (here, back) = (&network.lanelets[lanelet.at()], side.opposite());
    let adjacent = match side {
        Side::Left => here.adjacent_left,
        Side::Right => here.adjacent_right,
    };
    let returns = |it: &network::Lanelet| it.beside(back) == Some(lanelet);
    match (here.beside(side), adjacent) {
        (Some(_), _) => "dashed",
        (None, Some(other)) if returns(&network.lanelets[other.at()]) => match side {
            Side::Left => "dashed_solid",
            Side::Right => "solid_dashed",
        },
        (None, Some(_)) => "solid",
        (None, None) => "edge",
    }
}
