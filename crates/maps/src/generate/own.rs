//! The maps that come with the program.

use super::Motorway;

/// File names in the folder `maps`, and the motorways that they hold.
pub fn own_maps() -> Vec<(&'static str, Motorway)> {
    let motorway =
        |lanes, length_m| Motorway { lanes, length_m, lanelet_length_m: 200.0, ..Motorway::default() };
    vec![
        ("motorway_2_lanes.osm", motorway(2, 5000.0)),
        ("motorway_3_lanes.osm", motorway(3, 5000.0)),
        ("motorway_4_lanes.osm", motorway(4, 5000.0)),
        ("on_ramp.osm", Motorway { on_ramp_at: vec![1500.0], ..motorway(3, 4000.0) }),
        ("off_ramp.osm", Motorway { off_ramp_at: vec![2500.0], ..motorway(3, 4000.0) }),
        ("lane_drop.osm", Motorway { lane_drop_at: Some(2500.0), ..motorway(3, 4000.0) }),
        (
            "ramps.osm",
            Motorway { on_ramp_at: vec![2600.0], off_ramp_at: vec![1800.0, 4600.0], ..motorway(3, 6000.0) },
        ),
    ]
}
