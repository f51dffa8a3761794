//! Red lights.

use std::collections::HashMap;

use laneweave_network::{LightIndex, LightState, Network, Sign, SignalPlan, Turn};
use laneweave_sim::{Class, Placement, Setup, World};

use crate::junctions::town::{STEP, assert_sound, empty};
use crate::roads::{drivers, network};

#[test]
fn nobody_drives_over_the_line_of_a_red_light() {
    const STEPS: u32 = 3000;
    let network = network("grid.osm");
    let demand = drivers::demand(&network, 4000.0, 0.1, &[0.3, 0.7]);
    let driver_parameters = vec![drivers::aggressive(), drivers::conservative()];
    let setup = Setup { step: STEP, seed: 3, threads: 1 };
    let mut world = World::new(network, driver_parameters, demand, setup).expect("the set-up makes sense");
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

/// A grid with lights that are green, then yellow, then red; the times of green and red are given [s].
fn grid_of_lights(green: f64, red: f64) -> Network {
    let network = network("grid.osm");
    let lights = (0..network.junctions.lights.len() as u32).map(LightIndex).collect();
    let turn = |lights, green| Turn { lights, green, extension: None, yellow: 3.0, all_red: 2.0 };
    let turns = vec![turn(lights, green), turn(Vec::new(), red)];
    network.with_signals(&[SignalPlan { offset: 0.0, turns }])
}

/// A driver who comes to its first light from a position in its lane [m] at a speed [m/s].
fn comer_to_a_light(network: &Network, [x, speed]: [f64; 2]) -> World {
    let chain = network.entrances[0].chains[0];
    let mut world = empty(network.clone(), vec![drivers::conservative()]);
    let destination =
        (0..world.demand().destinations.len()).find(|it| world.leads(0, *it)).map(|it| it as u16);
    world
        .place(Placement { chain, x, speed, class: Class::Car, parameters: 0, destination })
        .expect("it fits on the road");
    world
}

#[test]
fn a_queue_drives_over_the_line_of_a_green_light_without_braking_for_it() {
    let network = grid_of_lights(60.0, 30.0);
    let chain = network.entrances[0].chains[0];
    let line = network.junctions.on(chain).stops[0].station;
    let mut world = comer_to_a_light(&network, [line - 60.0, 9.0]);
    let first = world.vehicles().next().expect("it is on the road").driver.goal.destination();
    for place in 1..4 {
        let x = line - 60.0 - 20.0 * f64::from(place);
        let class = Class::Car;
        let follower = Placement { chain, x, speed: 9.0, class, parameters: 0, destination: first };
        world.place(follower).expect("it fits on the road");
    }
    let mut passed = 0;
    for _ in 0..200 {
        let before: HashMap<_, _> =
            world.vehicles().map(|it| (it.id(), (it.spot.chain, it.speed()))).collect();
        world.step();
        for vehicle in world.vehicles() {
            let (lane, speed) = before[&vehicle.id()];
            let braking = (speed - vehicle.speed()) / STEP;
            assert!(lane != chain || braking < 0.5, "{} brakes with {braking} m/s²", vehicle.id());
            passed += u32::from(lane == chain && vehicle.spot.chain != chain);
        }
    }
    assert_eq!(passed, 4);
}

/// Number of stuck vehicles after ten minutes: one driver is at a light that is green for 5 s, then red for `red`
/// [s].
fn stuck_before_a_red_of(red: f64) -> u64 {
    let mut world = comer_to_a_light(&grid_of_lights(5.0, red), [10.0, 10.0]);
    (0..6000).for_each(|_| world.step());
    world.counters().stuck
}

#[test]
fn nobody_who_is_3_m_from_the_line_or_more_brakes_hard_for_a_light_that_turns_yellow() {
    /// Twice comfortable braking [m/s²].
    const HARDEST: f64 = 4.0;
    let network = grid_of_lights(0.5, 30.0);
    let line = network.junctions.on(network.entrances[0].chains[0]).stops[0].station;
    for number in 0..40 {
        let start = [line - 3.0 - 0.5 * f64::from(number), 0.4 + 0.9 * f64::from(number % 13)];
        let mut world = comer_to_a_light(&network, start);
        // It appears without a reservation, and gets one.
        (0..3).for_each(|_| world.step());
        let at_first = world.counters().emergency_brakings;
        let hardest = (0..150).fold(0.0, |hardest: f64, _| {
            let before: f64 = world.vehicles().map(|it| it.speed()).sum();
            world.step();
            let after: f64 = world.vehicles().map(|it| it.speed()).sum();
            hardest.max((before - after) / STEP)
        });
        let emergencies = world.counters().emergency_brakings - at_first;
        assert!(hardest < HARDEST + 1e-6 && emergencies == 0, "{start:?}: {hardest} m/s², {emergencies}");
    }
}

#[test]
fn who_waits_at_a_light_is_stuck_only_if_it_stays_red_for_very_long() {
    assert_eq!(stuck_before_a_red_of(280.0), 0);
    assert_eq!(stuck_before_a_red_of(1000.0), 1);
}
