//! Arrivals: a Poisson process, with classes drawn by shares, that nothing on the road delays.

use crate::roads::{Road, drivers};
use laneweave_generate::{Motorway, motorway};
use laneweave_models::Style;
use laneweave_network::Network;
use laneweave_sim::{Demand, Event, Fleet, Headways, Origin, Rate, Setup, World, WorldError};

fn styles() -> Vec<Style> {
    vec![drivers::aggressive(), drivers::conservative()]
}

fn world(network: Network, demand: Demand, step: f64) -> World {
    World::new(network, styles(), demand, Setup { step, seed: 11, threads: 1 })
        .expect("the set-up makes sense")
}

#[test]
fn v27_arrivals_within_ten_seconds_are_poisson() {
    const BINS: u32 = 20_000;
    const MEAN: f64 = 2.5;
    let network = Road { length: 510.0, ..Road::default() }.network();
    let demand = drivers::demand(&network, 900.0, 0.0, &[0.5, 0.5]);
    let mut world = world(network, demand, 1.0);
    let counts: Vec<u64> = (0..BINS)
        .map(|_| {
            let before = world.arrived();
            (0..10).for_each(|_| world.step());
            world.arrived() - before
        })
        .collect();
    let n = f64::from(BINS);
    let mean = counts.iter().sum::<u64>() as f64 / n;
    let variance = counts.iter().map(|it| (*it as f64 - mean).powi(2)).sum::<f64>() / (n - 1.0);
    // The mean headway is 4 s, within 1.96 standard errors.
    let headway = 10.0 / mean;
    assert!((headway - 4.0).abs() < 1.96 * 4.0 / (n * MEAN).sqrt(), "{headway} s");
    assert!((variance / mean - 1.0).abs() < 0.05, "dispersion {}", variance / mean);
    for (count, probability) in [(0, 0.082085), (1, 0.205212), (2, 0.256516)] {
        let share = counts.iter().filter(|it| **it == count).count() as f64 / n;
        let error = (probability * (1.0 - probability) / n).sqrt();
        assert!((share - probability).abs() < 3.0 * error, "{share} of the bins hold {count}");
    }
    // The counts of neighbouring bins are uncorrelated.
    let products = counts.windows(2).map(|it| (it[0] as f64 - mean) * (it[1] as f64 - mean)).sum::<f64>();
    let autocorrelation = products / ((n - 1.0) * variance);
    assert!(autocorrelation.abs() < 1.96 / n.sqrt(), "{autocorrelation}");
}

#[test]
fn arrivals_in_each_lane_follow_the_law_of_headways() {
    const LANES: usize = 2;
    const RATE: f64 = 1800.0;
    let law = Headways::CowanM3 { minimum: 1.5, free: 0.6 };
    let network = Road { lanes: LANES, length: 60.0, ..Road::default() }.network();
    let demand = Demand { headways: law, ..drivers::demand(&network, RATE, 0.0, &[0.5, 0.5]) };
    let mut world = world(network, demand, 0.1);
    let mut times = Vec::new();
    for _ in 0..200_000 {
        let before = world.arrived();
        world.step();
        times.extend((before..world.arrived()).map(|_| world.clock().time()));
    }
    let n = times.len() as f64;
    // Two streams, each with a mean of 4 s and a standard deviation of (4 − 1.5) √(2/0.6 − 1) s.
    let deviation = 2.5 * (2.0_f64 / 0.6 - 1.0).sqrt();
    let mean = 20_000.0 / n;
    assert!((mean - 2.0).abs() < 2.6 * 2.0 * deviation / 4.0 / n.sqrt(), "{mean} s");
    // There are never three in less than the minimum headway: that would take three lanes.
    assert!(times.windows(3).all(|it| it[2] - it[0] > 1.5 - 0.11));
}

