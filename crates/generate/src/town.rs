//! A town with a motorway through it.

use laneweave_maps::drawing::{Drawing, Surroundings};
use laneweave_network::{DrivingSide, Point};

use super::canvas::Canvas;
use super::compass::Compass::{self, East, North, West};
use super::control::Control;
use super::layout::{Junction, Kind, Layout, Place, Street, draw};
use super::path::Path;
use super::street::{End, Profile, pose, street};

/// Speed limits of streets, ramps and the motorway [km/h].
const STREET: f64 = 50.0;
const RAMP: f64 = 80.0;
const MOTORWAY: f64 = 120.0;
/// Width of the motorway's lanes [m].
const MOTORWAY_LANE: f64 = 3.5;
/// From the middle of the motorway to its first lanes [m].
const MEDIAN: f64 = 2.0;
/// From where to where the motorway runs [m]. No lanelet ends below the edge of a bridge, so that rounding does not
/// decide whether they have common area.
const MOTORWAY_ENDS: [f64; 2] = [-1020.0, 1365.0];
/// From where to where its deceleration lane runs, and its acceleration lane [m].
const DECELERATION: [f64; 2] = [-760.0, -510.0];
const ACCELERATION: [f64; 2] = [815.0, 1065.0];
/// Height of bridges above the motorway [m].
const BRIDGE: f64 = 6.0;
/// Length of streets beyond the last junction [m].
const BEYOND: f64 = 150.0;
/// Length of streets north and south of the roundabout [m].
const RING_ARM: f64 = 100.0;

/// East and north of the streets [m]; the motorway lies at 0.
const BRIDGES: [f64; 2] = [0.0, 300.0];
const MIDDLE: f64 = 150.0;
const RING: f64 = 470.0;
const NORTH_OF_MOTORWAY: f64 = 200.0;
const AT_RAMPS: f64 = -200.0;
const MAIN_STREET: f64 = -350.0;
const SOUTH_STREET: f64 = -500.0;

/// Draws a town whose streets lie south of a motorway and cross it on two bridges.
///
/// The carriageway to the east has an off-ramp to the western bridge's street and an on-ramp from the eastern one's,
/// both at lights. The main street has two lanes in each direction and three junctions with lights, and ends at a
/// roundabout. The other junctions have priority signs, except one without any, and one all-way stop.
pub fn town(driving_side: DrivingSide) -> Drawing {
    let mut canvas = Canvas::new();
    let Ramps { off, on } = motorway(&mut canvas);
    let mut town = Town::default();
    town.junctions();
    town.streets();
    let ramp = Profile {
        lane_width: MOTORWAY_LANE,
        surroundings: Surroundings::Motorway,
        ..Profile::street(0, 1, RAMP)
    };
    let terminal = |x, arm| town.place([x, AT_RAMPS], arm, East);
    let (end_of_off, begin_of_on) = (terminal(BRIDGES[0], West), terminal(BRIDGES[1], East));
    town.street(off, end_of_off, ramp);
    town.street(begin_of_on, on, ramp);
    draw(&mut canvas, &town.layout);
    canvas.finish(driving_side)
}

/// Where ramps leave the motorway and meet it.
struct Ramps {
    off: Place,
    on: Place,
}

/// Draws both carriageways of the motorway.
fn motorway(canvas: &mut Canvas) -> Ramps {
    let profile = |lanes| Profile {
        lane_width: MOTORWAY_LANE,
        surroundings: Surroundings::Motorway,
        ..Profile::street(0, lanes, MOTORWAY)
    };
    let [west, east] = MOTORWAY_ENDS;
    let westward = Path::straight(pose(east, MEDIAN, West.heading()), east - west);
    street(canvas, &westward, &profile(2), [End::Open, End::Open]);
    let mut eastward = |from: f64, to: f64, lanes: usize, begin: End| {
        let path = Path::straight(pose(from, -MEDIAN, East.heading()), to - from);
        let [begin, end] = street(canvas, &path, &profile(lanes), [begin, End::Open]);
        [begin.across, end.across]
    };
    let [_, before] = eastward(west, DECELERATION[0], 2, End::Open);
    let [_, fork] = eastward(DECELERATION[0], DECELERATION[1], 3, End::Road(before));
    let [_, between] = eastward(DECELERATION[1], ACCELERATION[0], 2, End::Road(fork[..3].to_vec()));
    let [merge, after] = eastward(ACCELERATION[0], ACCELERATION[1], 3, End::Road(between));
    eastward(ACCELERATION[1], east, 2, End::Road(after[..3].to_vec()));
    let ramp = |across: &[u32]| {
        let Point { x, y, .. } = canvas.at(across[2]);
        Place::Road(across[2..].to_vec(), pose(x, y, East.heading()))
    };
    Ramps { off: ramp(&fork), on: ramp(&merge) }
}

