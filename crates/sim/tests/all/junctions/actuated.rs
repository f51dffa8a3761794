//! Traffic lights with actuated greens.

use laneweave_generate::{Grid, grid};
use laneweave_maps::{Map, regulations};
use laneweave_network::{ChainIndex, Extension, LightIndex, LightState, Network, Sign, SignalPlan, Turn};
use laneweave_sim::{Command, Rate, Setup, World};

use crate::junctions::town::{STEP, assert_sound};
use crate::roads::drivers;

/// Maximum green [s].
const LONGEST: f64 = 40.0;

/// A junction of two streets with traffic lights.
fn junction() -> Network {
    let drawing = grid(&Grid { rows: 1, columns: 1, ..Grid::default() }).expect("the numbers make sense");
    let map = drawing.build().expect("the drawing is sound");
    let regulations = regulations(&map);
    let Map { network, .. } = map;
    network.regulated(&regulations)
}

/// Whether a lane starts on the street between east and west.
fn is_east_or_west(network: &Network, chain: ChainIndex) -> bool {
    network.chain(chain).centre.heading(0.0).cos().abs() > 0.5
}

/// The lights of the street between east and west, and those of the other street.
fn lights(network: &Network) -> [Vec<LightIndex>; 2] {
    let mut lights = [Vec::new(), Vec::new()];
    for index in (0..network.chains.len() as u32).map(ChainIndex) {
        for stop in &network.junctions.on(index).stops {
            if let Sign::Light(light) = stop.sign {
                lights[usize::from(!is_east_or_west(network, index))].push(light);
            }
        }
    }
    lights
}

/// A plan with one green for each street, actuated or not.
fn plan(network: &Network, green: f64, extension: Option<Extension>) -> SignalPlan {
    let turn = |lights| Turn { lights, green, extension, yellow: 3.0, all_red: 2.0 };
    SignalPlan { offset: 0.0, turns: lights(network).map(turn).into() }
}

fn actuated(network: &Network) -> SignalPlan {
    plan(network, LONGEST, Some(Extension::default()))
}

/// A world with a demand for each entrance of the first street, and of the other one [veh/h].
fn world(network: Network, plan: &SignalPlan, rates: [f64; 2]) -> World {
    let mut demand = drivers::demand(&network, 0.0, 0.1, &[0.3, 0.7]);
    for origin in &mut demand.origins {
        let is_first = is_east_or_west(&network, origin.place.chains()[0]);
        origin.rate = Rate::constant(rates[usize::from(!is_first)]);
    }
    let driver_parameters = vec![drivers::aggressive(), drivers::conservative()];
    let setup = Setup { step: STEP, seed: 1, threads: 1 };
    World::new(network.with_signals(std::slice::from_ref(plan)), driver_parameters, demand, setup)
        .expect("a world")
}

fn driven(mut world: World, seconds: f64, mut look: impl FnMut(&World)) -> World {
    for _ in 0..(seconds / STEP) as u32 {
        world.step();
        look(&world);
    }
    world
}

#[test]
fn the_main_road_stays_green_as_long_as_nobody_comes_from_the_other_one() {
    let network = junction();
    let ([main, _], plan) = (lights(&network), actuated(&network));
    let world = driven(world(network, &plan, [600.0, 0.0]), 600.0, |world| {
        assert!(main.iter().all(|it| world.scene().light(*it) == LightState::Green));
    });
    assert!(world.counts().left > 100);
    assert_sound(&world);
}

#[test]
fn whoever_comes_alone_to_a_red_light_soon_has_green() {
    let network = junction();
    let ([_, side], plan) = (lights(&network), actuated(&network));
    let mut waited: f64 = 0.0;
    let mut red_since = None;
    let world = driven(world(network, &plan, [0.0, 30.0]), 3600.0, |world| {
        let stands = world.vehicles().any(|it| it.speed() < 0.1);
        let is_red = side.iter().all(|it| world.scene().light(*it) == LightState::Red);
        red_since = if stands && is_red { red_since.or(Some(world.clock().time())) } else { None };
        waited = waited.max(red_since.map_or(0.0, |since| world.clock().time() - since));
    });
    // Yellow and all-red, and the time from detection until it stood.
    assert!(waited < 5.0, "{waited} s");
    assert!(world.counts().left > 40);
}

