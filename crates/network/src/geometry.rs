//! Points, lines with stations along them, and poses.

use serde::{Deserialize, Serialize};

/// A point of the map's local metric frame: x to the east, y to the north, z up [m].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// East [m].
    pub x: f64,
    /// North [m].
    pub y: f64,
    /// Up [m].
    pub z: f64,
}

impl Point {
    /// A point at (`x`, `y`, `z`) [m].
    pub fn new(x: f64, y: f64, z: f64) -> Point {
        Point { x, y, z }
    }

    /// Horizontal distance to `other` [m].
    pub fn distance(&self, other: &Point) -> f64 {
        let (dx, dy) = (other.x - self.x, other.y - self.y);
        (dx * dx + dy * dy).sqrt()
    }

    /// Horizontal distance to the line between two points [m].
    pub(crate) fn distance_to_segment(&self, [from, to]: [Point; 2]) -> f64 {
        let along = (to.x - from.x, to.y - from.y);
        let (dx, dy) = (self.x - from.x, self.y - from.y);
        let share = (dx * along.0 + dy * along.1) / (along.0 * along.0 + along.1 * along.1);
        // Where the two are one point, the share is no number.
        let share = if share.is_nan() { 0.0 } else { share };
        from.towards(&to, share.clamp(0.0, 1.0)).distance(self)
    }

    /// The point halfway to `other`; the result is the same from either point, bit for bit.
    pub fn midpoint(&self, other: &Point) -> Point {
        Point { x: 0.5 * (self.x + other.x), y: 0.5 * (self.y + other.y), z: 0.5 * (self.z + other.z) }
    }

    /// The point at `fraction` of the way to `other`; beyond it for fractions outside 0…1.
    pub fn towards(&self, other: &Point, fraction: f64) -> Point {
        Point {
            x: self.x + fraction * (other.x - self.x),
            y: self.y + fraction * (other.y - self.y),
            z: self.z + fraction * (other.z - self.z),
        }
    }
}

/// Where something is and where it points.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// Position [m].
    pub at: Point,
    /// Heading, counter-clockwise from east [rad].
    pub heading: f64,
}

/// The turn from one heading to another, between −π and π; NaN if their difference is not finite [rad].
#[inline]
pub fn turn(from: f64, to: f64) -> f64 {
    let turn = to - from;
    turn.sin().atan2(turn.cos())
}

/// A line of at least two distinct points, with the station (horizontal length from the start) of each, and the
/// direction from each to the next.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    points: Vec<Point>,
    stations: Vec<f64>,
    /// Counter-clockwise from east [rad], one less than points.
    headings: Vec<f64>,
}

impl Polyline {
    /// Points closer than this to the one before are dropped [m].
    const SAME: f64 = 1e-6;

    /// A line through `points`; `None` if fewer than two of them differ or one is not finite.
    pub fn new(points: impl IntoIterator<Item = Point>) -> Option<Polyline> {
        let points = points.into_iter();
        let (least, _) = points.size_hint();
        let mut line = Polyline {
            points: Vec::with_capacity(least),
            stations: Vec::with_capacity(least),
            headings: Vec::with_capacity(least),
        };
        for point in points {
            if !(point.x.is_finite() && point.y.is_finite() && point.z.is_finite()) {
                return None;
            }
            line.push(point);
        }
        (line.points.len() >= 2 && line.length().is_finite()).then_some(line)
    }

    fn push(&mut self, point: Point) {
        match self.points.last() {
            None => self.stations.push(0.0),
            Some(last) => {
                let step = last.distance(&point);
                if step <= Polyline::SAME {
                    return;
                }
                self.headings.push((point.y - last.y).atan2(point.x - last.x));
                self.stations.push(self.length() + step);
            }
        }
        self.points.push(point);
    }

    /// The line halfway between two borders, taken at equal fractions of their lengths.
    pub fn between(left: &Polyline, right: &Polyline) -> Option<Polyline> {
        let fractions = |line: &Polyline| line.stations.iter().map(|s| s / line.length()).collect::<Vec<_>>();
        let mut all = fractions(left);
        all.extend(fractions(right));
        all.sort_by(f64::total_cmp);
        let shorter = left.length().min(right.length());
        all.dedup_by(|b, a| (*b - *a) * shorter < 0.01);
        let last = all.len() - 1;
        all[last] = 1.0;
        Polyline::new(all.iter().map(|f| left.at(f * left.length()).midpoint(&right.at(f * right.length()))))
    }

    /// Its points, from its start to its end.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Horizontal length [m].
    pub fn length(&self) -> f64 {
        self.stations.last().copied().unwrap_or(0.0)
    }

