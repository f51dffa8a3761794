//! A world that is saved and restored continues bit for bit, from any time and on any number of threads.

use std::num::NonZero;

use laneweave_scenario::scenario::{MadeSignals, Origin, Scenario, prepare};
use laneweave_sim::{CheckpointError, World};
use xxhash_rust::xxh3::xxh3_64;

/// A world on a built-in map, with guidance every 30 s and actuated lights.
fn world(map: &str, demand: f64, threads: usize) -> World {
    prepare(&scenario(map, demand, threads), &Origin::default()).expect("the map is sound").world
}

fn scenario(map: &str, demand: f64, threads: usize) -> Scenario {
    let map = laneweave_test_data::map(map);
    let mut scenario = Scenario::of_map(map);
    scenario.demand.vehicles_per_hour = Some(demand);
    scenario.demand.trucks = 0.2;
    scenario.guidance.interval_s = 30.0;
    scenario.made_signals = MadeSignals::Actuated;
    scenario.run.threads = NonZero::new(threads);
    scenario
}

/// A few maps of different kinds, each with a demand that fills it [veh/h].
const MAPS: [(&str, f64); 5] = [
    ("ramps.osm", 5000.0),
    ("town.osm", 4000.0),
    ("grid.osm", 3000.0),
    ("roundabout.osm", 2000.0),
    ("all_way_stop.osm", 2000.0),
];

#[test]
fn a_restored_world_goes_on_bit_for_bit() {
    for (map, demand) in MAPS {
        let mut undisturbed = world(map, demand, 1);
        // At 0 s, then during lane changes, a measurement of travel times, and yellow lights.
        for (steps, threads) in [(0, 1), (613, 2), (587, 1), (1200, 2)] {
            (0..steps).for_each(|_| undisturbed.step());
            let saved = undisturbed.save().expect("it can be saved");
            let mut restored = world(map, demand, threads);
            restored.restore(&saved).expect("it is the same world");
            assert_eq!(restored.state_hash(), undisturbed.state_hash());
            assert_eq!(restored.save().expect("it can be saved"), saved, "nothing is lost");
            for _ in 0..400 {
                restored.step();
                undisturbed.step();
                assert_eq!(restored.events(), undisturbed.events(), "{map} at {:?}", restored.clock());
            }
            assert_eq!(restored.state_hash(), undisturbed.state_hash());
            assert_eq!(
                (restored.counters(), restored.counts()),
                (undisturbed.counters(), undisturbed.counts())
            );
            assert!(steps == 0 || undisturbed.on_road() > 20, "{map}");
        }
    }
}

#[test]
fn what_is_no_state_of_this_world_is_refused_and_the_world_left_as_it_was() {
    let mut other = world("ramps.osm", 3000.0, 1);
    (0..300).for_each(|_| other.step());
    let saved = other.save().expect("it can be saved");
    let mut untouched = world("roundabout.osm", 2000.0, 1);
    (0..300).for_each(|_| untouched.step());
    let before = untouched.state_hash();
    let told = |error: Result<(), CheckpointError>| error.expect_err("it is refused").to_string();
    assert!(
        told(untouched.restore(&saved)).starts_with("it is the state of another world, with other lanes")
    );
    assert!(told(untouched.restore(&saved[..saved.len() / 2])).starts_with("it is no state of a world: "));
    assert!(told(untouched.restore(&[])).starts_with("it is no state of a world: "));
    assert_eq!(untouched.state_hash(), before);
    untouched.step();
}

#[test]
fn the_state_of_a_world_with_other_drivers_is_refused() {
    let mut one_style = scenario("ramps.osm", 3000.0, 1);
    one_style.styles = [("paper-aggressive".to_owned(), 1.0)].into();
    let mut one = prepare(&one_style, &Origin::default()).expect("the style is there").world;
    let saved = world("ramps.osm", 3000.0, 1).save().expect("it can be saved");
    let error = one.restore(&saved).expect_err("it has other drivers");
    assert_eq!(error.to_string(), "it is the state of another world, with other drivers");
}

/// A saved world in which many processes are in progress, and one into which it is restored.
fn busy() -> (Vec<u8>, World) {
    let mut busy = world("town.osm", 6000.0, 1).with_trip_log();
    (0..1800).for_each(|_| busy.step());
    assert!(busy.on_road() > 50 && busy.waiting() > 0, "{} {}", busy.on_road(), busy.waiting());
    (busy.save().expect("it can be saved"), world("town.osm", 6000.0, 1))
}

/// Pseudo-random numbers, the same ones every time.
fn numbers() -> impl Iterator<Item = u64> {
    let next =
        |it: &u64| Some(it.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407));
    std::iter::successors(Some(1), next).map(|it| it >> 24)
}

#[test]
fn with_any_one_byte_changed_a_saved_world_is_refused() {
    let (mut saved, mut world) = busy();
    let before = world.state_hash();
    let mut numbers = numbers();
    for _ in 0..10_000 {
        let (place, by) = (numbers.next().unwrap() as usize % saved.len(), numbers.next().unwrap() as u8 | 1);
        saved[place] ^= by;
        assert!(world.restore(&saved).is_err(), "byte {place}");
        saved[place] ^= by;
    }
    assert_eq!(world.state_hash(), before);
    world.restore(&saved).expect("nothing is changed any more");
}

#[test]
fn what_is_changed_and_hashed_anew_is_refused_or_driven_on_from_but_breaks_nothing() {
    let (saved, mut world) = busy();
    let mut body = saved[..saved.len() - 8].to_vec();
    let (mut numbers, mut accepted) = (numbers(), 0);
    for _ in 0..2000 {
        let (place, by) = (numbers.next().unwrap() as usize % body.len(), numbers.next().unwrap() as u8 | 1);
        body[place] ^= by;
        let whole = [&body[..], &xxh3_64(&body).to_le_bytes()].concat();
        if world.restore(&whole).is_ok() {
            accepted += 1;
            (0..12).for_each(|_| world.step());
        }
        body[place] ^= by;
    }
    assert!(accepted > 100, "{accepted}");
}
