//! Simulated traffic, written as a recording with 10 cm of noise at 25 Hz and read again, shows its lane changes and
//! the knowledge of its drivers.

mod drive;
mod layouts;
mod town;
mod view;
#[path = "../../../../recordings/tests/all/datasets/written.rs"]
mod written;

use std::collections::{BTreeMap, HashSet};
use std::sync::LazyLock;

use drive::{Made, STEP, Stand, Truth, drive};
use laneweave_recorded::{Assumed, Evidence, Frame, Replay};
use laneweave_recordings::{LaneChange, Matched, Recording, clean, extents, interaction, lane_changes};
use laneweave_sim::Navigator;
use view::View;

/// The true values, and those from the file.
static DRIVEN: LazyLock<(Truth, Recording)> = LazyLock::new(|| {
    let (truth, seen) = drive(1);
    let mut file = Vec::new();
    interaction::write(&seen, &mut file).expect("memory can be written to");
    let (recording, problems) = interaction::read(&file).expect("it is a recording");
    assert_eq!(problems, []);
    (truth, clean(recording).0)
});

/// Maximum error of a crossing for a detected change [s].
const FOUND_WITHIN: f64 = 0.5;
/// A vehicle that is observed for a shorter time after a crossing has not changed lanes [s].
const STAY: f64 = 0.8;

/// The detected change for a true one.
fn found<'a>(changes: &'a [LaneChange], made: &Made) -> Option<(usize, &'a LaneChange)> {
    let is_it = |it: &LaneChange| it.vehicle == made.vehicle && (it.time - made.time).abs() <= FOUND_WITHIN;
    changes.iter().enumerate().find(|(_, it)| is_it(it))
}

#[test]
fn its_lane_changes_are_found_and_hardly_any_that_was_not_made() {
    let (truth, recording) = &*DRIVEN;
    let changes = lane_changes(&Matched::new(&truth.network, recording));
    let last_seen = |vehicle: i64| {
        let last = recording.tracks.iter().find(|it| it.id == vehicle)?.states.last()?;
        Some(last.frame as f64 * STEP)
    };
    let counts = |it: &&Made| last_seen(it.vehicle).is_some_and(|last| last - it.time >= STAY);
    let made = truth.changes.iter().filter(counts).count();
    let hits = truth.changes.iter().filter(counts).filter(|it| found(&changes, it).is_some()).count();
    let explained: HashSet<usize> =
        truth.changes.iter().filter_map(|it| found(&changes, it)).map(|(index, _)| index).collect();
    let invented = changes.len() - explained.len();
    let figures = format!("{made} made, {hits} of them found, {} found, {invented} invented", changes.len());
    assert!(made >= 300, "{figures}");
    assert!(hits * 100 >= made * 99 && invented * 100 <= changes.len(), "{figures}");
}

#[test]
fn changes_begin_and_end_when_they_did_to_a_tenth_of_a_second() {
    let (truth, recording) = &*DRIVEN;
    let matched = Matched::new(&truth.network, recording);
    let changes = lane_changes(&matched);
    let extents = extents(&matched, &changes);
    let mut errors: Vec<f64> = Vec::new();
    for made in &truth.changes {
        let Some((index, _)) = found(&changes, made) else { continue };
        errors.push((extents[index].began - made.began).abs());
        errors.push((extents[index].ended - made.ended).abs());
    }
    errors.sort_by(f64::total_cmp);
    let quantile = |percent: usize| errors[errors.len() * percent / 100];
    assert!(quantile(50) < 0.04 && quantile(90) < 0.1, "{} {}", quantile(50), quantile(90));
}

#[test]
fn durations_are_recovered_in_the_median_and_changes_that_were_cut_off_are_not_among_them() {
    let (truth, recording) = &*DRIVEN;
    let matched = Matched::new(&truth.network, recording);
    let changes = lane_changes(&matched);
    let navigator = Navigator::new(&truth.network);
    let assume = |track| Assumed::by_its_speeds(&matched, track, 0);
    let replay =
        Replay::new(&matched, &changes, &navigator, &truth.driver_parameters, assume).expect("drivers");
    let evidence = Evidence::of(&matched, &changes, &extents(&matched, &changes), &replay);
    let mut durations: Vec<f64> = truth.changes.iter().map(|it| it.ended - it.began).collect();
    durations.sort_by(f64::total_cmp);
    let (true_median, found) = (durations[durations.len() / 2], evidence.median_duration().expect("changes"));
    assert!((found - true_median).abs() < 0.2, "{found} instead of {true_median}");
    // Some begin as soon as their vehicle has entered the road, where it is first seen.
    let first_seen = |vehicle: i64| {
        let track = recording.tracks.iter().find(|it| it.id == vehicle)?;
        track.states.first().map(|it| it.frame as f64 * STEP)
    };
    let begins_with = |it: &&Made| first_seen(it.vehicle).is_some_and(|first| it.began < first + 0.2);
    let cut_off = truth.changes.iter().filter(begins_with).count();
    assert!(evidence.begun_before.abs_diff(cut_off) <= 3, "{} of {cut_off}", evidence.begun_before);
    assert_eq!(evidence.durations.len() + evidence.begun_before + evidence.not_ended, changes.len());
    assert!(evidence.forbidden.is_empty() && evidence.free_veh_h < evidence.veh_h);
    let sums = evidence.densities.iter().fold((0.0, 0), |(h, n), (_, it)| (h + it.veh_h, n + it.changes));
    assert!((sums.0 - evidence.veh_h).abs() < 1e-6 && sums.1 == changes.len(), "{sums:?}");
}

