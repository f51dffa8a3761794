//! The perceptions of drivers on a real road, if the recording is available.

use std::collections::BTreeSet;

use laneweave_maps::{Map, ReadOptions, load};
use laneweave_network::Side;
use laneweave_recorded::{Assumed, Replay};
use laneweave_recordings::{Matched, clean, interaction, lane_changes};
use laneweave_sim::{Navigator, Waypoint};
use laneweave_test_data::data;

use crate::drivers::usual;

#[test]
fn the_drivers_of_a_real_road_perceive_what_is_around_them() {
    let Some(folder) = data("recordings/mona_east") else { return };
    let bytes = std::fs::read(folder.join("vehicle_tracks_000.csv")).expect("it can be read");
    let options = ReadOptions { origin: Some((0.0, 0.0)), ..ReadOptions::default() };
    let Map { network, .. } = load(&folder.join("map.osm_xy"), &options).expect("the map is sound");
    let (recording, _) = interaction::read(&bytes).expect("the tracks are sound");
    let (recording, _) = clean(recording);
    let matched = Matched::new(&network, &recording);
    let changes = lane_changes(&matched);
    let navigator = Navigator::new(&network);
    let driver_parameters = [usual()];
    let assume = |track| Assumed::by_its_speeds(&matched, track, 0);
    let replay =
        Replay::new(&matched, &changes, &navigator, &driver_parameters, assume).expect("they are drivers");
    let (mut recorded, mut there, mut between_lanes) = (0, 0, 0);
    let (mut situations, mut led, mut followed, mut close) = (0, 0, 0, 0);
    let mut drivers = BTreeSet::new();
    for number in (1..=2400).step_by(6) {
        recorded += matched.frame(number).len();
        let frame = replay.frame(number);
        for vehicle in frame.vehicles() {
            there += 1;
            let spot = frame.spot(vehicle).expect("it is there");
            let (scene, x) = (frame.scene(), frame.scene().motion(spot).x);
            between_lanes += usize::from(scene.driver(spot).phase.is_between_lanes());
            // Where permitted changes do not lead to its destination, another destination is assumed.
            let destination = scene.driver(spot).goal.destination();
            let waypoint = navigator.waypoint(destination, spot.chain);
            assert!(waypoint.leads_on(x) || navigator.reachable(spot.chain, x).next().is_none());
            for situation in Side::BOTH.into_iter().filter_map(|side| frame.perceive(vehicle, side)) {
                assert!(situation.here.route.changes < Waypoint::NO_WAY);
                drivers.insert(vehicle);
                situations += 1;
                led += usize::from(situation.here.ahead.is_some());
                followed += usize::from(situation.here.behind.is_some());
                close += usize::from(situation.here.ahead.is_some_and(|it| it.gap < -0.5));
            }
        }
    }
    let figures = format!(
        "{recorded} recorded, {there} there, {between_lanes} between lanes; {} drivers in {situations} situations, \
         {led} led, {followed} followed, {close} too close",
        drivers.len()
    );
    // Nearly all vehicles are in the scene, except those with a front bumper beyond an exit.
    assert!(there * 1000 >= recorded * 999 && between_lanes * 50 >= there, "{figures}");
    assert!(drivers.len() > 700 && situations > 8000, "{figures}");
    assert!(led * 10 > situations * 7 && followed * 10 > situations * 6, "{figures}");
    // In the recording a few vehicles overlap, such as trucks and their trailers.
    assert!(close * 50 <= situations, "{figures}");
}
