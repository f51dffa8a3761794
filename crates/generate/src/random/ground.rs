//! Free areas: elements keep a distance from each other.

use laneweave_network::{Point, Polygon};

use super::stretch::Pen;

/// Minimum distance between elements that are not joined [m]. Ours.
const CLEARANCE: f64 = 6.0;
/// Within this distance of their joint, elements may be nearer to each other [m]. Ours.
const AROUND_JOINT: f64 = 25.0;
/// Distance between the samples along a border [m].
const STEP: f64 = 3.0;

/// The areas of an element's lanelets.
#[derive(Debug, Default)]
pub(super) struct Ground {
    lots: Vec<Lot>,
}

/// The area of one lanelet.
#[derive(Debug)]
struct Lot {
    outline: Polygon,
    /// Points along its borders.
    places: Vec<[f64; 2]>,
}

impl Ground {
    /// Takes the area of an element, all lanelets from number `first` on, if it is free beside the existing ones;
    /// around its joint it may be near to them.
    pub(super) fn take(&mut self, pen: &Pen, first: usize, joint: Option<Point>) -> bool {
        let drawing = pen.canvas.drawing();
        let outlines = drawing.lanes[first..].iter().filter_map(|it| drawing.outline(it));
        let lots: Vec<Lot> = outlines.map(|outline| Lot { places: places(&outline), outline }).collect();
        let is_near = |place: &[f64; 2]| {
            joint.is_some_and(|it| libm::hypot(place[0] - it.x, place[1] - it.y) < AROUND_JOINT)
        };
        let has_room = lots.iter().all(|lot| self.lots.iter().all(|other| lot.keeps_away(other, is_near)));
        if has_room {
            self.lots.extend(lots);
        }
        has_room
    }
}

impl Lot {
    fn keeps_away(&self, other: &Lot, is_near: impl Fn(&[f64; 2]) -> bool) -> bool {
        let ([low, high], [from, to]) = (self.outline.bounds(), other.outline.bounds());
        if (0..2).any(|axis| low[axis] > to[axis] + CLEARANCE || from[axis] > high[axis] + CLEARANCE) {
            return true;
        }
        let mine = || self.places.iter().filter(|it| !is_near(it));
        let is_far = |a: &[f64; 2]| {
            other.places.iter().all(|b| (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2) > CLEARANCE * CLEARANCE)
        };
        mine().all(is_far) && !self.outline.overlaps(&other.outline)
    }
}

/// Points along an outline.
fn places(outline: &Polygon) -> Vec<[f64; 2]> {
    let corners = outline.points();
    let mut places = Vec::new();
    for (from, to) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        let steps = (libm::hypot(to[0] - from[0], to[1] - from[1]) / STEP).ceil().max(1.0);
        places.extend((0..steps as usize).map(|it| {
            let share = it as f64 / steps;
            [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * share)
        }));
    }
    places
}