#[test]
fn the_rate_of_arrivals_changes_when_it_should() {
    let network = Road { length: 510.0, ..Road::default() }.network();
    for headways in
        [Headways::Exponential, Headways::Shifted { minimum: 1.0 }, Headways::Erlang { stages: 3 }]
    {
        let mut demand = Demand { headways, ..drivers::demand(&network, 0.0, 0.0, &[1.0]) };
        let hour = 3600.0;
        demand.origins[0].rate =
            Rate::by_pieces(&[(hour, 900.0), (11.0 * hour, 0.0), (12.0 * hour, 1800.0)]).unwrap();
        let mut world = world(network.clone(), demand, 1.0);
        let mut until = |hours: u32| {
            let before = world.arrived();
            (world.clock().step..3600 * hours).for_each(|_| world.step());
            (world.arrived() - before) as f64
        };
        let counts = [until(1), until(11), until(12), until(22)];
        assert_eq!((counts[0], counts[2]), (0.0, 0.0), "{headways:?}");
        for (count, expected) in [(counts[1], 9000.0_f64), (counts[3], 18_000.0)] {
            assert!(
                (count - expected).abs() < 2.6 * expected.sqrt(),
                "{headways:?}: {count}, not {expected}"
            );
        }
    }
}

#[test]
fn a_full_road_delays_no_arrival() {
    let arrivals = |lanes| {
        let network = Road { lanes, length: 1000.0, ..Road::default() }.network();
        let demand = drivers::demand(&network, 4000.0, 0.1, &[0.5, 0.5]);
        let mut world = world(network, demand, 0.1);
        let arrived: Vec<u64> = (0..6000)
            .map(|_| {
                world.step();
                world.arrived()
            })
            .collect();
        (arrived, world.waiting())
    };
    let ((one, waiting_for_one), (four, waiting_for_four)) = (arrivals(1), arrivals(4));
    assert!(waiting_for_one > 100 && waiting_for_four == 0);
    assert_eq!(one, four);
}

#[test]
fn classes_styles_and_destinations_come_in_their_shares() {
    let plan = Motorway { length_m: 2000.0, off_ramp_at: vec![1000.0], ..Motorway::default() };
    let network = motorway(&plan).unwrap().build().unwrap().network;
    assert_eq!(network.exits.len(), 2);
    let fleet = Fleet { trucks: 0.1, buses: 0.05, motorcycles: 0.2, ..Fleet::default() };
    let demand = Demand { fleet, ..drivers::demand(&network, 3000.0, 0.0, &[0.119, 0.881]) };
    let mut world = world(network, demand, 0.5);
    let (mut entered, mut classes, mut aggressive, mut to_the_ramp) = (0.0_f64, [0.0; 4], 0.0, 0.0);
    for _ in 0..2 * 3600 {
        world.step();
        let is_new = |id| world.events().contains(&Event::Entered(id));
        for vehicle in world.vehicles().filter(|it| it.x() < 60.0 && is_new(it.id())) {
            entered += 1.0;
            classes[vehicle.driver.class as usize] += 1.0;
            aggressive += f64::from(u8::from(vehicle.style().name == "aggressive"));
            to_the_ramp += f64::from(u8::from(vehicle.driver.goal.destination() == Some(1)));
        }
    }
    assert_eq!(entered as u64, world.counts().entered);
    let of_classes = classes.into_iter().zip([0.65, 0.1, 0.05, 0.2]);
    for (count, share) in of_classes.chain([(aggressive, 0.119), (to_the_ramp, 0.5)]) {
        let error = (share * (1.0 - share) / entered).sqrt();
        assert!((count / entered - share).abs() < 2.6 * error, "{} of {entered}", count / entered);
    }
}

