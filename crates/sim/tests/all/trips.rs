//! Records of trips: delay against the free travel time, number of stops, and reasons for waiting.

use laneweave_generate::{Grid, grid};
use laneweave_maps::regulations;
use laneweave_network::{ChainIndex, Network};
use laneweave_sim::{Class, Held, Placement, Setup, World, entry_queues};

use crate::roads::{drivers, motorway_with_ramps};

const STEP: f64 = 0.1;

/// A grid of two streets with lights and `rows` rows. With one row it has no loops.
fn streets(rows: usize) -> Network {
    let drawing = grid(&Grid { rows, columns: 2, ..Grid::default() }).expect("it can be made");
    let map = drawing.build().expect("it can be made");
    let regulations = regulations(&map);
    map.network.regulated(&regulations)
}

fn world(network: Network, per_hour: f64) -> World {
    let demand = drivers::demand(&network, per_hour, 0.0, &[0.9, 0.1]);
    let setup = Setup { step: STEP, seed: 1, threads: 1 };
    World::new(network, vec![drivers::conservative(), drivers::aggressive()], demand, setup)
        .expect("it can be made")
}

/// Places one moving vehicle at the start of `chain`.
fn place(world: &mut World, class: Class, chain: ChainIndex, destination: u16) {
    let style = drivers::conservative();
    let speed = laneweave_sim::desired_speed(
        class,
        &style,
        world.network().chain(chain).limit(0.0),
        &world.network().law,
    );
    let x = class.body().length;
    world
        .place(Placement { chain, x, speed, class, parameters: 0, destination: Some(destination) })
        .expect("it fits on the road");
}

#[test]
fn who_is_alone_on_a_motorway_is_not_delayed_wherever_it_goes() {
    for class in [Class::Car, Class::Truck] {
        for (exit, lane) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let mut world = world(motorway_with_ramps(2).network, 0.0);
            let start = world.network().entrances[0].chains[lane];
            place(&mut world, class, start, exit);
            while world.on_road() > 0 {
                world.step();
            }
            let counts = *world.counts();
            assert_eq!((counts.left, counts.planned, counts.stops), (1, 1, 0));
            assert!(counts.trip_time > 50.0);
            // The last step ends beyond the road. The ramp's limit is approached gently, which gains some seconds.
            let gained = if exit == 1 { 3.0 } else { STEP };
            assert!(
                (-gained..1.0).contains(&counts.delay),
                "{class:?} to {exit} from {lane}: {}",
                counts.delay
            );
        }
    }
}

#[test]
fn who_stands_at_a_red_light_has_stopped_once_and_is_delayed_for_as_long() {
    let mut seen = 0;
    for entrance in 0..streets(2).entrances.len() {
        let mut world = world(streets(2), 0.0);
        let start = world.network().entrances[entrance].chains[0];
        let destination =
            (0..world.demand().destinations.len()).find(|it| world.leads(entrance, *it)).unwrap();
        place(&mut world, Class::Car, start, destination as u16);
        let (mut halts, mut stood, mut stands) = (0, 0.0, false);
        while world.on_road() > 0 {
            world.step();
            let speed = world.vehicles().next().map_or(f64::INFINITY, |it| it.speed());
            // A vehicle that only moves up has not driven on.
            halts += u64::from(speed < 0.1 && !stands);
            stands = speed < if stands { 1.0 } else { 0.1 };
            stood += if speed < 0.1 { STEP } else { 0.0 };
        }
        let counts = world.counts();
        assert_eq!(counts.stops, halts, "from entrance {entrance}");
        assert!(counts.delay > stood, "{} s of delay, stood for {stood} s", counts.delay);
        seen += halts;
    }
    assert!(seen >= 4, "{seen} halts");
}

/// Times for which the first vehicles of all queues were blocked for each reason, in ten minutes [s].
fn held(mut world: World) -> Vec<(Held, u32)> {
    let mut times: Vec<(Held, u32)> = Held::ALL.into_iter().map(|it| (it, 0)).collect();
    for step in 0..6000 {
        world.step();
        if step % 10 > 0 {
            continue;
        }
        let queues: Vec<_> = entry_queues(&world).collect();
        assert_eq!(queues.iter().map(|it| it.waiting).sum::<usize>(), world.waiting());
        assert!(queues.iter().all(|it| it.held.is_some() == (it.waiting > 0)));
        for held in queues.iter().filter_map(|it| it.held) {
            times.iter_mut().filter(|it| it.0 == held).for_each(|it| it.1 += 1);
        }
    }
    times
}

#[test]
fn who_cannot_enter_knows_why() {
    let on_motorway = held(world(motorway_with_ramps(2).network, 7500.0));
    let before_lights = held(world(streets(1), 8000.0));
    let before_a_full_town = held(world(streets(2), 8000.0));
    let of = |times: &[(Held, u32)], held| times.iter().find(|it| it.0 == held).unwrap().1;
    assert!(of(&on_motorway, Held::Traffic) > 300, "{on_motorway:?}");
    assert_eq!(of(&on_motorway, Held::RedLight) + of(&on_motorway, Held::Space), 0, "{on_motorway:?}");
    assert!(of(&before_lights, Held::RedLight) > 300, "{before_lights:?}");
    assert_eq!(of(&before_lights, Held::FullMap), 0, "{before_lights:?}");
    assert!(of(&before_a_full_town, Held::FullMap) > 300, "{before_a_full_town:?}");
}
