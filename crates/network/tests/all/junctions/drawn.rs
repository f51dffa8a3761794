//! Small junctions drawn by hand, on flat ground unless a height is given.

use std::f64::consts::PI;

use laneweave_network::{
    DrivingSide, Junctions, Lanelet, LaneletIndex, Network, Point, Polyline, Regulations, Zone,
};

/// Width of a lane [m].
pub(crate) const WIDTH: f64 = 3.5;
/// Speed limit of all lanes [m/s].
const LIMIT: f64 = 50.0 / 3.6;
/// Angle between the points of a bend [rad].
const BEND: f64 = PI / 90.0;

/// Lanes, each by its centre line and the numbers of those that continue it; their ids are their numbers.
#[derive(Clone, Default)]
pub(crate) struct Lanes(Vec<(Vec<Point>, Vec<u32>)>);

impl Lanes {
    pub(crate) fn with(mut self, centre: Vec<Point>, following: &[u32]) -> Lanes {
        self.0.push((centre, following.to_vec()));
        self
    }

    /// The mirror image.
    pub(crate) fn mirrored(mut self) -> Lanes {
        self.0.iter_mut().flat_map(|lane| &mut lane.0).for_each(|point| point.y = -point.y);
        self
    }

    /// The network of these lanes without junctions.
    pub(crate) fn network(&self, side: DrivingSide) -> Network {
        let lanelet = |(number, (centre, following)): (usize, &(Vec<Point>, Vec<u32>))| {
            let centre = Polyline::new(centre.iter().copied()).expect("the line has a length");
            let border = |offset: f64| {
                let mut station = 0.0;
                let mut last = centre.points()[0];
                Polyline::new(centre.points().iter().map(|point| {
                    station += last.distance(point);
                    last = *point;
                    centre.beside(station, offset)
                }))
                .expect("the line has a length")
            };
            let borders = [border(0.5 * WIDTH), border(-0.5 * WIDTH)];
            let [left, right] = borders;
            let following = following.iter().map(|it| LaneletIndex(*it)).collect();
            Lanelet { following, ..Lanelet::alone(number as i64, [left, right, centre], LIMIT) }
        };
        Network::new(self.0.iter().enumerate().map(lanelet).collect(), side).expect("the lanelets fit")
    }

    /// The junctions where traffic drives on the right.
    pub(crate) fn junctions(&self, regulations: &Regulations) -> Junctions {
        self.network(DrivingSide::Right).regulated(regulations).junctions
    }

    /// The zones without rules.
    pub(crate) fn zones(&self) -> Vec<Zone> {
        self.junctions(&Regulations::default()).zones
    }
}

/// A straight line.
pub(crate) fn straight(from: (f64, f64), to: (f64, f64)) -> Vec<Point> {
    at_height(from, to, 0.0)
}

/// A straight line at a height [m].
pub(crate) fn at_height(from: (f64, f64), to: (f64, f64), height: f64) -> Vec<Point> {
    [from, to].map(|(x, y)| Point::new(x, y, height)).to_vec()
}

/// Part of a circle around `centre`, from the direction `from` in which a point on it lies, by `angle` [rad].
pub(crate) fn arc(centre: (f64, f64), radius: f64, from: f64, angle: f64) -> Vec<Point> {
    let pieces = (angle.abs() / BEND).ceil() as usize;
    (0..=pieces)
        .map(|piece| {
            let (sin, cos) = (from + angle * piece as f64 / pieces as f64).sin_cos();
            Point::new(centre.0 + radius * cos, centre.1 + radius * sin, 0.0)
        })
        .collect()
}

/// Lines one after the other.
pub(crate) fn joined(lines: &[Vec<Point>]) -> Vec<Point> {
    lines.concat()
}

/// Two lanes that cross at right angles, each after 100 m: number 0 to the east, number 1 to the north, `height` above.
pub(crate) fn crossing(height: f64) -> Lanes {
    Lanes::default()
        .with(straight((-100.0, 0.0), (100.0, 0.0)), &[])
        .with(at_height((0.0, -100.0), (0.0, 100.0), height), &[])
}
