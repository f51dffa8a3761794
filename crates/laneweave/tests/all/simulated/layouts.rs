//! Through the drone and through each layout that is read, lane changes are found as they were made.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use laneweave_recorded::{Drone, Watch};
use laneweave_recordings::{LaneChange, Matched, Recording, clean, lane_changes, open};
use laneweave_scenario::scenario::{Origin, Scenario, prepare};

use laneweave_network::Network;
use laneweave_sim::Event;

use crate::simulated::drive::Made;
use crate::simulated::written::{highd, ind, ngsim};
use crate::simulated::{DRIVEN, FOUND_WITHIN, STAY, found};

/// Writes a recording into a folder, in a layout.
type Writer = fn(&Recording, &Path) -> PathBuf;

/// How many changes were made in sight, how many of them were found, and how many more were.
struct Score {
    made: usize,
    hits: usize,
    invented: usize,
}

/// Compares the changes of `recording` with those of the truth that it can show. Times near the first and last sight of
/// a vehicle are left out on both sides: there a change is seen in part.
fn score((network, all): (&Network, &[Made]), recording: &Recording) -> Score {
    let changes = lane_changes(&Matched::new(network, recording));
    let in_sight = |vehicle: i64, time: f64| {
        recording.tracks.iter().filter(|it| it.id == vehicle).any(|it| {
            let seconds = |frame: i64| frame as f64 * recording.step;
            let (first, last) = (it.states[0].frame, it.states[it.states.len() - 1].frame);
            (seconds(first) + STAY..=seconds(last) - STAY).contains(&time)
        })
    };
    let made: Vec<&Made> = all.iter().filter(|it| in_sight(it.vehicle, it.time)).collect();
    let hits: HashSet<usize> = made.iter().filter_map(|it| found(&changes, it)).map(|it| it.0).collect();
    let is_true = |it: &LaneChange| {
        let is_it = |made: &Made| made.vehicle == it.vehicle && (made.time - it.time).abs() <= FOUND_WITHIN;
        all.iter().any(is_it)
    };
    let seen = changes.iter().filter(|it| in_sight(it.vehicle, it.time));
    Score { made: made.len(), hits: hits.len(), invented: seen.filter(|it| !is_true(it)).count() }
}

#[track_caller]
fn assert_found(what: &str, Score { made, hits, invented }: Score, least: usize) {
    let figures = format!("{what}: {made} made, {hits} found, {invented} invented");
    assert!(made >= least && hits * 100 >= made * 99 && invented * 100 <= made, "{figures}");
}

#[test]
fn in_each_layout_the_lane_changes_are_those_that_were_made() {
    let (truth, recording) = &*DRIVEN;
    let at_ten = Drone::exact(10.0).observe(recording);
    let write: [(&str, Writer, &Recording); 3] =
        [("highd", highd, recording), ("ind", ind, recording), ("ngsim", ngsim, &at_ten)];
    for (name, write, recording) in write {
        let folder = std::env::temp_dir().join(format!("laneweave_layouts_{}_{name}", std::process::id()));
        fs::create_dir_all(&folder).expect("it can be made");
        let (read, problems) = open(&write(recording, &folder), None).expect("it is sound");
        assert_eq!(problems, [], "{name}");
        // NGSIM has times, and its first frame is that of the first row.
        let first = recording.frames().expect("there is traffic").0 - read.frames().expect("the same").0;
        let (mut read, _) = clean(read);
        read.tracks.iter_mut().flat_map(|it| &mut it.states).for_each(|it| it.frame += first);
        assert_eq!(read.tracks.len(), recording.tracks.len(), "{name}");
        assert_found(name, score((&truth.network, &truth.changes), &read), 300);
        fs::remove_dir_all(folder).expect("it is there");
    }
}

#[test]
fn within_300_m_of_view_the_lane_changes_in_sight_are_found() {
    let (truth, recording) = &*DRIVEN;
    let drone = Drone { above: [1200.0, 0.0], view: 300.0, ..Drone::exact(25.0) };
    let (seen, _) = clean(drone.observe(recording));
    assert_found("300 m", score((&truth.network, &truth.changes), &seen), 20);
}

/// Ten minutes of the town with a motorway through it, as they were and as a drone saw them.
fn town() -> (Network, Vec<Made>, Recording) {
    let map = laneweave_test_data::map("town.osm");
    let mut scenario = Scenario::of_map(map);
    scenario.demand.vehicles_per_hour = Some(4000.0);
    let mut world = prepare(&scenario, &Origin::default()).expect("it is sound").world;
    (0..1200).for_each(|_| world.step());
    let (mut watch, began, mut made) = (Watch::from_now(&world), world.clock().time(), Vec::new());
    for step in 0..6300 {
        if step < 6000 {
            watch.see(&world);
        }
        world.step();
        for event in world.events() {
            let Event::LaneChange(it) = event else { continue };
            let (vehicle, time, start) = (i64::from(it.vehicle), it.time - began, it.started - began);
            if it.is_completed {
                made.push(Made { vehicle, began: start, time, ended: start + it.duration });
            }
        }
    }
    let drone = Drone { noise: 0.1, ..Drone::exact(25.0) };
    (world.network().clone(), made, drone.observe(&watch.into_recording()))
}

#[test]
fn in_a_town_the_lane_changes_are_found_as_well() {
    let (network, made, recording) = town();
    let (recording, _) = clean(recording);
    assert_found("town", score((&network, &made), &recording), 150);
}
