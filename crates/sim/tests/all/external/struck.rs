//! Who struck whom: the simulated drivers who moved and struck with their fronts, and whether they could have avoided
//! it by braking as hard as vehicles can, one step after the obstacle had come into their path.

use std::collections::{HashMap, VecDeque};

use laneweave_network::{Point, Pose, Rectangle};
use laneweave_sim::{Incident, VehicleId, World};

/// No vehicle brakes harder [m/s²].
const HARDEST: f64 = 8.0;
/// Steps that are remembered.
const REMEMBERED: usize = 150;
/// Slower than this a vehicle stands [m/s].
const STANDS: f64 = 0.1;

/// A vehicle hides another one only if they are no further apart than this [m].
const NEAR: f64 = 40.0;

/// A vehicle at the end of a step.
#[derive(Clone, Copy)]
struct Seen {
    rectangle: Rectangle,
    speed: f64,
    is_external: bool,
    /// Its user puts it on the centre line of its lane in this step.
    snaps: bool,
}

/// The last steps of a world.
pub(crate) struct History {
    step: f64,
    steps: VecDeque<HashMap<VehicleId, Seen>>,
}

impl History {
    /// No steps yet, of this length [s].
    pub(crate) fn new(step: f64) -> History {
        History { step, steps: VecDeque::new() }
    }

    /// Remembers the present instant. The users of `snaps` put them on the centre lines of their lanes in this step.
    pub(crate) fn note(&mut self, world: &World, snaps: &[VehicleId]) {
        if self.steps.len() == REMEMBERED {
            self.steps.pop_front();
        }
        let seen = world.vehicles().map(|it| {
            let size = it.driver.class.body();
            let rectangle = Rectangle { pose: it.pose(), length: size.length, width: size.width };
            let (speed, is_external) = (it.speed(), it.driver.is_external);
            (it.id(), Seen { rectangle, speed, is_external, snaps: snaps.contains(&it.id()) })
        });
        self.steps.push_back(seen.collect());
    }

    /// The simulated drivers who moved and struck with their fronts in an incident that was just noticed, and whether
    /// each could have avoided it.
    pub(crate) fn strikes(&self, incident: &Incident) -> Vec<(VehicleId, bool)> {
        let [a, b] = incident.vehicles;
        [(a, b), (b, a)]
            .into_iter()
            .filter_map(|(own, other)| Some((own, self.could_avoid(own, other)?)))
            .collect()
    }

    fn at(&self, ago: usize, id: VehicleId) -> Option<&Seen> {
        self.steps.get(self.steps.len().checked_sub(ago + 1)?)?.get(&id)
    }

    /// `None` if it stood, was driven by a user, or was struck elsewhere than at its front, or came upon by the other.
    fn could_avoid(&self, own: VehicleId, other: VehicleId) -> Option<bool> {
        let (me, obstacle, before) = (self.at(0, own)?, self.at(0, other)?, self.at(1, own)?);
        let is_hit = before.rectangle.depth(&obstacle.rectangle) > 0.0;
        if me.is_external || me.speed < STANDS || is_hit || !strikes_with_its_front(me, before, obstacle) {
            return None;
        }
        if obstacle.snaps {
            return Some(false);
        }
        for ago in 0..REMEMBERED {
            let Some(it) = self.at(ago, other) else { break };
            let earlier = self.at(ago + 1, other);
            let was_in_path = earlier.is_some_and(|it| self.is_in_path(ago + 1, own, it));
            let is_sudden = !was_in_path
                || earlier.is_none_or(|earlier| is_unphysical(earlier, it, self.step))
                || self.comes_into_view(ago, own, other);
            // A driver who takes over from a user finds the obstacle in its path.
            let takes_over = self.at(ago + 1, own).is_none_or(|it| it.is_external);
            if (is_sudden || takes_over) && !self.braking_avoids(ago.saturating_sub(1), own, other) {
                return Some(false);
            }
            if !was_in_path || takes_over {
                break;
            }
        }
        Some(true)
    }