#[test]
fn drivers_of_each_origin_go_to_its_own_destinations() {
    let plan = Motorway {
        length_m: 3000.0,
        on_ramp_at: vec![1000.0],
        off_ramp_at: vec![2000.0],
        ..Motorway::default()
    };
    let network = motorway(&plan).unwrap().build().unwrap().network;
    let mut demand = drivers::demand(&network, 3000.0, 0.1, &[0.5, 0.5]);
    (demand.origins[0].weights, demand.origins[1].weights) = (vec![300.0, 100.0], vec![0.0, 50.0]);
    let mut world = world(network, demand, 0.5);
    let mut counts = [[0.0_f64; 2]; 2];
    for _ in 0..2 * 3600 {
        world.step();
        let is_new = |id| world.events().contains(&Event::Entered(id));
        for vehicle in world.vehicles().filter(|it| is_new(it.id())) {
            let origins = &world.demand().origins;
            let at = |origin: &Origin| origin.place.chains().contains(&vehicle.spot.chain);
            let origin = origins.iter().position(at).unwrap();
            counts[origin][usize::from(vehicle.driver.goal.destination().unwrap())] += 1.0;
        }
    }
    let [[onward, off], from_the_ramp] = counts;
    assert_eq!(from_the_ramp[0], 0.0);
    assert!(from_the_ramp[1] > 500.0);
    let (share, all) = (off / (onward + off), onward + off);
    assert!((share - 0.25).abs() < 2.6 * (0.25 * 0.75 / all).sqrt(), "{share} of {all}");
}

#[test]
fn entrances_share_the_demand_by_their_lanes() {
    let plan = Motorway { length_m: 2000.0, on_ramp_at: vec![1000.0], ..Motorway::default() };
    let network = motorway(&plan).unwrap().build().unwrap().network;
    let lanes: Vec<usize> = network.entrances.iter().map(|it| it.chains.len()).collect();
    assert_eq!(lanes, [3, 1]);
    let demand = drivers::demand(&network, 4000.0, 0.0, &[1.0]);
    let rates: Vec<&Rate> = demand.origins.iter().map(|it| &it.rate).collect();
    assert_eq!(rates, [&Rate::constant(3000.0), &Rate::constant(1000.0)]);
    assert!(demand.origins.iter().all(|it| it.weights == [1.0]));
}

#[test]
fn a_demand_or_step_without_sense_is_refused_with_its_value() {
    let network = || Road::default().network();
    let refusal = |change: &dyn Fn(&mut Demand), step| {
        let mut demand = drivers::demand(&network(), 100.0, 0.1, &[0.5, 0.5]);
        change(&mut demand);
        World::new(network(), styles(), demand, Setup { step, seed: 1, threads: 1 }).err()
    };
    let message = |change: &dyn Fn(&mut Demand)| refusal(change, 0.1).unwrap().to_string();
    assert_eq!(refusal(&|_| (), 0.1), None);
    assert_eq!(refusal(&|_| (), 0.001), Some(WorldError::Step(0.001)));
    assert!(matches!(refusal(&|_| (), f64::NAN), Some(WorldError::Step(_))));
    assert_eq!(
        message(&|it| it.origins[0].rate = Rate::constant(-1.0)),
        "a demand in veh/h is -1: it must be a number not below 0 and not above 100000"
    );
    assert_eq!(
        message(&|it| it.fleet.trucks = 1.5),
        "the share of trucks is 1.5: it must be a number not below 0 and not above 1"
    );
    assert_eq!(
        message(&|it| it.fleet = Fleet { trucks: 0.5, buses: 0.5, motorcycles: 0.25, ..Fleet::default() }),
        "the share of cars is -0.25: it must be a number not below 0 and not above 1"
    );
    assert_eq!(
        message(&|it| it.origins[0].weights[0] = f64::NAN),
        "the weight of an exit is NaN: it must be a number not below 0"
    );
    assert_eq!(refusal(&|it| it.population.clear(), 0.1), Some(WorldError::NoDriverParameters));
    assert_eq!(
        refusal(&|it| it.population.iter_mut().for_each(|share| share.weight = 0.0), 0.1),
        Some(WorldError::NoDriverParameters)
    );
}
