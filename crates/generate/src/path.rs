//! Smooth lines of straight pieces and arcs, along which roads are drawn.

use std::f64::consts::{PI, TAU};

use laneweave_network::{Point, Pose};

/// Directions that differ by less count as one [rad].
const PARALLEL: f64 = 1e-6;
/// Lines at a smaller distance count as one [m].
const IN_LINE: f64 = 2e-3;
/// Length of the straight pieces between points on a bend, as a share of its radius. Ours: at most 2 cm beside the
/// arc in a junction, 6 cm on a long bend.
const CHORD_PER_RADIUS: f64 = 0.05;
/// Bounds of that length [m]. Ours.
const CHORDS: [f64; 2] = [1.5, 10.0];

/// A line with a continuous direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Path {
    /// Some of them may have no length.
    pieces: [Piece; 3],
}

/// A straight line, or an arc.
#[derive(Clone, Copy, Debug)]
struct Piece {
    from: Pose,
    /// Curvature, to the left positive [1/m].
    curvature: f64,
    length: f64,
}

impl Piece {
    /// The piece that continues from here.
    fn on(self, curvature: f64, length: f64) -> Piece {
        Piece { from: self.pose(self.length), curvature, length }
    }

    fn pose(&self, along: f64) -> Pose {
        let Pose { at, heading } = self.from;
        let turn = self.curvature * along;
        // The chord has half the turn of its arc.
        let half = turn / 2.0;
        let chord = if half == 0.0 { along } else { along * libm::sin(half) / half };
        let (x, y) = (libm::cos(heading + half), libm::sin(heading + half));
        Pose { at: Point::new(at.x + chord * x, at.y + chord * y, at.z), heading: heading + turn }
    }
}

impl Path {
    /// A straight line.
    pub(super) fn straight(from: Pose, length: f64) -> Path {
        let line = Piece { from, curvature: 0.0, length };
        Path { pieces: [line, line.on(0.0, 0.0), line.on(0.0, 0.0)] }
    }

    /// An arc of `turn` around a point `radius` to the left.
    pub(super) fn arc(from: Pose, radius: f64, turn: f64) -> Path {
        let arc = Piece { from, curvature: 1.0 / radius, length: radius * turn };
        Path { pieces: [arc, arc.on(0.0, 0.0), arc.on(0.0, 0.0)] }
    }

    /// The path between two poses: straight on; or one bend with the largest possible radius; or, for a parallel
    /// pose, a bend and one back.
    pub(super) fn between(from: Pose, to: Pose) -> Path {
        let turn = (to.heading - from.heading + PI).rem_euclid(TAU) - PI;
        let (x, y) = (libm::cos(from.heading), libm::sin(from.heading));
        let (dx, dy) = (to.at.x - from.at.x, to.at.y - from.at.y);
        let (ahead, beside) = (dx * x + dy * y, dy * x - dx * y);
        if turn.abs() >= PARALLEL {
            return Path::bend(from, ahead, beside, turn);
        }
        if beside.abs() < IN_LINE {
            return Path::straight(from, ahead);
        }
        Path::reverse_curve(from, ahead, beside)
    }

    fn bend(from: Pose, ahead: f64, beside: f64, turn: f64) -> Path {
        // Distance from either end to where their directions meet.
        let after = beside / libm::sin(turn);
        let before = ahead - after * libm::cos(turn);
        let tangent = before.min(after);
        let radius = tangent / libm::tan(turn.abs() / 2.0);
        let first = Piece { from, curvature: 0.0, length: before - tangent };
        let bend = first.on(turn.signum() / radius, radius * turn.abs());
        Path { pieces: [first, bend, bend.on(0.0, after - tangent)] }
    }

    /// Two equal bends, the second back.
    fn reverse_curve(from: Pose, ahead: f64, beside: f64) -> Path {
        let turn = 2.0 * libm::atan2(beside, ahead);
        let radius = ahead / (2.0 * libm::sin(turn));
        let there = Piece { from, curvature: 1.0 / radius, length: radius * turn };
        let back = there.on(-1.0 / radius, there.length);
        Path { pieces: [there, back, back.on(0.0, 0.0)] }
    }

    /// Its length [m].
    pub(super) fn length(&self) -> f64 {
        self.pieces.iter().map(|it| it.length).sum()
    }

