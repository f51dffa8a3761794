//! Real maps, if they are available: counts that agree with those of the reference library.

use laneweave_maps::lanelet2::{self, Document};
use laneweave_maps::{Map, ReadOptions, Rule, load};
use laneweave_network::Lanelet;
use laneweave_test_data::data;

fn read(file: &str) -> Option<Map> {
    Some(load(&data(file)?, &ReadOptions::default()).expect("the map is sound"))
}

/// Lanelets for cars, pairs that follow, left and right changes, left and right neighbours without changes, conflicts
/// seen from both sides, problems.
type Counts = [usize; 8];

fn counts(map: &Map) -> Counts {
    let lanelets = &map.network.lanelets;
    let count = |has: fn(&Lanelet) -> bool| lanelets.iter().filter(|it| has(it)).count();
    [
        lanelets.len(),
        lanelets.iter().map(|it| it.following.len()).sum(),
        count(|it| it.left.is_some()),
        count(|it| it.right.is_some()),
        count(|it| it.adjacent_left.is_some()),
        count(|it| it.adjacent_right.is_some()),
        map.graph.conflicting.iter().map(Vec::len).sum(),
        map.problems.len(),
    ]
}

const MAPS: [(&str, Counts); 11] = [
    ("lanelet2/crossroads_with_stoplines.osm", [79, 100, 0, 0, 0, 0, 176, 4]),
    ("lanelet2/four_track_highway.osm", [36, 28, 16, 16, 6, 6, 0, 2]),
    ("lanelet2/intersection.osm", [58, 57, 10, 10, 9, 9, 104, 6]),
    // The reference adds four successors that are two-way lanelets driven backwards, which traffic does not use here.
    ("lanelet2/karlsruhe.osm", [328, 313, 57, 56, 54, 55, 298, 70]),
    ("lanelet2/karlsruhe_roundabout.osm", [232, 225, 53, 52, 52, 53, 175, 8]),
    ("lanelet2/kashiwanoha.osm", [77, 93, 3, 3, 0, 0, 168, 4]),
    ("lanelet2/tianjin.osm", [62, 66, 2, 2, 26, 26, 576, 13]),
    ("lanelet2/town10.osm", [128, 160, 27, 27, 10, 10, 452, 0]),
    ("lanelet2/xian.osm", [52, 48, 6, 6, 16, 16, 196, 2]),
    ("recordings/mona_east/map.osm", [34, 20, 12, 12, 0, 0, 40, 11]),
    ("recordings/mona_east/map.osm_xy", [34, 20, 12, 12, 0, 0, 40, 11]),
];

#[test]
fn graphs_agree_with_the_reference_library() {
    for (file, expected) in MAPS {
        if let Some(map) = read(file) {
            assert_eq!(counts(&map), expected, "{file}");
        }
    }
}

#[test]
fn a_map_that_is_written_and_read_again_is_the_same() {
    for (file, _) in MAPS {
        let Some(path) = data(file) else { continue };
        let bytes = std::fs::read(path).expect("it can be read");
        let (document, problems) = Document::parse(&bytes).unwrap();
        let text = document.write();
        let map = document.map(problems, &ReadOptions::default()).unwrap();
        let again = lanelet2::read(text.as_bytes(), &ReadOptions::default()).unwrap();
        // Lanelets, chains, entrances and everything else, to the last bit.
        assert_eq!(format!("{:?}", again.network), format!("{:?}", map.network), "{file}");
        assert_eq!((&again.graph, &again.contents, again.origin), (&map.graph, &map.contents, map.origin));
        let lineless = |map: &Map| -> Vec<Rule> {
            map.rules.iter().map(|it| Rule { line: None, ..it.clone() }).collect()
        };
        assert_eq!(lineless(&again), lineless(&map), "{file}");
        assert_eq!(again.problems.len(), map.problems.len(), "{file}");
    }
}

#[test]
fn projected_and_metric_coordinates_of_one_place_agree() {
    let (projected, metric) = (read("recordings/mona_east/map.osm"), read("recordings/mona_east/map.osm_xy"));
    let (Some(projected), Some(metric)) = (projected, metric) else { return };
    assert_eq!((projected.origin, metric.origin), (Some((0.0, 0.0)), None));
    for (a, b) in projected.network.lanelets.iter().zip(&metric.network.lanelets) {
        assert_eq!(a.id, b.id);
        for (p, q) in a.left_border.points().iter().zip(b.left_border.points()) {
            // The metric file is rounded to a tenth of a millimetre.
            assert!(p.distance(q) < 1e-4, "lanelet {}: {p:?} {q:?}", a.id);
        }
    }
}

#[test]
fn four_track_highway_lies_where_its_local_coordinates_say() {
    let Some(map) = read("lanelet2/four_track_highway.osm") else { return };
    let lanelet = &map.network.lanelets[0];
    assert!((81_000.0..82_500.0).contains(&lanelet.centre.points()[0].x));
    assert!(map.origin.is_none());
    let limits: Vec<f64> = map.network.lanelets.iter().map(|it| (it.speed_limit * 3.6).round()).collect();
    assert_eq!(limits.iter().filter(|it| **it == 50.0).count(), 24);
    assert_eq!(limits.iter().filter(|it| **it == 60.0).count(), 12);
}