#[test]
fn with_queues_on_all_roads_greens_last_as_long_as_those_of_the_fixed_program() {
    let network = junction();
    let (all, plan) = (lights(&network).concat(), actuated(&network));
    let programs: Vec<_> = all.iter().map(|it| (*it, plan.program(*it))).collect();
    let (mut alike, mut all_steps) = (0, 0);
    let world = driven(world(network, &plan, [3000.0, 3000.0]), 900.0, |world| {
        let time = world.clock().time();
        // Until there are queues, traffic ends the first greens.
        if time > 300.0 {
            let states: Vec<_> = programs.iter().map(|it| world.scene().light(it.0)).collect();
            let greens = states.iter().filter(|it| **it == LightState::Green).count();
            alike += greens;
            all_steps += programs.len();
        }
    });
    let expected = programs.iter().map(|it| it.1.green_share()).sum::<f64>() / programs.len() as f64;
    let found = alike as f64 / all_steps as f64;
    assert!((found / expected - 1.0).abs() < 0.02, "{found}, not {expected}");
    assert_sound(&world);
}

#[test]
fn with_little_traffic_from_one_road_delays_are_shorter_than_with_fixed_greens() {
    let delay = |plan: fn(&Network) -> SignalPlan| {
        let network = junction();
        let plan = plan(&network);
        let world = driven(world(network, &plan, [500.0, 60.0]), 1800.0, |_| {});
        assert_sound(&world);
        world.counts().delay / world.counts().planned as f64
    };
    let by_traffic = delay(actuated);
    let longest = delay(|network| plan(network, LONGEST, None));
    let usual = delay(|network| plan(network, 25.0, None));
    eprintln!("{by_traffic:.1} s by traffic, {longest:.1} s with 40 s of green, {usual:.1} s with 25 s");
    assert!(by_traffic < 0.6 * usual && usual < longest, "{by_traffic} s, {usual} s, {longest} s");
}

#[test]
fn actuated_lights_are_the_same_on_any_number_of_threads_and_in_any_order_of_storage() {
    let town = |threads: usize, is_reversed: bool| {
        let network = crate::roads::network("grid.osm");
        let plans: Vec<_> = network.junctions.made.iter().cloned().map(SignalPlan::actuated).collect();
        let network = network.with_signals(&plans);
        let network = if is_reversed { network.with_chains_reversed() } else { network };
        let demand = drivers::demand(&network, 20_000.0, 0.1, &[0.3, 0.7]);
        let driver_parameters = vec![drivers::aggressive(), drivers::conservative()];
        let setup = Setup { step: STEP, seed: 1, threads };
        let world = World::new(network, driver_parameters, demand, setup).expect("a world");
        let world = driven(world, 180.0, |_| {});
        let (on_road, left) = (world.on_road(), world.counts().left);
        assert!(on_road > 300 && left > 100, "{on_road} on the road, {left} left");
        assert_sound(&world);
        world.state_hash()
    };
    let hash = town(1, false);
    assert_eq!(town(2, false), hash);
    assert_eq!(town(1, true), hash);
}

#[test]
fn a_plan_that_traffic_extends_has_no_offset() {
    let network = junction();
    let (plan, light) = (actuated(&network), network.junctions.lights[0].id);
    let mut world = world(network, &plan, [0.0; 2]);
    let refused = world.command(Command::SetOffset { light, offset_s: 5.0 }).map_err(|it| it.to_string());
    let said = refused.expect_err("traffic extends its greens");
    assert!(said.contains("traffic extends its greens; choose a light with a fixed plan"), "{said}");
}
