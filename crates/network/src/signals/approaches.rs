//! The approaches of a junction: lights at lanes that come side by side, in one direction.

use std::f64::consts::FRAC_PI_6;

use super::lanes::Lane;
use crate::geometry::{Point, turn};
use crate::junction::LightIndex;

/// Lanes of one approach: their directions differ by less [rad], and each of their lines is this near to another [m].
/// Ours.
const ONE_DIRECTION: f64 = FRAC_PI_6;
const BESIDE: f64 = 15.0;

/// An approach.
pub(super) struct Approach {
    /// Its lights, in order.
    pub(super) lights: Vec<LightIndex>,
    /// Its lanes, by number.
    pub(super) lanes: Vec<usize>,
    /// Its direction at the line [rad].
    pub(super) heading: f64,
}

/// The approaches of the junction of `members`, in the order of their first lights.
pub(super) fn approaches(lanes: &[Lane], members: &[LightIndex]) -> Vec<Approach> {
    let own: Vec<usize> = (0..lanes.len()).filter(|it| members.contains(&lanes[*it].light)).collect();
    let mut taken = vec![false; own.len()];
    let mut found: Vec<Approach> = Vec::new();
    for first in 0..own.len() {
        let mut open = vec![first];
        let mut group = Vec::new();
        while let Some(at) = open.pop() {
            if !std::mem::replace(&mut taken[at], true) {
                group.push(own[at]);
                let is_joined = |it: &usize| are_joined(&lanes[own[at]], &lanes[own[*it]]);
                open.extend((0..own.len()).filter(|it| !taken[*it]).filter(is_joined));
            }
        }
        if !group.is_empty() {
            group.sort_unstable();
            let mut lights: Vec<LightIndex> = group.iter().map(|it| lanes[*it].light).collect();
            lights.sort_unstable();
            lights.dedup();
            found.push(Approach { heading: lanes[group[0]].heading, lights, lanes: group });
        }
    }
    found.sort_by_key(|it| it.lights[0]);
    found
}

/// Whether two lanes have one light, or come side by side.
fn are_joined(one: &Lane, other: &Lane) -> bool {
    let distance = |a: Point, b: Point| (a.x - b.x).hypot(a.y - b.y);
    one.light == other.light
        || turn(one.heading, other.heading).abs() < ONE_DIRECTION && distance(one.point, other.point) < BESIDE
}
