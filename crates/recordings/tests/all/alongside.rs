//! Lanelets of real maps that lie side by side without a common border, if the maps are available.

use std::path::Path;

use laneweave_maps::{ReadOptions, load};

const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data/lanelet2/");

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
        let path = Path::new(DATA).join(file).with_extension("osm");
        if !path.exists() {
            eprintln!("skipped: {file} is not there");
            continue;
        }
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