    /// The same line in the opposite direction.
    pub fn reversed(&self) -> Polyline {
        let length = self.length();
        let points: Vec<Point> = self.points.iter().rev().copied().collect();
        let heading = |it: &[Point]| (it[1].y - it[0].y).atan2(it[1].x - it[0].x);
        Polyline {
            headings: points.windows(2).map(heading).collect(),
            points,
            stations: self.stations.iter().rev().map(|s| length - s).collect(),
        }
    }

    /// The segment that contains `station`, and the distance along it; the outer segments are prolonged.
    pub(crate) fn segment(&self, station: f64) -> (usize, f64) {
        let after = self.stations.partition_point(|s| *s <= station).clamp(1, self.stations.len() - 1);
        let (from, to) = (self.stations[after - 1], self.stations[after]);
        (after - 1, (station - from) / (to - from))
    }

    /// The point at `station` [m]; outside the line its end segments are prolonged.
    pub fn at(&self, station: f64) -> Point {
        let (segment, fraction) = self.segment(station);
        self.points[segment].towards(&self.points[segment + 1], fraction)
    }

    /// Directions of travel on its segments, counter-clockwise from east [rad].
    pub(crate) fn headings(&self) -> &[f64] {
        &self.headings
    }

    /// Direction of travel at `station`, counter-clockwise from east [rad].
    pub fn heading(&self, station: f64) -> f64 {
        self.headings[self.segment(station).0]
    }

    /// The point at `station`, moved `offset` to the left [m].
    pub fn beside(&self, station: f64, offset: f64) -> Point {
        let (segment, fraction) = self.segment(station);
        let (from, to) = (self.points[segment], self.points[segment + 1]);
        let length = self.stations[segment + 1] - self.stations[segment];
        let mut point = from.towards(&to, fraction);
        point.x -= offset * (to.y - from.y) / length;
        point.y += offset * (to.x - from.x) / length;
        point
    }

    /// A walk along the line from `station` [m]: for many stations one after the other, each near the one before.
    pub fn walk(&self, station: f64) -> LineWalk<'_> {
        LineWalk { line: self, after: self.segment(station).0 + 1 }
    }

    /// Station of the first place where the line through `points` crosses this one, seen from above.
    pub fn crossed_by(&self, points: &[Point]) -> Option<f64> {
        let pieces = self.points.windows(2).zip(&self.stations);
        pieces
            .filter_map(|(piece, start)| {
                let along = points.windows(2).filter_map(|other| crossing(piece, other)).reduce(f64::min)?;
                Some(start + along * piece[0].distance(&piece[1]))
            })
            .next()
    }

    /// Horizontal distance from `point` to the nearest place of the line [m].
    pub fn distance_to(&self, point: &Point) -> f64 {
        let to = |piece: &[Point]| point.distance_to_segment([piece[0], piece[1]]);
        self.points.windows(2).map(to).fold(f64::INFINITY, f64::min)
    }

    /// This line followed by `next`; their common point is kept once.
    pub fn append(&mut self, next: &Polyline) {
        for point in &next.points {
            self.push(*point);
        }
    }
}

/// A walk along a line, which begins where the last place was to look for the next one.
#[derive(Clone, Debug)]
pub struct LineWalk<'a> {
    line: &'a Polyline,
    /// The number of the point after the last place.
    after: usize,
}

impl LineWalk<'_> {
    /// The same as [`Polyline::at`].
    #[inline]
    pub fn at(&mut self, station: f64) -> Point {
        self.go_to(station);
        self.on_segment(station)
    }

    /// The direction of the segment on which the stations `front` and `rear` lie, and the point half-way between them;
    /// `None` if they lie on two segments. Directions are counter-clockwise from east [rad].
    #[inline]
    pub fn straight(&mut self, [front, rear]: [f64; 2]) -> Option<(Point, f64)> {
        self.go_to(front);
        let before = self.after - 1;
        // The first segment goes on before the line begins.
        if before > 0 && rear < self.line.stations[before] {
            return None;
        }
        Some((self.on_segment(0.5 * (front + rear)), self.line.headings[before]))
    }

    /// Goes to the segment with this station.
    #[inline]
    fn go_to(&mut self, station: f64) {
        let stations = &self.line.stations;
        let last = stations.len() - 1;
        while self.after < last && stations[self.after] <= station {
            self.after += 1;
        }
        while self.after > 1 && stations[self.after - 1] > station {
            self.after -= 1;
        }
    }

    /// The point at `station` along the segment where the walk is.
    #[inline]
    fn on_segment(&self, station: f64) -> Point {
        let Polyline { points, stations, .. } = self.line;
        let [from, to] = [self.after - 1, self.after];
        points[from].towards(&points[to], (station - stations[from]) / (stations[to] - stations[from]))
    }
}

