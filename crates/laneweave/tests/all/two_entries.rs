//! A vehicle between two lanes has an entry in both. They are one vehicle: they move alike at every step.

use laneweave::style::BUILT_IN;
use laneweave_scenario::scenario::{Origin, Scenario, prepare};

#[test]
fn both_entries_of_a_vehicle_in_a_lane_change_move_alike() {
    for map in ["ramps.osm", "motorway_3_lanes.osm", "town.osm"] {
        let map = laneweave_test_data::map(map);
        let mut scenario = Scenario::of_map(map);
        scenario.styles = BUILT_IN.iter().map(|it| (it.name.to_owned(), 1.0)).collect();
        scenario.demand.vehicles_per_hour = Some(4500.0);
        let mut world = prepare(&scenario, &Origin::default()).expect("it is sound").world;
        let mut seen = 0;
        for step in 0..2000 {
            world.step();
            let scene = world.scene();
            for vehicle in world.vehicles() {
                let Some(other) = vehicle.lane_change.counterpart else { continue };
                let entry = scene.motions(other.chain).iter().find(|it| it.id == vehicle.id());
                let Some(entry) = entry else { panic!("{} at {step} has one entry", vehicle.id()) };
                assert_eq!(entry.speed, vehicle.speed(), "{} at {step}", vehicle.id());
                assert!((entry.x - other.x).abs() < 1e-6, "{} at {step}: {entry:?} {other:?}", vehicle.id());
                seen += 1;
            }
        }
        assert!(seen > 1000, "{seen}");
    }
}
