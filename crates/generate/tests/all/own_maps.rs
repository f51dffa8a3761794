//! The maps in the folder `maps`; and generated drawings, which are the same after writing and reading.

use std::fs;

use laneweave_generate::{
    Control, Grid, Motorway, Roundabout, approach, grid, motorway, own_maps, roundabout, town,
};
use laneweave_maps::{Drawing, Law, Map, ReadOptions, Rule, RuleKind, check, lanelet2, load};
use laneweave_network::{DrivingSide, Gate, Point};
use laneweave_test_data::maps;

/// A drawing of every kind.
fn drawings(driving_side: DrivingSide) -> Vec<Drawing> {
    let everything = Motorway {
        length_m: 4000.0,
        lane_width_m: 3.75,
        on_ramp_at: vec![700.0, 3100.0],
        off_ramp_at: vec![1500.0],
        lane_drop_at: Some(2345.678),
        driving_side,
        ..Motorway::default()
    };
    let controls = [Control::Signals, Control::Priority, Control::RightBeforeLeft, Control::AllWayStop];
    let grids = controls.into_iter().zip([3, 1, 2, 1]).map(|(control, lanes)| {
        grid(&Grid { rows: 2, columns: 1, lanes, control, driving_side, ..Grid::default() })
            .expect("the grid is possible")
    });
    let others = [
        approach(driving_side),
        roundabout(&Roundabout { driving_side, ..Roundabout::default() }).expect("it can be drawn"),
        town(driving_side),
    ];
    [motorway(&everything).expect("the motorway is possible")]
        .into_iter()
        .chain(grids)
        .chain(others)
        .collect()
}

#[test]
fn the_files_are_what_the_generator_draws() {
    for (name, drawing) in own_maps().unwrap() {
        let file = fs::read_to_string(maps().join(name)).unwrap();
        let drawn = lanelet2::write(&drawing);
        assert!(file == drawn, "{name} differs; run `cargo run -p laneweave-generate --example own_maps`");
        assert!(file.len() < 1_000_000, "{name} has {} bytes", file.len());
    }
}

#[test]
fn the_files_have_the_entrances_exits_and_drops_they_are_named_after() {
    let mut found = Vec::new();
    for (name, _) in own_maps().unwrap() {
        let Map { network, problems, origin, .. } =
            load(&maps().join(name), &ReadOptions::default()).unwrap();
        assert!(problems.is_empty() && origin.is_none());
        assert_eq!(check(&network), [], "{name}");
        let lanes = |gates: &[Gate]| gates.iter().map(|it| it.chains.len()).collect::<Vec<_>>();
        found.push((name, lanes(&network.entrances), lanes(&network.exits), network.lane_drops.len()));
    }
    let town = [2, 2, 1, 1, 2, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1];
    let expected: [(&str, &[usize], &[usize], usize); 15] = [
        ("motorway_2_lanes.osm", &[2], &[2], 0),
        ("motorway_3_lanes.osm", &[3], &[3], 0),
        ("motorway_4_lanes.osm", &[4], &[4], 0),
        ("on_ramp.osm", &[3, 1], &[3], 1),
        ("off_ramp.osm", &[3], &[3, 1], 0),
        ("lane_drop.osm", &[3], &[2], 1),
        ("ramps.osm", &[3, 1], &[3, 1, 1], 1),
        ("weaving.osm", &[2, 1], &[2, 1], 0),
        ("grid.osm", &[2; 12], &[2; 12], 0),
        ("priority.osm", &[1; 4], &[1; 4], 0),
        ("right_before_left.osm", &[1; 4], &[1; 4], 0),
        ("all_way_stop.osm", &[1; 4], &[1; 4], 0),
        ("roundabout.osm", &[1; 4], &[1; 4], 0),
        ("approach.osm", &[3], &[1, 1, 2], 0),
        ("town.osm", &town, &town, 1),
    ];
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert_eq!((found.0, &found.1[..], &found.2[..], found.3), expected);
    }
}

