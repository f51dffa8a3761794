//! The direction of the borders of a lanelet. A file may list the points of a border in either order; the direction
//! of travel is the one with the left border on the left of the right one.

use laneweave_network::Point;

/// Whether the left and the right border must be reversed to run in the direction of travel.
///
/// The left border is turned so that the middle of the right one lies to its right, then the right border so
/// that the middle of the left one lies to its left.
pub(super) fn reversals(left: &[Point], right: &[Point]) -> (bool, bool) {
    let reverse_left = side(left, middle(right)) >= 0.0;
    let middle_left = if reverse_left { middle(&reversed(left)) } else { middle(left) };
    (reverse_left, side(right, middle_left) <= 0.0)
}

fn reversed(line: &[Point]) -> Vec<Point> {
    line.iter().rev().copied().collect()
}

fn middle(line: &[Point]) -> Point {
    match line {
        [first, last] => first.towards(last, 0.5),
        _ => line[line.len() / 2],
    }
}

/// Positive if `point` lies to the left of the line, negative if to its right, zero if on it.
fn side(line: &[Point], point: Point) -> f64 {
    let mut nearest = (f64::INFINITY, 0.0);
    for (index, segment) in line.windows(2).enumerate() {
        let (from, to) = (segment[0], segment[1]);
        let (dx, dy) = (to.x - from.x, to.y - from.y);
        let along = ((point.x - from.x) * dx + (point.y - from.y) * dy) / (dx * dx + dy * dy);
        let distance = point.distance(&from.towards(&to, along.clamp(0.0, 1.0)));
        if distance < nearest.0 {
            let beyond = line.get(index + 2).filter(|_| along >= 1.0);
            let here = cross(from, to, point);
            nearest = (distance, beyond.map_or(here, |next| at_corner(from, to, *next, point)));
        }
    }
    nearest.1
}

/// The side of the line from `from` through `corner` to `to` on which `point` lies, when the corner is nearest:
/// inside the bend only if it is inside of both legs.
fn at_corner(from: Point, corner: Point, to: Point, point: Point) -> f64 {
    let (before, after) = (cross(from, corner, point), cross(corner, to, point));
    if cross(from, corner, to) > 0.0 { before.min(after) } else { before.max(after) }
}

/// Twice the signed area of the triangle: positive if `point` lies to the left.
fn cross(from: Point, to: Point, point: Point) -> f64 {
    (to.x - from.x) * (point.y - from.y) - (to.y - from.y) * (point.x - from.x)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(points: &[(f64, f64)]) -> Vec<Point> {
        points.iter().map(|(x, y)| Point::new(*x, *y, 0.0)).collect()
    }

    #[test]
    fn borders_are_turned_so_that_left_is_left() {
        let left = [(0.0, 4.0), (5.0, 4.0), (10.0, 4.0)];
        let right = [(0.0, 0.0), (10.0, 0.0)];
        let turned = |points: &[(f64, f64)]| line(&points.iter().rev().copied().collect::<Vec<_>>());
        assert_eq!(reversals(&line(&left), &line(&right)), (false, false));
        assert_eq!(reversals(&turned(&left), &line(&right)), (true, false));
        assert_eq!(reversals(&line(&left), &turned(&right)), (false, true));
        // The same lane in the other direction of travel.
        assert_eq!(reversals(&line(&right), &line(&left)), (true, true));
    }

    #[test]
    fn a_point_outside_a_sharp_bend_lies_outside() {
        let bend = line(&[(0.0, 0.0), (10.0, 0.0), (8.0, 6.0)]);
        assert!(side(&bend, Point::new(13.0, 0.5, 0.0)) < 0.0);
        assert!(side(&bend, Point::new(7.0, 2.0, 0.0)) > 0.0);
        assert_eq!(side(&bend, Point::new(4.0, 0.0, 0.0)), 0.0);
    }

    #[test]
    fn doubled_points_do_not_disturb() {
        let left = line(&[(0.0, 4.0), (0.0, 4.0), (10.0, 4.0), (10.0, 4.0)]);
        assert_eq!(reversals(&left, &line(&[(0.0, 0.0), (10.0, 0.0)])), (false, false));
    }
}