    /// Its point and direction at `station` [m].
    pub(super) fn pose(&self, station: f64) -> Pose {
        let [first, second, third] = &self.pieces;
        if station <= first.length {
            return first.pose(station);
        }
        let along = station - first.length;
        if along <= second.length { second.pose(along) } else { third.pose(along - second.length) }
    }

    /// The point `offset` to the left of `station` [m].
    pub(super) fn beside(&self, station: f64, offset: f64) -> Point {
        let Pose { at, heading } = self.pose(station);
        Point::new(at.x - offset * libm::sin(heading), at.y + offset * libm::cos(heading), at.z)
    }

    /// Stations between its ends at which a drawing needs points: on bends, and where these begin and end.
    pub(super) fn bends(&self) -> Vec<f64> {
        let (mut stations, mut start) = (Vec::new(), 0.0);
        for piece in &self.pieces {
            stations.push(start);
            if piece.curvature != 0.0 {
                let chord = (CHORD_PER_RADIUS / piece.curvature.abs()).clamp(CHORDS[0], CHORDS[1]);
                let chords = (piece.length / chord).ceil();
                stations.extend((1..chords as usize).map(|it| start + piece.length * it as f64 / chords));
            }
            start += piece.length;
        }
        stations.dedup_by(|after, before| *after - *before < IN_LINE);
        stations.retain(|it| (IN_LINE..=start - IN_LINE).contains(it));
        stations
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    fn pose(x: f64, y: f64, heading: f64) -> Pose {
        Pose { at: Point::new(x, y, 0.0), heading }
    }

    fn assert_ends(path: &Path, to: Pose) {
        let end = path.pose(path.length());
        assert!(end.at.distance(&to.at) < 1e-9, "{end:?}");
        assert!((end.heading - to.heading).abs() < 1e-9, "{end:?}");
    }

    #[test]
    fn a_way_straight_on_has_no_points_between() {
        let path = Path::between(pose(1.0, 2.0, 0.0), pose(31.0, 2.0, 0.0));
        assert_eq!((path.length(), path.bends().len()), (30.0, 0));
        assert_eq!(path.beside(10.0, 1.5), Point::new(11.0, 3.5, 0.0));
    }

    #[test]
    fn a_bend_is_as_wide_as_there_is_room_for() {
        let to = pose(10.0, 14.0, FRAC_PI_2);
        let path = Path::between(pose(0.0, 0.0, 0.0), to);
        assert_ends(&path, to);
        // An arc of 10 m, then 4 m straight.
        assert!((path.length() - (10.0 * FRAC_PI_2 + 4.0)).abs() < 1e-9);
        let centre = Point::new(0.0, 10.0, 0.0);
        let on_arc = |it: &&f64| **it <= 10.0 * FRAC_PI_2;
        for station in path.bends().iter().filter(on_arc) {
            assert!((path.beside(*station, 0.0).distance(&centre) - 10.0).abs() < 1e-9);
            assert!((path.beside(*station, 2.0).distance(&centre) - 8.0).abs() < 1e-9);
        }
        let steps: Vec<f64> = path.bends().windows(2).map(|it| it[1] - it[0]).collect();
        assert!(steps.iter().all(|it| (1.0..=1.5).contains(it)), "{steps:?}");
        let right = pose(10.0, -14.0, -FRAC_PI_2);
        assert_ends(&Path::between(pose(0.0, 0.0, 0.0), right), right);
    }

    #[test]
    fn what_lies_beside_is_reached_by_a_bend_there_and_one_back() {
        for beside in [-30.0, 3.25] {
            let to = pose(100.0, beside, 0.0);
            let path = Path::between(pose(0.0, 0.0, 0.0), to);
            assert_ends(&path, to);
            let middle = path.beside(path.length() / 2.0, 0.0);
            assert!(middle.distance(&Point::new(50.0, beside / 2.0, 0.0)) < 1e-9);
        }
    }

    #[test]
    fn an_arc_leads_around_its_centre() {
        let path = Path::arc(pose(15.0, 0.0, FRAC_PI_2), 15.0, FRAC_PI_2);
        assert_ends(&path, pose(0.0, 15.0, PI));
    }
}
