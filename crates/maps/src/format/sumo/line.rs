//! The borders of a lane that is drawn by its centre line.

use laneweave_network::{Point, Polyline};

/// The left and the right border of a lane around `centre`, whose width changes evenly from its start to its end [m].
pub(super) fn borders(centre: &Polyline, widths: [f64; 2]) -> [Polyline; 2] {
    let half = widths.map(|it| 0.5 * it);
    [beside(centre, half), beside(centre, half.map(|it| -it))]
}

/// The line beside `centre`, at distances to its left that change evenly from its start to its end [m]. In a bend that
/// is tighter than that the line turns on the spot.
fn beside(centre: &Polyline, offsets: [f64; 2]) -> Polyline {
    let points = centre.points();
    let shifted: Vec<Point> = (0..points.len()).map(|it| shifted(centre, it, offsets)).collect();
    // Each point with the direction of the centre line on the way to it.
    let mut line: Vec<(Point, [f64; 2])> = vec![(shifted[0], [0.0; 2])];
    for (number, pair) in points.windows(2).enumerate() {
        let mut along = [pair[1].x - pair[0].x, pair[1].y - pair[0].y];
        let mut point = shifted[number + 1];
        while let Some((before, before_along)) = line.last().copied() {
            let is_forwards = along[0] * (point.x - before.x) + along[1] * (point.y - before.y) > 0.0;
            if is_forwards || line.len() == 1 {
                break;
            }
            (point, along) = (before.midpoint(&point), before_along);
            line.pop();
        }
        line.push((point, along));
    }
    let [first, last] = [shifted[0], shifted[shifted.len() - 1]];
    let inner = line[1..line.len() - 1].iter().map(|it| it.0);
    Polyline::new([first].into_iter().chain(inner).chain([last])).unwrap_or_else(|| around(centre, first))
}

/// The point of `centre` with this number, moved to the side: where its neighbours cut each other, but no further out
/// than twice the distance.
fn shifted(centre: &Polyline, number: usize, [first, last]: [f64; 2]) -> Point {
    const SHARPEST: f64 = 0.5;
    let points = centre.points();
    let direction = |from: usize| {
        let [a, b] = [points[from], points[from + 1]];
        let length = a.distance(&b);
        [(b.x - a.x) / length, (b.y - a.y) / length]
    };
    let before = direction(number.saturating_sub(1));
    let after = direction(number.min(points.len() - 2));
    let (sum_x, sum_y) = (before[0] + after[0], before[1] + after[1]);
    // Half the turn has this cosine.
    let size = sum_x.hypot(sum_y);
    let cosine = (0.5 * size).max(SHARPEST);
    let unit = if size > 1e-9 { [sum_x / size, sum_y / size] } else { before };
    let share = number as f64 / (points.len() - 1) as f64;
    let offset = (first + (last - first) * share) / cosine;
    let Point { x, y, z } = points[number];
    Point { x: x - offset * unit[1], y: y + offset * unit[0], z }
}

/// A line around which a vehicle turns on the spot: like `centre`, but so small that it lies at `point`.
fn around(centre: &Polyline, point: Point) -> Polyline {
    const SCALE: f64 = 1e-3;
    let points = centre.points().iter().map(|it| point.towards(it, SCALE));
    Polyline::new(points).unwrap_or_else(|| centre.clone())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(points: &[(f64, f64)]) -> Polyline {
        Polyline::new(points.iter().map(|(x, y)| Point::new(*x, *y, 0.0))).expect("a line")
    }

    #[test]
    fn borders_keep_their_distance_around_a_corner() {
        let [left, right] = borders(&line(&[(0.0, 0.0), (10.0, 0.0), (10.0, 10.0)]), [4.0; 2]);
        let close = |line: &Polyline, expected: &[(f64, f64)]| {
            let near = |(it, at): (&Point, &(f64, f64))| (it.x - at.0).hypot(it.y - at.1) < 1e-9;
            assert_eq!(line.points().len(), expected.len());
            assert!(line.points().iter().zip(expected).all(near), "{line:?}");
        };
        close(&left, &[(0.0, 2.0), (8.0, 2.0), (8.0, 10.0)]);
        close(&right, &[(0.0, -2.0), (12.0, -2.0), (12.0, 10.0)]);
    }

    #[test]
    fn a_lane_grows_wider_along_its_length() {
        let [left, _] = borders(&line(&[(0.0, 0.0), (10.0, 0.0), (20.0, 0.0)]), [2.0, 4.0]);
        let heights: Vec<f64> = left.points().iter().map(|it| it.y).collect();
        assert_eq!(heights, [1.0, 1.5, 2.0]);
    }

    #[test]
    fn a_turn_tighter_than_half_the_width_never_runs_backwards() {
        let arc = |it: i32| (f64::from(it) * 0.2).sin_cos();
        let points: Vec<(f64, f64)> = (0..=15).map(arc).map(|(sine, cosine)| (sine, 1.0 - cosine)).collect();
        let centre = line(&points);
        let [left, right] = borders(&centre, [6.0; 2]);
        // The inner border ends where it has to, and is not longer than between its ends.
        assert!(left.length() < 4.5 && right.length() > 3.0 * centre.length(), "{}", left.length());
    }
}
