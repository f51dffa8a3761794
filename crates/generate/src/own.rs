//! The maps that come with the program.

use laneweave_maps::Drawing;
use laneweave_network::DrivingSide;

use super::{Control, GenerateError, Grid, Motorway, Roundabout, approach, grid, motorway, roundabout, town};

/// File names in the folder `maps`, and their contents.
///
/// # Errors
/// If one of them cannot be drawn.
pub fn own_maps() -> Result<Vec<(&'static str, Drawing)>, GenerateError> {
    let road = |lanes, length_m| Motorway { lanes, length_m, lanelet_length_m: 200.0, ..Motorway::default() };
    let single = |control| Grid { rows: 1, columns: 1, lanes: 1, control, ..Grid::default() };
    let right = DrivingSide::Right;
    Ok(vec![
        ("motorway_2_lanes.osm", motorway(&road(2, 5000.0))?),
        ("motorway_3_lanes.osm", motorway(&road(3, 5000.0))?),
        ("motorway_4_lanes.osm", motorway(&road(4, 5000.0))?),
        ("on_ramp.osm", motorway(&Motorway { on_ramp_at: vec![1500.0], ..road(3, 4000.0) })?),
        ("off_ramp.osm", motorway(&Motorway { off_ramp_at: vec![2500.0], ..road(3, 4000.0) })?),
        ("lane_drop.osm", motorway(&Motorway { lane_drop_at: Some(2500.0), ..road(3, 4000.0) })?),
        (
            "ramps.osm",
            motorway(&Motorway {
                on_ramp_at: vec![2600.0],
                off_ramp_at: vec![1800.0, 4600.0],
                ..road(3, 6000.0)
            })?,
        ),
        ("weaving.osm", motorway(&Motorway { lanelet_length_m: 200.0, ..Motorway::weaving(450.0) })?),
        ("grid.osm", grid(&Grid::default())?),
        ("priority.osm", grid(&single(Control::Priority))?),
        ("right_before_left.osm", grid(&single(Control::RightBeforeLeft))?),
        ("all_way_stop.osm", grid(&single(Control::AllWayStop))?),
        ("roundabout.osm", roundabout(&Roundabout::default())?),
        ("approach.osm", approach(right)),
        ("town.osm", town(right)),
    ])
}
