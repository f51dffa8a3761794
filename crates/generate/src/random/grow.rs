//! The growth of a random map: from a cross-section at its edge, element by element, along every new road.

use std::collections::VecDeque;
use std::f64::consts::TAU;

use laneweave_network::{DrivingSide, Point};

use super::dice::Dice;
use super::element::{Builder, Built};
use super::ground::Ground;
use super::mouth::{Mouth, Width};
use super::stretch::Pen;
use super::{Element, Hazard, RandomMap};
use super::{
    alignment, bulge, fork, gap, junction, lane_end, merge, nested, ramp, ring, shared, strip, weave,
};
use crate::canvas::Canvas;
use crate::street::pose;

/// Once so much road is drawn, no road continues [m].
const ENOUGH: f64 = 2200.0;
/// Number of attempts before an element is left out.
const TRIES: usize = 6;
/// The same where only one kind of difficulty is drawn.
const TRIES_OF_ONE: usize = 120;
/// Number of elements along the first road, and along those that branch off.
const FIRST: [usize; 2] = [3, 7];
const FURTHER: [usize; 2] = [0, 2];
/// Probability of a street that is joined to nothing, and its maximum distance from the middle [m].
const ASIDE: f64 = 0.15;
const FAR: f64 = 300.0;
/// The road between elements, and to the edge of the map [m].
const BETWEEN: [f64; 2] = [15.0, 70.0];
const TO_EDGE: [f64; 2] = [40.0, 150.0];
/// A very short first lanelet [m].
const SHORT: [f64; 2] = [2.0, 8.0];
/// Widths of lanes [m], and speed limits [km/h].
const WIDTHS: [f64; 2] = [2.9, 3.75];
const LIMITS: [f64; 4] = [30.0, 50.0, 70.0, 100.0];

/// Elements for roads of one direction, and for streets of both; more likely ones are listed more than once.
const ONE_WAY: [Builder; 35] = [
    lane_end::narrowing,
    lane_end::narrowing,
    lane_end::opening,
    lane_end::blunt,
    ramp::closing,
    ramp::closing,
    ramp::closing,
    ramp::closing,
    ramp::opening,
    ramp::opening,
    strip::strip,
    fork::short_window,
    fork::short_window,
    alignment::sharp_bend,
    alignment::reverse_curve,
    fork::to_edge,
    merge::merge,
    merge::merge,
    nested::nested_fork,
    nested::nested_fork,
    nested::row_of_forks,
    nested::row_of_forks,
    lane_end::opening_at_light,
    lane_end::opening_at_light,
    bulge::bulge,
    bulge::bulge,
    weave::shared_entrance,
    weave::shared_entrance,
    weave::merge_then_exit,
    weave::crossing_exits,
    weave::crossing_exits,
    fork::short_window,
    fork::tiny_window,
    fork::tiny_window,
    gap::gap,
];
const TWO_WAY: [Builder; 15] = [
    fork::divided,
    shared::one_lane_street,
    shared::one_lane_street,
    shared::partial_overlap,
    junction::junction,
    junction::junction,
    junction::junction,
    ring::roundabout,
    ring::short_arms,
    ring::short_arms,
    gap::turn_back,
    gap::turn_back,
    strip::strip,
    alignment::sharp_bend,
    alignment::reverse_curve,
];
const ANY: [Builder; 3] = [alignment::short_lanelets, alignment::narrow_lanes, alignment::hairpin];

/// A road that may continue.
struct Bud {
    mouth: Mouth,
    /// Maximum of further elements.
    elements: usize,
}

/// A map under construction.
struct Growth {
    pen: Pen,
    ground: Ground,
    elements: Vec<Element>,
    buds: VecDeque<Bud>,
    /// The only difficulty that it may have, if there is one.
    only: Option<Hazard>,
}

/// Grows the map of a seed, with all kinds of difficulties or `only` one; each attempt is different.
pub(super) fn grow(seed: u64, attempt: u64, only: Option<Hazard>) -> RandomMap {
    let pen = Pen { canvas: Canvas::new(), dice: Dice::new(seed, attempt), length: 0.0 };
    let mut growth =
        Growth { pen, ground: Ground::default(), elements: Vec::new(), buds: VecDeque::new(), only };
    growth.begin();
    while let Some(bud) = growth.buds.pop_front() {
        growth.go_on(bud);
    }
    growth.set_aside();
    let Growth { pen, elements, .. } = growth;
    RandomMap { drawing: pen.canvas.tidied().finish(DrivingSide::Right), elements, length_m: pen.length }
}

