//! Windows of NGSIM, if they are available: counts that agree with those of the reference library.

use laneweave_maps::{Problem, ReadOptions, load};
use laneweave_network::Lanelet;
use laneweave_test_data::data;

/// Lanelets, pairs that follow, left and right changes, left and right neighbours without changes, and the sum of the
/// limits on signs [mm/s].
type Counts = [usize; 7];

#[test]
fn windows_of_ngsim_agree_with_the_reference_library() {
    let us101: Counts = [12, 6, 9, 9, 0, 0, 0];
    let expected: [(&str, Counts); 17] = [
        ("USA_Lanker-1_1_T-1", [91, 84, 57, 57, 0, 0, 1_182_421]),
        ("USA_Lanker-1_3_T-1", [95, 88, 44, 44, 15, 15, 1_236_066]),
        ("USA_Lanker-1_4_T-1", [95, 88, 44, 44, 15, 15, 1_236_066]),
        ("USA_Peach-3_1_T-1", [75, 77, 27, 27, 1, 1, 996_005]),
        ("USA_Peach-4_8_T-1", [79, 76, 36, 36, 7, 7, 1_052_779]),
        ("USA_US101-11_4_T-1", [5, 0, 4, 4, 0, 0, 0]),
        ("USA_US101-15_1_T-1", us101),
        ("USA_US101-17_1_T-1", us101),
        ("USA_US101-1_1_T-1", [6, 0, 5, 5, 0, 0, 0]),
        ("USA_US101-1_2_T-1", [6, 0, 5, 5, 0, 0, 0]),
        ("USA_US101-26_1_T-1", us101),
        ("USA_US101-3_1_T-1", us101),
        ("USA_US101-3_3_T-1", us101),
        ("USA_US101-4_1_T-1", us101),
        ("USA_US101-5_1_T-1", [5, 0, 4, 4, 0, 0, 0]),
        ("USA_US101-6_1_T-1", [5, 0, 4, 4, 0, 0, 0]),
        ("USA_US101-8_1_T-1", [5, 0, 4, 4, 0, 0, 0]),
    ];
    for (name, expected) in expected {
        let Some(path) = data(&format!("recordings/ngsim_commonroad/{name}.xml")) else { continue };
        let map = load(&path, &ReadOptions::default()).expect("the map is sound");
        // Some have bounds with the same point twice; all else is what traffic does not use.
        let is_expected = |it: &Problem| it.what.contains("one place twice") || it.what.contains(" in all: ");
        assert!(map.problems.iter().all(is_expected), "{name}");
        let lanelets = &map.network.lanelets;
        let count = |has: fn(&Lanelet) -> bool| lanelets.iter().filter(|it| has(it)).count();
        // The windows of US 101 have no signs: their tags give 130 km/h.
        let is_default = |it: &&Lanelet| it.speed_limit == 130.0 / 3.6;
        assert_eq!(lanelets.iter().all(|it| is_default(&it)), name.contains("US101"), "{name}");
        let signed: f64 = lanelets.iter().filter(|it| !is_default(it)).map(|it| it.speed_limit).sum();
        let counts = [
            lanelets.len(),
            lanelets.iter().map(|it| it.following.len()).sum(),
            count(|it| it.left.is_some()),
            count(|it| it.right.is_some()),
            count(|it| it.adjacent_left.is_some()),
            count(|it| it.adjacent_right.is_some()),
            (signed * 1000.0).round() as usize,
        ];
        assert_eq!(counts, expected, "{name}");
    }
}
