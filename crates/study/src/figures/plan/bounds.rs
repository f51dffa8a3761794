//! Rectangles of a plan.

/// Lanelets with a smaller distance than about this belong together [m].
pub(super) const APART: f64 = 150.0;

/// A rectangle of a plan: its west-southern and its north-eastern corner (x, y) [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The smallest coordinates.
    pub low: [f64; 2],
    /// The largest coordinates.
    pub high: [f64; 2],
}

impl Bounds {
    pub(super) const NONE: Bounds = Bounds { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };

    /// The rectangle around `points`.
    pub fn of(points: impl IntoIterator<Item = [f64; 2]>) -> Bounds {
        points.into_iter().fold(Bounds::NONE, |it, point| it.with(Bounds { low: point, high: point }))
    }

    /// The rectangle around both.
    #[must_use]
    pub fn with(self, other: Bounds) -> Bounds {
        Bounds {
            low: [self.low[0].min(other.low[0]), self.low[1].min(other.low[1])],
            high: [self.high[0].max(other.high[0]), self.high[1].max(other.high[1])],
        }
    }

    /// Whether `point` lies inside, or close outside.
    pub fn is_near(&self, point: [f64; 2]) -> bool {
        let near = |axis: usize| {
            let it = point[axis];
            self.low[axis] - it < APART / 3.0 && it - self.high[axis] < APART / 3.0
        };
        near(0) && near(1)
    }

    /// Width and height [m].
    pub fn size(&self) -> [f64; 2] {
        [self.high[0] - self.low[0], self.high[1] - self.low[1]]
    }
}
