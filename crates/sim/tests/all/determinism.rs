//! The order of vehicles, of chains and of threads changes nothing, bit for bit. The same holds for a mirrored road,
//! and for drivers who look no further because of the gain bound.

use crate::roads::{Road, drivers};
use laneweave_generate::{Motorway, motorway};
use laneweave_models::change::{LaneChangeModel, Mcdm, Rule};
use laneweave_models::{Attention, Style};
use laneweave_network::{ChainIndex, Network};
use laneweave_sim::{Class, Placement, Setup, World};

/// Five lanes of 10 km with an on-ramp and an off-ramp.
fn ramps() -> Network {
    let plan = Motorway {
        lanes: 5,
        length_m: 10_000.0,
        on_ramp_at: vec![1000.0],
        off_ramp_at: vec![2500.0],
        lanelet_length_m: 200.0,
        ..Motorway::default()
    };
    motorway(&plan).expect("the motorway is possible").build().expect("the drawing is sound").network
}

/// An aggressive style, and a conservative style that is inattentive at times.
fn styles() -> Vec<Style> {
    let attention = Attention { concentrated_for: 20.0, inattentive_for: 20.0, ..Attention::default() };
    vec![drivers::aggressive(), Style { attention, ..drivers::conservative() }]
}

/// Hash of the state after six minutes of dense traffic of both styles with trucks: enough to be shared among
/// threads.
fn hash(network: Network, seed: u64, threads: usize) -> u64 {
    hash_with(styles(), network, seed, threads)
}

fn hash_with(styles: Vec<Style>, network: Network, seed: u64, threads: usize) -> u64 {
    let demand = drivers::demand(&network, 9000.0, 0.1, &[0.3, 0.7]);
    let mut world = World::new(network, styles, demand, Setup { step: 0.1, seed, threads })
        .expect("the set-up makes sense");
    (0..3600).for_each(|_| world.step());
    assert!(world.on_road() > 320);
    assert!(world.counts().discretionary_changes > 20 && world.counts().route_changes > 20);
    world.state_hash()
}

#[test]
fn v29_neither_threads_nor_the_storage_of_chains_nor_a_second_run_changes_a_bit() {
    let first = hash(ramps(), 1, 1);
    assert_eq!(hash(ramps(), 1, 1), first);
    assert_eq!(hash(ramps(), 1, 2), first);
    assert_eq!(hash(ramps(), 1, 4), first);
    assert_eq!(hash(ramps().with_chains_reversed(), 1, 1), first);
}

#[test]
fn who_looks_closely_at_every_lane_decides_as_those_for_whom_a_bound_of_the_gain_is_enough() {
    // With any weight on discomfort, however small, the bound is not valid. So small a weight changes no bit of a
    // gain.
    let with_comfort = |weight: f64| {
        styles().into_iter().map(move |style| {
            let LaneChangeModel::Mcdm(mut mcdm) = style.change else { unreachable!() };
            mcdm.comfort.weight = weight;
            Style { change: LaneChangeModel::Mcdm(mcdm), ..style }
        })
    };
    let [by_the_bound, closely] = [0.0, -1e-300].map(|it| with_comfort(it).collect());
    assert_eq!(hash_with(closely, ramps(), 1, 2), hash_with(by_the_bound, ramps(), 1, 2));
}

/// Hash of cars and trucks on a ring road of three lanes. They pass the ends of chains again and again, also during
/// changes.
fn hash_of_a_ring(is_reversed: bool, threads: usize) -> u64 {
    const CARS: u32 = 60;
    const STEPS: usize = 2000;
    let road = Road { lanes: 3, length: 1000.0, is_ring: true, ..Road::default() };
    let network = if is_reversed { road.network().with_chains_reversed() } else { road.network() };
    let nobody = drivers::demand(&network, 0.0, 0.0, &[1.0]);
    let setup = Setup { step: 0.1, seed: 1, threads };
    let mut world = World::new(network, styles(), nobody, setup).expect("the set-up makes sense");
    for number in 0..CARS {
        let lane = number % 3;
        world
            .place(Placement {
                chain: ChainIndex(if is_reversed { 2 - lane } else { lane }),
                x: 15.0 + 16.0 * f64::from(number),
                speed: 12.0,
                class: if number % 10 == 0 { Class::Truck } else { Class::Car },
                parameters: number % 2,
                destination: None,
            })
            .expect("it fits on the road");
    }
    for _ in 0..STEPS {
        world.step();
        assert_eq!(world.on_road(), CARS as usize);
    }
    assert!(world.counts().discretionary_changes > 30);
    assert_eq!((world.counters().collisions, world.counters().overlaps, world.counters().stuck), (0, 0, 0));
    world.state_hash()
}

