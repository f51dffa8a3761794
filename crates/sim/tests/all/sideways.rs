//! Nobody moves sideways without moving forwards: not in a queue, not before an obstacle, not at the end of a lane.

use std::collections::HashMap;

use laneweave_network::Point;
use laneweave_sim::{VehicleId, World};

use crate::external::worlds::world;

/// A vehicle slower than this stands [m/s], and then moves sideways at most so fast [m/s].
const STANDS: f64 = 0.1;
const SIDEWAYS: f64 = 0.02;
const WALKS: f64 = 1.5;

/// Watches whether vehicles slide sideways.
#[derive(Default)]
pub(crate) struct Sideways {
    before: HashMap<VehicleId, (Point, f64)>,
    /// Looks at vehicles in lane changes at walking speed.
    pub(crate) slow_changes: u64,
}

impl Sideways {
    /// Looks at all vehicles in lane changes but the external ones, after a step of `dt` [s].
    pub(crate) fn look(&mut self, world: &World, dt: f64) {
        let mut now = HashMap::new();
        let changes = world.vehicles().filter(|it| it.lane_change.counterpart.is_some());
        for it in changes.filter(|it| !it.driver.is_external) {
            self.slow_changes += u64::from(it.motion.speed < WALKS);
            let (id, speed, at) = (it.motion.id, it.motion.speed, it.pose().at);
            if let Some((was, slow)) = self.before.get(&id).filter(|it| it.1.max(speed) < STANDS) {
                let heading = world.network().chain(it.spot.chain).centre.heading(it.motion.x);
                let sideways = (heading.cos() * (at.y - was.y) - heading.sin() * (at.x - was.x)).abs() / dt;
                assert!(sideways <= SIDEWAYS, "vehicle {id} at {slow} m/s slides at {sideways} m/s, {at:?}");
            }
            now.insert(id, (at, speed));
        }
        self.before = now;
    }
}

#[test]
fn nobody_moves_sideways_without_moving_forwards() {
    let roads = [
        ("lane_drop.osm", 4200.0),
        ("on_ramp.osm", 4000.0),
        ("weaving.osm", 4500.0),
        ("town.osm", 4000.0),
        ("roundabout.osm", 1500.0),
    ];
    let mut slow = 0;
    for (map, demand) in roads {
        let (mut world, mut sideways) = (world(map, demand, 11, 1), Sideways::default());
        for _ in 0..9000 {
            world.step();
            sideways.look(&world, 0.1);
        }
        let counters = world.counters();
        assert_eq!((counters.collisions, counters.overlaps, counters.stuck), (0, 0, 0), "{map}");
        slow += sideways.slow_changes;
    }
    assert!(slow > 10_000, "{slow}");
}
