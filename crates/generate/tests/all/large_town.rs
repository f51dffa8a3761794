//! The larger town of the generator.

use laneweave_generate::large_town;
use laneweave_maps::Map;
use laneweave_network::{DrivingSide, LaneletIndex};

fn map(size: usize, driving_side: DrivingSide) -> Map {
    let drawing = large_town(size, driving_side).expect("the town is possible");
    let map = drawing.build().expect("the drawing is sound");
    assert_eq!(map.problems, []);
    map
}

#[test]
fn every_street_ends_at_an_entrance_and_an_exit() {
    for (size, driving_side) in [(3, DrivingSide::Right), (4, DrivingSide::Left), (7, DrivingSide::Right)] {
        let network = map(size, driving_side).network;
        assert_eq!((network.entrances.len(), network.exits.len()), (4 * size, 4 * size));
    }
}

#[test]
fn a_size_out_of_range_is_refused() {
    let refusal = |size| large_town(size, DrivingSide::Right).expect_err("it is out of range").to_string();
    assert_eq!(refusal(2), "2 streets in each direction; choose 3 to 20");
    assert_eq!(refusal(21), "21 streets in each direction; choose 3 to 20");
}

#[test]
fn its_lanelets_go_on_except_at_the_edge() {
    let network = map(5, DrivingSide::Right).network;
    let ends = (0..network.lanelets.len() as u32).map(LaneletIndex);
    let ends = ends.filter(|it| network.lanelets[it.at()].following.is_empty()).count();
    let lanes: usize = network.exits.iter().map(|it| it.chains.len()).sum();
    assert_eq!(ends, lanes);
}