#[test]
fn a_drawing_and_its_text_make_the_same_map_bit_for_bit() {
    for side in [DrivingSide::Right, DrivingSide::Left] {
        for drawing in drawings(side) {
            let text = lanelet2::write(&drawing);
            let read = lanelet2::read(text.as_bytes(), &ReadOptions::default()).unwrap();
            let mut drawn = drawing.build().unwrap();
            // The law is none of the drawing's.
            drawn.network.law = Law::default().rules();
            assert_eq!((&read.problems, &drawn.problems), (&vec![], &vec![]));
            assert_eq!(read.network.driving_side, side);
            assert_eq!(format!("{:?}", read.network), format!("{:?}", drawn.network));
            assert_eq!(read.graph, drawn.graph);
            let read: Vec<Rule> = read.rules.into_iter().map(|it| Rule { line: None, ..it }).collect();
            assert_eq!(read, drawn.rules);
        }
    }
}

#[test]
fn rules_of_all_kinds_are_read_again_as_they_were() {
    let line = |x: f64, z: f64| vec![vec![Point::new(x, -3.5, z), Point::new(x, 0.0, z)]];
    let kinds = [
        RuleKind::TrafficLight,
        RuleKind::RightOfWay { first: vec![1.into(), 3.into()], yielding: vec![2.into()] },
        RuleKind::AllWayStop { lanelets: vec![1.into(), 2.into()] },
        RuleKind::StopSign,
        RuleKind::Crosswalk { lanelets: vec![4.into()] },
        RuleKind::Other("virtual_stop".into()),
    ];
    let rules = kinds.into_iter().zip(100..).map(|(kind, id)| {
        let (stop_lines, signs) = (line(id as f64, 0.0), line(id as f64, 5.0));
        Rule { id: id.into(), line: None, kind, lanelets: vec![1.into(), 2.into()], stop_lines, signs }
    });
    let road = motorway(&Motorway { length_m: 300.0, ..Motorway::default() }).unwrap();
    let drawing = Drawing { rules: rules.collect(), ..road };
    let map = lanelet2::read(lanelet2::write(&drawing).as_bytes(), &ReadOptions::default()).unwrap();
    // Traffic has no use for two of them.
    let unused: Vec<&str> =
        map.problems.iter().filter_map(|it| it.what.split_once(',')).map(|it| it.0).collect();
    let of = |subtype: &str| format!("regulatory elements of the subtype {subtype}");
    assert_eq!(unused, [of("crosswalk"), of("virtual_stop")]);
    let read: Vec<Rule> = map.rules.into_iter().map(|it| Rule { line: None, ..it }).collect();
    assert_eq!(read, drawing.rules);
}

#[test]
fn driving_on_the_left_is_the_mirror_image() {
    for (right, left) in drawings(DrivingSide::Right).iter().zip(drawings(DrivingSide::Left)) {
        let (right, left) = (right.build().unwrap(), left.build().unwrap());
        assert_eq!(right.graph.conflicting, left.graph.conflicting);
        assert_eq!(right.network.lanelets.len(), left.network.lanelets.len());
        for (a, b) in right.network.lanelets.iter().zip(&left.network.lanelets) {
            assert_eq!((a.id, a.speed_limit, &a.following), (b.id, b.speed_limit, &b.following));
            assert_eq!((a.left, a.right), (b.right, b.left));
            assert_eq!((a.adjacent_left, a.adjacent_right), (b.adjacent_right, b.adjacent_left));
            for (here, there) in [(&a.left_border, &b.right_border), (&a.right_border, &b.left_border)] {
                assert_eq!(here.points().len(), there.points().len());
                for (p, q) in here.points().iter().zip(there.points()) {
                    assert_eq!((p.x.to_bits(), (-p.y).to_bits()), (q.x.to_bits(), q.y.to_bits()));
                }
            }
            assert!((a.length() - b.length()).abs() < 1e-9);
        }
        assert_eq!(right.rules.len(), left.rules.len());
        for (a, b) in right.rules.iter().zip(&left.rules) {
            assert_eq!((&a.kind, &a.lanelets), (&b.kind, &b.lanelets));
            for (p, q) in a.stop_lines.iter().flatten().zip(b.stop_lines.iter().flatten()) {
                assert_eq!((p.x, -p.y, p.z), (q.x, q.y, q.z));
            }
        }
    }
}
