//! Any numbers give a map that can be driven, or a refusal.

use laneweave_generate::{Control, Grid, Motorway, Weaving, grid, motorway};
use laneweave_maps::{Map, check};
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

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
