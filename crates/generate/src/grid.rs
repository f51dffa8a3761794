//! Towns of straight streets that cross at right angles.

use laneweave_maps::Drawing;
use laneweave_network::DrivingSide;

use super::canvas::Canvas;
use super::compass::Compass;
use super::control::Control;
use super::error::{GenerateError, check_count, check_range};
use super::layout::{Junction, Kind, Layout, Place, Street, draw};
use super::street::{Profile, SHORTEST_WITH_BUS_LANES, pose};

/// Maximum of junctions in a row.
const MAXIMUM_JUNCTIONS: usize = 50;
/// Maximum of lanes in a direction.
const MAXIMUM_LANES: usize = 3;
/// Bounds of the length of a block [m]: shorter ones leave no space between junctions of three lanes.
const BLOCK_LENGTHS: [f64; 2] = [80.0, 1000.0];
/// Bounds of the speed limit [km/h].
const SPEED_LIMITS: [f64; 2] = [5.0, 130.0];

/// Rows of junctions, with streets between them and one block beyond.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Streets that run east and west: 1 to 50.
    pub rows: usize,
    /// Streets that run north and south: 1 to 50.
    pub columns: usize,
    /// Lanes of each street in each direction: 1 to 3.
    pub lanes: usize,
    /// From the middle of a junction to that of the next [m].
    pub block_length_m: f64,
    /// Speed limit [km/h].
    pub speed_limit_kmh: f64,
    /// The control of each junction.
    pub control: Control,
    /// Whether the slow one of several lanes is for buses, but not within 60 m of a junction.
    pub bus_lanes: bool,
    /// On which side traffic drives. Left is the mirror image of right, with y negated.
    pub driving_side: DrivingSide,
}

impl Default for Grid {
    /// Three rows and three columns of streets with two lanes in each direction, lights, 150 m between junctions, and
    /// 50 km/h.
    fn default() -> Grid {
        Grid {
            rows: 3,
            columns: 3,
            lanes: 2,
            block_length_m: 150.0,
            speed_limit_kmh: 50.0,
            control: Control::Signals,
            bus_lanes: false,
            driving_side: DrivingSide::Right,
        }
    }
}

/// A main street of two lanes in each direction, and streets of one lane that cross it at lights.
#[derive(Clone, Debug, PartialEq)]
pub struct Arterial {
    /// How many streets cross it: 1 to 50.
    pub junctions: usize,
    /// From the middle of a junction to that of the next [m].
    pub block_length_m: f64,
    /// Speed limit [km/h].
    pub speed_limit_kmh: f64,
    /// Whether the slow lanes of the main street are for buses, but not within 60 m of a junction.
    pub bus_lanes: bool,
    /// On which side traffic drives. Left is the mirror image of right, with y negated.
    pub driving_side: DrivingSide,
}

impl Default for Arterial {
    /// Five junctions 300 m from each other, and 50 km/h.
    fn default() -> Arterial {
        Arterial {
            junctions: 5,
            block_length_m: 300.0,
            speed_limit_kmh: 50.0,
            bus_lanes: false,
            driving_side: DrivingSide::Right,
        }
    }
}

/// Draws a grid. The south-western junction lies at (0, 0).
///
/// # Errors
/// If a number is out of range.
pub fn grid(grid: &Grid) -> Result<Drawing, GenerateError> {
    check_count("rows", grid.rows, [1, MAXIMUM_JUNCTIONS])?;
    check_count("columns", grid.columns, [1, MAXIMUM_JUNCTIONS])?;
    check_count("lanes in a direction", grid.lanes, [1, MAXIMUM_LANES])?;
    check_streets(grid.block_length_m, grid.speed_limit_kmh, grid.bus_lanes)?;
    if grid.bus_lanes {
        check_count("lanes in a direction, one of them for buses", grid.lanes, [2, MAXIMUM_LANES])?;
    }
    let has_bus_lanes = grid.bus_lanes;
    let profile = Profile { has_bus_lanes, ..Profile::street(grid.lanes, grid.lanes, grid.speed_limit_kmh) };
    let raster = Raster {
        rows: grid.rows,
        columns: grid.columns,
        block_length: grid.block_length_m,
        control: grid.control,
        main: profile,
        cross: profile,
    };
    Ok(raster.draw(grid.driving_side))
}

/// Draws a main street to the east. Its first junction lies at (0, 0).
///
/// # Errors
/// If a number is out of range.
pub fn arterial(arterial: &Arterial) -> Result<Drawing, GenerateError> {
    check_count("junctions", arterial.junctions, [1, MAXIMUM_JUNCTIONS])?;
    check_streets(arterial.block_length_m, arterial.speed_limit_kmh, arterial.bus_lanes)?;
    let raster = Raster {
        rows: 1,
        columns: arterial.junctions,
        block_length: arterial.block_length_m,
        control: Control::Signals,
        main: Profile {
            has_bus_lanes: arterial.bus_lanes,
            ..Profile::street(2, 2, arterial.speed_limit_kmh)
        },
        cross: Profile::street(1, 1, arterial.speed_limit_kmh),
    };
    Ok(raster.draw(arterial.driving_side))
}

fn check_streets(block_length: f64, speed_limit: f64, has_bus_lanes: bool) -> Result<(), GenerateError> {
    check_range("a block length", block_length, "m", BLOCK_LENGTHS)?;
    if has_bus_lanes {
        let lengths = [SHORTEST_WITH_BUS_LANES, BLOCK_LENGTHS[1]];
        check_range("a block length with bus lanes", block_length, "m", lengths)?;
    }
    check_range("a speed limit", speed_limit, "km/h", SPEED_LIMITS)
}

/// Streets that cross at the same distances.
struct Raster {
    rows: usize,
    columns: usize,
    block_length: f64,
    control: Control,
    /// Streets that run east and west.
    main: Profile,
    /// Streets that run north and south.
    cross: Profile,
}

impl Raster {
    fn draw(&self, driving_side: DrivingSide) -> Drawing {
        let mut layout = Layout::default();
        let junctions = (0..self.rows * self.columns).map(|it| (it / self.columns, it % self.columns));
        layout.junctions.extend(junctions.map(|(row, column)| Junction {
            at: (column as f64 * self.block_length, row as f64 * self.block_length),
            kind: Kind::Crossing(self.control),
        }));
        for row in 0..self.rows {
            let along: Vec<usize> = (0..self.columns).map(|it| row * self.columns + it).collect();
            self.street(&mut layout, &along, Compass::East, self.main);
        }
        for column in 0..self.columns {
            let along: Vec<usize> = (0..self.rows).map(|it| it * self.columns + column).collect();
            self.street(&mut layout, &along, Compass::North, self.cross);
        }
        let mut canvas = Canvas::new();
        draw(&mut canvas, &layout);
        canvas.finish(driving_side)
    }

    /// Adds the blocks of a street through these junctions, and one block beyond at either end.
    fn street(&self, layout: &mut Layout, junctions: &[usize], towards: Compass, profile: Profile) {
        let edge = |junction: usize, way: f64| {
            let ((x, y), (east, north)) = (layout.junctions[junction].at, towards.step());
            let length = way * self.block_length;
            Place::Edge(pose(x + length * east, y + length * north, towards.heading()))
        };
        let mut from = edge(junctions[0], -1.0);
        let last = edge(junctions[junctions.len() - 1], 1.0);
        for junction in junctions {
            let to = Place::Arm(*junction, towards.opposite());
            layout.streets.push(Street { from, to, profile });
            from = Place::Arm(*junction, towards);
        }
        layout.streets.push(Street { from, to: last, profile });
    }
}
