//! Rectangles on the ground: vehicles as seen from above.

use crate::geometry::{Point, Pose};

/// A rectangle on the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// The pose of its centre.
    pub pose: Pose,
    /// Length, along its heading [m].
    pub length: f64,
    /// Width [m].
    pub width: f64,
}

impl Rectangle {
    /// Its corners: front left, rear left, rear right, front right.
    pub fn corners(&self) -> [Point; 4] {
        let (sin, cos) = self.pose.heading.sin_cos();
        let Point { x, y, z } = self.pose.at;
        [(0.5, 0.5), (-0.5, 0.5), (-0.5, -0.5), (0.5, -0.5)].map(|(ahead, left)| {
            let (ahead, left) = (ahead * self.length, left * self.width);
            Point { x: x + ahead * cos - left * sin, y: y + ahead * sin + left * cos, z }
        })
    }

    /// The middles of its front and of its rear.
    pub fn ends(&self) -> [Point; 2] {
        let (sin, cos) = self.pose.heading.sin_cos();
        let Point { x, y, z } = self.pose.at;
        [0.5, -0.5].map(|it| it * self.length).map(|it| Point { x: x + it * cos, y: y + it * sin, z })
    }

    /// Depth of the intersection of two rectangles, by separating axes [m]; not positive if they are apart.
    pub fn depth(&self, other: &Rectangle) -> f64 {
        let (dx, dy) = self.to(other);
        let axes = [self, other].into_iter().flat_map(|it| {
            let (sin, cos) = it.pose.heading.sin_cos();
            [(cos, sin), (-sin, cos)]
        });
        axes.map(|(x, y)| self.reach(x, y) + other.reach(x, y) - (dx * x + dy * y).abs())
            .fold(f64::INFINITY, f64::min)
    }

    /// The way from its centre to that of another one, to the east and to the north [m].
    pub fn to(&self, other: &Rectangle) -> (f64, f64) {
        (other.pose.at.x - self.pose.at.x, other.pose.at.y - self.pose.at.y)
    }

    /// Half its extent in the direction (`x`, `y`).
    fn reach(&self, x: f64, y: f64) -> f64 {
        let (sin, cos) = self.pose.heading.sin_cos();
        0.5 * (self.length * (cos * x + sin * y).abs() + self.width * (cos * y - sin * x).abs())
    }
}
