//! Simple polygons, and whether two of them have common area. On which side of a line a point lies is computed
//! exactly (Shewchuk 1997, Adaptive precision floating-point arithmetic and fast robust geometric predicates), so the
//! answers do not depend on how close a touch is.

use robust::{Coord, orient2d};

use crate::geometry::Point;

/// A polygon seen from above, counter-clockwise, without doubled points.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    points: Vec<[f64; 2]>,
    /// Least coordinates [m].
    low: [f64; 2],
    /// Greatest coordinates [m].
    high: [f64; 2],
}

/// Where a point lies.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Place {
    Inside,
    Edge,
    Outside,
}

impl Polygon {
    /// The polygon through `points`, given either way round; `None` if it has no area.
    pub fn new(points: impl IntoIterator<Item = Point>) -> Option<Polygon> {
        let mut points: Vec<[f64; 2]> = points.into_iter().map(|it| [it.x, it.y]).collect();
        points.dedup();
        while points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        if points.len() < 3 {
            return None;
        }
        let area = twice_the_area(&points);
        if area < 0.0 {
            points.reverse();
        }
        let bound = |pick: fn(f64, f64) -> f64, axis: usize| {
            points.iter().map(|it| it[axis]).reduce(pick).unwrap_or(f64::NAN)
        };
        let low = [bound(f64::min, 0), bound(f64::min, 1)];
        let high = [bound(f64::max, 0), bound(f64::max, 1)];
        (area.is_finite() && area != 0.0).then_some(Polygon { points, low, high })
    }

    /// Least and greatest coordinates [m].
    pub fn bounds(&self) -> [[f64; 2]; 2] {
        [self.low, self.high]
    }

    /// Its corners, counter-clockwise.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// Whether there is area that both cover. Polygons that only touch have none in common.
    pub fn overlaps(&self, other: &Polygon) -> bool {
        let low = [self.low[0].max(other.low[0]), self.low[1].max(other.low[1])];
        let high = [self.high[0].min(other.high[0]), self.high[1].min(other.high[1])];
        if low[0] >= high[0] || low[1] >= high[1] {
            return false;
        }
        let near = |polygon: &Polygon| -> Vec<usize> {
            (0..polygon.points.len()).filter(|it| polygon.edge(*it).reaches(low, high)).collect()
        };
        let (mine, mut theirs) = (near(self), near(other));
        // From west to east, so that each edge is compared only with edges that are not further west than the longest
        // edge.
        theirs.sort_by(|a, b| other.edge(*a).low()[0].total_cmp(&other.edge(*b).low()[0]));
        let longest = theirs.iter().map(|it| other.edge(*it)).map(|it| it.high()[0] - it.low()[0]);
        // Rounding must not hide a touch.
        let longest = 1.001 * longest.fold(0.0, f64::max);
        for i in &mine {
            let edge = self.edge(*i);
            let first = theirs.partition_point(|j| other.edge(*j).low()[0] < edge.low()[0] - longest);
            for j in theirs[first..].iter().take_while(|j| other.edge(**j).low()[0] <= edge.high()[0]) {
                let across = other.edge(*j);
                if edge.reaches(across.low(), across.high()) && self.meets_at(*i, other, *j) {
                    return true;
                }
            }
        }
        // The outlines do not cross: one polygon lies in the other, or they lie apart.
        self.reaches_into(other) || other.reaches_into(self)
    }

    /// Whether the edges `i` here and `j` there show that both cover common area.
    fn meets_at(&self, i: usize, other: &Polygon, j: usize) -> bool {
        let (here, there) = (self.edge(i), other.edge(j));
        let sides = [here.side(there.from), here.side(there.to), there.side(here.from), there.side(here.to)];
        if is_opposite(sides[0], sides[1]) && is_opposite(sides[2], sides[3]) {
            return true;
        }
        // Each corner counts with the edge that begins there; one that lies on the other's edge is a touch.
        let touch = |at: [f64; 2]| self.corner(i, at).overlaps(&other.corner(j, at), at);
        sides[0] == 0.0 && here.holds(there.from) && touch(there.from)
            || sides[2] == 0.0 && there.holds(here.from) && touch(here.from)
    }

    /// The inside of the polygon seen from `at`, a point of edge `i`.
    fn corner(&self, i: usize, at: [f64; 2]) -> Sector {
        let edge = self.edge(i);
        if at == edge.from {
            let before = if i == 0 { self.points.len() - 1 } else { i - 1 };
            return Sector { from: edge.to, to: self.points[before] };
        }
        if at == edge.to {
            let after = (i + 2) % self.points.len();
            return Sector { from: self.points[after], to: edge.from };
        }
        Sector { from: edge.to, to: edge.from }
    }