impl Growth {
    /// Draws the edge of the map where it begins.
    fn begin(&mut self) {
        let Pen { canvas, dice, .. } = &mut self.pen;
        let width = Width { lane: dice.between(WIDTHS[0], WIDTHS[1]), limit_kmh: dice.pick(&LIMITS) };
        let at = pose(0.0, 0.0, dice.between(0.0, TAU));
        let elements = dice.count(FIRST[0], FIRST[1]);
        let ahead = dice.chance(0.7);
        let lanes = dice.count(1, 3);
        let (edge, builder): (Mouth, Builder) = match dice.count(0, 11) {
            10 => (Mouth::one_way(canvas, at, lanes, ahead, width), from_short_lanelet),
            11 => (Mouth::two_way(canvas, at, 0.0, width), from_short_lanelet),
            0..3 => (Mouth::one_way(canvas, at, lanes, ahead, width), from_edge),
            3..6 => (Mouth::one_way(canvas, at, 1, ahead, width), fork::from_edge),
            6 => (Mouth::two_way(canvas, at, 0.0, width), shared::from_edge),
            _ => (Mouth::two_way(canvas, at, 0.0, width), from_edge),
        };
        if !self.build(&edge, None, builder, elements) {
            self.build(&edge, None, from_edge, elements);
        }
    }

    /// Draws, with a probability, a street that is joined to nothing.
    fn set_aside(&mut self) {
        if !self.pen.dice.chance(ASIDE) {
            return;
        }
        for _ in 0..TRIES {
            let Pen { canvas, dice, .. } = &mut self.pen;
            let [x, y] = [(); 2].map(|()| dice.between(-FAR, FAR));
            let at = pose(x, y, dice.between(0.0, TAU));
            let width = Width { lane: dice.between(WIDTHS[0], WIDTHS[1]), limit_kmh: 50.0 };
            let edge = Mouth::two_way(canvas, at, 0.0, width);
            if self.build(&edge, None, shared::edge_to_edge, 0) {
                return;
            }
        }
    }

    /// Continues a road: with an element, or to the edge of the map.
    fn go_on(&mut self, Bud { mouth, elements }: Bud) {
        let joint = Some(mouth.pose.at);
        if elements > 0 && self.pen.length < ENOUGH {
            let tries = if self.only.is_some() { TRIES_OF_ONE } else { TRIES };
            for _ in 0..tries {
                if self.build(&mouth, joint, any, elements - 1) {
                    return;
                }
            }
        }
        // Without free area the road ends where it is.
        self.build(&mouth, joint, to_edge, 0);
    }

    /// Draws an element if its area is free; the new roads continue, the first one with so many elements.
    fn build(&mut self, mouth: &Mouth, joint: Option<Point>, builder: Builder, elements: usize) -> bool {
        let mut pen = self.pen.clone();
        let first = pen.canvas.drawing().lanes.len();
        let built = builder(&mut pen, mouth);
        // The next element uses other random numbers, even if this one is left out.
        self.pen.dice = pen.dice.clone();
        let Some(Built { mouths, hazard }) = built else { return false };
        let is_wanted = self.only.is_none_or(|only| hazard.is_none_or(|it| it == only));
        if !is_wanted || !self.ground.take(&pen, first, joint) {
            return false;
        }
        let lanelets = first as i64 + 1..pen.canvas.drawing().lanes.len() as i64 + 1;
        self.elements.push(Element { hazard, lanelets });
        for (number, mouth) in mouths.into_iter().enumerate() {
            let further = pen.dice.count(FURTHER[0], FURTHER[1]);
            self.buds.push_back(Bud { mouth, elements: if number == 0 { elements } else { further } });
        }
        self.pen = pen;
        true
    }
}

/// The road from the edge of the map onwards.
fn from_edge(pen: &mut Pen, edge: &Mouth) -> Option<Built> {
    Some(Built { mouths: vec![pen.straight(edge, TO_EDGE)], hazard: None })
}

/// The same with a very short first lanelet.
fn from_short_lanelet(pen: &mut Pen, edge: &Mouth) -> Option<Built> {
    let short = pen.straight(edge, SHORT);
    Some(Built::road(pen.straight(&short, TO_EDGE), Hazard::ShortEntrance))
}

/// The road to the edge of the map.
fn to_edge(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    pen.straight(mouth, TO_EDGE);
    Some(Built { mouths: Vec::new(), hazard: None })
}

/// A piece of road, then an element that can follow.
fn any(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    let mut mouth = mouth.clone();
    if pen.dice.chance(0.4) {
        mouth.limit_kmh = pen.dice.pick(&LIMITS);
    }
    let length = pen.dice.between(BETWEEN[0], BETWEEN[1]);
    let path = pen.gentle(&mouth, length);
    let mouth = pen.go_on(&mouth, path);
    let own: &[Builder] = if mouth.is_two_way() { &TWO_WAY } else { &ONE_WAY };
    let choices = if pen.dice.chance(0.2) { &ANY } else { own };
    let builder = pen.dice.pick(choices);
    builder(pen, &mouth)
}
