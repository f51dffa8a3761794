//! A larger town: streets of different kinds that cross at right angles, at different distances.

use laneweave_maps::Drawing;
use laneweave_network::DrivingSide;

use super::canvas::Canvas;
use super::control::Control;
use super::error::{GenerateError, check_count};
use super::layout::{Junction, Kind, draw};
use super::street::Profile;
use super::town::Town;

/// Fewest and most streets in each direction.
const SIZES: [usize; 2] = [3, 20];
/// Speed limits of main streets and of small ones [km/h].
const MAIN: f64 = 50.0;
const SMALL: f64 = 30.0;
/// From one street to the next, in turn [m].
const BLOCKS: [f64; 5] = [160.0, 140.0, 200.0, 150.0, 220.0];
/// Length of streets beyond the last junction [m].
const BEYOND: f64 = 150.0;

/// Draws a town of `size` streets in each direction, with a junction wherever two of them cross. The south-western one
/// lies at (0, 0).
///
/// The second of every three streets is a main street with two lanes in each direction and 50 km/h; the others have one
/// lane and 30 km/h. Main streets that run north and south have lights at every junction. Those that run east and
/// west have lights where they cross another main street, and priority over small streets. Small streets cross each
/// other by right before left, at all-way stops, or at roundabouts.
///
/// # Errors
/// If the size is out of range.
pub fn large_town(size: usize, driving_side: DrivingSide) -> Result<Drawing, GenerateError> {
    check_count("streets in each direction", size, SIZES)?;
    let places: Vec<f64> = (0..size).map(place).collect();
    let mut town = Town::default();
    for (row, y) in places.iter().enumerate() {
        for (column, x) in places.iter().enumerate() {
            town.layout.junctions.push(Junction { at: (*x, *y), kind: kind(row, column) });
        }
    }
    let last = places.last().copied().unwrap_or_default();
    let through: Vec<f64> = [-BEYOND].into_iter().chain(places.clone()).chain([last + BEYOND]).collect();
    for (number, at) in places.iter().enumerate() {
        let profile =
            if is_main(number) { Profile::street(2, 2, MAIN) } else { Profile::street(1, 1, SMALL) };
        town.row(*at, &through, profile);
        town.column(*at, &through, profile);
    }
    let mut canvas = Canvas::new();
    draw(&mut canvas, &town.layout);
    Ok(canvas.finish(driving_side))
}

/// Where the street with this number lies [m].
fn place(number: usize) -> f64 {
    (0..number).map(|it| BLOCKS[it % BLOCKS.len()]).sum()
}

fn is_main(number: usize) -> bool {
    number % 3 == 1
}

/// The junction of a street to the east and a street to the north.
fn kind(row: usize, column: usize) -> Kind {
    match (is_main(row), is_main(column), (row + column) % 3) {
        (_, true, _) => Kind::Crossing(Control::Signals),
        (true, false, _) => Kind::Crossing(Control::Priority),
        (false, false, 0) => Kind::Crossing(Control::RightBeforeLeft),
        (false, false, 1) => Kind::Crossing(Control::AllWayStop),
        (false, false, _) => Kind::Roundabout,
    }
}
