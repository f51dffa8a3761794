//! A real road, if it is available: six streams and 934 vehicles in 480 s.

use std::collections::BTreeSet;

use laneweave_maps::{Map, ReadOptions, load};
use laneweave_network::{Id, LaneletIndex};
use laneweave_recordings::{
    CutIn, LaneChange, Matched, RecordedChangeKind, Recording, clean, cut_ins, interaction, lane_changes,
};
use laneweave_test_data::data;

fn map(file: &str) -> Option<Map> {
    let path = data(&format!("recordings/mona_east/{file}"))?;
    let options = ReadOptions { origin: Some((0.0, 0.0)), ..ReadOptions::default() };
    Some(load(&path, &options).expect("the map is sound"))
}

fn recording() -> Option<Recording> {
    let path = data("recordings/mona_east/vehicle_tracks_000.csv")?;
    let bytes = std::fs::read(path).expect("it can be read");
    let (recording, problems) = interaction::read(&bytes).expect("the tracks are sound");
    assert_eq!(problems, []);
    Some(recording)
}

#[test]
fn lanelets_whose_common_border_was_drawn_twice_lie_alongside() {
    for file in ["map.osm", "map.osm_xy"] {
        let Some(Map { network, .. }) = map(file) else { return };
        let id = |it: LaneletIndex| network.lanelets[it.at()].id.number();
        let pairs: BTreeSet<_> = network.alongside().iter().map(|it| (id(it.left), id(it.right))).collect();
        for wanted in [(556, 223), (223, 338), (482, 285)] {
            assert!(pairs.contains(&(Some(wanted.0), Some(wanted.1))), "{wanted:?} in {file}");
        }
        // The two directions of the road, between 285 and 298, and the fan behind 307 from end to end.
        for other in [(285, 298), (298, 285), (338, 375), (375, 338)] {
            assert!(!pairs.contains(&(Some(other.0), Some(other.1))), "{other:?} in {file}");
        }
    }
}

#[test]
fn all_tracks_are_read_and_few_states_are_mended() {
    let Some(recording) = recording() else { return };
    assert_eq!((recording.step, recording.tracks.len(), recording.frames()), (0.2, 934, Some((1, 2400))));
    let (cleaned, report) = clean(recording);
    assert_eq!(report.states, 92_058);
    // Most vehicles are seen in part when they come into view, and not when they go out of it.
    let share = report.partly_seen.count as f64 / cleaned.tracks.len() as f64;
    assert!((0.6..0.8).contains(&share), "{report}");
    assert!(
        report.speeds.count + report.headings.count + report.outliers.count + report.jumps.count < 50,
        "{report}"
    );
    // Nothing is left to correct.
    let (again, report) = clean(cleaned.clone());
    assert!(report.jumps.count + report.long_gaps.count + report.speeds.count == 0, "{report}");
    assert_eq!(again.tracks.len(), cleaned.tracks.len());
}

#[test]
fn nearly_every_state_is_in_a_lane_and_goes_on_where_lanes_lead() {
    let (Some(map), Some(recording)) = (map("map.osm_xy"), recording()) else { return };
    let (recording, _) = clean(recording);
    let matched = Matched::new(&map.network, &recording);
    let states = matched.places.iter().flatten().count();
    let placed: Vec<_> = matched.places.iter().flatten().flatten().collect();
    assert!(placed.len() as f64 > 0.999 * states as f64, "{} of {states}", placed.len());
    let is_inside = |place: &&&laneweave_recordings::Place| {
        let lanelet = &map.network.lanelets[place.lanelet.at()];
        place.offset.abs() <= 0.5 * lanelet.width(place.station)
    };
    let inside = placed.iter().filter(is_inside).count();
    assert!(inside as f64 > 0.99 * placed.len() as f64, "{inside} of {}", placed.len());
}

#[test]
fn a_frame_shows_who_follows_whom() {
    let (Some(map), Some(recording)) = (map("map.osm_xy"), recording()) else { return };
    let (recording, _) = clean(recording);
    let matched = Matched::new(&map.network, &recording);
    let frame = matched.frame(1200);
    let there = recording.tracks.iter().filter(|it| it.at(1200).is_some()).count();
    assert!(frame.len() == there && there > 20, "{} of {there}", frame.len());
    for pair in frame.windows(2).filter(|pair| pair[0].place.lanelet == pair[1].place.lanelet) {
        let gap = pair[1].place.station - pair[0].place.station;
        assert!(gap > 0.4 * (pair[0].track.length + pair[1].track.length), "{pair:?}");
    }
    assert!(frame.iter().all(|it| it.acceleration.abs() < 6.0));
}

#[test]
fn its_lane_changes_are_found() {
    let Some(recording) = recording() else { return };
    let (recording, _) = clean(recording);
    let mut found: Vec<Vec<(i64, Id, Id)>> = Vec::new();
    for file in ["map.osm", "map.osm_xy"] {
        let Some(Map { network, .. }) = map(file) else { return };
        let changes = lane_changes(&Matched::new(&network, &recording));
        // 138 by an independent count, of which 109 along the graph.
        let count = |has: fn(&LaneChange) -> bool| changes.iter().filter(|it| has(it)).count();
        let kinds =
            [RecordedChangeKind::Discretionary, RecordedChangeKind::Route, RecordedChangeKind::Unknown]
                .map(|kind| changes.iter().filter(|it| it.kind == kind).count());
        assert_eq!((changes.len(), kinds, count(|it| it.along_graph)), (134, [92, 36, 6], 93));
        assert_eq!(count(|it| it.returned_after.is_some()), 2);
        let id = |it: LaneletIndex| network.lanelets[it.at()].id;
        found.push(changes.iter().map(|it| (it.vehicle, id(it.from), id(it.to))).collect());
    }
    assert_eq!(found[0], found[1], "the same place in degrees and in metres");
}

#[test]
fn its_cut_ins_are_those_that_the_page_on_plausibility_compares_with() {
    let (Some(map), Some(recording)) = (map("map.osm_xy"), recording()) else { return };
    let (recording, _) = clean(recording);
    let matched = Matched::new(&map.network, &recording);
    let found = cut_ins(&matched, &lane_changes(&matched));
    let at = |from: f64, to: f64| {
        let is_in = |it: &&CutIn| (from..to).contains(&(3.6 * it.follower_speed));
        let mut gaps: Vec<f64> = found.iter().filter(is_in).map(|it| it.gap).collect();
        gaps.sort_by(f64::total_cmp);
        (gaps.len(), 0.5 * (gaps[(gaps.len() - 1) / 2] + gaps[gaps.len() / 2]))
    };
    for ((from, to), (count, median)) in
        [((0.0, 30.0), (11, 9.8)), ((30.0, 60.0), (34, 17.4)), ((60.0, 90.0), (14, 28.8))]
    {
        let (found, gap) = at(from, to);
        assert!(found == count && (gap - median).abs() < 0.06, "{found} and {gap} from {from} km/h");
    }
    assert_eq!(found.len(), 59);
    // One of the two is an error of the recording: 1.7 m close at 4.6 m/s, and nobody collides.
    let short = found.iter().filter(|it| it.inverse_time_to_collision() > 1.0 / 3.0);
    assert_eq!(short.map(|it| it.gap < 2.0).collect::<Vec<_>>(), [false, true]);
}