/// The plan of the town's streets.
#[derive(Default)]
pub(super) struct Town {
    pub(super) layout: Layout,
}

impl Town {
    fn junctions(&mut self) {
        use Control::{AllWayStop, Priority, RightBeforeLeft, Signals};
        let [west, east] = BRIDGES;
        for (x, y, control) in [
            (west, NORTH_OF_MOTORWAY, Priority),
            (east, NORTH_OF_MOTORWAY, Priority),
            (west, AT_RAMPS, Signals),
            (MIDDLE, AT_RAMPS, Priority),
            (east, AT_RAMPS, Signals),
            (west, MAIN_STREET, Signals),
            (MIDDLE, MAIN_STREET, Signals),
            (east, MAIN_STREET, Signals),
            (west, SOUTH_STREET, Priority),
            (MIDDLE, SOUTH_STREET, RightBeforeLeft),
            (east, SOUTH_STREET, AllWayStop),
        ] {
            self.layout.junctions.push(Junction { at: (x, y), kind: Kind::Crossing(control) });
        }
        self.layout.junctions.push(Junction { at: (RING, MAIN_STREET), kind: Kind::Roundabout });
    }

    fn streets(&mut self) {
        let [west, east] = BRIDGES;
        let small = Profile::street(1, 1, STREET);
        let bridge = Profile { rise: BRIDGE, ..small };
        let wide = Profile::street(2, 2, STREET);
        let edges = [west - BEYOND, east + BEYOND];
        self.row(NORTH_OF_MOTORWAY, &[edges[0], west, east, edges[1]], small);
        self.row(AT_RAMPS, &[west, MIDDLE, east], small);
        self.row(MAIN_STREET, &[edges[0], west, MIDDLE, east], wide);
        self.row(MAIN_STREET, &[east, RING, RING + BEYOND], small);
        self.row(SOUTH_STREET, &[edges[0], west, MIDDLE, east, edges[1]], small);
        let edges = [SOUTH_STREET - BEYOND, NORTH_OF_MOTORWAY + BEYOND];
        for x in BRIDGES {
            self.column(x, &[edges[0], SOUTH_STREET, MAIN_STREET, AT_RAMPS], small);
            self.column(x, &[AT_RAMPS, NORTH_OF_MOTORWAY], bridge);
            self.column(x, &[NORTH_OF_MOTORWAY, edges[1]], small);
        }
        self.column(MIDDLE, &[edges[0], SOUTH_STREET, MAIN_STREET, AT_RAMPS], small);
        self.column(RING, &[MAIN_STREET - RING_ARM, MAIN_STREET, MAIN_STREET + RING_ARM], small);
    }

    /// Adds a street to the east through the places at `xs`.
    pub(super) fn row(&mut self, y: f64, xs: &[f64], profile: Profile) {
        self.through(xs.iter().map(|x| [*x, y]).collect(), East, profile);
    }

    /// Adds a street to the north through the places at `ys`.
    pub(super) fn column(&mut self, x: f64, ys: &[f64], profile: Profile) {
        self.through(ys.iter().map(|y| [x, *y]).collect(), North, profile);
    }

    fn through(&mut self, places: Vec<[f64; 2]>, towards: Compass, profile: Profile) {
        for pair in places.windows(2) {
            let from = self.place(pair[0], towards, towards);
            let to = self.place(pair[1], towards.opposite(), towards);
            self.street(from, to, profile);
        }
    }

    fn street(&mut self, from: Place, to: Place, profile: Profile) {
        self.layout.streets.push(Street { from, to, profile });
    }

    /// An arm of the junction that is there, or else the edge of the map, for a path in the direction `along`.
    fn place(&self, [x, y]: [f64; 2], arm: Compass, along: Compass) -> Place {
        match self.layout.junctions.iter().position(|it| it.at == (x, y)) {
            Some(junction) => Place::Arm(junction, arm),
            None => Place::Edge(pose(x, y, along.heading())),
        }
    }
}