/// Simulated drivers obey a new limit when they next consider lanes: after so many frames at most. Before a bend or a
/// lower limit they slow down; recorded ones are supposed to desire what is allowed where they are.
const CONSIDERS_WITHIN: i64 = (2.0 / STEP) as i64;

/// The limit where a vehicle is in a recorded frame [m/s].
fn limit(frame: &Frame<'_>, vehicle: i64) -> Option<f64> {
    let (scene, spot) = (frame.scene(), frame.spot(vehicle)?);
    Some(scene.network.chain(spot.chain).limit(scene.motion(spot).x))
}

/// How often what a recorded driver knows is what the simulated one knew, and where it is not.
fn outcomes(truth: &Truth, recording: &Recording) -> BTreeMap<&'static str, usize> {
    let matched = Matched::new(&truth.network, recording);
    let navigator = Navigator::new(&truth.network);
    let assume = |track: usize| {
        let parameters = truth.character_of[&recording.tracks[track].id];
        Assumed { parameters, speed_factor: truth.driver_parameters[parameters as usize].speed_factor }
    };
    let changes = lane_changes(&matched);
    let replay =
        Replay::new(&matched, &changes, &navigator, &truth.driver_parameters, assume).expect("drivers");
    let mut outcomes = BTreeMap::new();
    for instant in &truth.instants {
        let frame = replay.frame(instant.frame);
        // The observed begin, crossing or end of a change is a frame or two too early or late; a change whose vehicle
        // leaves the map before it counts is not known.
        let differs = stands(&frame) != instant.stands;
        for sample in &instant.samples {
            let seen = frame.perceive(sample.vehicle, sample.side).as_ref().map(View::of);
            let outcome = match (&seen, &sample.view) {
                (None, None) => continue,
                (Some(seen), Some(known)) if seen.agrees(known) => "agree",
                _ if differs => "while a lane change begins, crosses or ends",
                (Some(seen), Some(known)) if known.desired < seen.desired => "slows for what lies ahead",
                (Some(seen), Some(known)) if known.desired > seen.desired => {
                    let had = limit(&replay.frame(instant.frame - CONSIDERS_WITHIN), sample.vehicle);
                    if had > limit(&frame, sample.vehicle) { "new limit" } else { "another desired speed" }
                }
                (Some(seen), Some(known)) if seen.agrees_here(known) => "beyond junctions",
                // A vehicle is at the edge of the range, or exactly alongside.
                _ => "edge",
            };
            *outcomes.entry(outcome).or_default() += 1;
        }
    }
    outcomes
}

#[test]
fn a_recorded_driver_knows_what_the_simulated_one_knew() {
    let (truth, recording) = &*DRIVEN;
    let outcomes = outcomes(truth, recording);
    let samples: usize = outcomes.values().sum();
    let count = |outcome: &str| outcomes.get(outcome).copied().unwrap_or(0);
    assert!(samples >= 2000, "{outcomes:?}");
    // How many instants a change touches depends on how often drivers change lanes; at all others they agree.
    let during = count("while a lane change begins, crosses or ends");
    assert!(count("agree") * 100 >= (samples - during) * 99 && during * 50 <= samples, "{outcomes:?}");
    assert!(count("edge") * 400 <= samples, "{outcomes:?}");
    assert_eq!((count("another desired speed"), count("beyond junctions")), (0, 0), "{outcomes:?}");
}

/// The positions of vehicles, and those between lanes, in a recorded frame.
fn stands(frame: &Frame<'_>) -> Vec<Stand> {
    let scene = frame.scene();
    let stand = |vehicle: i64| {
        let spot = frame.spot(vehicle)?;
        let is_between_lanes = scene.driver(spot).phase.is_between_lanes();
        Some(Stand { vehicle, chain: spot.chain, is_between_lanes })
    };
    frame.vehicles().filter_map(stand).collect()
}