#[test]
fn v29_nor_do_they_where_chains_end_in_the_middle_of_changes() {
    let first = hash_of_a_ring(false, 1);
    for (is_reversed, threads) in [(false, 2), (true, 1)] {
        assert_eq!(hash_of_a_ring(is_reversed, threads), first);
    }
}

#[test]
fn v29_another_seed_is_another_run() {
    let hashes = [1, 2, 3].map(|seed| hash(ramps(), seed, 1));
    assert!(hashes[0] != hashes[1] && hashes[1] != hashes[2] && hashes[2] != hashes[0]);
}

/// The style without random choice and with a low threshold: it wants to change when G > θ.
fn resolute(style: Style) -> Style {
    let LaneChangeModel::Mcdm(mcdm) = style.change else { unreachable!() };
    let change = LaneChangeModel::Mcdm(Mcdm { rule: Rule::Threshold, theta: 0.02, ..mcdm });
    Style { change, attention: Attention::default(), ..style }
}

#[test]
fn v29_the_order_in_which_vehicles_are_put_on_the_road_changes_nothing_but_their_names() {
    // The spacing is so large that no two vehicles ever ask for one gap in the same step. Their ids would decide
    // that.
    const VEHICLES: u32 = 90;
    const STEPS: usize = 70;
    // With a step as long as an epoch, no random number is drawn when a driver begins.
    let setup = Setup { step: 1.0, seed: 1, threads: 1 };
    let run = |order: &mut dyn Iterator<Item = u32>| {
        let network = Road { lanes: 2, length: 4000.0, ..Road::default() }.network();
        let nobody = drivers::demand(&network, 0.0, 0.0, &[1.0]);
        let driver_parameters = styles().into_iter().map(resolute).collect();
        let mut world = World::new(network, driver_parameters, nobody, setup).unwrap();
        let mut number_of = Vec::new();
        for number in order {
            number_of.push(number);
            world
                .place(Placement {
                    chain: ChainIndex(number % 2),
                    x: 20.0 + 40.0 * f64::from(number),
                    speed: 18.0 + f64::from(number * 7 % 9),
                    class: if number % 10 == 0 { Class::Truck } else { Class::Car },
                    parameters: u32::from(number % 4 != 0),
                    destination: Some(0),
                })
                .expect("it fits on the road");
        }
        (0..STEPS).for_each(|_| world.step());
        let mut state: Vec<_> = world
            .vehicles()
            .map(|it| (number_of[it.id() as usize], it.spot.chain, it.x().to_bits(), it.speed().to_bits()))
            .collect();
        state.sort_unstable();
        (state, world.counts().discretionary_changes)
    };
    let (forward, changes) = run(&mut (0..VEHICLES));
    assert!(changes > 10 && forward.len() > 50, "{changes} changes, {} on the road", forward.len());
    let (backward, _) = run(&mut (0..VEHICLES).rev());
    assert!(backward == forward, "{changes} changes went another way");
}

#[test]
fn v38_a_mirrored_road_mirrors_all_trajectories() {
    const MINUTES: u32 = 4;
    let world = |is_mirrored| {
        let network = Road { lanes: 3, length: 3000.0, is_mirrored, ..Road::default() }.network();
        let demand = drivers::demand(&network, 4500.0, 0.15, &[0.5, 0.5]);
        World::new(network, styles(), demand, Setup { step: 0.1, seed: 5, threads: 1 }).unwrap()
    };
    let (mut original, mut image) = (world(false), world(true));
    for _ in 0..MINUTES * 600 {
        original.step();
        image.step();
        assert_eq!(original.on_road(), image.on_road());
        for (one, other) in original.vehicles().zip(image.vehicles()) {
            assert_eq!((one.id(), one.spot, one.driver.phase), (other.id(), other.spot, other.driver.phase));
            assert_eq!(one.x().to_bits(), other.x().to_bits());
            assert_eq!(one.speed().to_bits(), other.speed().to_bits());
            assert_eq!(one.lateral_offset(), -other.lateral_offset());
            let (pose, mirrored) = (one.pose(), other.pose());
            assert_eq!((pose.at.x, pose.at.y), (mirrored.at.x, -mirrored.at.y));
            assert_eq!(pose.heading, -mirrored.heading);
        }
    }
    assert!(original.counts().discretionary_changes > 50);
}
