//! The direction of the borders of a lanelet. A file may list the points of a border in either order; the direction
//! of travel is the one with the left border on the left of the right one.

use laneweave_network::Point;

/// Points that are nearer to each other lie at one place [m].
const SAME: f64 = 1e-6;

/// Whether the left and the right border must be reversed to run in the direction of travel. A border at one place
/// runs as it is listed.
pub(super) fn reversals(left: &[Point], right: &[Point]) -> (bool, bool) {
    let (left, right) = (without_repetitions(left), without_repetitions(right));
    if left.len() < 2 || right.len() < 2 {
        let beside = |line: &[Point], other: &[Point]| other.first().map_or(0.0, |it| side(line, *it));
        return (beside(&left, &right) > 0.0, beside(&right, &left) < 0.0);
    }
    let usual = by_middle(&left, &right);
    let (l, r) = (turned(&left, usual.0), turned(&right, usual.1));
    if are_parallel(&l, &r) && area(&l, &r) <= 0.0 { usual } else { by_area(&left, &right) }
}

/// As the reference library decides: the left border is turned so that the middle of the right one lies to its right,
/// then the right border so that the middle of the left one lies to its left.
fn by_middle(left: &[Point], right: &[Point]) -> (bool, bool) {
    let reverse_left = side(left, middle(right)) >= 0.0;
    let middle_left = middle(&turned(left, reverse_left));
    (reverse_left, side(right, middle_left) <= 0.0)
}

/// For borders whose middles mislead because they cross, or one has a spike: both run the same way, with most of the
/// area to the right of the left one.
fn by_area(left: &[Point], right: &[Point]) -> (bool, bool) {
    let turns_right = !are_parallel(left, right);
    let turns_both = area(left, &turned(right, turns_right)) > 0.0;
    (turns_both, turns_both != turns_right)
}

/// Whether the ends of two borders show that they do not run in opposite directions.
fn are_parallel(left: &[Point], right: &[Point]) -> bool {
    let ends = |line: &[Point]| (line[0], line[line.len() - 1]);
    let ((left_start, left_end), (right_start, right_end)) = (ends(left), ends(right));
    let apart = left_start.distance(&right_start) + left_end.distance(&right_end);
    // Where a lane ends near its start, this tells nothing.
    apart <= 2.0 * (left_start.distance(&right_end) + left_end.distance(&right_start))
}

/// Twice the area between two borders: negative if it lies to the right of the left one.
fn area(left: &[Point], right: &[Point]) -> f64 {
    let outline: Vec<Point> = left.iter().chain(right.iter().rev()).copied().collect();
    outline.windows(2).map(|it| cross(outline[0], it[0], it[1])).sum()
}

fn turned(line: &[Point], is_reversed: bool) -> Vec<Point> {
    if is_reversed { line.iter().rev().copied().collect() } else { line.to_vec() }
}

/// The line, without points that lie where the one before them does.
fn without_repetitions(line: &[Point]) -> Vec<Point> {
    let mut line = line.to_vec();
    line.dedup_by(|b, a| a.distance(b) <= SAME);
    line
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
        let right = line(&[(0.0, 0.0), (10.0, 0.0)]);
        for x in [0.0, 5.0, 10.0] {
            let left = line(&[(0.0, 4.0), (x, 4.0), (x, 4.0), (10.0, 4.0)]);
            assert_eq!(reversals(&left, &right), (false, false), "{x}");
            assert_eq!(reversals(&turned(&left, true), &right), (true, false), "{x}");
        }
    }

    #[test]
    fn a_spike_across_the_other_border_does_not_disturb() {
        let right = line(&[(0.0, 0.0), (200.0, 0.0)]);
        for x in [20.0, 95.0, 100.0, 110.0] {
            let left = line(&[(0.0, 4.0), (x - 10.0, 4.0), (x, -3.0), (x + 10.0, 4.0), (200.0, 4.0)]);
            for (l, r) in [(false, false), (true, false), (false, true), (true, true)] {
                assert_eq!(reversals(&turned(&left, l), &turned(&right, r)), (l, r), "{x}");
            }
        }
    }

    #[test]
    fn a_border_at_one_place_runs_as_it_is_listed() {
        let (bend, point) = (line(&[(0.0, 4.0), (3.0, 3.0), (4.0, 0.0)]), line(&[(0.0, 0.0), (0.0, 0.0)]));
        assert_eq!(reversals(&bend, &point), (false, false));
        assert_eq!(reversals(&turned(&bend, true), &point), (true, false));
        assert_eq!(reversals(&point[..1], &bend), (false, true));
    }
}