/// Share of the segment `one` at which the segment `other` crosses it, seen from above.
pub(crate) fn crossing(one: &[Point], other: &[Point]) -> Option<f64> {
    let ([a, b], [c, d]) = ([one[0], one[1]], [other[0], other[1]]);
    let cross = |(ux, uy): (f64, f64), (vx, vy): (f64, f64)| ux * vy - uy * vx;
    let (along, across) = ((b.x - a.x, b.y - a.y), (d.x - c.x, d.y - c.y));
    let between = (c.x - a.x, c.y - a.y);
    let area = cross(along, across);
    let (on_one, on_other) = (cross(between, across) / area, cross(between, along) / area);
    let is_within = |share: f64| (0.0..=1.0).contains(&share);
    (is_within(on_one) && is_within(on_other)).then_some(on_one)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(points: &[(f64, f64)]) -> Polyline {
        Polyline::new(points.iter().map(|(x, y)| Point::new(*x, *y, 0.0))).unwrap()
    }

    #[test]
    fn a_walk_tells_the_direction_of_a_segment_if_both_stations_lie_on_it() {
        let corner = line(&[(0.0, 0.0), (10.0, 0.0), (10.0, 5.0)]);
        let mut walk = corner.walk(0.0);
        for [front, rear] in [[4.0, 1.0], [9.0, -2.0], [10.0, 9.0], [14.0, 9.9], [14.0, 11.0], [19.0, 12.0]] {
            let found = walk.straight([front, rear]);
            let is_bent = front >= 10.0 && rear < 10.0;
            let expected = (corner.at(0.5 * (front + rear)), corner.heading(front));
            assert_eq!(found, (!is_bent).then_some(expected), "{front} m to {rear} m");
        }
    }

    #[test]
    fn a_walk_finds_the_points_of_its_line_forwards_backwards_and_beyond_the_ends() {
        let corner = line(&[(0.0, 0.0), (10.0, 0.0), (10.0, 5.0), (3.0, 9.0)]);
        let mut walk = corner.walk(12.0);
        for station in [-3.0, 0.0, 9.5, 10.0, 10.5, 40.0, 15.0, 14.0, 3.0, 22.0, -1.0] {
            assert_eq!(walk.at(station), corner.at(station), "{station} m");
        }
    }

    #[test]
    fn a_point_lies_at_its_station_and_beyond_the_ends() {
        let corner = line(&[(0.0, 0.0), (10.0, 0.0), (10.0, 5.0)]);
        assert_eq!(corner.length(), 15.0);
        assert_eq!(corner.at(12.0), Point::new(10.0, 2.0, 0.0));
        assert_eq!(corner.at(-3.0), Point::new(-3.0, 0.0, 0.0));
        assert_eq!(corner.at(17.0), Point::new(10.0, 7.0, 0.0));
        assert_eq!(corner.beside(2.0, 1.5), Point::new(2.0, 1.5, 0.0));
    }

    #[test]
    fn a_line_is_crossed_where_another_one_cuts_it() {
        let corner = line(&[(0.0, 0.0), (10.0, 0.0), (10.0, 5.0)]);
        let at = |x0, y0, x1, y1| corner.crossed_by(&[Point::new(x0, y0, 0.0), Point::new(x1, y1, 0.0)]);
        assert_eq!(at(4.0, -1.0, 4.0, 1.0), Some(4.0));
        assert_eq!(at(8.0, 2.0, 12.0, 2.0), Some(12.0));
        assert_eq!(at(4.0, 1.0, 4.0, 2.0), None);
        assert_eq!(at(0.0, 1.0, 5.0, 1.0), None);
    }

    #[test]
    fn the_centre_lies_between_borders_of_different_density() {
        let left = line(&[(0.0, 2.0), (5.0, 2.0), (20.0, 2.0)]);
        let right = line(&[(0.0, -2.0), (20.0, -2.0)]);
        let centre = Polyline::between(&left, &right).unwrap();
        assert!(centre.points().iter().all(|p| p.y == 0.0));
        assert_eq!(centre.length(), 20.0);
    }

    #[test]
    fn lines_without_length_are_refused() {
        assert!(Polyline::new([Point::new(1.0, 1.0, 0.0); 3]).is_none());
        assert!(Polyline::new([Point::new(1.0, 1.0, 0.0), Point::new(f64::NAN, 1.0, 0.0)]).is_none());
    }
}
