//! Who stays behind a vehicle by the law of the map, says so.

use laneweave::explain::story;
use laneweave::network::LaneUse;

use crate::explain::motorway;

#[test]
fn a_driver_who_may_not_pass_on_the_slow_side_says_so() {
    let mut world = motorway();
    assert_eq!(world.network().law.lane_use, LaneUse::SlowSide);
    let mut found = 0;
    for _ in 0..3000 {
        world.step();
        for vehicle in world.vehicles().filter(|it| it.lane_change.minds_offside) {
            let account = laneweave_sim::explain(&world, vehicle.spot);
            let text = story(&account, world.network(), (vehicle.x(), vehicle.speed()), &[]);
            let says_so = text.contains("by law nobody passes it on this side");
            let Some(ahead) = account.stays_behind else {
                assert!(!says_so, "{text}");
                continue;
            };
            assert!(says_so, "{text}");
            let at = format!("({:.1} m ahead, {:.1} km/h)", ahead.gap, 3.6 * ahead.speed);
            assert!(text.contains(&at), "{text}");
            found += 1;
        }
    }
    assert!(found > 10, "{found} drivers stay behind");
}