    /// Whether a corner lies inside of `other`, for polygons whose outlines do not cross.
    fn reaches_into(&self, other: &Polygon) -> bool {
        let places = self.points.iter().map(|it| other.place(*it));
        places.filter(|it| *it != Place::Edge).map(|it| it == Place::Inside).next().unwrap_or(false)
    }

    fn place(&self, point: [f64; 2]) -> Place {
        if (0..2).any(|axis| point[axis] < self.low[axis] || point[axis] > self.high[axis]) {
            return Place::Outside;
        }
        let mut is_inside = false;
        for edge in (0..self.points.len()).map(|it| self.edge(it)) {
            let side = edge.side(point);
            if side == 0.0 && edge.holds(point) {
                return Place::Edge;
            }
            let (below, above) = (edge.from[1] <= point[1], edge.to[1] <= point[1]);
            // The ray to the right crosses an upward edge if the point lies to its left, a downward one if to its
            // right.
            if below != above && (side > 0.0) == below {
                is_inside = !is_inside;
            }
        }
        if is_inside { Place::Inside } else { Place::Outside }
    }

    fn edge(&self, i: usize) -> Edge {
        let next = if i + 1 == self.points.len() { 0 } else { i + 1 };
        Edge { from: self.points[i], to: self.points[next] }
    }
}

/// A side of a polygon.
#[derive(Clone, Copy)]
struct Edge {
    from: [f64; 2],
    to: [f64; 2],
}

impl Edge {
    fn low(&self) -> [f64; 2] {
        [self.from[0].min(self.to[0]), self.from[1].min(self.to[1])]
    }

    fn high(&self) -> [f64; 2] {
        [self.from[0].max(self.to[0]), self.from[1].max(self.to[1])]
    }

    /// Whether its bounding box meets this one.
    fn reaches(&self, low: [f64; 2], high: [f64; 2]) -> bool {
        let (own_low, own_high) = (self.low(), self.high());
        (0..2).all(|axis| own_low[axis] <= high[axis] && own_high[axis] >= low[axis])
    }

    /// Positive if `point` lies to the left.
    fn side(&self, point: [f64; 2]) -> f64 {
        turn(self.from, self.to, point)
    }

    /// Whether a point of its line lies between its ends.
    fn holds(&self, point: [f64; 2]) -> bool {
        self.reaches(point, point)
    }
}

/// What lies between two directions, counter-clockwise; a direction is given by a point in it.
struct Sector {
    from: [f64; 2],
    to: [f64; 2],
}

impl Sector {
    /// Whether two open sectors around `at` have directions in common.
    fn overlaps(&self, other: &Sector, at: [f64; 2]) -> bool {
        is_same_direction(at, self.from, other.from)
            || self.holds(other.from, at)
            || other.holds(self.from, at)
    }

    /// Whether the direction to `point` lies inside.
    fn holds(&self, point: [f64; 2], at: [f64; 2]) -> bool {
        let (from, to) = (turn(at, self.from, point), turn(at, point, self.to));
        let opening = turn(at, self.from, self.to);
        if opening > 0.0 {
            from > 0.0 && to > 0.0
        } else if opening < 0.0 {
            // More than a half turn: all but what lies between its end and its beginning.
            !(turn(at, self.to, point) >= 0.0 && turn(at, point, self.from) >= 0.0)
        } else {
            // A straight edge, or a spike that covers nothing.
            from > 0.0 && !is_same_direction(at, self.from, self.to)
        }
    }
}

/// Whether two points with these sides lie on different sides.
fn is_opposite(a: f64, b: f64) -> bool {
    (a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0)
}

/// Whether `a` and `b`, seen from `at`, lie in exactly the same direction.
fn is_same_direction(at: [f64; 2], a: [f64; 2], b: [f64; 2]) -> bool {
    let same_half = |axis: usize| {
        (a[axis] > at[axis]) == (b[axis] > at[axis]) && (a[axis] < at[axis]) == (b[axis] < at[axis])
    };
    turn(at, a, b) == 0.0 && same_half(0) && same_half(1)
}

/// Positive if the path from `a` over `b` to `c` turns left, negative to the right, zero if it is straight; exactly.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let [a, b, c] = [a, b, c].map(|[x, y]| Coord { x, y });
    orient2d(a, b, c)
}

