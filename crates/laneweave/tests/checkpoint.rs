//! A world that is saved and restored goes on bit for bit, wherever it was saved and on any number of threads.

use std::num::NonZero;
use std::path::Path;

use laneweave::scenario::{MadeSignals, Origin, Scenario, prepare};
use laneweave::sim::{CheckpointError, World};

/// A world on one of our maps, with guidance every 30 s and actuated lights.
fn world(map: &str, demand: f64, threads: usize) -> World {
    let map = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../maps").join(map);
    let mut scenario = Scenario::of_map(map);
    scenario.demand.vehicles_per_hour = Some(demand);
    scenario.demand.trucks = 0.2;
    scenario.guidance.interval_s = 30.0;
    scenario.made_signals = MadeSignals::Actuated;
    scenario.run.threads = NonZero::new(threads);
    prepare(&scenario, &Origin::default()).expect("the map is sound").world
}

/// A few maps of different kinds, each with a demand that fills it [veh/h].
const MAPS: [(&str, f64); 5] = [
    ("ramps.osm", 5000.0),
    ("town.osm", 4000.0),
    ("grid.osm", 3000.0),
    ("roundabout.osm", 2000.0),
    ("all_way_stop.osm", 1500.0),
];

#[test]
fn a_restored_world_goes_on_bit_for_bit() {
    for (map, demand) in MAPS {
        let mut undisturbed = world(map, demand, 1);
        // At 0 s, then in the midst of lane changes, of a measurement of travel times, of yellow lights.
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
            assert_eq!((restored.tally(), restored.counts()), (undisturbed.tally(), undisturbed.counts()));
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
    assert!(told(untouched.restore(&saved)).starts_with("it is the state of another world: of "));
    assert!(told(untouched.restore(&saved[..saved.len() / 2])).starts_with("it is no state of a world: "));
    assert!(told(untouched.restore(&[])).starts_with("it is no state of a world: "));
    assert_eq!(untouched.state_hash(), before);
    untouched.step();
}
