//! Roads for tests: drawn without a map, and some maps.

pub(crate) mod drivers;

use laneweave_generate::{Motorway, motorway, own_maps};
use laneweave_maps::{Graph, Map, ReadOptions, load, regulations};
use laneweave_network::{Classes, DrivingSide, Lanelet, LaneletIndex, Network, Point, Polyline};
use laneweave_test_data::data;

/// Width of a lane [m].
pub(crate) const WIDTH: f64 = 3.5;

/// A road of parallel lanes, drawn in rows of at most 500 m. Lane 0 is the slow one.
#[derive(Clone, Copy)]
pub(crate) struct Road {
    pub(crate) lanes: usize,
    /// Length along the slow edge [m].
    pub(crate) length: f64,
    /// Speed limit [m/s].
    pub(crate) limit: f64,
    /// Radius of the slow edge in a curve to the fast side [m]; infinite for a straight road to the east.
    pub(crate) radius: f64,
    /// Whether its lanes lead back to their starts, whatever the drawing shows.
    pub(crate) is_ring: bool,
    /// Whether it is the mirror image, with traffic on the left.
    pub(crate) is_mirrored: bool,
    /// Whether it lies in a town.
    pub(crate) is_in_town: bool,
    /// Who may use which lane of which row.
    pub(crate) classes: fn(usize, usize) -> Classes,
}

impl Default for Road {
    fn default() -> Road {
        Road {
            lanes: 1,
            length: 2000.0,
            limit: 120.0 / 3.6,
            radius: f64::INFINITY,
            is_ring: false,
            is_mirrored: false,
            is_in_town: false,
            classes: |_, _| Classes::ALL,
        }
    }
}

impl Road {
    const LONGEST_ROW: f64 = 500.0;
    /// Distance between the points of a curve [m].
    const CHORD: f64 = 2.0;

    pub(crate) fn network(self) -> Network {
        let rows = self.rows();
        let all =
            (0..rows).flat_map(|row| (0..self.lanes).map(move |lane| self.lanelet(row, lane))).collect();
        let side = if self.is_mirrored { DrivingSide::Left } else { DrivingSide::Right };
        Network::new(all, side).expect("the lanelets fit")
    }

    fn rows(&self) -> usize {
        (self.length / Road::LONGEST_ROW).ceil() as usize
    }

    fn index(&self, row: usize, lane: usize) -> LaneletIndex {
        LaneletIndex((row * self.lanes + lane) as u32)
    }

    fn lanelet(&self, row: usize, lane: usize) -> Lanelet {
        let (slow, fast) = (self.border(row, lane), self.border(row, lane + 1));
        let towards_fast = (lane + 1 < self.lanes).then(|| self.index(row, lane + 1));
        let towards_slow = (lane > 0).then(|| self.index(row, lane - 1));
        let (left_border, right_border) = if self.is_mirrored { (slow, fast) } else { (fast, slow) };
        let (left, right) =
            if self.is_mirrored { (towards_slow, towards_fast) } else { (towards_fast, towards_slow) };
        let next_row = if self.is_ring { (row + 1) % self.rows() } else { row + 1 };
        let id = i64::from(self.index(row, lane).0) + 1;
        let centre = Polyline::between(&left_border, &right_border).expect("the line has a length");
        Lanelet {
            classes: (self.classes)(row, lane),
            is_in_town: self.is_in_town,
            following: if next_row < self.rows() { vec![self.index(next_row, lane)] } else { vec![] },
            left,
            right,
            ..Lanelet::alone(id, [left_border, right_border, centre], self.limit)
        }
    }

    /// The line between lanes `line - 1` and `line`.
    fn border(&self, row: usize, line: usize) -> Polyline {
        let row_length = self.length / self.rows() as f64;
        let pieces = if self.radius.is_finite() { (row_length / Road::CHORD).ceil() as usize } else { 1 };
        let station = |piece| (row as f64 + piece as f64 / pieces as f64) * row_length;
        Polyline::new((0..=pieces).map(|piece| self.point(station(piece), line as f64 * WIDTH)))
            .expect("the line has a length")
    }

    /// The point at `station`, at the distance `beside` [m] from the slow edge to the fast side.
    fn point(&self, station: f64, beside: f64) -> Point {
        let (x, y) = if self.radius.is_finite() {
            let (sin, cos) = (station / self.radius).sin_cos();
            let radius = self.radius - beside;
            (radius * sin, self.radius - radius * cos)
        } else {
            (station, beside)
        };
        Point::new(x, if self.is_mirrored { -y } else { y }, 0.0)
    }
}

/// The network of a map of our own, with its junctions.
pub(crate) fn network(name: &str) -> Network {
    let maps = own_maps().expect("they can be drawn");
    let (_, drawing) = maps.into_iter().find(|it| it.0 == name).expect("there is one of this name");
    regulated(drawing.build().expect("the drawing is sound")).0
}

/// The network of a real map of a town, if this machine has it, and its graph.
pub(crate) fn real(file: &str) -> Option<(Network, Graph)> {
    let path = data(&format!("lanelet2/{file}"))?;
    Some(regulated(load(&path, &ReadOptions::default()).expect("the map is sound")))
}

pub(crate) fn regulated(map: Map) -> (Network, Graph) {
    let regulations = regulations(&map);
    (map.network.regulated(&regulations), map.graph)
}

/// A motorway of 3 km with an on-ramp and an off-ramp.
pub(crate) fn motorway_with_ramps(lanes: usize) -> Map {
    let plan = Motorway {
        lanes,
        length_m: 3000.0,
        on_ramp_at: vec![1000.0],
        off_ramp_at: vec![2000.0],
        ..Motorway::default()
    };
    motorway(&plan).expect("it can be made").build().expect("the drawing is sound")
}
