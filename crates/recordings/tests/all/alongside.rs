//! Lanelets of real maps that lie side by side without a common border, if the maps are available.

use laneweave_maps::{ReadOptions, load};
use laneweave_test_data::data;

#[test]
fn what_lies_alongside_runs_the_same_way_a_lane_apart() {
    // Most of them fan out, or come together, in junctions.
    let expected = [
        ("crossroads_with_stoplines", 0),
        ("four_track_highway", 4),
        ("intersection", 20),
        ("karlsruhe", 7),
        ("karlsruhe_roundabout", 7),
        ("kashiwanoha", 0),
        ("tianjin", 2),
        ("town10", 34),
        ("xian", 1),
    ];
    for (file, count) in expected {
        let Some(path) = data(&format!("lanelet2/{file}.osm")) else { continue };
        let network = load(&path, &ReadOptions::default()).unwrap().network;
        let pairs = network.alongside();
        assert_eq!(pairs.len(), count, "{file}");
        for pair in pairs {
            let (left, right) = (&network.lanelets[pair.left.at()], &network.lanelets[pair.right.at()]);
            for part in [0.1, 0.5, 0.9] {
                let along = |stretch: [f64; 2]| stretch[0] + part * (stretch[1] - stretch[0]);
                let (l, r) = (along(pair.on_left), along(pair.on_right));
                let apart = left.centre.at(l).distance(&right.centre.at(r));
                let turn = left.centre.heading(l) - right.centre.heading(r);
                let what = format!("{file}: {} and {}, {apart} m, {turn} rad", left.id, right.id);
                assert!((2.0..7.0).contains(&apart) && turn.cos() > 0.9, "{what}");
            }
        }
    }
}