fn twice_the_area(points: &[[f64; 2]]) -> f64 {
    // Relative to the first point, so that far from the origin nothing is lost.
    let [x0, y0] = points[0];
    let from_first = |it: &[f64; 2]| [it[0] - x0, it[1] - y0];
    points
        .windows(2)
        .map(|pair| {
            let ([ax, ay], [bx, by]) = (from_first(&pair[0]), from_first(&pair[1]));
            ax * by - bx * ay
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(points: &[(f64, f64)]) -> Polygon {
        Polygon::new(points.iter().map(|(x, y)| Point::new(*x, *y, 0.0))).unwrap()
    }

    fn rectangle(x: [f64; 2], y: [f64; 2]) -> Polygon {
        polygon(&[(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])])
    }

    fn overlap(a: &Polygon, b: &Polygon) -> bool {
        assert_eq!(a.overlaps(b), b.overlaps(a));
        // A mirror image, and a shift by powers of two, change nothing.
        let moved = |it: &Polygon| {
            Polygon::new(it.points.iter().map(|p| Point::new(4.0 - 2.0 * p[0], 2.0 * p[1], 0.0))).unwrap()
        };
        assert_eq!(a.overlaps(b), moved(a).overlaps(&moved(b)));
        a.overlaps(b)
    }

    #[test]
    fn crossing_outlines_overlap() {
        let square = rectangle([0.0, 2.0], [0.0, 2.0]);
        assert!(overlap(&square, &rectangle([1.0, 3.0], [1.0, 3.0])));
        assert!(overlap(&square, &rectangle([-1.0, 3.0], [0.5, 1.5])));
        assert!(overlap(&square, &polygon(&[(1.0, -1.0), (3.0, 1.0), (1.0, 3.0), (-1.0, 1.0)])));
        assert!(!overlap(&square, &rectangle([2.5, 3.0], [0.0, 2.0])));
    }

    #[test]
    fn what_only_touches_does_not_overlap() {
        let square = rectangle([0.0, 2.0], [0.0, 2.0]);
        for other in [
            rectangle([2.0, 4.0], [0.0, 2.0]),
            rectangle([2.0, 4.0], [1.0, 5.0]),
            rectangle([2.0, 4.0], [2.0, 4.0]),
            polygon(&[(2.0, 1.0), (3.0, 0.0), (3.0, 2.0)]),
            polygon(&[(3.0, 1.0), (1.0, 3.0), (3.0, 3.0)]),
        ] {
            assert!(!overlap(&square, &other), "{other:?}");
        }
    }

    #[test]
    fn touches_with_common_ground_overlap() {
        let square = rectangle([0.0, 2.0], [0.0, 2.0]);
        for other in [
            square.clone(),
            // Inside, along an edge, and with corners on edges.
            rectangle([0.0, 1.0], [0.5, 1.5]),
            rectangle([0.5, 1.5], [0.5, 1.5]),
            polygon(&[(1.0, 0.0), (2.0, 1.0), (1.0, 2.0), (0.0, 1.0)]),
            // A chord from corner to corner.
            polygon(&[(0.0, 0.0), (2.0, 2.0), (0.0, 2.0)]),
            // All around it, through its corners.
            polygon(&[(1.0, -1.0), (3.0, 1.0), (1.0, 3.0), (-1.0, 1.0)]),
        ] {
            assert!(overlap(&square, &other), "{other:?}");
        }
    }

    #[test]
    fn a_polygon_in_the_bay_of_another_lies_outside() {
        let bay = polygon(&[
            (0.0, 0.0),
            (6.0, 0.0),
            (6.0, 4.0),
            (4.0, 4.0),
            (4.0, 2.0),
            (2.0, 2.0),
            (2.0, 4.0),
            (0.0, 4.0),
        ]);
        assert!(!overlap(&bay, &rectangle([2.0, 4.0], [2.0, 4.0])));
        assert!(!overlap(&bay, &rectangle([2.5, 3.5], [2.0, 3.0])));
        assert!(overlap(&bay, &rectangle([2.0, 4.0], [1.75, 4.0])));
    }

    #[test]
    fn a_touch_is_decided_to_the_last_bit() {
        // A corner that lies on a slanted edge of another polygon, and the next floating-point number to either side.
        let slanted = polygon(&[(0.0, 0.0), (12.0, 12.0), (0.0, 12.0)]);
        let tip = |x: f64| polygon(&[(x, 0.5), (14.0, 0.0), (14.0, 1.0)]);
        assert!(!overlap(&slanted, &tip(0.5)));
        assert!(!slanted.overlaps(&tip(0.5_f64.next_up())));
        assert!(slanted.overlaps(&tip(0.5_f64.next_down())));
    }

    #[test]
    fn polygons_without_area_are_refused() {
        assert!(Polygon::new([]).is_none());
        let line = [Point::new(0.0, 0.0, 0.0), Point::new(1.0, 0.0, 0.0), Point::new(2.0, 0.0, 0.0)];
        assert!(Polygon::new(line).is_none());
        assert!(Polygon::new(line.map(|it| Point { y: f64::NAN, ..it })).is_none());
    }
}
