//! Lights behind an element, so that vehicles queue in it.

use std::f64::consts::FRAC_PI_2;

use super::branch::{Course, Joint};
use super::mouth::{Mouth, beside, onward};
use super::stretch::{Pen, Stretch};
use crate::control::light;
use crate::path::Path;

/// Distance from the edge of the road to the stop line of the road that crosses it [m].
const SETBACK: f64 = 4.0;
/// Length of the road that crosses, before and after [m].
const CROSSING: [f64; 2] = [60.0, 120.0];

impl Pen {
    /// Draws a road of one lane that crosses at a right angle, with lights for it and for all lanes that end at
    /// `mouth`. Returns where the road goes on beyond, and where the crossing one does.
    pub(super) fn light_behind(&mut self, mouth: &Mouth) -> [Mouth; 2] {
        self.lights(mouth);
        let width = mouth.width();
        let across = width.lane + 2.0 * SETBACK;
        let over = Stretch::onward(mouth, Path::straight(mouth.pose, across)).solid();
        let beyond = self.draw(&over);
        let side = self.dice.sign();
        let length = self.dice.between(CROSSING[0], CROSSING[1]);
        let middle = onward(mouth.pose, across / 2.0, FRAC_PI_2 * side);
        let half = mouth.breadth() / 2.0 + SETBACK;
        let start = onward(middle, -half - length, 0.0);
        let edge = Mouth::one_way(&mut self.canvas, start, 1, true, width);
        let line = self.go_on(&edge, Path::straight(start, length));
        self.lights(&line);
        let out = self.draw(&Stretch::onward(&line, Path::straight(line.pose, 2.0 * half)).solid());
        [beyond, out]
    }

    fn lights(&mut self, mouth: &Mouth) {
        let ends = (0..mouth.lanes()).filter_map(|it| mouth.only(it..it + 1).lane_end(true));
        ends.for_each(|it| light(&mut self.canvas, &it));
    }

    /// A lane that leaves a road to the left, or to the right where `side` is negative, from the outermost lane there.
    pub(super) fn turning_off(
        &mut self,
        mouth: &Mouth,
        side: f64,
        angles: [f64; 2],
        first_leg: f64,
    ) -> Mouth {
        let lane = if side > 0.0 { 0 } else { mouth.lanes() - 1 };
        let angle = side * self.dice.between(angles[0], angles[1]);
        let legs = [first_leg, self.dice.between(35.0, 60.0)];
        let course = Course { joint: Joint::Parts, angle, legs };
        self.side_road(&mouth.only(lane..lane + 1), course)
    }

    /// A road of one lane that joins the outermost lane on a side.
    pub(super) fn turning_in(&mut self, mouth: &Mouth, side: f64, angles: [f64; 2]) -> Mouth {
        let lane = if side > 0.0 { 0 } else { mouth.lanes() - 1 };
        let angle = side * self.dice.between(angles[0], angles[1]);
        let legs = [self.dice.between(10.0, 25.0), self.dice.between(35.0, 60.0)];
        self.side_road(&mouth.only(lane..lane + 1), Course { joint: Joint::Comes, angle, legs })
    }
}

/// A cross-section of the same form, shifted to the left and ahead [m], that nothing leads to.
pub(super) fn elsewhere(pen: &mut Pen, mouth: &Mouth, [left, ahead]: [f64; 2]) -> Mouth {
    let pose = onward(beside(mouth.pose, left), ahead, 0.0);
    Mouth::one_way(&mut pen.canvas, pose, mouth.lanes(), true, mouth.width())
}
