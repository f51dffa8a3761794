//! Junctions: where streets meet at right angles.

use std::collections::HashMap;

use laneweave_maps::drawing::{Edge, Surroundings};
use laneweave_network::{Id, Pose};

use super::canvas::Canvas;
use super::compass::Compass;
use super::movement::{Lanes, Movement};
use super::path::Path;
use super::street::{LANE_WIDTH, LaneEnd};

/// Radius of the middle of the sharpest turn to the right [m]. Ours.
const RADIUS: f64 = 10.0;

/// A street where it meets a junction.
#[derive(Clone, Debug)]
pub(super) struct Arm {
    /// The direction of the street, seen from the junction.
    pub(super) towards: Compass,
    /// Lanes that end at the junction, from left to right.
    pub(super) arriving: Vec<LaneEnd>,
    /// Lanes that begin there, from left to right.
    pub(super) leaving: Vec<LaneEnd>,
    pub(super) limit_kmh: f64,
}

impl Arm {
    /// The lanelets that arrive, and those that leave.
    pub(super) fn ways(&self, connectors: &[Connector]) -> Vec<Id> {
        let own = connectors.iter().filter(|it| it.from == self.towards).map(|it| it.lanelet);
        self.arriving.iter().map(|it| it.lanelet).chain(own).collect()
    }
}

/// A lanelet that leads over a junction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Connector {
    /// The arm from which it comes.
    pub(super) from: Compass,
    pub(super) lanelet: Id,
}

/// Distance from the middle of a junction to the end of its arm [m], large enough for turns from and to the crossing
/// arms.
pub(super) fn setback(arms: &[Lanes; 4], towards: Compass) -> f64 {
    let across = Compass::ALL.into_iter().filter(|it| it.is_along_east() != towards.is_along_east());
    let lanes = across.map(|it| arms[it as usize]).map(|it| it.arriving.max(it.leaving)).max().unwrap_or(0);
    (lanes.max(1) as f64 - 0.5) * LANE_WIDTH + RADIUS
}

/// Draws the paths over a junction.
pub(super) fn connect(canvas: &mut Canvas, arms: &[Arm], movements: &[Movement]) -> Vec<Connector> {
    let arm = |towards: Compass| arms.iter().find(|it| it.towards == towards);
    let mut borders = Borders::default();
    let mut connectors = Vec::new();
    for movement in movements {
        let (Some(from), Some(to)) = (arm(movement.from), arm(movement.to)) else { continue };
        let ends = (from.arriving.get(movement.lane), to.leaving.get(movement.onto));
        let (Some(begin), Some(end)) = ends else { continue };
        let headings = [movement.from.opposite().heading(), movement.to.heading()];
        let lanelet = borders.connector(canvas, [*begin, *end], headings, from.limit_kmh);
        connectors.push(Connector { from: movement.from, lanelet });
    }
    connectors
}

/// Borders that already exist between two points; connectors side by side share them.
#[derive(Default)]
pub(super) struct Borders(HashMap<[u32; 2], u32>);

impl Borders {
    /// Draws a lanelet from the end of one lane to the beginning of another one, and returns its id.
    pub(super) fn connector(
        &mut self,
        canvas: &mut Canvas,
        [begin, end]: [LaneEnd; 2],
        headings: [f64; 2],
        limit_kmh: f64,
    ) -> Id {
        let sides = [[begin.left, end.left], [begin.right, end.right]];
        let edges = sides.map(|it| Edge { border: self.border(canvas, it, headings), reversed: false });
        canvas.lane(edges, Surroundings::Town, limit_kmh)
    }

    fn border(&mut self, canvas: &mut Canvas, ends: [u32; 2], [from, to]: [f64; 2]) -> u32 {
        *self.0.entry(ends).or_insert_with(|| {
            let pose = |point: u32, heading: f64| Pose { at: canvas.at(point), heading };
            let path = Path::between(pose(ends[0], from), pose(ends[1], to));
            let mut points = vec![ends[0]];
            points.extend(path.bends().iter().map(|it| canvas.point(path.beside(*it, 0.0))));
            points.push(ends[1]);
            canvas.imaginary(points)
        })
    }
}
