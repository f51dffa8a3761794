//! The approaches of a junction: lights at lanes that come side by side, or one after the other, in one direction.

use std::f64::consts::FRAC_PI_6;

use super::components::components;
use super::lanes::Lane;
use crate::geometry::{Point, turn};
use crate::junction::LightIndex;

/// Lanes of one approach: their directions differ by less [rad], and each of their lines is this near to another [m],
/// or lies on a way from it. Ours.
const ONE_DIRECTION: f64 = FRAC_PI_6;
const BESIDE: f64 = 15.0;

/// An approach.
pub(super) struct Approach<'a> {
    /// Its lights, in order.
    pub(super) lights: Vec<LightIndex>,
    pub(super) lanes: Vec<&'a Lane>,
    /// Its direction at the line [rad].
    pub(super) heading: f64,
}

/// The approaches of a junction with these `lanes`, in the order of their first lights.
pub(super) fn approaches<'a>(lanes: &[&'a Lane]) -> Vec<Approach<'a>> {
    let near = |at: usize| (0..lanes.len()).filter(move |it| are_joined(lanes[at], lanes[*it]));
    let approach = |group: Vec<usize>| {
        let lanes: Vec<&Lane> = group.iter().map(|it| lanes[*it]).collect();
        let mut lights: Vec<LightIndex> = lanes.iter().map(|it| it.light).collect();
        lights.sort_unstable();
        lights.dedup();
        Approach { heading: lanes[0].heading, lights, lanes }
    };
    let mut found: Vec<Approach> = components(lanes.len(), near).into_iter().map(approach).collect();
    found.sort_by_key(|it| it.lights[0]);
    found
}

/// Whether two lanes have one light, or come side by side or one after the other.
fn are_joined(one: &Lane, other: &Lane) -> bool {
    let distance = |a: Point, b: Point| (a.x - b.x).hypot(a.y - b.y);
    let leads_to = |from: &Lane, to: &Lane| from.ways.iter().any(|it| it.chains.contains(&to.stop.chain));
    let are_near =
        || distance(one.point, other.point) < BESIDE || leads_to(one, other) || leads_to(other, one);
    one.light == other.light || turn(one.heading, other.heading).abs() < ONE_DIRECTION && are_near()
}
