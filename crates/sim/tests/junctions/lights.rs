//! Red lights.

use std::collections::HashMap;

use laneweave_network::{LightState, Sign};
use laneweave_sim::{Setup, World};

use crate::drivers;
use crate::town::{STEP, assert_sound, network};

#[test]
fn nobody_drives_over_the_line_of_a_red_light() {
    const STEPS: u32 = 3000;
    let network = network("grid.osm");
    let demand = drivers::demand(&network, 4000.0, 0.1, &[0.3, 0.7]);
    let characters = vec![drivers::aggressive(), drivers::conservative()];
    let setup = Setup { step: STEP, seed: 3, threads: 1 };
    let mut world = World::new(network, characters, demand, setup).expect("the set-up makes sense");
    let (mut passed, mut stood) = (0, 0);
    let mut before = HashMap::new();
    for _ in 0..STEPS {
        let time = world.clock().time();
        world.step();
        let junctions = &world.network().junctions;
        let mut now = HashMap::new();
        for vehicle in world.vehicles() {
            let (id, chain, x) = (vehicle.id(), vehicle.spot.chain, vehicle.x());
            now.insert(id, (chain, x));
            let Some((lane, was)) = before.get(&id).copied() else { continue };
            let has_left = world.network().chain(lane).following.contains(&chain);
            for stop in junctions.on(lane).stops.iter().filter(|it| was <= it.station) {
                let Sign::Light(light) = stop.sign else { continue };
                let state = junctions.lights[light.at()].program.state(time);
                if has_left || (chain == lane && x > stop.station) {
                    assert_ne!(state, LightState::Red, "{id} at {time:.1} s with {:.1} m/s", vehicle.speed());
                    passed += 1;
                }
                let waits = chain == lane && x > stop.station - 5.0 && vehicle.speed() == 0.0;
                stood += u32::from(state == LightState::Red && waits);
            }
        }
        before = now;
    }
    assert!(passed > 50 && stood > 1000, "{passed} passed, {stood} steps at standstill");
    assert_sound(&world);
}