    /// Whether a third vehicle hid `other` from the driver until `ago` steps ago: it was ahead of the driver, and then
    /// was gone, did what no vehicle can do, or drove through `other`.
    fn comes_into_view(&self, ago: usize, own: VehicleId, other: VehicleId) -> bool {
        let Some(it) = self.at(ago, other) else { return false };
        let Some(before) = self.steps.len().checked_sub(ago + 2).and_then(|at| self.steps.get(at)) else {
            return false;
        };
        before.iter().filter(|(id, _)| **id != own && **id != other).any(|(id, third)| {
            let is_near = third.rectangle.pose.at.distance(&it.rectangle.pose.at) < NEAR;
            let now = self.at(ago, *id);
            let lets_see = || {
                now.is_none_or(|now| {
                    is_unphysical(third, now, self.step) || now.rectangle.depth(&it.rectangle) > 0.0
                })
            };
            is_near && lets_see() && self.is_in_path(ago + 1, own, third)
        })
    }

    /// Whether `it` is on the way that the vehicle took from `ago` steps ago on.
    fn is_in_path(&self, ago: usize, own: VehicleId, it: &Seen) -> bool {
        (0..=ago).any(|at| {
            self.at(at, own).is_some_and(|me| {
                // A little beyond the contact.
                let rectangle = Rectangle { length: me.rectangle.length + 2.0, ..me.rectangle };
                rectangle.depth(&it.rectangle) > 0.0
            })
        })
    }

    /// Whether it would not have touched the other one if it had braked with 8 m/s² from `ago` steps ago on, on the
    /// way that it took.
    fn braking_avoids(&self, ago: usize, own: VehicleId, other: VehicleId) -> bool {
        let Some(from) = self.at(ago, own) else { return false };
        (0..=ago).all(|left| {
            let time = (ago - left) as f64 * self.step;
            let time = time.min(from.speed / HARDEST);
            let way = from.speed * time - 0.5 * HARDEST * time * time;
            let other = self.at(left, other).map(|it| it.rectangle);
            let me = self.on_its_way(ago, own, way);
            other.zip(me).is_none_or(|(other, me)| me.depth(&other) <= 0.0)
        })
    }

    /// Where the vehicle is `way` metres beyond its place of `ago` steps ago, on the way that it took.
    fn on_its_way(&self, ago: usize, own: VehicleId, way: f64) -> Option<Rectangle> {
        let mut left = way;
        for at in (1..=ago).rev() {
            let (before, after) = (self.at(at, own)?, self.at(at - 1, own)?);
            // Along the lane, as speeds are: in a lane change it also moves sideways.
            let step = 0.5 * (before.speed + after.speed) * self.step;
            let (from, to) = (before.rectangle, after.rectangle);
            if step >= left && step > 0.0 {
                let (share, turned) = (left / step, to.pose.heading - from.pose.heading);
                let at = from.pose.at.towards(&to.pose.at, share);
                let heading = from.pose.heading + share * turned.sin().atan2(turned.cos());
                return Some(Rectangle { pose: Pose { at, heading }, ..from });
            }
            left -= step;
        }
        Some(self.at(0, own)?.rectangle)
    }
}

/// Whether the intersection lies in what the vehicle covered in the last step.
fn strikes_with_its_front(me: &Seen, before: &Seen, other: &Seen) -> bool {
    let moved = me.rectangle.pose.at.distance(&before.rectangle.pose.at) + 0.3;
    let (sin, cos) = me.rectangle.pose.heading.sin_cos();
    let Pose { at, heading } = me.rectangle.pose;
    let at = Point { x: at.x - 0.5 * moved * cos, y: at.y - 0.5 * moved * sin, ..at };
    let rest = Rectangle { pose: Pose { at, heading }, length: me.rectangle.length - moved, ..me.rectangle };
    rest.length <= 0.0 || rest.depth(&other.rectangle) <= 0.0
}

/// Whether a vehicle did what no vehicle can do: it braked or accelerated harder than 8 m/s², moved sideways or
/// backwards, or turned on the spot.
fn is_unphysical(before: &Seen, now: &Seen, dt: f64) -> bool {
    let (sin, cos) = before.rectangle.pose.heading.sin_cos();
    let (dx, dy) = before.rectangle.to(&now.rectangle);
    let (along, aside) = (dx * cos + dy * sin, (dy * cos - dx * sin).abs());
    let turned = (now.rectangle.pose.heading - before.rectangle.pose.heading).sin().abs();
    let least = (before.speed - 0.5 * HARDEST * dt).max(0.0) * dt;
    along < least - 0.01
        || aside > 0.05 + 0.3 * along.abs()
        || turned > 0.02 + 0.5 * along.abs()
        || now.speed < before.speed - HARDEST * dt - 1e-6
        || along > (before.speed + HARDEST * dt) * dt + 0.05
}
