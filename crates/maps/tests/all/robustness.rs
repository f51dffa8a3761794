//! The reader does not panic, whatever the bytes.

use laneweave_maps::generate::{Control, Grid, Motorway, Weaving, grid, motorway};
use laneweave_maps::{Map, ReadOptions, check, lanelet2};
use proptest::prelude::*;

fn map() -> String {
    let small = Motorway {
        lanes: 2,
        length_m: 800.0,
        on_ramp_at: vec![300.0],
        lanelet_length_m: 200.0,
        ..Motorway::default()
    };
    lanelet2::write(&motorway(&small).expect("the motorway is possible"))
}

/// Text that is put into files: markup in unusual places, and invalid numbers.
fn scrap() -> impl Strategy<Value = Vec<u8>> {
    prop_oneof![
        prop::collection::vec(any::<u8>(), 0..4),
        prop::sample::select(vec![
            "<",
            ">",
            "/>",
            "\"",
            "&",
            "&#0;",
            "<!--",
            "<![CDATA[",
            "<?",
            "</osm>",
            "<way id=\"1\">",
            "-",
            "NaN",
            "inf",
            "1e308",
            "-1e-308",
            "\u{feff}",
            "99999999999999999999",
        ])
        .prop_map(|it| it.as_bytes().to_vec()),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn mutated_maps_never_panic(
        changes in prop::collection::vec((any::<prop::sample::Index>(), 0_usize..40, scrap()), 1..12),
    ) {
        let mut bytes = map().into_bytes();
        for (at, length, scrap) in changes {
            let from = at.index(bytes.len().max(1)).min(bytes.len());
            let to = (from + length).min(bytes.len());
            bytes.splice(from..to, scrap);
        }
        let _ = lanelet2::read(&bytes, &ReadOptions::default());
    }

    #[test]
    fn maps_with_any_numbers_never_panic(
        numbers in prop::collection::vec((any::<prop::sample::Index>(), any::<f64>()), 1..30),
    ) {
        let mut parts: Vec<String> = map().split('"').map(String::from).collect();
        for (at, number) in numbers {
            // Every second part is the value of an attribute.
            let value = 2 * at.index(parts.len() / 2) + 1;
            if parts[value].parse::<f64>().is_ok() {
                parts[value] = number.to_string();
            }
        }
        let _ = lanelet2::read(parts.join("\"").as_bytes(), &ReadOptions::default());
    }

    #[test]
    fn any_motorway_is_drawn_or_refused(
        (lanes, length_m, limit, width, lanelet) in
            (0_usize..15, -10.0..9000.0_f64, 0.0..200.0_f64, 1.0..6.0_f64, 5.0..500.0_f64),
        on_ramp_at in prop::collection::vec(0.0..9000.0_f64, 0..3),
        off_ramp_at in prop::collection::vec(0.0..9000.0_f64, 0..3),
        lane_drop_at in prop::option::of(0.0..9000.0_f64),
        weaving in prop::option::of((0.0..9000.0_f64, 0.0..1200.0_f64)),
    ) {
        let wanted = Motorway {
            lanes,
            length_m,
            speed_limit_kmh: limit,
            lane_width_m: width,
            lanelet_length_m: lanelet,
            on_ramp_at,
            off_ramp_at,
            lane_drop_at,
            weaving: weaving.map(|(from_m, length_m)| Weaving { from_m, length_m }),
            ..Motorway::default()
        };
        if let Ok(drawing) = motorway(&wanted) {
            let Map { network, problems, .. } = drawing.build().unwrap();
            prop_assert!(problems.is_empty());
            let weavings = usize::from(wanted.weaving.is_some());
            prop_assert_eq!(network.entrances.len(), 1 + wanted.on_ramp_at.len() + weavings);
            prop_assert_eq!(network.exits.len(), 1 + wanted.off_ramp_at.len() + weavings);
            let drops = usize::from(wanted.lane_drop_at.is_some()) + wanted.on_ramp_at.len();
            prop_assert_eq!(network.lane_drops.len(), drops);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_grid_is_drawn_or_refused(
        (rows, columns, lanes) in (0_usize..4, 0_usize..4, 0_usize..5),
        block_length_m in 60.0..400.0_f64,
        limit in 0.0..150.0_f64,
        control in prop::sample::select(vec![
            Control::Signals, Control::Priority, Control::RightBeforeLeft, Control::AllWayStop,
        ]),
    ) {
        let wanted =
            Grid { rows, columns, lanes, block_length_m, speed_limit_kmh: limit, control, ..Grid::default() };
        if let Ok(drawing) = grid(&wanted) {
            let Map { network, problems, .. } = drawing.build().unwrap();
            prop_assert!(problems.is_empty());
            prop_assert_eq!(check(&network), vec![]);
            prop_assert_eq!(network.entrances.len(), 2 * (rows + columns));
            prop_assert_eq!(network.exits.len(), 2 * (rows + columns));
            prop_assert!(network.lane_drops.is_empty());
        }
    }
}
